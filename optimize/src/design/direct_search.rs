//! A direct search: without derivatives, by points around the best so far (Kolda, Lewis and Torczon 2003).

use std::mem;

use softstop_console::interrupt;

use super::coordinates::Coordinates;
use super::problem::Problem;

/// First distance of the points around the best, in edges of the cube.
const FIRST: f64 = 0.08;
/// Factor by which the distance shrinks where nothing better is found, and grows again, up to the first, where something is.
const SHRINKING: f64 = 0.7;

/// A direct search until its step is shorter than the last one, and again from the first step on as long as that gains: `better`
/// tells the best of some points, if that is better, and whether it gains enough. Directions turn, and a step that bettered is gone
/// on with: where the border of the machines that have a zone holds a design back, only a narrow cone of directions leads up.
pub(super) fn direct_search<T>(
    problem: &Problem,
    mut best: T,
    last: f64,
    unit: impl Fn(&T) -> &Vec<f64>,
    better: impl Fn(&[Vec<f64>], &T) -> Option<(T, bool)>,
) -> T {
    let mut step = FIRST;
    let mut before: Option<T> = None;
    let mut has_gained = false;
    for turn in 0.. {
        if step < last && mem::take(&mut has_gained) {
            step = FIRST;
        }
        if step < last || interrupt::requested() {
            break;
        }
        let coordinates = Coordinates::new(problem, unit(&best));
        let mut units = coordinates.around(step, turn);
        units.extend(before.iter().flat_map(|it| coordinates.beyond(unit(it))));
        match better(&units, &best) {
            Some((better, gains)) => {
                has_gained |= gains;
                step = match gains {
                    true => FIRST.min(step / SHRINKING),
                    false => step * SHRINKING,
                };
                before = Some(mem::replace(&mut best, better));
            }
            None => {
                step *= SHRINKING;
                before = None;
            }
        }
    }
    best
}
