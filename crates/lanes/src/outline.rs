//! What the lanes of a batch need not look up in each law: which phases follow on which, and of what kind they are.

use super::law::Constants;

/// Most phases that lanes choose between.
pub(super) const MOST_PHASES: usize = 16;
/// Most ways out of a phase.
const ENDS: usize = 3;
/// No phase.
const NONE: u8 = u8::MAX;

/// The phases of a machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Outline {
    /// How many there are.
    pub count: usize,
    /// Bit by bit, those that end at one position alone, and those with a power law.
    plain: u16,
    presses: u16,
    /// Those that follow on each, the further ones first.
    beyond: [[u8; ENDS]; MOST_PHASES],
}

impl Outline {
    /// That of a machine with these laws, at most [`MOST_PHASES`].
    pub fn of(laws: &[Constants]) -> Self {
        let mut outline = Self {
            count: laws.len(),
            plain: 0,
            presses: 0,
            beyond: [[NONE; ENDS]; MOST_PHASES],
        };
        for (phase, law) in laws.iter().enumerate() {
            outline.plain |= u16::from(law.is_plain()) << phase;
            outline.presses |= u16::from(law.presses()) << phase;
            for (end, next) in outline.beyond[phase].iter_mut().zip(law.beyond()) {
                *end = next as u8;
            }
        }
        outline
    }

    /// The different ones among these.
    pub fn different<'a>(all: impl Iterator<Item = &'a Self>) -> Vec<Self> {
        let mut different: Vec<Self> = Vec::new();
        for outline in all {
            if different.last() != Some(outline) && !different.contains(outline) {
                different.push(*outline);
            }
        }
        different
    }

    /// True unless the phase is one that something else can end than one position.
    pub fn is_plain(&self, phase: usize) -> bool {
        phase >= self.count || self.plain >> phase & 1 != 0
    }

    /// True if a power law acts in the phase.
    pub fn presses(&self, phase: usize) -> bool {
        self.presses >> phase & 1 != 0
    }

    /// The phases that follow on one.
    pub fn beyond(&self, phase: usize) -> impl Iterator<Item = usize> + '_ {
        let ends = self.beyond[phase].iter();
        ends.filter(|end| **end != NONE)
            .map(|end| usize::from(*end))
    }
}
