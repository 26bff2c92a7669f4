//! The place and the height of the largest value of a function between two places.

use std::f64::consts::TAU;

/// Share of an interval that each step of the golden section keeps: (sqrt(5) - 1) / 2.
const GOLDEN_RATIO: f64 = 0.618_033_988_749_894_9;
/// Samples in each period of the fastest oscillation, between which the largest value is searched.
const SAMPLES_PER_OSCILLATION: f64 = 24.0;

/// Where a function that oscillates no faster than with `rate` in rad/s is largest between two times, and how large.
pub fn largest_value((from, to): (f64, f64), rate: f64, value: impl Fn(f64) -> f64) -> (f64, f64) {
    let steps = (SAMPLES_PER_OSCILLATION * rate * (to - from) / TAU)
        .clamp(6.0, 4096.0)
        .ceil();
    let at = |sample: f64| from + (to - from) * (sample / steps);
    let all: Vec<f64> = (0..=steps as u32)
        .map(|sample| value(at(sample.into())))
        .collect();
    let before = |sample: usize| all[sample.saturating_sub(1)];
    let after = |sample: usize| all[(sample + 1).min(all.len() - 1)];
    let tops = (0..all.len()).filter(|&sample| all[sample] >= before(sample).max(after(sample)));
    let tops = tops.map(|sample| {
        let ends = [sample as f64 - 1.0, sample as f64 + 1.0].map(|end| at(end.clamp(0.0, steps)));
        let top = highest_point(ends[0], ends[1], 1e-8 * (at(1.0) - from), &value);
        if top.1 > all[sample] {
            top
        } else {
            (at(sample as f64), all[sample])
        }
    });
    let higher = |one: (f64, f64), other: (f64, f64)| if other.1 > one.1 { other } else { one };
    tops.fold((from, f64::NEG_INFINITY), higher)
}

/// Where a function with one peak between `low` and `high` is highest, and how high, by golden section (Kiefer 1953)
/// until the place is known to `width`, or to rounding.
pub fn highest_point(low: f64, high: f64, width: f64, value: impl Fn(f64) -> f64) -> (f64, f64) {
    let (mut low, mut high) = (low, high);
    let inner = |low: f64, high: f64| {
        [
            high - GOLDEN_RATIO * (high - low),
            low + GOLDEN_RATIO * (high - low),
        ]
    };
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
            let (_, largest) = largest_value((from, from + length), 1.0, |x| 2.0 - x);
            assert!((largest - (2.0 - from)).abs() < 1e-12, "{largest}");
        }
    }
}
