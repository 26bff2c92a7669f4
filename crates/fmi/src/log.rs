//! Which log lines are wanted.

use std::borrow::Cow;

use crate::fault::Fault;

/// Names of a category.
type Names = &'static [&'static str];

/// A category of log lines, as in the model description.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Category {
    /// What happens in the motion.
    Events,
    /// Calls that are carried out, but hardly as meant.
    Warnings,
    /// Calls that are refused.
    Errors,
}

impl Category {
    pub(crate) const ALL: [Self; 3] = [Self::Events, Self::Warnings, Self::Errors];

    /// Its name; what it tells, which of events the unit knows; the standard's names of that (FMI 2.0.4, 2.2.4).
    pub(crate) const fn about(self) -> (&'static str, Option<&'static str>, Names) {
        match self {
            Self::Events => ("events", None, &["logEvents"]),
            Self::Warnings => (
                "warnings",
                Some("calls that are carried out, but hardly as meant"),
                &["logStatusWarning"],
            ),
            Self::Errors => (
                "errors",
                Some("calls that are refused and steps that are discarded, always logged"),
                &["logStatusDiscard", "logStatusError"],
            ),
        }
    }

    /// The categories of a name, its own or one of the standard's.
    fn named(name: &str) -> Result<Vec<Self>, Fault> {
        let is_meant = |it: &Self| {
            let (own, _, standard) = it.about();
            own == name || name == LOG_ALL || standard.contains(&name)
        };
        let found: Vec<_> = Self::ALL.into_iter().filter(is_meant).collect();
        match found.is_empty() {
            true => Err(Fault::LogCategory(name.to_owned())),
            false => Ok(found),
        }
    }
}

/// The standard's name of all categories.
pub(crate) const LOG_ALL: &str = "logAll";

/// The importer's wishes, by category. Errors are always logged: a refused call must not pass in silence.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wanted([bool; 3]);

impl Wanted {
    /// All or nothing, as `loggingOn` at instantiation.
    pub(crate) const fn all(on: bool) -> Self {
        Self([on, on, true])
    }

    /// Whether lines of this category are wanted.
    pub(crate) const fn has(self, category: Category) -> bool {
        self.0[category as usize]
    }

    /// Switches the named categories, or all if none is named.
    pub(crate) fn switch(&mut self, on: bool, names: &[Cow<str>]) -> Result<(), Fault> {
        let named = names.iter().map(|name| Category::named(name));
        let categories = named.collect::<Result<Vec<_>, _>>()?.concat();
        if categories.is_empty() {
            *self = Self::all(on);
        }
        for category in categories {
            self.0[category as usize] = on || category == Category::Errors;
        }
        Ok(())
    }
}
