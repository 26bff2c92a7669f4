//! A budget of work for everything that a thread computes meanwhile.
//!
//! Work is counted in scan windows (see [`Effort`](crate::Effort)), never in time: the same work costs the same
//! on every machine. Once a budget is spent, every motion ends at once with
//! [`MotionError::OverBudget`](crate::MotionError::OverBudget), so whoever set it must discard what came of the work.

use std::cell::Cell;
use std::sync::atomic::{AtomicU64, Ordering};

/// Cost of a crossing with the arc after it, in scan windows: a window takes some 10 ns, a crossing half a microsecond to two.
pub(crate) const CROSSING: u64 = 64;
/// Cost of the derivatives at a node of a scan, in windows, where a window is not passed at once.
pub(crate) const NODE_DERIVATIVES: u64 = 8;
/// Cost of a node that is computed anew with its derivatives, in windows.
pub(crate) const EXACT_NODE: u64 = 96;
/// Cost of the search of one window on its Taylor polynomial, in windows.
pub(crate) const POLYNOMIAL: u64 = 128;
/// Cost of a halving, in windows: of a window whose polynomial leaves open what happens, or of a bracket in which
/// Newton's method does not converge.
pub(crate) const HALVING: u64 = 4;
/// Cost of zero-state responses without a closed form, in windows.
pub(crate) const ZERO_STATE_RESPONSES: u64 = 32;
/// Further cost of zero-state responses for each doubling of their time, in windows.
pub(crate) const DOUBLING: u64 = 8;
/// Further cost of a Taylor step with state variations, in windows.
pub(crate) const STATE_VARIATIONS: u64 = 256;
/// Cost of a step of Newton's method for slow motion under heavy damping, in windows.
pub(crate) const SLOW_MANIFOLD_STEP: u64 = 768;
/// Cost of a Taylor step, in windows: it takes a microsecond.
pub(crate) const TAYLOR_STEP: u64 = 128;

thread_local! {
    /// Windows that are left on this thread.
    static LEFT: Cell<u64> = const { Cell::new(u64::MAX) };
}

/// Sets the former budget again, also after a panic.
struct Restore(u64);

impl Drop for Restore {
    fn drop(&mut self) {
        LEFT.set(self.0);
    }
}

/// Does work within a budget of its own, in windows; what came of it, and what it cost. Work that is over its budget
/// costs all of it.
pub fn run_within<T>(windows: u64, work: impl FnOnce() -> T) -> (T, u64) {
    let restore = Restore(LEFT.replace(windows));
    let done = work();
    let spent = windows - LEFT.get();
    drop(restore);
    (done, spent)
}

/// Counts work, in windows; false if nothing is left.
#[inline]
pub fn charge(windows: u64) -> bool {
    let left = LEFT.get().saturating_sub(windows);
    LEFT.set(left);
    left > 0
}

/// Windows that are left of the budget of this thread.
pub fn windows_left() -> u64 {
    LEFT.get()
}

/// True if nothing is left.
#[inline]
pub fn is_spent() -> bool {
    LEFT.get() == 0
}

/// Parts of one piece of work that go on several threads. Each may cost what was left before; all are charged together
/// in the end. So whether the budget is spent depends on the work alone, not on the threads.
#[derive(Debug)]
pub struct SharedBudget {
    left: u64,
    spent: AtomicU64,
}

impl SharedBudget {
    /// Shares what is left of the budget of this thread.
    pub fn of_this_thread() -> Self {
        Self {
            left: LEFT.get(),
            spent: AtomicU64::new(0),
        }
    }

    /// Does a part, on any thread. Where the others have spent all, it has nothing: it is discarded with them.
    pub fn run_part<T>(&self, work: impl FnOnce() -> T) -> T {
        let is_open = self.spent.load(Ordering::Relaxed) < self.left;
        let (done, spent) = run_within(if is_open { self.left } else { 0 }, work);
        let add = |sum: u64| Some(sum.saturating_add(spent));
        let _ = self
            .spent
            .fetch_update(Ordering::Relaxed, Ordering::Relaxed, add);
        done
    }

    /// Charges what all parts have cost, once they have ended.
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
