//! The branch of the motion to start from, and those of its doublings.

use std::ops::ControlFlow;

use anyhow::anyhow;
use nalgebra::Vector2;
use softstop::Machine;
use softstop_dynamics::continuation::{
    BranchEnd, ContinuationSettings, Family, SpecialKind, TestFunction,
};
use softstop_dynamics::{Branch, BranchLimits, BranchPoint, Continuation};

use super::{ContinueArguments, FollowedParameter, family, seed};
use softstop_console::failure::{Failure, check_interrupt};
use softstop_console::progress::Progress;

/// Largest steps along branches and curves, scaled: fine enough for charts of wide ranges.
pub(super) const STEP: f64 = 0.02;
/// Steps of a narrow range, and the least share of `STEP` that they are.
const NARROW: (f64, f64) = (100.0, 0.1);
/// Number of steps across a range that `STEP` divides into more, as long as they are no longer than those of a continuation that
/// has no chart to draw.
const MAX_STEPS_ACROSS: f64 = 2000.0;

/// A continuation with steps that leave the chart of a range no corners.
fn continuation<'a>(
    family: &'a dyn Family,
    periods: u64,
    limits: &BranchLimits,
) -> Result<Continuation<'a>, Failure> {
    let [low, high] = <[f64; 2]>::from(limits.range).map(|end| family.scaled_parameters([end])[0]);
    let (steps, least) = NARROW;
    let width = high - low;
    let longest = ContinuationSettings::default().largest_step;
    let most = (width / MAX_STEPS_ACROSS).clamp(STEP, longest);
    let largest = (width / steps).clamp(least * STEP, most);
    Ok(Continuation::new(family, periods).with_steps(largest)?)
}

/// Counts a point; asks to stop after Ctrl-C.
pub(super) fn count(bar: &Progress) -> ControlFlow<()> {
    match bar.step() {
        Ok(()) => ControlFlow::Continue(()),
        Err(_) => ControlFlow::Break(()),
    }
}

/// The branch of the start, and doubled ones.
pub(super) fn branches(
    arguments: &ContinueArguments,
    machine: &Machine,
    along: &FollowedParameter,
    (periods, state): (u64, Option<Vector2<f64>>),
) -> Result<Vec<Branch>, Failure> {
    let family = &family(machine, [along.parameter])?;
    let limits = &BranchLimits {
        range: along.range,
        points: arguments.points,
    };
    let state = match state {
        Some(state) => state,
        None => seed::find(&machine.scene, arguments.orbit)?.state(),
    };
    let bar = Progress::open("points");
    let first = continuation(family, periods, limits)?
        .branch(along.start, state, limits, |_| count(&bar))
        .map_err(|error| anyhow!(error).context("no orbit to start from"))?;
    let mut branches = vec![first];
    let mut done = 0;
    for _ in 0..arguments.double {
        let fresh = done..branches.len();
        done = fresh.end;
        for index in fresh {
            let doubled = doubled(family, &branches[index], limits, &bar)?;
            branches.extend(doubled);
        }
    }
    drop(bar);
    check_interrupt()?;
    Ok(branches)
}

/// Distance, in units of the scale of the parameter, between the end of a branch that merges into another one and the special point
/// of that. Beside such a point orbits change with the root of the parameter.
const MERGING_DISTANCE: f64 = 1e-6;

