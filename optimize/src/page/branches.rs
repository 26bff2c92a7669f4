//! The z = 1 motions of a zone and below it, as curves of the velocity over the drive's frequency.

use softstop::{Dimension, Machine, Parameter, Scene};
use softstop_console::interrupt;
use softstop_draw::Stroke;
use softstop_dynamics::continuation::{Continuation, Direction, TestFunction};
use softstop_dynamics::monitor::stop_if;
use softstop_dynamics::zone::loss_of_stability;
use softstop_dynamics::{BranchPoint, Orbit, ParameterFamily, Zone};

use super::figure::Curve;
use crate::placed::{fold, grazing};

/// The z = 1 motions of a zone, and those below it where it begins at g0.
pub(super) struct ZoneBranches {
    above: Vec<BranchPoint>,
    below: Vec<BranchPoint>,
    /// Frequencies in rad/s of g0, of `s_SN` and of where the period doubles, as far as there are such.
    pub(super) borders: [Option<f64>; 3],
}

/// What these borders are called.
pub(super) const BORDERS: [&str; 3] = ["g₀", "s_SN", "s_PD"];

/// Points after which the motions below g0 are given up, and how far they are looked for.
const LONGEST: usize = 400;
const FARTHEST: f64 = 4.0;
/// Points put in between two of a branch, for a curve without visible corners.
const BETWEEN: u32 = 8;

impl ZoneBranches {
    pub(super) fn of(zone: &Zone) -> Self {
        let (below, flip) = match zone.begins_at_g0() {
            true => below(zone).unwrap_or_default(),
            false => {
                let mut ends = [&zone.low, &zone.high].into_iter();
                let flip = ends.find(|end| end.is_critical(TestFunction::Flip));
                (Vec::new(), flip.map(|end| end.frequency))
            }
        };
        Self {
            above: zone.branch.clone(),
            below,
            borders: [grazing(zone), fold(zone), flip],
        }
    }

    /// The same with others between them.
    pub(super) fn refined(self, zone: &Zone) -> Self {
        Self {
            above: refined(&zone.scene, &self.above),
            below: refined(&zone.scene, &self.below),
            ..self
        }
    }

    /// Least and greatest frequency in rad/s.
    pub(super) fn range(&self) -> [f64; 2] {
        let all = || self.above.iter().chain(&self.below).map(|it| it.parameter);
        [
            all().fold(f64::INFINITY, f64::min),
            all().fold(0.0, f64::max),
        ]
    }

    /// The highest velocity of a stable motion at a frequency in rad/s, between neighbours along a straight line.
    pub(super) fn velocity_at(&self, frequency: f64) -> Option<f64> {
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

    /// The stable motions of this machine as curves of one name.
    pub(super) fn stable(&self, machine: &Machine, name: &str, stroke: Stroke) -> Vec<Curve> {
        let all = [&self.below, &self.above].into_iter();
        let pieces = all.flat_map(|points| points.chunk_by(|a, b| is_shown(a) && is_shown(b)));
        curves(machine, pieces, name, stroke)
    }

    /// The unstable motions of the zone's branch.
    pub(super) fn unstable(&self, machine: &Machine, name: &str, stroke: Stroke) -> Vec<Curve> {
        let pieces = self.above.chunk_by(|a, b| is_lost(a) && is_lost(b));
        curves(machine, pieces, name, stroke)
    }
}

/// Pieces of a branch of this machine in its own units.
fn curves<'a>(
    machine: &Machine,
    pieces: impl Iterator<Item = &'a [BranchPoint]>,
    name: &str,
    stroke: Stroke,
) -> Vec<Curve> {
    let place = |point: BranchPoint| {
        let frequency = machine.to_own(Dimension::Frequency, point.parameter);
        (frequency, point.before_impact_velocity())
    };
    let curve = |piece: &[BranchPoint]| Curve {
        name: name.to_owned(),
        stroke,
        points: refined(&machine.scene, piece)
            .into_iter()
            .map(place)
            .collect(),
    };
    let pieces = pieces.filter(|piece| piece.len() > 1);
    pieces.map(curve).collect()
}

/// Unstable, or a fold, where an unstable piece begins.
fn is_lost(point: &BranchPoint) -> bool {
    !point.is_stable() || point.fold_test().abs() < 1e-6
}

/// Stable, or at the end of what is stable.
fn is_shown(point: &BranchPoint) -> bool {
    let end = point
        .fold_test()
        .abs()
        .min(TestFunction::Flip.scaled_value(&point.monodromy).abs());
    point.is_stable() || end < 1e-6
}

/// The stable motions from g0 down, and where their period doubles.
fn below(zone: &Zone) -> Option<(Vec<BranchPoint>, Option<f64>)> {
    let start: Orbit = zone.orbit_of(zone.branch.first()?).ok()?;
    let family = ParameterFamily::new(Scene::clone(&start.scene), [Parameter::Frequency]).ok()?;
    let follower = Continuation::new(&family, 1);
    let from = start.scene.excitation.frequency;
    let mut points = follower
        .follow_points(&start, from, Direction::Down, LONGEST, |point| {
            let ends = !point.is_stable() || point.parameter < from / FARTHEST;
            stop_if(ends || interrupt::watch(0, 0).is_break())
        })
        .ok()?;
    let last = points.pop_if(|point| !point.is_stable());
    let flip =
        last.and_then(|_| loss_of_stability(&start, Direction::Down, TestFunction::Flip).ok()?);
    let at = flip.as_ref().map(|flip| flip.parameter);
    points.extend(flip);
    Some((points, at))
}

/// Motions of a branch with others between them, where Newton's method stays between its neighbours.
fn refined(scene: &Scene, points: &[BranchPoint]) -> Vec<BranchPoint> {
    let Ok(family) = ParameterFamily::new(scene.clone(), [Parameter::Frequency]) else {
        return points.to_vec();
    };
    let follower = Continuation::new(&family, 1);
    let mut all: Vec<BranchPoint> = points.first().cloned().into_iter().collect();
    for pair in points.windows(2) {
        let (from, to) = (&pair[0], &pair[1]);
        let shares = (1..=BETWEEN).map(|step| f64::from(step) / f64::from(BETWEEN + 1));
        let new = shares.filter_map(|share| {
            let frequency = from.parameter + share * (to.parameter - from.parameter);
            let state = from.state() + share * (to.state() - from.state());
            let point = follower.find_point(frequency, state).ok()?;
            let inside = |value: f64, a: f64, b: f64| value >= a.min(b) && value <= a.max(b);
            inside(point.position, from.position, to.position).then_some(point)
        });
        all.extend(new);
        all.push(to.clone());
    }
    all
}
