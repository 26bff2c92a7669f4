//! The highest value of a function between two places.

use std::f64::consts::TAU;

/// Share of an interval that each step of a golden section keeps.
const KEPT: f64 = 0.618_033_988_749_894_9;
/// Samples of a function in the time of its fastest oscillation, at least and at most.
const LOOKS: f64 = 24.0;
const FEWEST: f64 = 6.0;
const MOST: f64 = 4096.0;
/// Share of the time between two samples to which a peak is known; being flat it is known to rounding then.
const WIDTH: f64 = 1e-8;

/// The largest value between two times of a function that oscillates no faster than with `rate` in rad/s.
pub fn largest_value((from, to): (f64, f64), rate: f64, value: impl Fn(f64) -> f64) -> f64 {
    let looks = (LOOKS * rate * (to - from) / TAU)
        .clamp(FEWEST, MOST)
        .ceil();
    let at = |look: f64| from + (to - from) * (look / looks);
    let all: Vec<f64> = (0..=looks as u32)
        .map(|look| value(at(look.into())))
        .collect();
    let before = |look: usize| all[look.saturating_sub(1)];
    let after = |look: usize| all[(look + 1).min(all.len() - 1)];
    let tops = (0..all.len()).filter(|&look| all[look] >= before(look).max(after(look)));
    let tops = tops.map(|look| {
        let ends = [look as f64 - 1.0, look as f64 + 1.0].map(|end| at(end.clamp(0.0, looks)));
        let (_, top) = highest_point(ends[0], ends[1], WIDTH * (at(1.0) - from), &value);
        top.max(all[look])
    });
    tops.fold(f64::NEG_INFINITY, f64::max)
}

/// Where a function with one peak between `low` and `high` is highest, and how high, by golden section (Kiefer 1953)
/// until the place is known to `width`, or to rounding.
pub fn highest_point(low: f64, high: f64, width: f64, value: impl Fn(f64) -> f64) -> (f64, f64) {
    let (mut low, mut high) = (low, high);
    let inner = |low: f64, high: f64| [high - KEPT * (high - low), low + KEPT * (high - low)];
    let mut places = inner(low, high);
    let mut values = places.map(&value);
    while high - low > width && low < places[0] && places[0] < places[1] && places[1] < high {
        if values[0] > values[1] {
            high = places[1];
            places = [inner(low, high)[0], places[0]];
            values = [value(places[0]), values[0]];
        } else {
            low = places[0];
            places = [places[1], inner(low, high)[1]];
            values = [values[1], value(places[1])];
        }
    }
    (places[0], values[0])
}

#[cfg(test)]
mod tests {
    use super::{highest_point, largest_value};

    #[test]
    fn the_peak_is_found_as_well_as_its_flat_top_allows() {
        let (place, value) = highest_point(-1.0, 3.0, 1e-9, |x| 2.0 - (x - 0.7).powi(2));
        assert!(
            (place - 0.7).abs() < 1e-7 && (value - 2.0).abs() < 1e-14,
            "{place} {value}"
        );
    }
    #[test]
    fn a_stretch_that_rounding_hardly_resolves_has_a_largest_value() {
        for (from, length) in [(5.0, 1e-9), (5.0, 1e-15), (0.0, f64::MIN_POSITIVE)] {
            let largest = largest_value((from, from + length), 1.0, |x| 2.0 - x);
            assert!((largest - (2.0 - from)).abs() < 1e-12, "{largest}");
        }
    }
}
