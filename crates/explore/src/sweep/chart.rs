//! A bifurcation diagram: largest position and before-impact velocities along a swept parameter.

use std::collections::{BTreeMap, BTreeSet};

use kuva::backend::svg::SvgBackend;
use kuva::plot::ScatterPlot;
use kuva::plot::legend::{LegendEntry, LegendPosition, LegendShape};
use kuva::render::annotations::TextAnnotation;
use kuva::render::figure::Figure;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use softstop::{Dimension, Language, Machine, Parameter};
use softstop_dynamics::motion::MotionKind;
use softstop_dynamics::sweep::{Chain, Direction, Plan, Step};

use softstop_draw::scale::around;
use softstop_draw::style;

/// The diagram of all chains of a plan.
#[derive(Debug, Clone, Copy)]
pub struct SweepChart<'a> {
    machine: &'a Machine,
    plan: &'a Plan,
    pub(super) chains: &'a [Chain],
}

/// Where points are: seen on the way up, on the way down, or both.
pub(super) const WAYS: [(&str, &str); 3] = [
    ("both ways", "#555555"),
    ("up only →", style::DESIGN),
    ("down only ←", style::OPTIMUM),
];

/// Size of a panel in pixels, and of the dots.
const PANEL: (f64, f64) = (1180.0, 470.0);
const DOT: (f64, f64) = (0.9, 2.0);
/// Share of the panel between two values that a dot fills.
const FILLS: f64 = 0.45;
/// Points in one square of this many pixels are one.
const GRAIN: f64 = 0.8;

/// The points of one panel and what they are.
type Points = BTreeMap<(i64, i64), u8>;
/// What a panel shows of a step.
pub(super) type Show = fn(&Step) -> Vec<f64>;

impl<'a> SweepChart<'a> {
    /// The diagram.
    #[must_use]
    pub fn new(machine: &'a Machine, plan: &'a Plan, chains: &'a [Chain]) -> Self {
        Self {
            machine,
            plan,
            chains,
        }
    }

