//! The chart of stops from soft to rigid: diagrams, a map of the motions, and folds.

use super::folds::Folds;
use super::stops::{CLEARANCE, RESTITUTION, grazing};
use super::subharmonics::{self, NARROW, Subharmonic};
use super::swept::{RANGE, Swept, kind};
use super::{DECADES, SUBHARMONIC};
use softstop_draw::{Align, Axis, Chart, Corner, Layer, Legend, Panel, Stroke, style};
use softstop_dynamics::motion::MotionClass;
use softstop_explore::palette::{motion_color, motion_keys};

/// What is drawn.
pub(super) struct Picture<'a> {
    /// Sweeps of the stops whose diagrams are shown.
    pub(super) drawn: &'a [Swept],
    /// Those of the map, by rising stiffness.
    pub(super) map: &'a [Swept],
    /// By rising stiffness.
    pub(super) folds: &'a [Folds],
    pub(super) found: &'a [Subharmonic],
}

/// Diagrams in a row.
const ACROSS: usize = 2;
const GRAZING: Stroke = Stroke::dashed(style::INK, 1.2, (5.0, 4.0));
const FOLD: Stroke = Stroke::solid(style::INK, 2.0);
/// Radius of a dot of the diagrams.
const DOT: f64 = 1.0;

/// The frequency of a bend of a branch.
type Bend = fn(&Folds) -> Option<f64>;

