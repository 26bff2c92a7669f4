//! The chart of stops from soft to rigid: diagrams, a map of the motions, and folds.

use super::folds::Folds;
use super::stops::{CLEARANCE, RESTITUTION, grazing};
use super::subharmonics::{self, NARROW, Subharmonic};
use super::swept::{KINDS, Kind, RANGE, Swept, kind};
use super::{DECADES, SUBHARMONIC};
use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{self, Align, Area, Pen, Stroke};
use softstop_draw::shade::ordered;
use softstop_draw::style;

/// What is drawn.
pub(super) struct Chart<'a> {
    /// Sweeps of the stops whose diagrams are shown.
    pub(super) drawn: &'a [Swept],
    /// Those of the map, by rising stiffness.
    pub(super) map: &'a [Swept],
    /// By rising stiffness.
    pub(super) folds: &'a [Folds],
    pub(super) found: &'a [Subharmonic],
}

const PAGE: (f64, f64) = (1480.0, 1212.0);
const LETTERS: u32 = 14;
/// Diagrams in a row.
const ACROSS: usize = 4;
/// Left end and top of the first diagram, distance to the next, and size.
const DIAGRAM: [(f64, f64); 3] = [(78.0, 104.0), (354.0, 272.0), (306.0, 208.0)];
const MAP: Area = (78.0, 694.0, 760.0, 420.0);
const WIDTHS: Area = (938.0, 694.0, 508.0, 176.0);
const ORDERS: Area = (938.0, 956.0, 508.0, 158.0);
const GRAZING: Stroke = Stroke::dashed(style::INK, 1.2, (5.0, 4.0));
/// Radius of a dot of the diagrams.
const DOT: f64 = 1.0;
/// Room beside the curves of widths in decades.
const ROOM: f64 = 0.4;
/// How much lower the dots of each stop whose subharmonic motions are shown are drawn.
const STOPS: [f64; 3] = [-0.17, 0.0, 0.17];

const FOLD: Stroke = Stroke::solid(style::INK, 2.0);

