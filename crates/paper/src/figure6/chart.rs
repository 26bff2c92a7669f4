//! The picture of figure 6: diagrams over several clearances, their boundaries, and where the strip is pierced.
//! Largest positions above, before-impact velocities below, up and down (Peterka 2003).

use softstop_dynamics::sweep::{Chain, Direction, Jump, Step};

use super::piercing::{self, Ranges};
use crate::diagram::is_one;
use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Pen, Stroke};
use softstop_draw::style;

/// A colour for each clearance, in the order of the rainbow, all of Okabe and Ito's.
const COLOURS: [&str; 6] = [
    "#D55E00", "#E69F00", "#009E73", "#56B4E9", "#0072B2", "#CC79A7",
];
/// Pixels for each unit of length.
const SCALE: f32 = 2.0;
const WIDTH: f64 = 1200.0;
/// Left and right end of the panels.
const SIDES: (f64, f64) = (84.0, 1176.0);
/// Height of the panels.
const HEIGHT: f64 = 560.0;
/// Size of letters, and of the dots.
const LETTERS: u32 = 15;
const DOT: f64 = 0.65;
/// Height of a jump on the page that has an arrow.
const SEEN: f64 = 16.0;
/// Largest position and velocity that the panels show.
const TOP: (f64, f64) = (27.0, 20.0);

/// Lines of the boundaries.
const RESPONSE: Stroke = Stroke::solid(style::INK, 1.5);
const FOLD: Stroke = Stroke::dashed(style::INK, 1.7, (8.0, 4.0));
const FLIP: Stroke = Stroke::dashed(style::INK, 1.7, (2.0, 3.0));

/// The diagram of one clearance.
#[derive(Debug, Clone)]
pub struct ClearanceRow {
    /// rho.
    pub clearance: f64,
    /// The sweeps up and down.
    pub ways: [Chain; 2],
}

/// Boundaries across the clearances; points are eta, X_m and X'- of z = 1 there.
#[derive(Debug, Clone, Default)]
pub struct Boundaries {
    /// Amplitude of the free mass over eta.
    pub response: Vec<(f64, f64)>,
    /// z = 1 at the grazing g0 above resonance.
    pub grazing: Vec<[f64; 3]>,
    /// s_SN in pieces.
    pub folds: Vec<Vec<[f64; 3]>>,
    /// s_PD in pieces.
    pub flips: Vec<Vec<[f64; 3]>>,
}

/// The picture.
#[derive(Debug, Clone)]
pub struct ClearanceChart<'a> {
    /// The diagrams, in rising order of the clearance.
    pub rows: &'a [ClearanceRow],
    /// The boundaries.
    pub boundaries: &'a Boundaries,
    /// Range of eta.
    pub range: (f64, f64),
    /// The paper's point: its name, eta, X_m, X'-.
    pub point: (&'static str, [f64; 3]),
    /// Ranges of eta in which the motion pierces the strip, up and down, for each diagram; none for a machine
    /// without a strip.
    pub piercing: Option<Vec<[Ranges; 2]>>,
    /// What it shows.
    pub title: String,
    /// How it was made.
    pub explanation: String,
}

