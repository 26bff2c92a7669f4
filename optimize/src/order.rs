//! Orders by a number. A sort of the standard library is compiled anew for each comparison, some 1,000 lines of LLVM; here there
//! is one.

/// Sorts elements by a number, the least first; those of one number stay in order.
pub(crate) fn sort_rising<T>(all: &mut Vec<T>, number: impl Fn(&T) -> f64) {
    let mut order = Vec::with_capacity(all.len());
    for (index, it) in all.iter().enumerate() {
        order.push((number(it), index));
    }
    sort_numbered(&mut order);
    let mut unsorted: Vec<Option<T>> = Vec::with_capacity(all.len());
    for it in all.drain(..) {
        unsorted.push(Some(it));
    }
    for (_, index) in order {
        all.extend(unsorted[index].take());
    }
}

/// Sorts elements by a number, the largest first; those of one number stay in order.
pub(crate) fn sort_falling<T>(all: &mut Vec<T>, number: impl Fn(&T) -> f64) {
    sort_rising(all, |it| -number(it));
}

fn sort_numbered(order: &mut [(f64, usize)]) {
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
}
