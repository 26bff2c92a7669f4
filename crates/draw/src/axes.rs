//! How the axes of a panel are written: letters, names, how many numbers.

use crate::scale::{power_of_ten, ticks};

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
    /// Whether the values are powers of ten.
    pub is_log: bool,
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
            is_log: false,
        }
    }

    /// Round values in a range, about so many, and how they are written.
    pub(crate) fn marks(&self, range: (f64, f64), count: usize) -> Vec<(f64, String)> {
        let mut marks = ticks(range, count);
        if self.is_log {
            marks.retain(|(value, _)| (value - value.round()).abs() < 1e-9);
            for (value, name) in &mut marks {
                *name = power_of_ten(value.round() as i32);
            }
        }
        marks
    }
}
