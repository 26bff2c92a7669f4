//! Where the values of parameters may lie.

use crate::error::SceneError;

/// Where a value may lie; its size is at most [`Allowed::LARGEST`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Allowed {
    /// > 0 and not too large.
    Positive,
    /// >= 0 and not too large.
    NotNegative,
    /// Not too large, of either sign.
    Finite,
    /// From 0 to 1.
    Share,
    /// From 1 to [`Allowed::HIGHEST_POWER`].
    Power,
}

impl Allowed {
    /// A number far above any machine's, below which no intermediate result overflows.
    pub const LARGEST: f64 = 1e24;

    /// The exponent up to which Taylor steps keep all digits; beyond 30 a power law is a wall to them.
    pub const HIGHEST_POWER: f64 = 20.0;

    /// True if a value lies in this range.
    pub fn holds(self, value: f64) -> bool {
        value.abs() <= Self::LARGEST
            && match self {
                Self::Positive => value > 0.0,
                Self::NotNegative => value >= 0.0,
                Self::Finite => true,
                Self::Share => (0.0..=1.0).contains(&value),
                Self::Power => (1.0..=Self::HIGHEST_POWER).contains(&value),
            }
    }

    /// This range in words, as after "must be".
    pub const fn words(self) -> &'static str {
        match self {
            Self::Positive => "finite and > 0, at most 1e24",
            Self::NotNegative => "finite and >= 0, at most 1e24",
            Self::Finite => "finite, from -1e24 to 1e24",
            Self::Share => "in [0, 1]",
            Self::Power => "from 1 to 20",
        }
    }

    /// Refuses a value outside this range.
    ///
    /// # Errors
    /// [`SceneError::OutOfRange`].
    pub fn check(self, name: &'static str, value: f64) -> Result<(), SceneError> {
        if self.holds(value) {
            return Ok(());
        }
        Err(SceneError::OutOfRange {
            name,
            value,
            allowed: self.words(),
        })
    }
}
