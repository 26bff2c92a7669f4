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
}

impl Options {
    /// The choices that there are by a standard, but for none of them.
    pub(crate) fn choices(standard: Standard) -> &'static [Self] {
        const NONE: Options = Options {
            exchange: false,
            clock: false,
        };
        match standard {
            Standard::Fmi2 => &[Self {
                exchange: true,
                ..NONE
            }],
            Standard::Fmi3 => &[Self {
                clock: true,
                ..NONE
            }],
        }
    }
}
