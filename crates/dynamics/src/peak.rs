//! The highest value of a function between two places.

/// Share of an interval that each step of a golden section keeps.
const KEPT: f64 = 0.618_033_988_749_894_9;

/// Where a function with one peak between `low` and `high` is highest, and how high, by golden section (Kiefer 1953)
/// until the place is known to `width`.
pub fn highest(low: f64, high: f64, width: f64, value: impl Fn(f64) -> f64) -> (f64, f64) {
    let (mut low, mut high) = (low, high);
    let inner = |low: f64, high: f64| [high - KEPT * (high - low), low + KEPT * (high - low)];
    let mut places = inner(low, high);
    let mut values = places.map(&value);
    while high - low > width {
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
    use super::highest;

    #[test]
    fn the_peak_is_found_as_well_as_its_flat_top_allows() {
        let (place, value) = highest(-1.0, 3.0, 1e-9, |x| 2.0 - (x - 0.7).powi(2));
        assert!(
            (place - 0.7).abs() < 1e-7 && (value - 2.0).abs() < 1e-14,
            "{place} {value}"
        );
    }
}
