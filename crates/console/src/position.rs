//! Where in a TOML file that stands which is wrong.

use std::path::Path;

use softstop::internals::with_near_word;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Error};

use crate::failure::Failure;

impl Failure {
    /// The failure, of usage with file, line and column of the key that its message begins with, or of the innermost
    /// table that the key is in; with the file alone where there is none.
    #[must_use]
    pub fn in_text(self, path: &Path, text: &str) -> Self {
        let Self::Usage(message) = &self else {
            return self;
        };
        let key = message.split([' ', ':']).next().unwrap_or_default();
        let table = DeTable::parse(text).ok();
        match table.and_then(|table| start_of(key, table.get_ref())) {
            Some(start) => Self::at(path, text, start, message),
            None => self.in_file(path),
        }
    }

    /// What the reader of a TOML file says, with file, line and column.
    pub fn of_toml(path: &Path, text: &str, error: &Error) -> Self {
        match error.span() {
            Some(span) => Self::at(path, text, span.start, &with_near_word(error.message())),
            None => Self::usage(with_near_word(error.message())).in_file(path),
        }
    }

    fn at(path: &Path, text: &str, start: usize, message: &str) -> Self {
        let before = &text[..start];
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|it| *it != '\n').count() + 1;
        Self::usage(format!("{}:{line}:{column}: {message}", path.display()))
    }
}

/// Where a dotted key begins, or the innermost table of those that it is in.
fn start_of(key: &str, table: &DeTable<'_>) -> Option<usize> {
    table.iter().find_map(|(name, value)| {
        let rest = key.strip_prefix(name.get_ref().as_ref())?;
        let rest = match rest.strip_prefix('.') {
            None if rest.is_empty() => "",
            rest => rest?,
        };
        Some(start_in(rest, value).unwrap_or(name.span().start))
    })
}

/// Where the rest of a dotted key begins in a value; the tables of a list are counted from 1.
fn start_in(key: &str, value: &Spanned<DeValue<'_>>) -> Option<usize> {
    match value.get_ref() {
        DeValue::Table(inner) => start_of(key, inner),
        DeValue::Array(all) => {
            let (number, rest) = key.split_once('.').unwrap_or((key, ""));
            let index = number.parse::<usize>().ok()?.checked_sub(1)?;
            let table = all.get(index)?;
            Some(start_in(rest, table).unwrap_or(table.span().start))
        }
        _ => None,
    }
}
