//! What an orbit crosses, and how often.

use super::half_branch::BorderCollision;

/// How often an orbit crosses what; it changes only where the orbit grazes something.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Sequence {
    /// Impacts; each row of bounces that ends in rest counts as one.
    pub impacts: usize,
    /// Crossings of surfaces, impacts on a rigid stop among them.
    pub surfaces: usize,
    /// Those of them at a [`Face`](super::face::Face).
    pub faces: usize,
    /// Turns under dry friction.
    pub reversals: usize,
    /// Rows of bounces that end in rest.
    pub rests: usize,
    /// Crossings of other kinds: ends of rest, contacts that cease or begin to press.
    pub others: usize,
    /// How often the mass is held, by dry friction or at a face.
    pub holds: usize,
    /// Crossings of surfaces and turns at which the force does not jump: an orbit gains and loses them smoothly.
    pub gentle: [usize; 2],
}

impl Sequence {
    /// True if no crossing with a jump of the force makes the difference.
    pub fn agrees(&self, other: &Self) -> bool {
        self.hard() == other.hard() && self.rests == other.rests
    }

    /// True if the sequences agree and have as many impacts.
    pub fn goes_on(&self, other: &Self) -> bool {
        self.impacts == other.impacts && self.agrees(other)
    }

    /// What comes in between two orbits.
    pub fn border(&self, other: &Self) -> Option<BorderCollision> {
        let ([surfaces, turns], [others, other_turns]) = (self.hard(), other.hard());
        if (self.holds, self.rests) != (other.holds, other.rests) {
            Some(BorderCollision::Rest)
        } else if surfaces != others {
            Some(BorderCollision::Surface)
        } else {
            (turns != other_turns).then_some(BorderCollision::Turn)
        }
    }

    fn hard(&self) -> [usize; 2] {
        [
            self.surfaces - self.gentle[0],
            self.reversals - self.gentle[1],
        ]
    }

    /// What happens how often, whether the force jumps there or not: at the end of a range a jump may vanish.
    pub fn events(&self) -> [usize; 4] {
        [self.impacts, self.surfaces, self.reversals, self.rests]
    }

    /// Crossings of all kinds.
    pub fn crossings(&self) -> usize {
        self.surfaces + self.reversals + self.others
    }
}