impl ClearanceChart<'_> {
    /// As PNG.
    ///
    /// # Errors
    /// What the encoder says.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        let rows = self.piercing.as_deref();
        let strip = rows.map_or(0.0, |rows| 26.0 + piercing::height(rows.len()));
        let top = 74.0;
        let low = top + HEIGHT + 26.0 + strip;
        let mut pen = Pen::new(WIDTH, low + HEIGHT + 66.0);
        heading(&mut pen, (SIDES.0, 30.0), &self.title, &self.explanation);
        let panel = |top, highest| {
            Panel::new(
                (SIDES.0, top, SIDES.1 - SIDES.0, HEIGHT),
                self.range,
                (0.0, highest),
            )
        };
        self.positions(&mut pen, &panel(top, TOP.0));
        if let Some(rows) = rows {
            let top = top + HEIGHT + 26.0;
            let height = piercing::height(rows.len());
            let panel = Panel::new(
                (SIDES.0, top, SIDES.1 - SIDES.0, height),
                self.range,
                (0.0, 1.0),
            );
            let lines = rows.iter().zip(self.rows).zip(COLOURS);
            let lines = lines.map(|((ways, row), color)| (row.clearance, ways, color));
            piercing::draw(&mut pen, &panel, lines);
        }
        self.velocities(&mut pen, &panel(low, TOP.1));
        pen.png_at(SCALE)
    }

    fn positions(&self, pen: &mut Pen, panel: &Panel) {
        let axes = Axes::new(LETTERS, None, "largest position Xₘ", (10, 6));
        panel.ground(pen, &axes);
        self.diagrams(pen, panel, |step| match step.hardest() {
            0.0 => Vec::new(),
            _ => vec![step.max_position],
        });
        panel.curve(pen, &self.boundaries.response, RESPONSE);
        self.critical(pen, panel, 1);
        for row in self.rows {
            for (way, jump) in jumps(row) {
                let (from, to) = (position(row, way, jump.from), position(row, way, jump.to));
                arrow(pen, panel, (jump.from, from), (jump.to, to));
            }
        }
        self.names(pen, panel, 1);
        self.mark(pen, panel, 1);
        panel.axes(pen, &axes);
        self.legend(pen, panel);
    }

    fn velocities(&self, pen: &mut Pen, panel: &Panel) {
        let axes = Axes::new(
            LETTERS,
            Some("drive frequency η = ω/Ω"),
            "before-impact velocity X′₋",
            (10, 5),
        );
        panel.ground(pen, &axes);
        self.diagrams(pen, panel, |step| step.velocities.clone());
        panel.curve(pen, &pairs(&self.boundaries.grazing, 2), RESPONSE);
        self.critical(pen, panel, 2);
        for row in self.rows {
            for (_, jump) in jumps(row) {
                let (before, after) = jump.velocities;
                arrow(pen, panel, (jump.from, before), (jump.to, after));
            }
        }
        self.names(pen, panel, 2);
        self.mark(pen, panel, 2);
        panel.axes(pen, &axes);
    }

    /// Dots of all motions, and a line where z = 1 is stable.
    fn diagrams(&self, pen: &mut Pen, panel: &Panel, show: impl Fn(&Step) -> Vec<f64>) {
        for (row, color) in self.rows.iter().zip(COLOURS) {
            let steps = row.ways.iter().flat_map(|chain| &chain.steps);
            // What has not settled is on its way from one motion to another.
            let settled = steps.filter(|step| step.is_settled());
            let points = settled.flat_map(|step| {
                let value = step.value;
                show(step).into_iter().map(move |height| (value, height))
            });
            panel.dots(pen, points, DOT, color);
            for chain in &row.ways {
                let rising = chain.rising();
                for run in rising.chunk_by(|a, b| is_one(a) && is_one(b)) {
                    let line: Vec<(f64, f64)> = run
                        .iter()
                        .filter(|step| is_one(step))
                        .flat_map(|step| show(step).into_iter().map(|y| (step.value, y)))
                        .collect();
                    panel.curve(pen, &line, Stroke::solid(color, 2.6));
                }
            }
        }
    }

    fn critical(&self, pen: &mut Pen, panel: &Panel, which: usize) {
        for piece in &self.boundaries.folds {
            panel.curve(pen, &pairs(piece, which), FOLD);
        }
        for piece in &self.boundaries.flips {
            panel.curve(pen, &pairs(piece, which), FLIP);
        }
    }

    /// The clearance of each diagram, beside the end of its z = 1 or above its hardest impact.
    fn names(&self, pen: &mut Pen, panel: &Panel, which: usize) {
        for (row, color) in self.rows.iter().zip(COLOURS) {
            let steps = row.ways.iter().flat_map(|chain| &chain.steps);
            let ones = steps.filter(|step| is_one(step));
            let height = |step: &&Step| match which {
                1 => step.value,
                _ => step.hardest(),
            };
            let Some(step) = ones.max_by(|a, b| height(a).total_cmp(&height(b))) else {
                continue;
            };
            let text = format!("ρ = {}", row.clearance);
            let (height, shift, align) = match which {
                1 => (step.max_position, (12.0, -4.0), Align::Left),
                _ => (step.hardest(), (-7.0, -6.0), Align::Right),
            };
            let (x, y) = panel.place((step.value, height));
            let place = (x + shift.0, y + shift.1);
            pen.words(place, LETTERS, align, (color, which == 1), &text);
        }
    }

    fn mark(&self, pen: &mut Pen, panel: &Panel, which: usize) {
        let (name, at) = self.point;
        let (x, y) = panel.place((at[0], at[which]));
        pen.spot((x, y), 5.0);
        pen.words(
            (x + 9.0, y + 18.0),
            LETTERS + 2,
            Align::Left,
            (style::INK, true),
            name,
        );
    }

    fn legend(&self, pen: &mut Pen, panel: &Panel) {
        let entries = [
            (
                RESPONSE,
                "g₀  amplitude of the free mass: impacts begin where it is ρ",
            ),
            (FOLD, "s_SN  fold: z = 1 ends"),
            (FLIP, "s_PD  flip: the period of z = 1 doubles"),
            (
                Stroke::solid(style::ASIDE, 2.6),
                "z = 1, stable (in the colour of its ρ)",
            ),
        ];
        let left = panel.right() - 500.0;
        let mut y = panel.area.1 + 24.0;
        pen.tint((left - 14.0, y - 18.0, 506.0, 126.0), "#ffffff", 0.9);
        for (stroke, text) in entries {
            pen.line(&[(left, y - 5.0), (left + 40.0, y - 5.0)], stroke);
            pen.text((left + 50.0, y), LETTERS - 1, Align::Left, text);
            y += 20.0;
            if stroke.width == RESPONSE.width && stroke.dashes.is_none() {
                let more = "(lower panel: X′₋ of z = 1 there, above resonance)";
                pen.text((left + 82.0, y), LETTERS - 1, Align::Left, more);
                y += 20.0;
            }
        }
    }
}

