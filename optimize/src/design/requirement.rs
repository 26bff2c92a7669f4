//! What a task asks of a design.

use super::figure::Figure;

/// Bounds of a figure, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Requirement {
    /// Of what.
    pub figure: Figure,
    /// Least allowed value.
    pub least: Option<f64>,
    /// Largest allowed value.
    pub most: Option<f64>,
}

impl Requirement {
    /// How far inside its bounds a value lies, in SI units; negative outside.
    pub fn margin(&self, value: f64) -> f64 {
        if value.is_nan() {
            return value;
        }
        let above = self.least.map_or(f64::INFINITY, |least| value - least);
        let below = self.most.map_or(f64::INFINITY, |most| most - value);
        above.min(below)
    }

    /// How far outside its bounds a value lies, in units of the bound; 0 inside. A value that is none is as far as
    /// can be.
    pub fn violation(&self, value: f64) -> f64 {
        let bound = [self.least, self.most].into_iter().flatten();
        let unit = bound.map(f64::abs).fold(0.0, f64::max);
        let unit = if unit > 0.0 {
            unit
        } else {
            value.abs().max(f64::MIN_POSITIVE)
        };
        match self.margin(value) {
            margin if margin.is_nan() => FARTHEST,
            margin => (-margin / unit).clamp(0.0, FARTHEST),
        }
    }
}

/// The violation of what has no value.
const FARTHEST: f64 = 10.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn margins_are_those_of_the_nearer_bound() {
        let both = Requirement {
            figure: Figure::Velocity,
            least: Some(2.0),
            most: Some(5.0),
        };
        assert_eq!(both.margin(4.5), 0.5);
        assert_eq!(both.margin(1.0), -1.0);
        assert_eq!(both.violation(1.0), 0.2);
        assert_eq!(both.violation(3.0), 0.0);
        let one = Requirement { most: None, ..both };
        assert!(
            one.margin(f64::NAN).is_nan(),
            "what has no value is not met"
        );
        assert_eq!([both, one].map(|it| it.violation(f64::NAN)), [FARTHEST; 2]);
    }
}
