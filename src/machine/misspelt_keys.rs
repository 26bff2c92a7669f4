//! What a misspelt key or word was meant to be.

use super::keys::{FREQUENCY_HZ, TASK_TABLES, other_keys};
use super::{Machine, UnitSystem};
use crate::error::MachineError;
use crate::error_message::did_you_mean;
use crate::scene::Parameter;

/// The one of these keys that a misspelt one may mean.
pub(super) fn meant_key(key: &str, keys: &[&'static str]) -> Option<&'static str> {
    if key.ends_with("rpm") && keys.contains(&FREQUENCY_HZ) {
        return Some(FREQUENCY_HZ);
    }
    let called = Parameter::ALL
        .into_iter()
        .find(|parameter| parameter.is_called(key) && keys.contains(&parameter.name()));
    if let Some(parameter) = called {
        return Some(parameter.name());
    }
    meant_table(key, keys)
        .map(|(_, meant)| meant)
        .or_else(|| nearest_name(key, keys))
        .or_else(|| nearest_name(key, &TASK_TABLES).filter(|_| !key.contains('.')))
}

/// Of a key whose table none of these keys has: that table, and the one of [`TASK_TABLES`] that it may mean.
pub(super) fn meant_table<'a>(
    key: &'a str,
    keys: &[&'static str],
) -> Option<(&'a str, &'static str)> {
    let (table, _) = key.split_once('.')?;
    let is_table = |key: &&str| key.split_once('.').is_some_and(|(own, _)| own == table);
    let meant = nearest_name(table, &TASK_TABLES).filter(|_| !keys.iter().any(is_table))?;
    Some((table, meant))
}

/// Most bytes of an unknown name for which the nearest known one is searched; no known name has a third of that.
const MAX_NAME_LENGTH: usize = 200;

/// The one of these names that a misspelt one may mean; dots part a name, and its last part may stand alone.
pub fn nearest_name<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    if name.len() > MAX_NAME_LENGTH {
        return None;
    }
    let last = |name: &str| name.rsplit('.').next().unwrap_or_default().to_owned();
    let distance =
        |known: &&str| edit_distance(name, known).min(1 + edit_distance(&last(name), &last(known)));
    let nearest = known.iter().copied().min_by_key(distance)?;
    (distance(&nearest) <= (name.len() / 3).max(1)).then_some(nearest)
}

/// What a reader says of an unknown word, with the known one that it may mean; any other message stays as it is.
pub fn with_near_word(message: &str) -> String {
    let mut quoted = message.split('`').skip(1).step_by(2);
    let unknown = quoted.next().filter(|_| message.starts_with("unknown "));
    let known: Vec<&str> = quoted.collect();
    let meant = unknown.and_then(|unknown| nearest_name(unknown, &known));
    message.to_owned() + &did_you_mean(meant)
}

/// Letters to put in, take out or change to make one word of another.
fn edit_distance(a: &str, b: &str) -> usize {
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
    /// The error that this machine does not have a key, with those that it `has`: [`MachineError::Lacks`] for a key of other
    /// machines, else [`MachineError::UnknownKey`] with the key that may be meant.
    pub(super) fn key_error(&self, key: &str, has: Vec<&'static str>) -> MachineError {
        let is_parameter = Parameter::ALL.iter().any(|it| it.is_called(key));
        let exists = is_parameter || other_keys().any(|it| it == key);
        if exists {
            return MachineError::Lacks {
                key: key.to_owned(),
                has: has.join(", "),
            };
        }
        let in_hertz = (self.unit_system == UnitSystem::Si).then_some(FREQUENCY_HZ);
        let stated: Vec<_> = has.iter().copied().chain(in_hertz).collect();
        let is_speed = key.ends_with("rpm");
        MachineError::UnknownKey {
            line: None,
            key: key.to_owned(),
            meant: meant_key(key, if is_speed { &stated } else { &has }),
            known: has.join(", "),
        }
    }
}
