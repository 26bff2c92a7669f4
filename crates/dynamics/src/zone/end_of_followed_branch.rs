//! The end of the stable motions of a branch that was followed.

use super::zone_end::{Loss, ZoneEnd, first_end};
use crate::continuation::{
    Branch, BranchLimits, BranchPoint, Continuation, Direction, SpecialKind, TestFunction,
};
use crate::monitor::stop_if;
use crate::orbit::OrbitError;

/// Most points of a branch that is followed for the end of a zone; after these it is given up.
pub const LONGEST_BRANCH: usize = 2000;

/// Finds where the stable motions of a branch end that was followed in `direction` from the first of `points` on: cuts the points
/// there and appends the end. Where no test function tells it, as at a grazing, the branch is followed again with all special
/// points.
///
/// # Errors
/// [`OrbitError`] if the branch cannot be followed.
pub fn find_end(
    continuation: &Continuation<'_>,
    points: &mut Vec<BranchPoint>,
    direction: Direction,
    range: (f64, f64),
) -> Result<ZoneEnd, OrbitError> {
    let is_beyond =
        |point: &BranchPoint| !point.is_stable() || !(range.0..=range.1).contains(&point.parameter);
    let first = points.iter().skip(1).position(is_beyond);
    let beyond = first.and_then(|first| points.drain(first + 1..).next());
    if let (Some(before), Some(beyond)) = (points.last(), beyond)
        && let Ok(end) = end_between(continuation, before, beyond, range)
    {
        points.push(end.point.clone());
        return Ok(end);
    }
    follow_to_end(continuation, points, direction, range)
}

/// The end of stable motions between a stable point and one `beyond`: at the zero of a test function, or at the range's bound.
fn end_between(
    continuation: &Continuation<'_>,
    before: &BranchPoint,
    mut beyond: BranchPoint,
    (low, high): (f64, f64),
) -> Result<ZoneEnd, OrbitError> {
    if !beyond.is_stable() {
        let fails = |test: &TestFunction| test.scaled_value(&beyond.monodromy) <= 0.0;
        let test = TestFunction::ALL.into_iter().find(fails);
        let test = test.ok_or(OrbitError::NotIsolated)?;
        beyond = continuation.critical_between(before, &beyond, test)?;
        // At a grazing the test jumps over zero.
        if test.jumps_at(&beyond.monodromy) {
            return Err(OrbitError::NotIsolated);
        }
        if (low..=high).contains(&beyond.parameter) {
            return Ok(ZoneEnd::at_special(&beyond, SpecialKind::Critical(test)));
        }
    }
    let bound = beyond.parameter.clamp(low, high);
    let point = continuation.point_between(before, &beyond, bound)?;
    Ok(ZoneEnd::at_point(&point, Loss::Range, None))
}

/// A branch that was followed anew, with its special points, from one of the stable points of another.
struct Followed {
    /// Index of that point.
    from: usize,
    branch: Branch,
    /// The bifurcation or grazing that ends its stable motions, if one does.
    named_end: Option<ZoneEnd>,
}

/// The points of a branch without its start, which has this value of the parameter.
fn points_beyond_start(branch: &Branch, start: f64) -> impl Iterator<Item = &BranchPoint> + Clone {
    let points = branch.points.iter();
    points.filter(move |point| point.parameter != start)
}

/// Follows stable motions with all special points to their end, from the last of `points` on, or where that fails from the first:
/// replaces the points after it by those of the branch, up to the end.
pub(super) fn follow_to_end(
    continuation: &Continuation<'_>,
    points: &mut Vec<BranchPoint>,
    direction: Direction,
    range: (f64, f64),
) -> Result<ZoneEnd, OrbitError> {
    let last = points.len().checked_sub(1).ok_or(OrbitError::NotIsolated)?;
    let follow_from = |from: usize| {
        let start = &points[from];
        let limits = BranchLimits {
            range: match direction {
                Direction::Up => (start.parameter, range.1),
                Direction::Down => (range.0, start.parameter),
            },
            points: LONGEST_BRANCH,
        };
        let branch = continuation.branch(start.parameter, start.state(), &limits, |point| {
            stop_if(!point.is_stable() || point.impacts.len() != 1)
        });
        branch.map(|mut branch| {
            if direction == Direction::Down {
                branch.points.reverse();
            }
            Followed {
                from,
                named_end: first_end(&branch, points_beyond_start(&branch, start.parameter)),
                branch,
            }
        })
    };
    // A branch from right beside its end may be lost there: the one from the first point tells what the end is.
    let followed = match follow_from(last) {
        Ok(found) if found.named_end.is_some() => found,
        other => match follow_from(0) {
            Ok(found) if other.is_err() || found.named_end.is_some() => found,
            _ => other?,
        },
    };
    let Followed {
        from,
        branch,
        named_end,
    } = followed;
    points.truncate(from + 1);
    let further = points_beyond_start(&branch, points[from].parameter);
    if let Some(end) = named_end {
        let until = further.take_while(|it| it.parameter != end.frequency);
        points.extend(until.chain([&end.point]).cloned());
        return Ok(end);
    }
    points.extend(further.filter(|point| point.is_stable()).cloned());
    let end = match direction {
        Direction::Up => &branch.ends.1,
        Direction::Down => &branch.ends.0,
    };
    let last = points.last().ok_or(OrbitError::NotIsolated)?;
    Ok(match branch.special_at(last) {
        Some(special) => ZoneEnd::at_special(last, special.kind),
        None => ZoneEnd::at_point(last, Loss::of_branch_end(end), None),
    })
}
