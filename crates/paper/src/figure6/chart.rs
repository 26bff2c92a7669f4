//! The picture of figure 6: diagrams over several clearances, their boundaries, and where the strip is pierced.
//! Largest positions above, before-impact velocities below, up and down (Peterka 2003).

use super::RANGE;
use super::boundaries::Boundaries;
use crate::diagram::{is_one, steps};
use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Pen, Stroke};
use softstop_draw::shade::ordered;
use softstop_draw::style;
use softstop_dynamics::sweep::Jump;
use softstop_dynamics::{Chain, Step};

/// Pixels for each unit of length.
const SCALE: f32 = 2.0;
const WIDTH: f64 = 1200.0;
/// Left and right end of the panels, top of the first, height, and room between them.
const SIDES: (f64, f64) = (84.0, 1176.0);
const TOP: f64 = 74.0;
const HEIGHT: f64 = 560.0;
const BETWEEN: f64 = 26.0;
/// Size of letters, and of the dots.
const LETTERS: u32 = 15;
const DOT: f64 = 0.65;
/// Height of a couple of lines where the strip is pierced.
const ROW: f64 = 19.0;
/// Height of a jump on the page that has an arrow.
const SEEN: f64 = 16.0;
/// The axes of both panels, and the largest position and velocity that they show.
const PANELS: [(Axes<'static>, f64); 2] = [
    (
        Axes::new(LETTERS, None, "largest position Xₘ", (10, 6)),
        27.0,
    ),
    (
        Axes::new(
            LETTERS,
            Some("drive frequency η = ω/Ω"),
            "before-impact velocity X′₋",
            (10, 5),
        ),
        20.0,
    ),
];

/// Lines of the boundaries.
const RESPONSE: Stroke = Stroke::solid(style::INK, 1.5);
const FOLD: Stroke = Stroke::dashed(style::INK, 1.7, (8.0, 4.0));
const FLIP: Stroke = Stroke::dashed(style::INK, 1.7, (2.0, 3.0));

/// The picture.
pub(super) struct Chart<'a> {
    /// The sweeps up and down of each clearance, in its rising order.
    pub(super) chains: &'a [Chain],
    pub(super) boundaries: &'a Boundaries,
    /// The paper's point: its name, eta, X_m, X'-.
    pub(super) point: (&'static str, [f64; 3]),
    pub(super) is_loaded: bool,
    /// How it was made.
    pub(super) explanation: String,
}

/// Which value of eta, X_m and X'- a panel shows over the first.
type Which = usize;

impl Chart<'_> {
    pub(super) fn png(&self) -> Result<Vec<u8>, String> {
        let strip = height_of(self.chains.len());
        let below = TOP + HEIGHT + BETWEEN;
        let low = if self.is_loaded {
            below + BETWEEN + strip
        } else {
            below
        };
        let mut pen = Pen::new(WIDTH, low + HEIGHT + 66.0);
        let title = match self.is_loaded {
            false => "Impact motion without piercing (unloaded machine), ρ = 2, 6, …, 22",
            true => "Impact motion with piercing (loaded machine), ρ = 2, 6, …, 22",
        };
        heading(&mut pen, (SIDES.0, 30.0), title, &self.explanation);
        let panel = |top, height, highest| {
            let area = (SIDES.0, top, SIDES.1 - SIDES.0, height);
            Panel::new(area, RANGE, (0.0, highest))
        };
        let upper = panel(TOP, HEIGHT, PANELS[0].1);
        self.draw(&mut pen, &upper, 1);
        legend(&mut pen, &upper);
        if self.is_loaded {
            let panel = panel(below, strip, 1.0);
            pierced(&mut pen, &panel, self.chains);
        }
        self.draw(&mut pen, &panel(low, HEIGHT, PANELS[1].1), 2);
        pen.png_at(SCALE)
    }

    fn draw(&self, pen: &mut Pen, panel: &Panel, which: Which) {
        let axes = &PANELS[which - 1].0;
        let boundaries = self.boundaries;
        panel.ground(pen, axes);
        for (ways, color) in self.rows() {
            diagram(pen, panel, ways, color, which);
        }
        let response = match which {
            1 => boundaries.response.clone(),
            _ => pairs(&boundaries.grazing, which),
        };
        panel.curve(pen, &response, RESPONSE);
        for (pieces, stroke) in [(&boundaries.folds, FOLD), (&boundaries.flips, FLIP)] {
            for piece in pieces {
                panel.curve(pen, &pairs(piece, which), stroke);
            }
        }
        for chain in self.chains {
            for jump in chain.jumps().iter().filter(|jump| is_between(jump)) {
                let (from, to) = match which {
                    1 => (position(chain, jump.from), position(chain, jump.to)),
                    _ => jump.velocities,
                };
                let from = panel.place((jump.from, from));
                let to = panel.place((jump.to, to));
                if (from.1 - to.1).abs() > SEEN {
                    pen.arrow(from, to, Stroke::solid(style::ASIDE, 1.2));
                }
            }
        }
        for (ways, color) in self.rows() {
            name(pen, panel, ways, color, which);
        }
        let (name, at) = self.point;
        let (x, y) = panel.place((at[0], at[which]));
        pen.spot((x, y), 5.0);
        let (place, ink) = ((x + 9.0, y + 18.0), (style::INK, true));
        pen.words(place, LETTERS + 2, Align::Left, ink, name);
        panel.axes(pen, axes);
    }

    /// The sweeps of each clearance, and its colour.
    fn rows(&self) -> impl Iterator<Item = (&[Chain], &'static str)> {
        rows(self.chains)
    }
}

