//! Which wandering motions are one and the same: those that visit the same places.

use crate::integrator::Start;

/// Cells across the plane.
const CELLS: f64 = 100.0;
/// Share of the larger set of cells that two logs of one motion have in common at least.
const COMMON: f64 = 0.1;

/// Groups logs of states by the cells that they visit: the number of its group for each.
pub(super) fn groups(logs: &[&[Start]]) -> Vec<usize> {
    let widths = widths(logs);
    let cells: Vec<Vec<(i64, i64)>> = logs.iter().map(|log| cells(log, widths)).collect();
    let mut group: Vec<usize> = (0..logs.len()).collect();
    for index in 0..logs.len() {
        for other in 0..index {
            if group[index] != group[other] && meet(&cells[index], &cells[other]) {
                let (kept, gone) = (group[other], group[index]);
                for member in &mut group {
                    if *member == gone {
                        *member = kept;
                    }
                }
            }
        }
    }
    group
}

/// Size of a cell.
fn widths(logs: &[&[Start]]) -> (f64, f64) {
    let states = || logs.iter().flat_map(|log| log.iter());
    let range = |value: fn(&Start) -> f64| {
        let low = states().map(value).fold(f64::INFINITY, f64::min);
        let high = states().map(value).fold(f64::NEG_INFINITY, f64::max);
        if high > low {
            (high - low) / CELLS
        } else {
            1.0
        }
    };
    (range(|state| state.position), range(|state| state.velocity))
}

/// The cells of a log, in order.
fn cells(log: &[Start], widths: (f64, f64)) -> Vec<(i64, i64)> {
    let cell = |state: &Start| {
        let (x, v) = (state.position / widths.0, state.velocity / widths.1);
        (x.floor() as i64, v.floor() as i64)
    };
    let mut cells: Vec<(i64, i64)> = log.iter().map(cell).collect();
    cells.sort_unstable();
    cells.dedup();
    cells
}

fn meet(a: &[(i64, i64)], b: &[(i64, i64)]) -> bool {
    let common = a.iter().filter(|cell| b.binary_search(cell).is_ok());
    common.count() as f64 >= COMMON * a.len().max(b.len()) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A motion along a circle.
    fn circle(radius: f64, from: f64) -> Vec<Start> {
        let state = |k: u32| {
            let angle = from + 2.4 * f64::from(k);
            Start {
                position: radius * angle.cos(),
                velocity: radius * angle.sin(),
            }
        };
        (0..256).map(state).collect()
    }

    #[test]
    fn motions_on_the_same_places_are_one() {
        let logs = [circle(1.0, 0.0), circle(0.7, 0.3), circle(1.0, 0.1)];
        let logs: Vec<&[Start]> = logs.iter().map(Vec::as_slice).collect();
        let groups = groups(&logs);
        assert_eq!(groups[0], groups[2]);
        assert_ne!(groups[0], groups[1]);
    }
}
