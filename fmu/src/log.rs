//! Which log lines are wanted.

use std::borrow::Cow;

use crate::error::Fault;

/// A category of log lines, as in the model description.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Category {
    /// Impacts and pierced strips.
    Events,
    /// Calls that are carried out, but hardly as meant.
    Warnings,
    /// Calls that are refused.
    Errors,
}

impl Category {
    /// Its name for the importer.
    pub(crate) const fn name(self) -> &'static std::ffi::CStr {
        match self {
            Self::Events => c"events",
            Self::Warnings => c"warnings",
            Self::Errors => c"errors",
        }
    }

    fn of(name: &str) -> Result<Self, Fault> {
        match name {
            "events" => Ok(Self::Events),
            "warnings" => Ok(Self::Warnings),
            "errors" => Ok(Self::Errors),
            _ => Err(Fault::LogCategory {
                name: name.to_owned(),
            }),
        }
    }
}

/// The importer's wishes. Errors are always logged: a refused call must not pass in silence.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wanted {
    events: bool,
    warnings: bool,
}

impl Wanted {
    /// All or nothing, as `loggingOn` at instantiation.
    pub(crate) const fn all(on: bool) -> Self {
        Self {
            events: on,
            warnings: on,
        }
    }

    /// Whether lines of this category are wanted.
    pub(crate) const fn has(self, category: Category) -> bool {
        match category {
            Category::Events => self.events,
            Category::Warnings => self.warnings,
            Category::Errors => true,
        }
    }

    /// Switches the named categories, or all if none is named.
    pub(crate) fn switch(&mut self, on: bool, names: &[Cow<str>]) -> Result<(), Fault> {
        let categories = names
            .iter()
            .map(|name| Category::of(name))
            .collect::<Result<Vec<_>, _>>()?;
        if categories.is_empty() {
            *self = Self::all(on);
        }
        for category in categories {
            match category {
                Category::Events => self.events = on,
                Category::Warnings => self.warnings = on,
                Category::Errors => {}
            }
        }
        Ok(())
    }
}
