//! The standards that a unit speaks.

/// A version of FMI.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Standard {
    /// FMI 2.0.
    #[default]
    Fmi2,
    /// FMI 3.0.
    Fmi3,
}

impl Standard {
    /// What the names of its functions begin with.
    pub fn prefix(self) -> &'static str {
        match self {
            Self::Fmi2 => "fmi2",
            Self::Fmi3 => "fmi3",
        }
    }
}
