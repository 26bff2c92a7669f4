//! The lines of a text by the places in it.

/// A text and where its lines end.
pub(super) struct Lines<'t> {
    pub text: &'t str,
    ends: Vec<usize>,
}

impl<'t> Lines<'t> {
    pub fn new(text: &'t str) -> Self {
        let ends = text.match_indices('\n').map(|(at, _)| at).collect();
        Self { text, ends }
    }

    /// The number of the line of a place.
    pub fn number(&self, at: usize) -> usize {
        1 + self.ends.partition_point(|end| *end < at)
    }
}