    /// The picture as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let positions: Show = |step| vec![step.max_position];
        let velocities: Show = |step| step.velocities.clone();
        let (mut upper, mut lower) = (self.plots(positions), self.plots(velocities));
        lower.extend(self.arrows());
        // A panel without points still needs a plot.
        for plots in [&mut upper, &mut lower] {
            if plots.is_empty() {
                plots.push(Plot::Scatter(ScatterPlot::new()));
            }
        }
        let figure = Figure::new(2, 1)
            .with_plots(vec![upper, lower])
            .with_layouts(vec![
                self.layout(
                    positions,
                    ("largest position", "X_m", Dimension::Length),
                    false,
                ),
                self.layout(
                    velocities,
                    ("before-impact velocity", "X′₋", Dimension::Velocity),
                    true,
                ),
            ])
            .with_title(self.title())
            .with_cell_size(PANEL.0, PANEL.1)
            .with_shared_legend_bottom()
            .with_shared_legend_entries(self.legend());
        SvgBackend::new().render_scene(&figure.render())
    }

    fn title(&self) -> String {
        format!(
            "Motions swept along the {}: {} drive periods at each of {} values",
            self.plan.parameter.about().meaning,
            self.plan.periods,
            self.plan.steps
        )
    }

    fn layout(&self, show: Show, name: (&str, &str, Dimension), bottom: bool) -> Layout {
        let (low, high) = self.plan.range;
        let room = 0.02 * (high - low);
        let (x, y) = ((low - room, high + room), self.range(show));
        let plain = style::plain(x, y);
        let is_empty = self
            .chains
            .iter()
            .all(|chain| chain.steps.iter().all(|step| show(step).is_empty()));
        let layout = if is_empty {
            style::message(plain, x, y, "no impacts")
        } else {
            plain
        };
        let layout = layout
            .with_y_label(self.machine.label(name.0, name.1, name.2))
            .with_x_label(self.machine.label_of(self.plan.parameter))
            .with_legend_position(LegendPosition::OutsideRightTop);
        if bottom {
            self.arrow_heads(layout)
        } else {
            self.names(layout, show)
        }
    }

    /// Least and largest value with some room.
    pub(super) fn range(&self, show: Show) -> (f64, f64) {
        let values = self
            .chains
            .iter()
            .flat_map(|chain| &chain.steps)
            .flat_map(show);
        let (low, high) = around(values, 0.0);
        let low = if 0.0 < low && low < 0.35 * high {
            0.0
        } else {
            low
        };
        let room = 0.05 * (high - low);
        (if low == 0.0 { 0.0 } else { low - room }, high + room)
    }

    /// The points by the way on which they are seen, machine by machine.
    fn plots(&self, show: Show) -> Vec<Plot> {
        let (low, high) = self.range(show);
        let (left, right) = self.plan.range;
        let grain = (
            GRAIN * (right - left) / PANEL.0,
            GRAIN * (high - low) / PANEL.1,
        );
        let mut points: [Vec<(f64, f64)>; 3] = Default::default();
        let machines = self
            .chains
            .chunk_by(|a, b| a.direction != b.direction && a.direction == Direction::Up);
        for machine in machines {
            let mut seen = Points::new();
            let shared = chaos_both_ways(machine);
            for chain in machine {
                let way = if chain.direction == Direction::Up {
                    1
                } else {
                    2
                };
                for step in &chain.steps {
                    let is_shared = shared.contains(&step.value.to_bits());
                    let way = if is_shared { 3 } else { way };
                    for value in show(step) {
                        let place = (
                            (step.value / grain.0).round() as i64,
                            (value / grain.1).round() as i64,
                        );
                        *seen.entry(place).or_default() |= way;
                    }
                }
            }
            for (place, ways) in seen {
                let point = (place.0 as f64 * grain.0, place.1 as f64 * grain.1);
                points[usize::from(ways % 3)].push(point);
            }
        }
        let plots = points
            .into_iter()
            .zip(WAYS)
            .filter(|(points, _)| !points.is_empty());
        let plot = |(points, (_, color)): (Vec<(f64, f64)>, (&str, &str))| {
            Plot::Scatter(
                ScatterPlot::new()
                    .with_data(points)
                    .with_color(color)
                    .with_size((FILLS * PANEL.0 / self.plan.steps as f64).clamp(DOT.0, DOT.1)),
            )
        };
        plots.map(plot).collect()
    }

    /// The clearance of each machine above its largest position, if there are several.
    fn names(&self, layout: Layout, show: Show) -> Layout {
        let several = self.chains.len() > 2 && self.plan.parameter != Parameter::Clearance;
        let (low, high) = self.range(show);
        let ways = |chain: &&Chain| several && chain.direction == self.chains[0].direction;
        self.chains
            .iter()
            .filter(ways)
            .fold(layout, |layout, chain| {
                let clearance = chain.machine.value(Parameter::Clearance);
                let highest = chain
                    .steps
                    .iter()
                    .max_by(|a, b| a.max_position.total_cmp(&b.max_position));
                let (Some(clearance), Some(step)) = (clearance, highest) else {
                    return layout;
                };
                let place = step.max_position + 0.02 * (high - low);
                let name = TextAnnotation::new(self.clearance(clearance), step.value, place);
                layout.with_annotation(name.with_font_size(12))
            })
    }

    fn clearance(&self, value: f64) -> String {
        match self.machine.speaks {
            Language::Ratios => format!("ρ = {value}"),
            _ => format!("clearance {value} m"),
        }
    }

    fn legend(&self) -> Vec<LegendEntry> {
        let entry = |(label, color): (&str, &str)| LegendEntry {
            label: label.to_owned(),
            color: color.to_owned(),
            shape: LegendShape::Rect,
            dasharray: None,
        };
        let up = self
            .chains
            .iter()
            .any(|chain| chain.direction == Direction::Up);
        let down = self
            .chains
            .iter()
            .any(|chain| chain.direction == Direction::Down);
        let wanted = [up && down, up, down];
        let entries = WAYS.into_iter().zip(wanted);
        entries
            .filter(|(_, wanted)| *wanted)
            .map(|(way, _)| entry(way))
            .collect()
    }
}

/// The values at which a machine moves chaotically both on the way up and on the way down: all points there belong
/// to one motion.
fn chaos_both_ways(machine: &[Chain]) -> BTreeSet<u64> {
    let chaos = |chain: &Chain| -> BTreeSet<u64> {
        let steps = chain.steps.iter();
        let steps = steps.filter(|step| step.motion == MotionKind::Chaos);
        steps.map(|step| step.value.to_bits()).collect()
    };
    match machine {
        [up, down] => chaos(up).intersection(&chaos(down)).copied().collect(),
        _ => BTreeSet::new(),
    }
}
