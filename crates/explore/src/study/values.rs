//! Values along an axis of a study: listed, on a grid, or drawn.

use serde::{Deserialize, Serialize};
use softstop_dynamics::spread_points;

/// How the values of an axis are spaced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Scale {
    /// Evenly.
    #[default]
    Linear,
    /// Their logarithms evenly.
    Log,
}

/// How an axis that is no grid is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Draw {
    /// Independent numbers.
    Random,
    /// Owen-scrambled Sobol points, all axes of this kind together.
    Sobol,
}

/// Where the values of an axis come from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub(super) enum Values {
    /// These.
    List { values: Vec<f64> },
    /// So many from one to the other, both included.
    Grid {
        from: f64,
        to: f64,
        count: u64,
        scale: Scale,
    },
    /// Drawn from a range.
    Drawn {
        from: f64,
        to: f64,
        scale: Scale,
        sample: Draw,
    },
}

impl Values {
    /// How many there are; none if they are drawn.
    pub fn count(&self) -> Option<u64> {
        match self {
            Self::List { values } => Some(values.len() as u64),
            Self::Grid { count, .. } => Some(*count),
            Self::Drawn { .. } => None,
        }
    }

    /// True if they are evenly spaced.
    pub fn is_grid(&self) -> bool {
        matches!(self, Self::Grid { .. })
    }

    /// How they are spaced.
    pub fn scale(&self) -> Scale {
        match self {
            Self::List { .. } => Scale::Linear,
            Self::Grid { scale, .. } | Self::Drawn { scale, .. } => *scale,
        }
    }

    /// The one of this number, if they are not drawn.
    pub fn at(&self, number: u64) -> f64 {
        match self {
            Self::List { values } => values.get(number as usize).copied().unwrap_or(f64::NAN),
            Self::Grid { count: 1, from, .. } => *from,
            Self::Grid {
                from,
                to,
                count,
                scale,
            } => match number {
                0 => *from,
                last if last + 1 == *count => *to,
                _ => between(*from, *to, number as f64 / (count - 1) as f64, *scale),
            },
            Self::Drawn { .. } => f64::NAN,
        }
    }

    /// The number of the one that is nearest to a value.
    pub fn nearest(&self, value: f64) -> u64 {
        let distance = |number: &u64| (self.at(*number) - value).abs();
        let all = 0..self.count().unwrap_or(1);
        all.min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .unwrap_or(0)
    }
}

/// The value at a share of the way from one to another.
pub(super) fn between(from: f64, to: f64, share: f64, scale: Scale) -> f64 {
    match scale {
        Scale::Linear => from + share * (to - from),
        Scale::Log => (from.ln() + share * (to.ln() - from.ln())).exp(),
    }
}

/// The share between 0 and 1 that a sample takes of an axis of random numbers or of Sobol points.
pub(super) fn share(draw: Draw, seed: u32, sample: u64, dimension: u32) -> f64 {
    match draw {
        Draw::Sobol => spread_points::sobol_coordinate(seed, sample, dimension),
        Draw::Random => spread_points::random_coordinate(seed, sample, dimension),
    }
}
