//! The keys of machine files that are no numbers of a scene, and what a misspelt key was meant to be.

use super::{Language, Machine};
use crate::error::MachineError;
use crate::scene::Parameter;

pub(super) const POSITION: &str = "initial.position";
pub(super) const VELOCITY: &str = "initial.velocity";
pub(super) const FREQUENCY_HZ: &str = "excitation.frequency_hz";
pub(super) const DEFLECTION: &str = "stop.preload_deflection";
pub(super) const MODEL: &str = "stop.model";

/// Keys of a file that are no [`Parameter`], of machines in SI units.
pub(super) const FURTHER: [&str; 10] = [
    FREQUENCY_HZ,
    MODEL,
    "stop.release",
    "stop.loading",
    "stop.unloading",
    DEFLECTION,
    POSITION,
    VELOCITY,
    "name",
    "description",
];

/// Parameters that machines in ratios do not state: they are 1.
const ONES: [Parameter; 3] = [Parameter::Mass, Parameter::Suspension, Parameter::Amplitude];

/// All keys of a file in a language.
pub(super) fn all(speaks: Language) -> Vec<&'static str> {
    let ratios = speaks == Language::Ratios;
    let numbers = Parameter::ALL
        .into_iter()
        .filter(|it| !(ratios && ONES.contains(it)));
    let further = FURTHER
        .into_iter()
        .filter(|key| !(ratios && *key == FREQUENCY_HZ));
    numbers.map(Parameter::name).chain(further).collect()
}

/// The one of these keys that a misspelt one may mean.
pub(super) fn meant(key: &str, keys: &[&'static str]) -> Option<&'static str> {
    let called = Parameter::ALL
        .into_iter()
        .find(|parameter| parameter.is_called(key) && keys.contains(&parameter.name()));
    if let Some(parameter) = called {
        return Some(parameter.name());
    }
    let last = |key: &str| key.rsplit('.').next().unwrap_or_default().to_owned();
    let distance =
        |known: &&'static str| edits(key, known).min(1 + edits(&last(key), &last(known)));
    let nearest = keys.iter().copied().min_by_key(distance)?;
    (distance(&nearest) <= (key.len() / 3).max(1)).then_some(nearest)
}

/// Letters to put in, take out or change to make one word of another.
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, letter) in a.chars().enumerate() {
        let mut corner = row[0];
        row[0] = i + 1;
        for (j, other) in b.iter().enumerate() {
            let change = corner + usize::from(letter != *other);
            corner = row[j + 1];
            row[j + 1] = change.min(row[j] + 1).min(corner + 1);
        }
    }
    row[b.len()]
}

impl Machine {
    /// The parameter of this name, letter or older name that it has. `stiffness` is that of the suspension,
    /// or of the stop in ratios.
    ///
    /// # Errors
    /// [`MachineError::Lacks`] or [`MachineError::UnknownKey`], with what it has instead.
    pub fn parameter(&self, name: &str) -> Result<Parameter, MachineError> {
        let name = name.replace('-', "_");
        let named =
            |parameter: &Parameter| name == self.name(*parameter) || name == parameter.name();
        let called = |parameter: &Parameter| parameter.is_called(&name);
        let found = self
            .parameters()
            .find(named)
            .or_else(|| self.parameters().find(called));
        found.ok_or_else(|| self.unknown(&name))
    }

    /// Why it does not have this key.
    pub(super) fn unknown(&self, key: &str) -> MachineError {
        let mut has: Vec<&'static str> = self.parameters().map(|it| self.name(it)).collect();
        has.extend([POSITION, VELOCITY]);
        let exists = FURTHER.contains(&key) || Parameter::ALL.iter().any(|it| it.is_called(key));
        if exists {
            return MachineError::Lacks {
                key: key.to_owned(),
                has: has.join(", "),
            };
        }
        MachineError::UnknownKey {
            line: None,
            key: key.to_owned(),
            meant: meant(key, &has),
            known: has.join(", "),
        }
    }
}
