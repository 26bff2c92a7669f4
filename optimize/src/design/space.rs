//! The box that is searched, and its image, the unit cube that the optimiser sees.

use std::{fmt, iter};

use softstop::Parameter;

/// An end of a range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum End {
    /// The lower one; of a zone g0.
    Lower,
    /// The upper one; of a zone `s_SN`.
    Upper,
}

/// What rounding may do to a place in a zone.
pub(super) const ROUNDING: f64 = 1e-12;
/// Distance from an end of a range, as a share of it, that is none.
const AT_END: f64 = 1e-9;
/// Upper end of a range in units of the lower one from which on it is searched by the logarithm.
const DECADES: f64 = 1e3;

/// A closed interval; a value that is held has both ends equal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end, not below the lower one; may be infinite.
    pub high: f64,
}

impl Interval {
    /// No bounds of a positive value.
    pub const ANY: Self = Self {
        low: f64::MIN_POSITIVE,
        high: f64::INFINITY,
    };

    /// From one end to the other.
    pub const fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    /// A single value.
    pub const fn held(value: f64) -> Self {
        Self::new(value, value)
    }

    /// Whether there is anything to search.
    pub fn is_held(&self) -> bool {
        self.low == self.high
    }

    /// Whether a value lies inside, up to rounding.
    pub(super) fn contains(&self, value: f64) -> bool {
        (self.low - ROUNDING..=self.high + ROUNDING).contains(&value)
    }

    /// The value at `unit` in [0, 1], both ends exact; what lies outside is pulled in.
    pub fn at(&self, unit: f64) -> f64 {
        if unit <= 0.0 || self.is_held() {
            self.low
        } else if unit >= 1.0 {
            self.high
        } else {
            (self.low + unit * (self.high - self.low)).clamp(self.low, self.high)
        }
    }
}

impl fmt::Display for Interval {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_held() {
            write!(formatter, "{}", self.low)
        } else if self.high.is_infinite() {
            write!(formatter, "any")
        } else {
            write!(formatter, "{} to {}", self.low, self.high)
        }
    }
}

/// A parameter that is searched, and where, in the machine's own units.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Which.
    pub parameter: Parameter,
    /// Its values, or their ends.
    pub range: Interval,
    /// The only values that can be had, in rising order; empty if all of the range can.
    pub catalogue: Vec<f64>,
}

impl Axis {
    /// All values of a range.
    pub const fn new(parameter: Parameter, range: Interval) -> Self {
        Self {
            parameter,
            range,
            catalogue: Vec::new(),
        }
    }

    /// The values of a catalogue, in rising order.
    pub fn of_catalogue(parameter: Parameter, catalogue: Vec<f64>) -> Self {
        let end = |value: Option<&f64>| value.copied().unwrap_or(f64::NAN);
        let range = Interval::new(end(catalogue.first()), end(catalogue.last()));
        Self {
            parameter,
            range,
            catalogue,
        }
    }

    /// The logarithm of the upper end over the lower one, where the range spans decades.
    pub(super) fn decades(&self) -> Option<f64> {
        let Interval { low, high } = self.range;
        let is_wide = self.catalogue.is_empty() && low > 0.0 && high.is_finite();
        (is_wide && high > DECADES * low).then(|| high.ln() - low.ln())
    }

    /// Whether the range spans decades, so that it is searched by the logarithm.
    pub fn is_log(&self) -> bool {
        self.decades().is_some()
    }

    /// d(value)/d(coordinate) at a value.
    pub fn rate(&self, value: f64) -> f64 {
        let width = self.range.high - self.range.low;
        self.decades().map_or(width, |decades| decades * value)
    }

    /// How far apart two values are, as a share of the range.
    pub fn apart(&self, one: f64, other: f64) -> f64 {
        match self.decades() {
            Some(decades) => (one / other).ln().abs() / decades,
            None => (one - other).abs() / (self.range.high - self.range.low),
        }
    }

    /// Which end a value stands at to rounding, if there are two.
    pub fn end_at(&self, value: f64) -> Option<End> {
        let Interval { low, high } = self.range;
        let near = |end: f64| self.apart(value, end) <= AT_END;
        match self.range.is_held() {
            true => None,
            false if near(low) => Some(End::Lower),
            false => near(high).then_some(End::Upper),
        }
    }

    /// The value at a coordinate in [0, 1]: in a catalogue, each has an equal part of it.
    pub(super) fn at(&self, unit: f64) -> f64 {
        if let Some(decades) = self.decades().filter(|_| (0.0..1.0).contains(&unit)) {
            return self.range.low * (unit * decades).exp();
        }
        let part = (unit.clamp(0.0, 1.0) * self.catalogue.len() as f64) as usize;
        let last = self.catalogue.len().saturating_sub(1);
        let listed = self.catalogue.get(part.min(last)).copied();
        listed.unwrap_or_else(|| self.range.at(unit))
    }
}

/// The first digits of a number to some base, the last of them first: its place along each axis of a lattice.
pub(super) fn digits(number: usize, base: usize, count: usize) -> impl Iterator<Item = usize> {
    let above = iter::successors(Some(number), move |rest| Some(rest / base));
    above.take(count).map(move |rest| rest % base)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_exact() {
        let axis = |range| Axis::new(Parameter::Clearance, range);
        let searched = axis(Interval::new(0.1, 0.3));
        assert_eq!(searched.end_at(0.3), Some(End::Upper));
        assert_eq!(searched.end_at(0.2), None);
        assert_eq!(axis(Interval::held(7.0)).end_at(7.0), None);
    }

    #[test]
    fn ranges_of_decades_are_logarithmic() {
        let (low, high) = (1.0, 1e12);
        let axis = Axis::new(Parameter::StopStiffness, Interval { low, high });
        let values = [0.0, 0.25, 1.0].map(|unit| axis.at(unit));
        assert!((values[1] / 1e3 - 1.0).abs() < 1e-12);
        assert_eq!([values[0], values[2]], [low, high]);
        assert_eq!(axis.end_at(10.0), None);
        assert!(axis.is_log());
        let step = 1e-6;
        let found = (axis.at(0.25 + step) - axis.at(0.25 - step)) / (2.0 * step);
        assert!((found / axis.rate(values[1]) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn catalogues_hold_their_values_alone() {
        let axis = Axis::of_catalogue(Parameter::StopStiffness, vec![3.0, 5.0, 9.0]);
        let found = [-0.5, 0.0, 0.33, 0.34, 0.66, 0.67, 1.0].map(|unit| axis.at(unit));
        assert_eq!(found, [3.0, 3.0, 3.0, 5.0, 5.0, 9.0, 9.0]);
    }
}
