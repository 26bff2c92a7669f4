//! Terminals: variables that are connected together, as FMI 3.0 has them.

/// A group of variables. Those of two units are connected by the names of their members.
#[derive(Debug)]
pub struct Terminal {
    /// Its name.
    pub name: &'static str,
    /// What it is for.
    pub description: &'static str,
    /// Its variables, each with the name of the member that it is.
    pub members: &'static [(&'static str, Flow, &'static str)],
}

/// What holds for a variable where terminals are connected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// All have the same value.
    Signal,
    /// What flows into the units adds up to nothing.
    Inflow,
}

impl Flow {
    /// `variableKind` as in the XML.
    pub(crate) fn kind(self) -> &'static str {
        match self {
            Self::Signal => "signal",
            Self::Inflow => "inflow",
        }
    }
}
