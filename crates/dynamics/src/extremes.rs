//! The least and the largest of some values.

/// The least and the largest of some values; none if there are no values.
pub(crate) fn extremes(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    let each = values.into_iter().map(|value| [value; 2]);
    each.reduce(|[low, high], [value, _]| [low.min(value), high.max(value)])
}
