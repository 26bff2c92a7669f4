//! A bifurcation diagram: largest position and before-impact velocities along a swept parameter.

use std::collections::{BTreeMap, BTreeSet};

use softstop::{Dimension, Language, Machine, Parameter};
use softstop_dynamics::{Chain, Direction, MotionKind, Plan, Step};

use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Pen, Stroke};
use softstop_draw::scale::around;
use softstop_draw::shapes::Sign;
use softstop_draw::style;

/// The diagram of all chains of a plan.
#[derive(Debug, Clone, Copy)]
pub struct SweepChart<'a> {
    machine: &'a Machine,
    plan: &'a Plan,
    chains: &'a [Chain],
}

/// Where points are: seen on the way up, on the way down, or both.
const WAYS: [(&str, &str); 3] = [
    ("both ways", "#555555"),
    ("up only →", style::DESIGN),
    ("down only ←", style::OPTIMUM),
];

/// Left and top of the first panel, size of a panel, from one to the next, and the dots.
const FIRST: (f64, f64) = (96.0, 76.0);
const PANEL: (f64, f64) = (1080.0, 360.0);
const NEXT: f64 = 440.0;
const DOT: (f64, f64) = (0.9, 2.0);
/// Share of the panel between two values that a dot fills.
const FILLS: f64 = 0.45;
/// Points in one square of this many pixels are one.
const GRAIN: f64 = 0.8;
/// Height of a jump, in units of the axis, that has an arrow.
const SEEN: f64 = 0.15;
/// Letters.
const LETTERS: u32 = 14;

/// The points of one panel and what they are.
type Points = BTreeMap<(i64, i64), u8>;
/// What a panel shows of a step.
type Show = fn(&Step) -> Vec<f64>;

impl<'a> SweepChart<'a> {
    /// The diagram.
    pub fn new(machine: &'a Machine, plan: &'a Plan, chains: &'a [Chain]) -> Self {
        Self {
            machine,
            plan,
            chains,
        }
    }

    /// The picture as an SVG document.
    pub fn svg(&self) -> String {
        let (width, height) = (FIRST.0 + PANEL.0 + 24.0, FIRST.1 + 2.0 * NEXT + 44.0);
        let mut pen = Pen::page(width, height);
        heading(&mut pen, (FIRST.0, 36.0), &self.title(), "");
        let position = self
            .machine
            .label("largest position", "X_m", Dimension::Length);
        let positions: Show = |step| vec![step.max_position];
        let panel = self.panel(&mut pen, 0, &position, positions);
        self.names(&mut pen, &panel);
        let velocity = self
            .machine
            .label("before-impact velocity", "X′₋", Dimension::Velocity);
        let panel = self.panel(&mut pen, 1, &velocity, |step| step.velocities.clone());
        self.arrows(&mut pen, &panel);
        pen.legend((FIRST.0, height - 60.0), LETTERS, &self.legend());
        pen.svg()
    }

    fn title(&self) -> String {
        format!(
            "Motions swept along the {}: {} drive periods at each of {} values",
            self.plan.parameter.about().meaning,
            self.plan.periods,
            self.plan.steps
        )
    }

    /// One of the panels, with its dots.
    fn panel(&self, pen: &mut Pen, row: usize, upwards: &str, show: Show) -> Panel {
        let (low, high) = self.plan.range;
        let room = 0.02 * (high - low);
        let area = (FIRST.0, FIRST.1 + NEXT * row as f64, PANEL.0, PANEL.1);
        let panel = Panel::new(area, (low - room, high + room), self.range(show));
        let across = self.machine.label_of(self.plan.parameter);
        let axes = Axes::new(LETTERS, Some(&across), upwards, (8, 6));
        panel.ground(pen, &axes);
        let radius = (FILLS * PANEL.0 / self.plan.steps as f64).clamp(DOT.0, DOT.1);
        let points = self.points(&panel, show);
        if points.iter().all(Vec::is_empty) {
            panel.message(pen, LETTERS, "no impacts");
        }
        for (points, (_, color)) in points.into_iter().zip(WAYS) {
            panel.dots(pen, points.into_iter(), radius, color);
        }
        panel.axes(pen, &axes);
        panel
    }

    /// Least and largest value with some room.
    fn range(&self, show: Show) -> (f64, f64) {
        let steps = self.chains.iter().flat_map(|chain| &chain.steps);
        let (low, high) = around(steps.flat_map(show), 0.0);
        let low = match low {
            0.0.. if low < 0.35 * high => 0.0,
            _ => low,
        };
        let room = 0.05 * (high - low);
        (if low == 0.0 { 0.0 } else { low - room }, high + room)
    }

    /// The points by the way on which they are seen, machine by machine.
    fn points(&self, panel: &Panel, show: Show) -> [Vec<(f64, f64)>; 3] {
        let grain = (
            GRAIN * (panel.x.1 - panel.x.0) / PANEL.0,
            GRAIN * (panel.y.1 - panel.y.0) / PANEL.1,
        );
        let mut points: [Vec<(f64, f64)>; 3] = Default::default();
        let machines = self
            .chains
            .chunk_by(|a, b| a.direction != b.direction && a.direction == Direction::Up);
        for machine in machines {
            let mut seen = Points::new();
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
    fn names(&self, pen: &mut Pen, panel: &Panel) {
        let several = self.chains.len() > 2 && self.plan.parameter != Parameter::Clearance;
        let first = self.chains.iter();
        let first = first.filter(|chain| several && chain.direction == self.chains[0].direction);
        for chain in first {
            let steps = chain.steps.iter();
            let highest = steps.max_by(|a, b| a.max_position.total_cmp(&b.max_position));
            let clearance = chain.machine.value(Parameter::Clearance);
            let (Some(clearance), Some(step)) = (clearance, highest) else {
                continue;
            };
            let (x, y) = panel.place((step.value, step.max_position));
            let name = match self.machine.speaks {
                Language::Ratios => format!("ρ = {clearance}"),
                _ => format!("clearance {clearance} m"),
            };
            pen.text((x, y - 6.0), LETTERS - 2, Align::Middle, &name);
        }
    }

    /// Arrows where the motion jumps so far that it is seen.
    fn arrows(&self, pen: &mut Pen, panel: &Panel) {
        for chain in self.chains {
            let color = match chain.direction {
                Direction::Up => WAYS[1].1,
                Direction::Down => WAYS[2].1,
            };
            for jump in chain.jumps() {
                let (before, after) = jump.velocities;
                if (before - after).abs() > SEEN * panel.y.1 {
                    let ends = [(jump.from, before), (jump.to, after)];
                    let [from, to] = ends.map(|point| panel.place(point));
                    pen.arrow(from, to, Stroke::solid(color, 1.0));
                }
            }
        }
    }

    fn legend(&self) -> Vec<(Sign, String)> {
        let goes = |way| self.chains.iter().any(|chain| chain.direction == way);
        let (up, down) = (goes(Direction::Up), goes(Direction::Down));
        let wanted = WAYS.into_iter().zip([up && down, up, down]);
        let wanted = wanted.filter(|(_, wanted)| *wanted);
        wanted
            .map(|((name, color), _)| (Sign::Patch(color), name.to_owned()))
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
