//! The graph of the phases of a machine: which follow on which, and which are ended by one position or have a power
//! law.

use super::law::Constants;

/// Most phases of a machine that lanes follow.
pub(super) const MAX_PHASES: usize = 16;
/// Most phases that may follow on one phase.
const MAX_SUCCESSORS: usize = 3;
/// Marks an unused place in the list of successors.
const NO_SUCCESSOR: u8 = u8::MAX;

/// The phases of a machine and their successors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PhaseGraph {
    /// Number of phases.
    pub count: usize,
    /// One bit for each phase: it ends at one position alone; it has a power law.
    plain: u16,
    presses: u16,
    /// Successors of each phase, those on the way to the stop first.
    beyond: [[u8; MAX_SUCCESSORS]; MAX_PHASES],
}

impl PhaseGraph {
    /// The graph of a machine with these laws, at most [`MAX_PHASES`].
    pub fn from_laws(laws: &[Constants]) -> Self {
        let mut outline = Self {
            count: laws.len(),
            plain: 0,
            presses: 0,
            beyond: [[NO_SUCCESSOR; MAX_SUCCESSORS]; MAX_PHASES],
        };
        for (phase, law) in laws.iter().enumerate() {
            outline.plain |= u16::from(law.has_one_end()) << phase;
            outline.presses |= u16::from(law.has_power_law()) << phase;
            for (end, next) in outline.beyond[phase].iter_mut().zip(law.successors()) {
                *end = next as u8;
            }
        }
        outline
    }

    /// The distinct ones among these graphs.
    pub fn distinct<'a>(all: impl Iterator<Item = &'a Self>) -> Vec<Self> {
        let mut different: Vec<Self> = Vec::new();
        for outline in all {
            if different.last() != Some(outline) && !different.contains(outline) {
                different.push(*outline);
            }
        }
        different
    }

    /// True if one position, and nothing else, ends the phase.
    pub fn has_one_end(&self, phase: usize) -> bool {
        phase >= self.count || self.plain >> phase & 1 != 0
    }

    /// True if a power law acts in the phase.
    pub fn has_power_law(&self, phase: usize) -> bool {
        self.presses >> phase & 1 != 0
    }

    /// The phases that follow on one.
    pub fn successors(&self, phase: usize) -> impl Iterator<Item = usize> + '_ {
        let ends = self.beyond[phase].iter();
        ends.filter(|end| **end != NO_SUCCESSOR)
            .map(|end| usize::from(*end))
    }
}
