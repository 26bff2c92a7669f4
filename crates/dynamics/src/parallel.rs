//! Work on all threads whose outcome does not depend on them, and which is charged to the [budget](softstop::internals::budget)
//! of the thread that asks for it. An iterator of `rayon` is compiled anew wherever it stands, some 2,000 lines of LLVM each;
//! here the work is a `dyn Fn` and the threads are shared out in one place.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};

use rayon::prelude::*;
use softstop::internals::budget::SharedBudget;

/// Calls a function with each number below `count`, on all threads.
fn for_each(count: usize, work: &(dyn Fn(usize) + Sync)) {
    let budget = SharedBudget::of_this_thread();
    let part = |index| budget.run_part(|| work(index));
    (0..count).into_par_iter().for_each(part);
    budget.charge_parts();
}

/// The numbers of a range in blocks of `size`, on all threads, in order.
pub fn parallel_blocks(
    numbers: Range<u64>,
    size: u64,
) -> impl IndexedParallelIterator<Item = Range<u64>> + Clone {
    let Range { start, end } = numbers;
    let count = (end - start).div_ceil(size) as usize;
    (0..count).into_par_iter().map(move |block| {
        let first = start + block as u64 * size;
        first..(first + size).min(end)
    })
}

/// The values of a function of the numbers below `count`, computed on all threads, in order.
pub fn map_indices<T: Send + Sync>(count: usize, of: &(dyn Fn(usize) -> T + Sync)) -> Vec<T> {
    let mut values: Vec<OnceLock<T>> = Vec::new();
    values.resize_with(count, OnceLock::new);
    for_each(count, &|index| {
        values[index].get_or_init(|| of(index));
    });
    let mut found = Vec::with_capacity(count);
    for value in values {
        found.extend(value.into_inner());
    }
    found
}

/// The values of a function of some elements, computed on all threads, in order.
pub fn map<A: Sync, T: Send + Sync>(all: &[A], of: impl Fn(&A) -> T + Sync) -> Vec<T> {
    map_indices(all.len(), &|index| of(&all[index]))
}

/// The values that a function has of some elements, computed on all threads, in order, without elements that it has none of.
pub fn filter_map<A: Sync, T: Send + Sync>(
    all: &[A],
    of: impl Fn(&A) -> Option<T> + Sync,
) -> Vec<T> {
    let mut found = Vec::new();
    for value in map(all, of) {
        found.extend(value);
    }
    found
}

/// The values of a function of the numbers below `count`, computed on all threads, in order; after a failure no larger number is
/// begun.
///
/// # Errors
/// The failure at the least number that has one.
pub fn try_map_indices<T: Send + Sync, E: Send + Sync>(
    count: usize,
    of: &(dyn Fn(usize) -> Result<T, E> + Sync),
) -> Result<Vec<T>, E> {
    let least_failed = AtomicUsize::new(usize::MAX);
    let values = map_indices(count, &|index| {
        if index > least_failed.load(Ordering::Relaxed) {
            return None;
        }
        let value = of(index);
        if value.is_err() {
            least_failed.fetch_min(index, Ordering::Relaxed);
        }
        Some(value)
    });
    let mut found = Vec::with_capacity(count);
    for value in values.into_iter().flatten() {
        found.push(value?);
    }
    Ok(found)
}

/// The values of a function of some elements, computed on all threads, in order; after a failure no later element is begun.
///
/// # Errors
/// The failure at the first element that has one.
pub fn try_map<A: Sync, T: Send + Sync, E: Send + Sync>(
    all: &[A],
    of: impl Fn(&A) -> Result<T, E> + Sync,
) -> Result<Vec<T>, E> {
    try_map_indices(all.len(), &|index| of(&all[index]))
}

/// The values of a function of chunks of `size` elements, the last one of fewer, computed on all threads, in order; after a
/// failure no later chunk is begun.
///
/// # Errors
/// The failure at the first piece that has one.
pub fn try_map_chunks<A: Sync, T: Send + Sync, E: Send + Sync>(
    all: &[A],
    size: usize,
    of: impl Fn(&[A]) -> Result<T, E> + Sync,
) -> Result<Vec<T>, E> {
    try_map(&all.chunks(size).collect::<Vec<_>>(), |chunk| of(chunk))
}

/// Calls a function that changes elements with chunks of `size` of them, the last one of fewer, on all threads; after a failure
/// no later chunk is begun.
///
/// # Errors
/// The failure at the first piece that has one.
pub fn try_change_chunks<A: Send, E: Send + Sync>(
    all: &mut [A],
    size: usize,
    change: impl Fn(&mut [A]) -> Result<(), E> + Sync,
) -> Result<(), E> {
    let chunks: Vec<_> = all.chunks_mut(size).map(Mutex::new).collect();
    try_map(&chunks, |chunk| {
        change(&mut chunk.lock().unwrap_or_else(PoisonError::into_inner))
    })?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::thread;
    use std::time::Duration;

    use super::{filter_map, map, try_map};

    #[test]
    fn values_come_in_order_and_the_first_failure_ends_it() {
        let all: Vec<usize> = (0..100).collect();
        assert_eq!(map(&all, |it| *it), all);
        let even = filter_map(&all, |it| it.is_multiple_of(2).then_some(*it));
        assert_eq!(even, all.iter().copied().step_by(2).collect::<Vec<_>>());
        assert_eq!(try_map(&all, |it| Ok::<_, ()>(*it)), Ok(all.clone()));
        assert_eq!(
            try_map(&all, |it| if *it == 50 { Err(50) } else { Ok(()) }),
            Err(50)
        );
    }

    #[test]
    fn the_first_failure_does_not_depend_on_threads() {
        let all: Vec<usize> = (0..100).collect();
        let found = try_map(&all, |it| match it {
            0..30 => {
                thread::sleep(Duration::from_millis(1));
                Ok(())
            }
            _ => Err(*it),
        });
        assert_eq!(found, Err(30));
    }
}
