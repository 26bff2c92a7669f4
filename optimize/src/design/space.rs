//! The box that is searched, and its image, the unit cube that the optimiser sees.

use std::fmt;

use softstop::Parameter;

/// An end of a range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum End {
    /// The lower one; of a zone g0.
    Lower,
    /// The upper one; of a zone `s_SN`.
    Upper,
}

/// Distance from an end of an interval, as a share of it, that is none.
const AT_END: f64 = 1e-9;

/// A closed interval; a value that is held has both ends equal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end, not below the lower one; may be infinite.
    pub high: f64,
}

impl Interval {
    /// A single value.
    pub const fn held(value: f64) -> Self {
        Self {
            low: value,
            high: value,
        }
    }

    /// Whether there is anything to search.
    pub fn is_held(&self) -> bool {
        self.low == self.high
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

    /// Which end a value stands at to rounding, if the interval has two.
    pub fn end_at(&self, value: f64) -> Option<End> {
        let near = |end: f64| (value - end).abs() <= AT_END * (self.high - self.low);
        match self.is_held() {
            true => None,
            false if near(self.low) => Some(End::Lower),
            false => near(self.high).then_some(End::Upper),
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
        let range = Interval {
            low: end(catalogue.first()),
            high: end(catalogue.last()),
        };
        Self {
            parameter,
            range,
            catalogue,
        }
    }

    /// The value at a coordinate in [0, 1]: in a catalogue, each has an equal part of it.
    fn at(&self, unit: f64) -> f64 {
        let part = (unit.clamp(0.0, 1.0) * self.catalogue.len() as f64) as usize;
        let last = self.catalogue.len().saturating_sub(1);
        let listed = self.catalogue.get(part.min(last)).copied();
        listed.unwrap_or_else(|| self.range.at(unit))
    }
}

/// The axes of the outer search, of which those that are held are taken out of the optimiser's sight.
#[derive(Debug, Clone, Copy)]
pub struct Space<'a>(pub &'a [Axis]);

impl Space<'_> {
    /// How many coordinates the optimiser has.
    pub fn dimension(&self) -> usize {
        self.0.iter().filter(|axis| !axis.range.is_held()).count()
    }

    /// The values of all axes at a point of the unit cube.
    pub fn values(&self, unit: &[f64]) -> Vec<f64> {
        let mut coordinates = unit.iter().copied();
        let value = |axis: &Axis| match axis.range.is_held() {
            true => axis.range.low,
            false => axis.at(coordinates.next().unwrap_or(0.5)),
        };
        self.0.iter().map(value).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn held_axes_take_no_coordinate_and_ends_are_exact() {
        let range = Interval {
            low: 0.1,
            high: 0.3,
        };
        let axes = [
            (Parameter::StopStiffness, Interval::held(7.0)),
            (Parameter::Clearance, range),
        ]
        .map(|(parameter, range)| Axis::new(parameter, range));
        let space = Space(&axes);
        assert_eq!(space.dimension(), 1);
        assert_eq!(space.values(&[0.0]), [7.0, 0.1]);
        assert_eq!(space.values(&[1.0]), [7.0, 0.3]);
        assert_eq!(
            space.values(&[1.7]),
            [7.0, 0.3],
            "outside the cube: pulled in"
        );
        assert_eq!(range.end_at(0.3), Some(End::Upper));
        assert_eq!(range.end_at(0.2), None);
        assert_eq!(Interval::held(2.0).end_at(2.0), None);
    }

    #[test]
    fn catalogues_hold_their_values_alone() {
        let axes = [Axis::of_catalogue(
            Parameter::StopStiffness,
            vec![3.0, 5.0, 9.0],
        )];
        let space = Space(&axes);
        let found = [-0.5, 0.0, 0.33, 0.34, 0.66, 0.67, 1.0].map(|unit| space.values(&[unit])[0]);
        assert_eq!(found, [3.0, 3.0, 3.0, 5.0, 5.0, 9.0, 9.0]);
    }
}
