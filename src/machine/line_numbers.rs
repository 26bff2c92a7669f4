//! Numbers of the lines of a text, by places in it.

/// A text and where its lines end.
pub(super) struct LineNumbers<'t> {
    pub text: &'t str,
    ends: Vec<usize>,
}

impl<'t> LineNumbers<'t> {
    pub fn new(text: &'t str) -> Self {
        let ends = text.match_indices('\n').map(|(at, _)| at).collect();
        Self { text, ends }
    }

    /// The number of the line of a place.
    pub fn line_of(&self, at: usize) -> usize {
        1 + self.ends.partition_point(|end| *end < at)
    }
}