impl Picture<'_> {
    pub(super) fn chart(&self) -> Chart {
        // What is linear, the first, grows without regard to the clearance.
        let points = self.drawn[1..].iter().flat_map(Swept::points).flatten();
        let top = 1.05 * points.map(|point| point.1).fold(0.0, f64::max);
        let rows = self.drawn.chunks(ACROSS).enumerate();
        let diagrams = rows.flat_map(|(row, diagrams)| {
            let diagrams = diagrams.iter().enumerate();
            diagrams.map(move |(column, swept)| diagram(swept, (column, row), top))
        });
        let panels = diagrams.chain([self.map(), self.widths(), self.orders()]);
        let explanation = format!(
            "before-impact velocity X′₋ over η: clearance ρ = {CLEARANCE}, β₁ = 0.02, contact damping for a \
             restitution of {RESTITUTION}; dashed: grazing of the impact-less motion, g₀"
        );
        Chart {
            subtitle: explanation,
            legend: Legend::Below,
            ..Chart::new(
                "From a soft to a rigid stop: the stiffness k₂ from 0 to infinity",
                panels,
            )
        }
    }

    /// Rows of diagrams.
    const fn rows(&self) -> usize {
        self.drawn.len().div_ceil(ACROSS)
    }

    /// On the way up; a dot where the way down ends in another motion.
    fn map(&self) -> Panel {
        let (columns, rows) = (self.map[0].up.len(), self.map.len());
        let cells = self.map.iter().flat_map(|swept| &swept.up);
        let colors = cells.map(|step| motion_color(kind(step)));
        let place = |(low, high): (f64, f64), index: usize, count: usize| {
            low + (high - low) * (index as f64 + 0.5) / count as f64
        };
        let mut differs = [Vec::new(), Vec::new()];
        for (row, swept) in self.map.iter().enumerate() {
            let cells = swept.up.iter().zip(&swept.down).enumerate();
            let others = cells.filter(|(_, (up, down))| kind(up) != kind(down));
            let stiffness = 10f64.powf(place(DECADES, row, rows));
            for (column, (up, _)) in others {
                let is_dark = matches!(kind(up), MotionClass::Chaos | MotionClass::Unsettled);
                differs[usize::from(is_dark)].push((place(RANGE, column, columns), stiffness));
            }
        }
        let [on_light, on_dark] = differs;
        let mut layers = vec![
            Layer::cells(columns, colors),
            Layer::dots(on_light, 0.9, style::INK).named("falling η differs"),
            Layer::dots(on_dark, 0.9, style::PAPER),
        ];
        layers.extend(grazes());
        let upper = Layer::text((grazing(CLEARANCE).1, 0.1), Align::Left, "g₀");
        layers.push(upper.moved(6.0, -6.0).plated());
        let strong: Bend = |fold| Some(fold.strong?.0);
        let ends: [(&str, Bend); 2] = [("s_SN", strong), ("s_PD", |fold| fold.flip)];
        for (name, eta) in ends {
            let points = self.folds.iter();
            let points = points.filter_map(|fold| Some((eta(fold)?, fold.stiffness)));
            layers.push(Layer::line(points, FOLD));
            let last = self.folds.iter().rfind(|fold| fold.strong.is_some());
            if let Some(eta) = last.and_then(eta) {
                let text = Layer::text((eta, 10f64.powf(DECADES.1)), Align::Left, name);
                layers.push(text.moved(8.0, 24.0).plated());
            }
        }
        layers.extend(motion_keys(|class| {
            let mut steps = self.map.iter().flat_map(|swept| &swept.up);
            steps.any(|step| kind(step) == class)
        }));
        let decades = (10f64.powf(DECADES.0), 10f64.powf(DECADES.1));
        Panel {
            title: "Motions on rising η".to_owned(),
            at: (0, self.rows()),
            span: (ACROSS, 1),
            size: (600.0, 380.0),
            x: Axis::new("η").range(RANGE),
            y: Axis::new("k₂/k₁").range(decades).log(),
            layers,
            ..Panel::default()
        }
    }

    /// How wide the regions of weak impacts and of hysteresis are, over the stiffness, logarithmic.
    fn widths(&self) -> Panel {
        let widths = self.folds.iter().filter_map(Folds::widths);
        let widths: Vec<[f64; 3]> = widths.filter(|it| it[1] > 0.0).collect();
        let hysteresis = "hysteresis, from s_SN back to the weak fold";
        let weak = "weak z = 1, from g₀ to its fold";
        let curves = [
            (2, style::DESIGN, 24.0, hysteresis),
            (1, style::OPTIMUM, -6.0, weak),
        ];
        let layers = curves.into_iter().flat_map(|(which, color, shift, name)| {
            let points = widths.iter().map(|it| (it[0], it[which]));
            let points: Vec<(f64, f64)> = points.collect();
            let named = points.get(points.len() / 4).map(|at| {
                let text = Layer::text(*at, Align::Left, name).moved(12.0, shift);
                text.colored(color).plated()
            });
            let line = Layer::line(points.iter().copied(), Stroke::solid(color, 2.0));
            [line, Layer::dots(points, 3.4, color)]
                .into_iter()
                .chain(named)
        });
        Panel {
            title: "Widths above the resonance".to_owned(),
            at: (0, self.rows() + 1),
            span: (ACROSS, 1),
            size: (600.0, 176.0),
            x: Axis::new("k₂/k₁").range((1.0, 10f64.powf(DECADES.1))).log(),
            y: Axis::new("width in η").log(),
            layers: layers.collect(),
            ..Panel::default()
        }
    }

    /// The frequencies at which there are motions z = 1/n.
    fn orders(&self) -> Panel {
        let found = || self.found.iter().filter(|motion| motion.impacts == 1);
        let highest = found()
            .map(|motion| motion.periods)
            .max()
            .unwrap_or(2)
            .max(2);
        let stops = SUBHARMONIC.into_iter().enumerate();
        let stops = stops.map(|(index, stiffness)| {
            let own = found().filter(|motion| motion.stiffness == stiffness);
            // The dots of each stop are a little lower than those of the one before.
            let shift = 0.17 * (index as f64 - 1.0);
            let points = own.map(|motion| (motion.frequency, motion.periods as f64 - shift));
            let color = style::ordered(index, SUBHARMONIC.len());
            Layer::dots(points, 3.2, color).named(format!("k₂/k₁ = {stiffness}"))
        });
        let name = "g₀: beyond it z = 0 coexists";
        let eta = grazing(NARROW).1;
        let orders = (2..=highest).map(|order| (order as f64, order.to_string()));
        Panel {
            title: format!("Motions z = 1/n found at clearance ρ = {NARROW}"),
            at: (0, self.rows() + 2),
            span: (ACROSS, 1),
            size: (600.0, 158.0),
            x: Axis::new("η").range(subharmonics::RANGE),
            y: Axis::new("n of z = 1/n")
                .range((1.4, highest as f64 + 0.6))
                .ticks(orders),
            layers: stops.chain([Layer::vertical(eta, GRAZING, name)]).collect(),
            legend: Some(Legend::Inside(Corner::BottomRight)),
        }
    }
}

/// The diagram of a stop.
fn diagram(swept: &Swept, at: (usize, usize), top: f64) -> Panel {
    let [up, down] = swept.points();
    let down = Layer::dots(down, DOT, style::FALLING).named("η falling only");
    let up = Layer::dots(up, DOT, style::RISING).named("η rising");
    Panel {
        title: swept.law.name(),
        at,
        size: (270.0, 160.0),
        x: Axis::new("").range(RANGE),
        y: Axis::new(if at.0 > 0 { "" } else { "X′₋" }).range((0.0, top)),
        layers: grazes().into_iter().chain([down, up]).collect(),
        ..Panel::default()
    }
}

/// Where the motion without impacts grazes.
fn grazes() -> [Layer; 2] {
    let (lower, upper) = grazing(CLEARANCE);
    [lower, upper].map(|eta| Layer::vertical(eta, GRAZING, ""))
}