impl Chart<'_> {
    /// The picture as an SVG document.
    pub(super) fn svg(&self) -> String {
        let mut pen = Pen::new(PAGE.0, PAGE.1);
        let title = "From a soft to a rigid stop: the stiffness k₂ from 0 to infinity";
        let explanation = format!(
            "clearance ρ = {CLEARANCE}, β₁ = 0.02, contact damping for a restitution of {RESTITUTION}; dashed: \
             grazing of the impact-less motion, g₀"
        );
        heading(&mut pen, (28.0, 38.0), title, &explanation);
        // Which way is which colour.
        let ways = [
            ("η rising", style::DESIGN),
            ("η falling only", style::OPTIMUM),
        ];
        for ((name, color), x) in ways.into_iter().zip([PAGE.0 - 320.0, PAGE.0 - 190.0]) {
            pen.dots(&[(x, 55.0)], 5.0, color);
            pen.text((x + 12.0, 60.0), LETTERS, Align::Left, name);
        }
        for (row, diagrams) in self.drawn.chunks(ACROSS).enumerate() {
            // What is linear grows without regard to the clearance.
            let highest = diagrams[usize::from(row == 0)..].iter();
            let points = highest.flat_map(|swept| swept.points()).flatten();
            let top = 1.08 * points.map(|point| point.1).fold(0.0, f64::max);
            for (column, swept) in diagrams.iter().enumerate() {
                self.diagram(&mut pen, (column, row), swept, top);
            }
        }
        self.map(&mut pen, MAP);
        self.widths(&mut pen);
        self.orders(&mut pen);
        pen.svg()
    }

    fn diagram(&self, pen: &mut Pen, (column, row): (usize, usize), swept: &Swept, top: f64) {
        let [first, next, (width, height)] = DIAGRAM;
        let left = first.0 + next.0 * column as f64;
        let above = first.1 + next.1 * row as f64;
        let panel = Panel::new((left, above, width, height), RANGE, (0.0, top));
        let last = row + 1 == self.drawn.len().div_ceil(ACROSS);
        let up = ["before-impact velocity X′₋", ""][usize::from(column > 0)];
        let across = Some(if last { "η" } else { "" });
        let axes = Axes::new(LETTERS, across, up, (6, 5));
        panel.ground(pen, &axes);
        grazes(pen, &panel);
        let [up, down] = swept.points();
        panel.dots(pen, down.into_iter(), DOT, style::OPTIMUM);
        panel.dots(pen, up.into_iter(), DOT, style::DESIGN);
        panel.axes(pen, &axes);
        let name = swept.law.name();
        pen.heading((left, above - 8.0), 15, Align::Left, &name);
    }

    /// On the way up; a dot where the way down ends in another motion.
    pub(super) fn map(&self, pen: &mut Pen, area: Area) {
        let panel = Panel::new(area, RANGE, DECADES);
        let cells = self.cells(&panel);
        for (own, _, color) in KINDS {
            let cells = cells.iter().filter(|(up, ..)| *up == own);
            let areas: Vec<Area> = cells.map(|cell| cell.2).collect();
            if !areas.is_empty() {
                pen.fill(&areas, color);
            }
        }
        let differs = cells.iter().filter(|(up, down, _)| up != down);
        let dots = differs.map(|(.., (x, y, width, height))| (x + 0.5 * width, y + 0.5 * height));
        pen.dots(&dots.collect::<Vec<_>>(), 0.9, style::INK);
        grazes(pen, &panel);
        let lines = [
            |fold: &Folds| Some(fold.strong?.0),
            |fold: &Folds| fold.flip,
        ];
        for eta in lines {
            let points = self.folds.iter();
            let points = points.filter_map(|fold| Some((eta(fold)?, fold.stiffness.log10())));
            panel.curve(pen, &points.collect::<Vec<_>>(), FOLD);
        }
        let axes = Axes::new(LETTERS, Some("η"), "", (12, 0));
        panel.axes(pen, &axes);
        let axes = Axes {
            is_log: true,
            ..Axes::new(LETTERS, None, "k₂/k₁", (0, 5))
        };
        panel.axes(pen, &axes);
        if let Some(last) = self.folds.iter().rfind(|fold| fold.strong.is_some()) {
            let mut name = |eta: f64, shift: f64, y: f64, name: &str| {
                let (place, ink) = ((panel.across(eta) + shift, y), (style::INK, true));
                pen.words(place, LETTERS, Align::Left, ink, name);
            };
            for (eta, text) in lines.map(|eta| eta(last)).into_iter().zip(["s_SN", "s_PD"]) {
                if let Some(eta) = eta {
                    name(eta, 8.0, area.1 + 24.0, text);
                }
            }
            name(grazing(CLEARANCE).1, 6.0, panel.bottom() - 12.0, "g₀");
        }
        let occurs = |(kind, ..): &(Kind, &str, &str)| cells.iter().any(|(up, ..)| up == kind);
        let (mut x, y) = (area.0, area.1 - 14.0);
        for (_, name, color) in KINDS.into_iter().filter(occurs) {
            let area = (x, y - 11.0, 16.0, 12.0);
            pen.fill(&[area], color);
            pen.frame(area);
            pen.text((x + 21.0, y), 13, Align::Left, name);
            x += 21.0 + pen::width(13, name) + 8.0;
        }
        pen.dots(&[(x + 4.0, y - 5.0)], 1.6, style::INK);
        pen.text((x + 12.0, y), 13, Align::Left, "falling η differs");
    }

    /// The cells with the motions on the way up and on the way down.
    fn cells(&self, panel: &Panel) -> Vec<(Kind, Kind, Area)> {
        let height = panel.area.3 / self.map.len().max(1) as f64;
        let mut cells = Vec::new();
        for (index, swept) in self.map.iter().enumerate() {
            let top = panel.bottom() - height * (index + 1) as f64;
            let width = panel.area.2 / swept.up.len().max(1) as f64;
            for (column, (up, down)) in swept.up.iter().zip(&swept.down).enumerate() {
                let left = panel.area.0 + width * column as f64;
                cells.push((kind(up), kind(down), (left, top, width, height)));
            }
        }
        cells
    }

    /// How wide the regions of weak impacts and of hysteresis are, over the stiffness, logarithmic.
    fn widths(&self, pen: &mut Pen) {
        let widths = self.folds.iter().filter_map(Folds::widths);
        let widths: Vec<[f64; 3]> = widths.filter(|it| it[1] > 0.0).collect();
        let curve = |which: usize| -> Vec<(f64, f64)> {
            let points = widths.iter();
            points
                .map(|it| (it[0].log10(), it[which].log10()))
                .collect()
        };
        let (weak, strong) = (curve(1), curve(2));
        let lowest = weak.iter().map(|point| point.1).fold(0.0, f64::min);
        let panel = Panel::new(WIDTHS, (0.0, DECADES.1), (lowest - ROOM, ROOM));
        let axes = Axes {
            is_log: true,
            ..Axes::new(LETTERS, Some("k₂/k₁"), "width in η", (4, 5))
        };
        panel.ground(pen, &axes);
        let hysteresis = "hysteresis, from s_SN back to the weak fold";
        for (points, color, shift, name) in [
            (strong, style::DESIGN, 24.0, hysteresis),
            (
                weak,
                style::OPTIMUM,
                -6.0,
                "weak z = 1, from g₀ to its fold",
            ),
        ] {
            panel.curve(pen, &points, Stroke::solid(color, 2.0));
            panel.dots(pen, points.iter().copied(), 3.4, color);
            if let Some(point) = points.get(points.len() / 4) {
                let (x, y) = panel.place(*point);
                let place = (x + 12.0, y + shift);
                pen.words(place, LETTERS, Align::Left, (color, true), name);
            }
        }
        panel.axes(pen, &axes);
        let place = (WIDTHS.0, WIDTHS.1 - 14.0);
        pen.heading(place, 15, Align::Left, "Widths above the resonance");
    }

    /// The frequencies at which there are motions z = 1/n.
    fn orders(&self, pen: &mut Pen) {
        let found = self.found.iter().filter(|motion| motion.impacts == 1);
        let orders = found.clone().map(|motion| motion.periods as f64);
        let highest = orders.fold(2.0, f64::max);
        let panel = Panel::new(ORDERS, subharmonics::RANGE, (1.4, highest + 0.6));
        let axes = Axes::new(LETTERS, Some("η"), "n of z = 1/n", (9, highest as usize));
        panel.ground(pen, &axes);
        let (_, eta) = grazing(NARROW);
        panel.curve(pen, &[(eta, panel.y.0), (eta, panel.y.1)], GRAZING);
        let mut right = panel.right() - 8.0;
        for (index, (stiffness, shift)) in SUBHARMONIC.into_iter().zip(STOPS).enumerate().rev() {
            let color = ordered(index, STOPS.len());
            let own = found.clone().filter(|motion| motion.stiffness == stiffness);
            let points = own.map(|motion| (motion.frequency, motion.periods as f64 - shift));
            panel.dots(pen, points, 3.2, color);
            let name = format!("k₂/k₁ = {stiffness}");
            right -= pen::width(13, &name);
            let place = (right, panel.bottom() - 9.0);
            pen.words(place, 13, Align::Left, (color, true), &name);
            right -= 10.0;
        }
        let place = (panel.across(eta) + 6.0, ORDERS.1 + 18.0);
        let name = "g₀: beyond it z = 0 coexists";
        pen.words(place, LETTERS - 1, Align::Left, (style::INK, true), name);
        panel.axes(pen, &axes);
        let title = format!("Motions z = 1/n found at clearance ρ = {NARROW}");
        let place = (ORDERS.0, ORDERS.1 - 14.0);
        pen.heading(place, 15, Align::Left, &title);
    }
}

/// Where the motion without impacts grazes.
fn grazes(pen: &mut Pen, panel: &Panel) {
    let (lower, upper) = grazing(CLEARANCE);
    for eta in [lower, upper] {
        panel.curve(pen, &[(eta, panel.y.0), (eta, panel.y.1)], GRAZING);
    }
}