/// The branches of twice the period from the flips of one, and those of asymmetric orbits from its pitchforks, each from one end
/// alone.
fn doubled(
    family: &dyn Family,
    branch: &Branch,
    limits: &BranchLimits,
    bar: &Progress,
) -> Result<Vec<Branch>, Failure> {
    let follower = continuation(family, branch.periods, limits)?;
    let mut found: Vec<Branch> = Vec::new();
    let flips = branch.critical_points(TestFunction::Flip);
    let pitchforks = branch.specials.iter();
    let pitchforks = pitchforks.filter(|special| special.kind == SpecialKind::Pitchfork);
    let pitchforks = pitchforks.map(|special| (&special.point, true));
    for (point, is_pitchfork) in flips.map(|flip| (flip, false)).chain(pitchforks) {
        let merges_here = |other: &Branch| {
            let merges = match other.ends.1 {
                BranchEnd::Merged => !is_pitchfork,
                BranchEnd::Symmetric => is_pitchfork,
                _ => false,
            };
            merges && ends_at(&follower, family, other, point)
        };
        if found.iter().any(merges_here) {
            continue;
        }
        found.extend(match is_pitchfork {
            false => follower.double_period(point, limits, |_| count(bar)),
            true => follower.branch_asymmetric(point, limits, |_| count(bar)),
        });
    }
    Ok(found)
}

/// True if a branch ends in the orbit at a point of another one, whose continuation this is, whatever number of drive periods later.
fn ends_at(
    continuation: &Continuation<'_>,
    family: &dyn Family,
    branch: &Branch,
    point: &BranchPoint,
) -> bool {
    let [slope] = family.parameter_derivatives([point.parameter]);
    let [length, speed] = family.state_scales();
    let is_beside =
        |last: &&BranchPoint| (last.parameter - point.parameter).abs() < MERGING_DISTANCE * slope;
    let Some(last) = branch.points.last().filter(is_beside) else {
        return false;
    };
    let is_last = |state: &Vector2<f64>| {
        let apart = last.state() - state;
        (apart.x / length).hypot(apart.y / speed) < MERGING_DISTANCE.sqrt()
    };
    let orbit = continuation.orbit_at(point);
    let states = orbit.ok().and_then(|orbit| orbit.states().ok());
    states.is_some_and(|states| states.iter().any(is_last))
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use nalgebra::Vector2;
    use softstop::{Parameter, Ratios};
    use softstop_dynamics::continuation::TestFunction;
    use softstop_dynamics::{BranchLimits, BranchPoint, Continuation, ParameterFamily};

    use super::ends_at;

    #[test]
    fn orbits_at_one_value_of_the_parameter_are_told_apart_by_their_states() {
        let scene = Ratios::unloaded().scene().expect("a scene");
        let family = ParameterFamily::new(scene, [Parameter::Frequency]).expect("a family");
        let continuation = Continuation::new(&family, 1);
        let limits = BranchLimits {
            range: (0.95, 1.2),
            points: 500,
        };
        let go_on = |_: &BranchPoint| ControlFlow::Continue(());
        let branch = continuation.branch(1.15, Vector2::new(6.9, 9.5), &limits, go_on);
        let branch = branch.expect("a branch");
        let mut flips = branch.critical_points(TestFunction::Flip);
        let flip = flips.next().expect("a flip").clone();
        let ends = |point: &BranchPoint| {
            let mut other = branch.clone();
            other.points = vec![point.clone()];
            ends_at(&continuation, &family, &other, &flip)
        };
        assert!(ends(&flip));
        let parameter = flip.parameter + 1e-9;
        assert!(ends(&BranchPoint {
            parameter,
            ..flip.clone()
        }));
        let parameter = flip.parameter + 1e-5;
        assert!(!ends(&BranchPoint {
            parameter,
            ..flip.clone()
        }));
        let position = flip.position + 0.1;
        assert!(!ends(&BranchPoint {
            position,
            ..flip.clone()
        }));
        let doubled = continuation.double_period(&flip, &limits, go_on);
        let mut doubled = doubled.expect("a branch of twice the period");
        let point = doubled.points[1].clone();
        let twice = Continuation::new(&family, 2);
        let later = twice
            .orbit_at(&point)
            .and_then(|orbit| Ok(orbit.states()?[1]));
        let later = later.expect("a motion");
        doubled.points = vec![BranchPoint {
            position: later.x,
            velocity: later.y,
            ..point.clone()
        }];
        assert!(ends_at(&twice, &family, &doubled, &point));
    }
}
