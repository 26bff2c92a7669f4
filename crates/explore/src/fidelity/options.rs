//! Values of the command line.

use std::str::FromStr;

use clap::ValueEnum;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use softstop_dynamics::models::{Likeness, Quantity};

/// Reads a quantity by its name.
pub(super) fn quantity() -> impl TypedValueParser<Value = Quantity> {
    let names = Quantity::ALL.map(Quantity::name);
    PossibleValuesParser::new(names).try_map(|name| {
        let mut all = Quantity::ALL.into_iter();
        all.find(|quantity| quantity.name() == name)
            .ok_or("not a quantity")
    })
}

/// What soft models have in common with the contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Matched {
    /// The largest penetration: the energy stored there
    Penetration,
    /// The duration of the contact
    Duration,
    /// Two models, one of each
    #[default]
    Both,
}

impl Matched {
    pub(super) fn likenesses(self) -> Vec<Likeness> {
        match self {
            Self::Penetration => vec![Likeness::Penetration],
            Self::Duration => vec![Likeness::Duration],
            Self::Both => vec![Likeness::Penetration, Likeness::Duration],
        }
    }
}

/// A range of drive frequencies in units of sqrt(k1/m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sweep {
    /// The lowest.
    pub low: f64,
    /// The highest.
    pub high: f64,
}

impl FromStr for Sweep {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let range = || {
            let (low, high) = text.split_once(':')?;
            Some((low.trim().parse().ok()?, high.trim().parse().ok()?))
        };
        match range() {
            Some((low, high)) if 0.0 < low && low < high && high < f64::INFINITY => {
                Ok(Self { low, high })
            }
            _ => Err("must be LOW:HIGH with 0 < LOW < HIGH".to_owned()),
        }
    }
}

impl Sweep {
    /// So many frequencies, evenly spread, both ends included.
    pub(super) fn frequencies(self, points: u64) -> Vec<f64> {
        let share = |point: u64| point as f64 / (points - 1) as f64;
        (0..points)
            .map(|point| self.low + share(point) * (self.high - self.low))
            .collect()
    }
}
