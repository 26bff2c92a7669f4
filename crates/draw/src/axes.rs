//! How the axes of a panel are written: letters, names, how many numbers.

/// How axes are written.
#[derive(Debug, Clone, Copy)]
pub struct Axes<'a> {
    /// Size of the numbers.
    pub letters: u32,
    /// Name below, if numbers and name are to be there.
    pub across: Option<&'a str>,
    /// Name at the left.
    pub upwards: &'a str,
    /// About how many numbers along each axis.
    pub ticks: (usize, usize),
}

impl<'a> Axes<'a> {
    /// Axes with numbers of this size, the names across and upwards, and about so many numbers along each.
    pub const fn new(
        letters: u32,
        across: Option<&'a str>,
        upwards: &'a str,
        ticks: (usize, usize),
    ) -> Self {
        Self {
            letters,
            across,
            upwards,
            ticks,
        }
    }
}