/// The sweeps of each clearance, and its colour.
fn rows(chains: &[Chain]) -> impl Iterator<Item = (&[Chain], &'static str)> {
    let rows = chains.chunks_exact(2).enumerate();
    rows.map(|(index, ways)| (ways, ordered(index, chains.len() / 2)))
}

/// Dots of all motions, and a line where z = 1 is stable.
fn diagram(pen: &mut Pen, panel: &Panel, ways: &[Chain], color: &'static str, which: Which) {
    let show = |step: &Step| -> Vec<(f64, f64)> {
        let heights = match which {
            1 if step.hardest() == 0.0 => &[],
            1 => std::slice::from_ref(&step.max_position),
            _ => &step.velocities[..],
        };
        heights.iter().map(|height| (step.value, *height)).collect()
    };
    // What has not settled is on its way from one motion to another.
    let settled = steps(ways).filter(|step| step.is_settled());
    panel.dots(pen, settled.flat_map(show), DOT, color);
    for chain in ways {
        let rising = chain.rising();
        for run in rising.chunk_by(|a, b| is_one(a) && is_one(b)) {
            let ones = run.iter().filter(|step| is_one(step));
            let line: Vec<(f64, f64)> = ones.flat_map(|step| show(step)).collect();
            panel.curve(pen, &line, Stroke::solid(color, 2.6));
        }
    }
}

/// The clearance of a diagram, beside the end of its z = 1 or above its hardest impact.
fn name(pen: &mut Pen, panel: &Panel, ways: &[Chain], color: &'static str, which: Which) {
    let ones = steps(ways).filter(|step| is_one(step));
    let last = |step: &&Step| {
        if which == 1 {
            step.value
        } else {
            step.hardest()
        }
    };
    let Some(step) = ones.max_by(|a, b| last(a).total_cmp(&last(b))) else {
        return;
    };
    let (height, shift, align) = match which {
        1 => (step.max_position, (12.0, -4.0), Align::Left),
        _ => (step.hardest(), (-7.0, -6.0), Align::Right),
    };
    let (x, y) = panel.place((step.value, height));
    let place = (x + shift.0, y + shift.1);
    let text = format!("ρ = {}", ways[0].machine.scene.clearance);
    pen.words(place, LETTERS, align, (color, which == 1), &text);
}

