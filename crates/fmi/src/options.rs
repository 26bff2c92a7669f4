//! What an FMU tells of only if it is asked to.

use crate::standard::Standard;

/// What an FMU tells of beyond what each one does. Each choice gives it a GUID of its own, by which its library knows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Options {
    /// Model exchange by FMI 2.0: importers that find both interface types may then integrate by themselves. An FMU for
    /// FMI 3.0 always tells of it.
    pub exchange: bool,
    /// The unit's clock, by FMI 3.0.
    pub clock: bool,
    /// Arrays of parameters as one variable each, by FMI 3.0.
    pub arrays: bool,
}

impl Options {
    /// The choices that there are by a standard.
    pub(crate) fn choices(standard: Standard) -> Vec<Self> {
        let none = Self::default();
        match standard {
            Standard::Fmi2 => [false, true]
                .map(|exchange| Self { exchange, ..none })
                .into(),
            Standard::Fmi3 => [(false, false), (true, false), (false, true), (true, true)]
                .map(|(clock, arrays)| Self {
                    clock,
                    arrays,
                    ..none
                })
                .into(),
        }
    }
}
