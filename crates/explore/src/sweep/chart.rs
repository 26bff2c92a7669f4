//! A bifurcation diagram: largest position and before-impact velocities along a swept parameter.

use std::collections::{BTreeMap, BTreeSet};

use softstop::{Dimension, Machine, Parameter, UnitSystem};
use softstop_dynamics::{Chain, Direction, MotionKind, Plan, SweepStep};

use softstop_draw::{Align, Axis, Chart, Layer, Legend, Panel, Stroke, around, style};

/// The diagram of all chains of a plan.
#[derive(Debug, Clone, Copy)]
pub(super) struct SweepChart<'a> {
    pub(super) machine: &'a Machine,
    pub(super) plan: &'a Plan,
    pub(super) chains: &'a [Chain],
}

/// Where points are: seen on the way up, on the way down, or both.
const WAYS: [(&str, &str); 3] = [
    ("both ways", style::BOTH_WAYS),
    ("up only →", style::RISING),
    ("down only ←", style::FALLING),
];

/// Size of a panel, and the least and the largest radius of a dot.
const SIZE: (f64, f64) = (640.0, 290.0);
const DOT: (f64, f64) = (0.9, 2.0);
/// Share of the panel between two values that a dot fills.
const FILLS: f64 = 0.45;
/// Points in one square of this many pixels are one.
const GRAIN: f64 = 0.8;
/// Height of a jump, in units of the axis, that has an arrow.
const SEEN: f64 = 0.15;

/// What a panel shows of a step.
type PanelValues = fn(&SweepStep) -> Vec<f64>;

impl SweepChart<'_> {
    /// The picture as an SVG document.
    pub(super) fn svg(&self) -> String {
        let position = ("largest position", "X_m", Dimension::Length);
        let velocity = ("before-impact velocity", "X′₋", Dimension::Velocity);
        let mut positions = self.panel(position, |step| vec![step.max_position]);
        positions.layers.extend(self.names());
        let mut velocities = self.panel(velocity, |step| step.velocities.clone());
        let highest = velocities.y.ends[1].unwrap_or(1.0);
        velocities.layers.extend(self.arrows(SEEN * highest));
        let Plan { periods, steps, .. } = self.plan;
        let meaning = self.plan.parameter.about().meaning;
        let title = format!("Motions swept along the {meaning}");
        let chart = Chart {
            subtitle: format!("{periods} drive periods at each of {steps} values"),
            legend: Legend::Below,
            ..Chart::new(title, [positions, velocities])
        };
        chart.in_columns(1).svg()
    }

    /// One of the panels, with its dots.
    fn panel(
        &self,
        (what, symbol, dimension): (&str, &str, Dimension),
        show: PanelValues,
    ) -> Panel {
        let (low, high) = self.plan.range;
        let room = 0.02 * (high - low);
        let (x, y) = ((low - room, high + room), self.range(show));
        let grain = (GRAIN * (x.1 - x.0) / SIZE.0, GRAIN * (y.1 - y.0) / SIZE.1);
        let radius = (FILLS * SIZE.0 / self.plan.steps as f64).clamp(DOT.0, DOT.1);
        let points = self.points(grain, show);
        let message = points.iter().all(Vec::is_empty);
        let message = message.then(|| Layer::message("no impacts"));
        let goes = |way| self.chains.iter().any(|chain| chain.direction == way);
        let (up, down) = (goes(Direction::Up), goes(Direction::Down));
        let dots = points.into_iter().zip(WAYS).zip([up && down, up, down]);
        let dots = dots.filter(|(_, goes)| *goes);
        let dots =
            dots.map(|((points, (name, color)), _)| Layer::dots(points, radius, color).named(name));
        let across = Axis::new(self.machine.label_of(self.plan.parameter)).range(x);
        let up = Axis::new(self.machine.label(what, symbol, dimension)).range(y);
        Panel::new(across, up, dots.chain(message)).sized(SIZE)
    }

    /// Least and largest value with some room.
    fn range(&self, show: PanelValues) -> (f64, f64) {
        let steps = self.chains.iter().flat_map(|chain| &chain.steps);
        let (low, high) = around(steps.flat_map(show), 0.0);
        let low = match low {
            0.0.. if low < 0.35 * high => 0.0,
            _ => low,
        };
        let room = 0.05 * (high - low);
        (if low == 0.0 { 0.0 } else { low - room }, high + room)
    }

    /// The points by the way on which they are seen, machine by machine; in squares of this grain all points are one.
    fn points(&self, grain: (f64, f64), show: PanelValues) -> [Vec<(f64, f64)>; 3] {
        let mut points: [Vec<(f64, f64)>; 3] = Default::default();
        let machines = self
            .chains
            .chunk_by(|a, b| a.direction != b.direction && a.direction == Direction::Up);
        for machine in machines {
            let mut seen = BTreeMap::<(i64, i64), u8>::new();
            let shared = chaos_both_ways(machine);
            for chain in machine {
                let way = match chain.direction {
                    Direction::Up => 1,
                    Direction::Down => 2,
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
        points
    }

    /// The clearance of each machine above its largest position, if there are several.
    fn names(&self) -> impl Iterator<Item = Layer> + '_ {
        let several = self.chains.len() > 2 && self.plan.parameter != Parameter::Clearance;
        let first = self.chains.iter();
        let first = first.filter(move |it| several && it.direction == self.chains[0].direction);
        first.filter_map(|chain| {
            let steps = chain.steps.iter();
            let highest = steps.max_by(|a, b| a.max_position.total_cmp(&b.max_position))?;
            let clearance = chain.machine.value(Parameter::Clearance)?;
            let name = match self.machine.unit_system {
                UnitSystem::Ratios => format!("ρ = {clearance}"),
                _ => format!("clearance {clearance} m"),
            };
            let place = (highest.value, highest.max_position);
            Some(Layer::text(place, Align::Middle, name).moved(0.0, -6.0))
        })
    }

    /// Arrows where the motion jumps so far that it is seen.
    fn arrows(&self, seen: f64) -> impl Iterator<Item = Layer> + '_ {
        self.chains.iter().flat_map(move |chain| {
            let color = match chain.direction {
                Direction::Up => WAYS[1].1,
                Direction::Down => WAYS[2].1,
            };
            let jumps = chain.find_jumps().into_iter();
            jumps.filter_map(move |jump| {
                let (before, after) = jump.velocities;
                let arrow = Layer::arrow(
                    (jump.from, before),
                    (jump.to, after),
                    Stroke::solid(color, 1.0),
                );
                ((before - after).abs() > seen).then_some(arrow)
            })
        })
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
