//! What the engine has to do.

use super::job::Job;
use super::machine::Machine;
use super::observer::ObserverHandle;

/// Motions to follow.
pub(super) struct Task<'a> {
    pub machines: &'a [Machine],
    pub jobs: &'a [Job],
    pub watch: ObserverHandle<'a>,
    /// Most lanes to use.
    pub at_once: usize,
}
