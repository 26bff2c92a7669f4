//! A budget of work for everything that a thread computes meanwhile.
//!
//! Work is counted in scan windows (see [`Effort`](crate::Effort)), never in time: the same work costs the same
//! on every machine. Once a budget is spent, every motion ends at once with
//! [`MotionError::OverBudget`](crate::MotionError::OverBudget), so whoever set it must discard what came of the work.

use std::cell::Cell;
use std::sync::atomic::{AtomicU64, Ordering};

/// Cost of a crossing with the arc after it, in scan windows: a window takes some 10 ns, a crossing half a microsecond to two.
pub(crate) const CROSSING: u64 = 64;
/// Cost, in scan windows, of the derivatives at a scan node, where a window is not passed at once.
pub(crate) const NODE_DERIVATIVES: u64 = 8;
/// Cost, in windows, of a scan node that is computed anew, with its derivatives, where a window is halved.
pub(crate) const EXACT_NODE: u64 = 96;
/// Cost, in windows, of the search of one window on its Taylor polynomial.
pub(crate) const POLYNOMIAL: u64 = 128;
/// Cost, in windows, of a halving: of a window in which a polynomial leaves open what happens, or of a bracket in which
/// Newton's method does not converge.
pub(crate) const HALVING: u64 = 4;
/// Cost, in windows, of zero-state responses, which have no closed form.
pub(crate) const ZERO_STATE_RESPONSES: u64 = 32;
/// Further cost of zero-state responses for each doubling of their time, in windows.
pub(crate) const DOUBLING: u64 = 8;
/// Further cost, in windows, of a Taylor step whose variations with its start are computed too.
pub(crate) const STATE_VARIATIONS: u64 = 256;
/// Cost, in windows, of one step of Newton's method for the series of a motion on the slow manifold.
pub(crate) const SLOW_MANIFOLD_STEP: u64 = 768;
/// Cost of a Taylor step, in windows: it takes a microsecond.
pub(crate) const TAYLOR_STEP: u64 = 128;

thread_local! {
    /// Windows that are left on this thread.
    static LEFT: Cell<u64> = const { Cell::new(u64::MAX) };
}

/// Gives a thread its former budget back when it is dropped, also by a panic.
struct RestoredBudget(u64);

impl Drop for RestoredBudget {
    fn drop(&mut self) {
        LEFT.set(self.0);
    }
}

/// Does work on this thread under a budget of its own, in scan windows, and returns its result with what it cost. Work
/// that is over its budget costs all of it.
pub fn run_within<T>(windows: u64, work: impl FnOnce() -> T) -> (T, u64) {
    let restore = RestoredBudget(LEFT.replace(windows));
    let done = work();
    let spent = windows - LEFT.get();
    drop(restore);
    (done, spent)
}

/// Charges work, in scan windows, to the budget of this thread; false once nothing is left.
#[inline]
pub fn charge(windows: u64) -> bool {
    let left = LEFT.get().saturating_sub(windows);
    LEFT.set(left);
    left > 0
}

/// Scan windows of work that are left of the budget of this thread.
pub fn windows_left() -> u64 {
    LEFT.get()
}

/// True if nothing is left of the budget of this thread.
#[inline]
pub fn is_spent() -> bool {
    LEFT.get() == 0
}

/// The budget of one thread for a piece of work whose parts run on several threads. Each part may cost what was left
/// before; all are charged together in the end. So whether the budget is spent depends on the work alone, not on the threads.
#[derive(Debug)]
pub struct SharedBudget {
    left: u64,
    spent: AtomicU64,
}

impl SharedBudget {
    /// A budget to share: what is left of that of this thread.
    pub fn of_this_thread() -> Self {
        Self {
            left: LEFT.get(),
            spent: AtomicU64::new(0),
        }
    }

    /// Does a part of the work, on any thread, within the shared budget. Where other parts have spent all, it has
    /// nothing: its result is discarded with theirs.
    pub fn run_part<T>(&self, work: impl FnOnce() -> T) -> T {
        let is_open = self.spent.load(Ordering::Relaxed) < self.left;
        let (done, spent) = run_within(if is_open { self.left } else { 0 }, work);
        let add = |sum: u64| Some(sum.saturating_add(spent));
        let _ = self
            .spent
            .fetch_update(Ordering::Relaxed, Ordering::Relaxed, add);
        done
    }

    /// Charges what all parts have cost to the budget of this thread, once they have ended.
    pub fn charge_parts(self) {
        charge(self.spent.into_inner());
    }
}

#[cfg(test)]
mod tests {
    use super::{SharedBudget, charge, is_spent, run_within};

    #[test]
    fn work_is_charged_to_the_innermost_budget() {
        let ((inner, spent), outer) = run_within(10, || {
            assert!(charge(3));
            run_within(4, || {
                assert!(!charge(5));
                is_spent()
            })
        });
        assert!(inner && !is_spent());
        assert_eq!((spent, outer), (4, 3));
    }

    #[test]
    fn parts_are_charged_together_whatever_their_order() {
        let cost = |parts: [u64; 3]| {
            let all = || {
                let fork = SharedBudget::of_this_thread();
                let part = |cost| fork.run_part(|| charge(cost));
                let ends = parts.map(part);
                fork.charge_parts();
                (ends, is_spent())
            };
            run_within(10, all).0
        };
        assert_eq!(cost([3, 3, 3]), ([true; 3], false));
        assert!(cost([3, 3, 4]).1 && cost([4, 3, 3]).1);
        assert_eq!(cost([11, 1, 1]), ([false; 3], true));
        assert_eq!(cost([1, 1, 11]), ([true, true, false], true));
    }
}
