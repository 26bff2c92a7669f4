//! What pictures show of a design, computed from its machine, its zone and its motion alone.

mod basin;
mod comparison;
mod map;
mod portrait;
mod response;

pub use basin::basin;
pub use comparison::comparison;
pub use map::map;
pub use portrait::portrait;
pub use response::{bands, response};

use softstop::{Dimension, Language, Machine, Parameter, Scene};
use softstop_console::interrupt;
use softstop_dynamics::continuation::{Follower, Heading, Test};
use softstop_dynamics::watch::stop_if;
use softstop_dynamics::{Along, BranchPoint, Orbit, Zone};

use super::data::Label;

/// The label of a parameter of a machine.
pub(crate) fn label_of(machine: &Machine, parameter: Parameter) -> Label {
    let about = parameter.about();
    match machine.speaks {
        Language::Ratios => Label::new(about.meaning, about.symbol, ""),
        _ if parameter == Parameter::Preload && machine.preload_deflection.is_some() => Label::new(
            "preload of the stop as a deflection",
            "",
            machine.unit_of(parameter),
        ),
        _ => Label::new(about.meaning, "", machine.unit_of(parameter)),
    }
}

/// The label of a quantity in a machine's own units, with its letter if it speaks ratios.
fn label(machine: &Machine, name: &str, symbol: &str, dimension: Dimension) -> Label {
    match machine.speaks {
        Language::Ratios => Label::new(name, symbol, ""),
        _ => Label::new(name, "", machine.unit(dimension)),
    }
}

/// The label of the before-impact velocity.
fn velocity(machine: &Machine) -> Label {
    label(
        machine,
        "before-impact velocity",
        "X′₋",
        Dimension::Velocity,
    )
}

/// The machine's scene with nothing to pierce where its strip was.
fn unfed(scene: &Scene) -> Option<Scene> {
    let mut scene = scene.clone();
    let strip = scene.piercing.as_mut()?;
    (strip.stiffness, strip.friction) = (0.0, 0.0);
    Some(scene)
}

/// The z = 1 motions of a zone: those above g0, and those below, from g0 down.
struct Motions {
    above: Vec<BranchPoint>,
    below: Vec<BranchPoint>,
    /// Frequency in rad/s at which the period doubles below g0.
    flip: Option<f64>,
}

/// Points after which the motions below g0 are given up, and how far they are looked for.
const LONGEST: usize = 400;
const FARTHEST: f64 = 4.0;
/// Points put in between two of a branch, for a curve without visible corners.
const BETWEEN: u32 = 8;

impl Motions {
    fn of(zone: &Zone) -> Self {
        let (below, flip) = below(zone).unwrap_or_default();
        Self {
            above: zone.branch.clone(),
            below,
            flip,
        }
    }

    /// The same with others between them.
    fn refined(self, zone: &Zone) -> Self {
        Self {
            above: refined(&zone.scene, &self.above),
            below: refined(&zone.scene, &self.below),
            ..self
        }
    }

    /// Least and greatest frequency in rad/s.
    fn range(&self) -> [f64; 2] {
        let all = || self.above.iter().chain(&self.below).map(|it| it.parameter);
        [
            all().fold(f64::INFINITY, f64::min),
            all().fold(0.0, f64::max),
        ]
    }

    /// The highest velocity of a stable motion at a frequency in rad/s, between neighbours along a straight line.
    fn velocity_at(&self, frequency: f64) -> Option<f64> {
        let at = |pair: &[BranchPoint]| {
            let (from, to) = (&pair[0], &pair[1]);
            let share = (frequency - from.parameter) / (to.parameter - from.parameter);
            let (a, b) = (from.before_impact_velocity(), to.before_impact_velocity());
            (is_shown(from) && is_shown(to) && (0.0..=1.0).contains(&share))
                .then_some(a + share * (b - a))
        };
        let pairs = self.above.windows(2).chain(self.below.windows(2));
        pairs.filter_map(at).max_by(f64::total_cmp)
    }
}

/// Stable, or at the end of what is stable.
pub(crate) fn is_shown(point: &BranchPoint) -> bool {
    let end = point
        .fold_test()
        .abs()
        .min(Test::Flip.value(&point.monodromy).abs());
    point.is_stable() || end < 1e-6
}

/// The stable motions from g0 down, and where their period doubles.
fn below(zone: &Zone) -> Option<(Vec<BranchPoint>, Option<f64>)> {
    let start: Orbit = zone.orbit(zone.branch.first()?).ok()?;
    let family = Along::new(start.scene.clone(), [Parameter::Frequency]).ok()?;
    let follower = Follower::new(&family, 1);
    let from = start.scene.excitation.frequency;
    let mut points = follower
        .follow(&start, from, Heading::Down, LONGEST, |point| {
            let ends = !point.is_stable() || point.parameter < from / FARTHEST;
            stop_if(ends || interrupt::watch(0, 0).is_break())
        })
        .ok()?;
    let flips = |point: &BranchPoint| Test::Flip.value(&point.monodromy) <= 0.0;
    let last = points.pop_if(|point| !point.is_stable());
    let flip = last
        .filter(flips)
        .and_then(|last| follower.critical(&last, Test::Flip).ok());
    let at = flip.as_ref().map(|flip| flip.parameter);
    points.extend(flip);
    Some((points, at))
}

/// Motions of a branch with others between them, where Newton's method stays between its neighbours.
pub(crate) fn refined(scene: &Scene, points: &[BranchPoint]) -> Vec<BranchPoint> {
    let Ok(family) = Along::new(scene.clone(), [Parameter::Frequency]) else {
        return points.to_vec();
    };
    let follower = Follower::new(&family, 1);
    let mut all: Vec<BranchPoint> = points.first().cloned().into_iter().collect();
    for pair in points.windows(2) {
        let (from, to) = (&pair[0], &pair[1]);
        let shares = (1..=BETWEEN).map(|step| f64::from(step) / f64::from(BETWEEN + 1));
        let new = shares.filter_map(|share| {
            let frequency = from.parameter + share * (to.parameter - from.parameter);
            let state = from.state() + share * (to.state() - from.state());
            let point = follower.point(frequency, state).ok()?;
            let inside = |value: f64, a: f64, b: f64| value >= a.min(b) && value <= a.max(b);
            inside(point.position, from.position, to.position).then_some(point)
        });
        all.extend(new);
        all.push(to.clone());
    }
    all
}
