//! Groups of wandering motions that are one and the same, because their logs visit the same places.
//!
//! States of two logs of one motion mix: the nearest other state belongs to either log equally often, however thin
//! or wide the set is that they fill (the nearest-neighbour test for two samples, Schilling 1986). States of
//! two motions apart from each other have all their nearest neighbours in their own log. Where a motion is nearly
//! periodic for long (intermittency), each log is a few slow strands, and neighbours are those next on the strand:
//! there the strands of one motion share the cells of a grid. Either is enough.

use crate::extremes::extremes;
use softstop::Start;
use softstop::internals::budget;

/// Least share of the states of two logs whose nearest neighbours lie in the other log, from which on the logs are of one motion:
/// it is 0.5 on average for one motion, with a standard deviation of 0.05 or more for logs of 129 states, and 0 for two. Also the
/// least share of the larger set of cells that logs of one motion have in common.
const MIXED_SHARE: f64 = 0.1;

/// Number of pairs of states of two logs that are compared at the cost of one scan window.
const STATE_PAIRS_PER_SCAN_WINDOW: usize = 8;

/// A state in units of the width and height of the region that all logs fill.
type ScaledState = [f64; 2];

/// Groups logs of wandering motions that visit the same places, and so are of one motion: the index of its group for each log.
///
/// # Errors
/// Those of `ask`, which is asked for each log.
pub(super) fn group_logs<E>(
    logs: &[&[Start]],
    ask: impl Fn() -> Result<(), E>,
) -> Result<Vec<usize>, E> {
    let units = plane_units(logs);
    let place = |state: &Start| [state.position / units[0], state.velocity / units[1]];
    let places = logs.iter().map(|log| log.iter().map(place).collect());
    let places: Vec<Vec<ScaledState>> = places.collect();
    let cells: Vec<Vec<(i64, i64)>> = places.iter().map(|log| visited_cells(log)).collect();
    let own = places
        .iter()
        .map(|log| ask().map(|()| nearest_gaps_within(log)));
    let own = own.collect::<Result<Vec<Vec<f64>>, E>>()?;
    let mut group: Vec<usize> = (0..logs.len()).collect();
    for index in 0..logs.len() {
        ask()?;
        for other in 0..index {
            if group[index] == group[other] {
                continue;
            }
            budget::charge(
                (logs[index].len() * logs[other].len() / STATE_PAIRS_PER_SCAN_WINDOW) as u64,
            );
            let pair = [index, other].map(|at| (places[at].as_slice(), own[at].as_slice()));
            if have_common_cells(&cells[index], &cells[other]) || are_mixed(pair) {
                let (kept, gone) = (group[other], group[index]);
                for member in &mut group {
                    if *member == gone {
                        *member = kept;
                    }
                }
            }
        }
    }
    Ok(group)
}

/// Width and height of the range of positions and velocities that the states of all logs fill.
fn plane_units(logs: &[&[Start]]) -> [f64; 2] {
    let range = |value: fn(&Start) -> f64| match extremes(logs.iter().copied().flatten().map(value))
    {
        Some([low, high]) if high > low => high - low,
        _ => 1.0,
    };
    [range(|state| state.position), range(|state| state.velocity)]
}

/// Squared distance of two scaled states of logs.
fn squared_distance(a: &ScaledState, b: &ScaledState) -> f64 {
    let (x, v) = (a[0] - b[0], a[1] - b[1]);
    x * x + v * v
}

/// The squared distance of each state of a log from the nearest other state of that log.
fn nearest_gaps_within(log: &[ScaledState]) -> Vec<f64> {
    let gap = |index: usize| {
        let others = log.iter().enumerate().filter(|(other, _)| *other != index);
        let squares = others.map(|(_, other)| squared_distance(&log[index], other));
        squares.fold(f64::INFINITY, f64::min)
    };
    (0..log.len()).map(gap).collect()
}

/// The cells of a grid over the plane of states that a log visits, sorted.
fn visited_cells(log: &[ScaledState]) -> Vec<(i64, i64)> {
    let cell = |place: &ScaledState| {
        // A hundred cells across the plane.
        let [x, v] = place.map(|part| (100.0 * part).floor() as i64);
        (x, v)
    };
    let mut cells: Vec<(i64, i64)> = log.iter().map(cell).collect();
    cells.sort_unstable();
    cells.dedup();
    cells
}

/// True if two logs have so many of their cells in common that they are of one motion.
fn have_common_cells(a: &[(i64, i64)], b: &[(i64, i64)]) -> bool {
    let common = a.iter().filter(|cell| b.binary_search(cell).is_ok());
    common.count() as f64 >= MIXED_SHARE * a.len().max(b.len()) as f64
}

/// True if so many states of two logs, with their [`nearest_gaps_within`], are next to the other log that both are of one motion.
fn are_mixed([one, other]: [(&[ScaledState], &[f64]); 2]) -> bool {
    let abroad = |(from, own): (&[ScaledState], &[f64]), to: &[ScaledState]| {
        let range = |axis: usize| extremes(to.iter().map(|at| at[axis])).unwrap_or([0.0; 2]);
        let [across, up] = [range(0), range(1)];
        let within = |value: f64, [low, high]: [f64; 2]| value.max(low).min(high);
        // The nearest place of the box that holds them all is no farther than any of them.
        let is_nearer = |(place, gap): &(&ScaledState, &f64)| {
            let nearest = [within(place[0], across), within(place[1], up)];
            squared_distance(place, &nearest) < **gap
                && to.iter().any(|at| squared_distance(place, at) < **gap)
        };
        from.iter().zip(own).filter(is_nearer).count()
    };
    let mixed = abroad(one, other.0) + abroad(other, one.0);
    mixed as f64 >= MIXED_SHARE * (one.0.len() + other.0.len()) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    fn all(logs: &[&[Start]]) -> Vec<usize> {
        let groups: Result<Vec<usize>, Infallible> = group_logs(logs, || Ok(()));
        groups.expect("nothing fails")
    }

    /// A motion along a circle.
    fn circle(radius: f64, from: f64) -> Vec<Start> {
        let state = |k: u32| {
            let angle = from + 2.4 * f64::from(k);
            Start::new(radius * angle.cos(), radius * angle.sin())
        };
        (0..256).map(state).collect()
    }

    #[test]
    fn motions_on_the_same_places_are_one() {
        let logs = [circle(1.0, 0.0), circle(0.7, 0.3), circle(1.0, 0.1)];
        let logs: Vec<&[Start]> = logs.iter().map(Vec::as_slice).collect();
        let groups = all(&logs);
        assert_eq!(groups[0], groups[2]);
        assert_ne!(groups[0], groups[1]);
    }

    /// A motion all over a square.
    fn square_filled(seed: u32) -> Vec<Start> {
        let share = |step: f64, k: u32| (step * f64::from(k + seed)).fract();
        let state = |k: u32| {
            Start::new(
                share(0.754_877_666_246_692_7, k * k),
                share(0.569_840_290_998_053_3, k * k * k),
            )
        };
        (0..129).map(state).collect()
    }

    #[test]
    fn logs_that_fill_the_plane_thinly_are_one_motion() {
        let logs: Vec<Vec<Start>> = (0..64).map(|k| square_filled(1000 * k)).collect();
        let logs: Vec<&[Start]> = logs.iter().map(Vec::as_slice).collect();
        let groups = all(&logs);
        assert!(groups.iter().all(|group| *group == groups[0]), "{groups:?}");
    }
}
