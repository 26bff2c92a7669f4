//! What a task asks of a design.

use serde::Deserialize;
use softstop_dynamics::figure::{Figure, Sense};

/// Which machines something is asked of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Scope {
    /// All within the tolerances.
    #[default]
    Tolerances,
    /// The one of the drawing.
    Drawing,
}

/// 1 for a figure of which more is better, -1 for one of which less is.
pub(crate) fn sign(sense: Sense) -> f64 {
    match sense {
        Sense::Least => 1.0,
        Sense::Most => -1.0,
    }
}

/// Bounds of a figure, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Requirement {
    /// Of what.
    pub figure: Figure,
    /// Least allowed value.
    pub least: Option<f64>,
    /// Largest allowed value.
    pub most: Option<f64>,
    /// Of which machines. What a motion does not tell by itself, nor trials, is asked of the drawing's machine.
    pub scope: Scope,
}

/// Share of a bound by which rounding may put a value beyond it.
const ROUNDING: f64 = 1e-9;

impl Requirement {
    /// At least so much of a figure in all machines within the tolerances.
    pub fn at_least(figure: Figure, least: f64) -> Self {
        Self::new(figure, Some(least), None)
    }

    /// At most so much of a figure in all machines within the tolerances.
    pub fn at_most(figure: Figure, most: f64) -> Self {
        Self::new(figure, None, Some(most))
    }

    /// A bound of a figure on its good side.
    pub(super) fn on_side(figure: Figure, side: Sense, bound: f64) -> Self {
        match side {
            Sense::Least => Self::at_least(figure, bound),
            Sense::Most => Self::at_most(figure, bound),
        }
    }

    /// At least so much of a figure, or at most, in all machines within the tolerances.
    pub fn new(figure: Figure, least: Option<f64>, most: Option<f64>) -> Self {
        Self {
            figure,
            least,
            most,
            scope: Scope::Tolerances,
        }
    }

    /// How far inside its bounds a value lies, in SI units; negative outside. What rounding puts outside is at its bound.
    pub fn margin(&self, value: f64) -> f64 {
        if value.is_nan() {
            return value;
        }
        let inside = |margin: f64, bound: f64| match -margin <= ROUNDING * bound.abs() {
            true => margin.max(0.0),
            false => margin,
        };
        let least = self.least.map(|least| inside(value - least, least));
        let most = self.most.map(|most| inside(most - value, most));
        least
            .unwrap_or(f64::INFINITY)
            .min(most.unwrap_or(f64::INFINITY))
    }

    /// Whether a value is within its bounds; what is no value is not.
    pub fn is_met(&self, value: f64) -> bool {
        self.margin(value) >= 0.0
    }

    /// Whether the motion of each machine within the tolerances is to be looked at.
    pub fn is_of_each_motion(&self) -> bool {
        self.scope == Scope::Tolerances && self.figure.is_of_motion()
    }

    /// The sides on which a value may be too far, by the side that is good.
    pub fn sides(&self) -> impl Iterator<Item = (Sense, f64)> {
        let least = self.least.map(|least| (Sense::Least, least));
        let most = self.most.map(|most| (Sense::Most, most));
        least.into_iter().chain(most)
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
        let both = Requirement::new(Figure::Velocity, Some(2.0), Some(5.0));
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
