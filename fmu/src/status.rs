//! What a call returns.

/// `fmi2Status`: what a call returns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(i32)]
pub enum Status {
    /// All well.
    Ok = 0,
    /// Done, but hardly as meant.
    Warning = 1,
    /// Not done; it can be tried in another way.
    Discard = 2,
    /// Refused.
    Error = 3,
}