fn legend(pen: &mut Pen, panel: &Panel) {
    let stable = Stroke::solid(style::ASIDE, 2.6);
    let entries = [
        (
            Some(RESPONSE),
            "g₀  amplitude of the free mass: impacts begin where it is ρ",
        ),
        (None, "(lower panel: X′₋ of z = 1 there, above resonance)"),
        (Some(FOLD), "s_SN  fold: z = 1 ends"),
        (Some(FLIP), "s_PD  flip: the period of z = 1 doubles"),
        (Some(stable), "z = 1, stable (in the colour of its ρ)"),
    ];
    let (left, mut y) = (panel.right() - 500.0, panel.area.1 + 24.0);
    pen.tint((left - 14.0, y - 18.0, 506.0, 126.0), "#ffffff", 0.9);
    for (stroke, text) in entries {
        if let Some(stroke) = stroke {
            pen.line(&[(left, y - 5.0), (left + 40.0, y - 5.0)], stroke);
        }
        let indent = if stroke.is_some() { 50.0 } else { 82.0 };
        pen.text((left + indent, y), LETTERS - 1, Align::Left, text);
        y += 20.0;
    }
}

fn pairs(points: &[[f64; 3]], which: Which) -> Vec<(f64, f64)> {
    points.iter().map(|at| (at[0], at[which])).collect()
}

/// True of a jump between rest from impacts and z = 1.
fn is_between(jump: &Jump) -> bool {
    let of = |motion: &softstop_dynamics::motion::MotionKind| {
        let regime = motion.regime()?;
        (regime.periods == 1).then_some(regime.impacts)
    };
    matches!(
        (of(&jump.before), of(&jump.after)),
        (Some(0), Some(1)) | (Some(1), Some(0))
    )
}

/// X_m of a step.
fn position(chain: &Chain, value: f64) -> f64 {
    let step = chain.steps.iter().find(|step| step.value == value);
    step.map_or(f64::NAN, |step| step.max_position)
}

/// Height of the panel for so many sweeps.
fn height_of(chains: usize) -> f64 {
    0.5 * ROW * chains as f64 + 8.0
}

/// Ranges of eta in which the largest position of a sweep lies behind the strip, if there is one.
pub(super) fn ranges(chain: &Chain) -> Vec<(f64, f64)> {
    let scene = &chain.machine.scene;
    let strip = scene.piercing.map_or(f64::INFINITY, |it| it.thickness);
    let through = scene.clearance + strip;
    let rising = chain.rising();
    let runs = rising.chunk_by(|a, b| (a.max_position > through) == (b.max_position > through));
    let pierced = runs.filter(|run| run[0].max_position > through && run.len() > 1);
    let ends = pierced.map(|run| (run[0].value, run[run.len() - 1].value));
    ends.collect()
}

/// A couple of lines in its colour for each clearance, whose sweeps are given up and down.
fn pierced(pen: &mut Pen, panel: &Panel, chains: &[Chain]) {
    let (left, top, _, height) = panel.area;
    pen.frame(panel.area);
    let text = "the strip is pierced: Xₘ > ρ + σ";
    let place = (panel.right() - 8.0, panel.bottom() - 9.0);
    pen.words(place, LETTERS - 1, Align::Right, (style::INK, false), text);
    for (index, (ways, color)) in rows(chains).enumerate() {
        let middle = top + 4.0 + ROW * (index as f64 + 0.5);
        for (way, (chain, shift)) in ways.iter().zip([-3.6, 3.6]).enumerate() {
            for (from, to) in ranges(chain) {
                let ends = [from, to].map(|eta| (panel.across(eta), middle + shift));
                let [tail, head] = if way == 0 { ends } else { [ends[1], ends[0]] };
                pen.arrow(tail, head, Stroke::solid(color, 1.8));
            }
        }
        let name = ways[0].machine.scene.clearance.to_string();
        let place = (left - 9.0, middle + 5.0);
        pen.words(place, LETTERS - 2, Align::Right, (color, false), &name);
    }
    let middle = top + 0.5 * height;
    pen.text((left - 42.0, middle), LETTERS + 1, Align::Upwards, "ρ");
}
