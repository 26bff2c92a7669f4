//! A value with its derivatives.

/// A value, and its derivatives by the coordinates of the search.
#[derive(Debug, Clone, PartialEq)]
pub struct Slope {
    /// The value.
    pub value: f64,
    /// Its derivatives.
    pub by: Vec<f64>,
}

/// Zeros, with a one at an index.
pub(super) fn unit_row(count: usize, one: Option<usize>) -> impl Iterator<Item = f64> {
    (0..count).map(move |index| if one == Some(index) { 1.0 } else { 0.0 })
}

impl Slope {
    /// What always holds.
    pub(super) fn free(coordinates: usize) -> Self {
        Self {
            value: 1.0,
            by: vec![0.0; coordinates],
        }
    }

    /// How far it lies beyond a bound, in units of that, or, of a bound of 0, of its largest derivative.
    pub(super) fn beyond(&self, bound: f64, sign: f64) -> Self {
        if self.value.is_infinite() {
            return Self {
                value: sign * self.value.signum(),
                by: vec![0.0; self.by.len()],
            };
        }
        let largest = self.by.iter().fold(0.0, |most: f64, by| most.max(by.abs()));
        let unit = match bound == 0.0 {
            true if largest > 0.0 => largest,
            true => self.value.abs().max(f64::MIN_POSITIVE),
            false => bound.abs(),
        };
        Self {
            value: sign * (self.value - bound) / unit,
            by: self.by.iter().map(|by| sign * by / unit).collect(),
        }
    }
}