fn pairs(points: &[[f64; 3]], which: usize) -> Vec<(f64, f64)> {
    points.iter().map(|at| (at[0], at[which])).collect()
}

/// Jumps between rest from impacts and z = 1.
fn jumps(row: &ClearanceRow) -> Vec<(Direction, Jump)> {
    let all = row.ways.iter().flat_map(|chain| {
        let jumps = chain.jumps().into_iter();
        jumps.map(move |jump| (chain.direction, jump))
    });
    let impacts = |jump: &Jump| {
        let regimes = [jump.before.regime()?, jump.after.regime()?];
        let one = |impacts| {
            regimes
                .iter()
                .any(|it| (it.impacts, it.periods) == (impacts, 1))
        };
        Some(one(0) && one(1))
    };
    all.filter(|(_, jump)| impacts(jump) == Some(true))
        .collect()
}

/// X_m of a step.
fn position(row: &ClearanceRow, way: Direction, value: f64) -> f64 {
    let chain = row.ways.iter().find(|chain| chain.direction == way);
    let step = chain.and_then(|chain| chain.steps.iter().find(|step| step.value == value));
    step.map_or(f64::NAN, |step| step.max_position)
}

fn arrow(pen: &mut Pen, panel: &Panel, from: (f64, f64), to: (f64, f64)) {
    let (from, to) = (panel.place(from), panel.place(to));
    if (from.1 - to.1).abs() > SEEN {
        pen.arrow(from, to, Stroke::solid(style::ASIDE, 1.2));
    }
}
