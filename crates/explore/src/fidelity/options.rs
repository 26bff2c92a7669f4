//! Values of the command line.

use clap::ValueEnum;
use clap::builder::{StringValueParser, TypedValueParser};
use softstop_dynamics::models::{Likeness, Quantity};

/// Reads a quantity by its name; hyphens stand for underscores.
pub(super) fn quantity() -> impl TypedValueParser<Value = Quantity> {
    let names = Quantity::ALL.map(Quantity::name);
    StringValueParser::new().try_map(move |given| {
        let name = given.replace('-', "_");
        let mut all = Quantity::ALL.into_iter();
        let found = all.find(|quantity| quantity.name() == name);
        found.ok_or_else(|| format!("must be one of {}", names.join(", ")))
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
