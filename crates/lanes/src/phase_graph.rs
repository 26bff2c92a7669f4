//! The phases of a machine as a graph, and the order in which a round of the loop visits them.

use super::lane_laws::PhaseConstants;

/// The order in which a round of the loop visits the phases of machines with these graphs: each phase before its successors, but
/// for the step that closes a cycle, so that lanes go from phase to phase in one round.
pub(super) fn phase_order(outlines: &[PhaseGraph], most: usize) -> Vec<usize> {
    let mut beyond = vec![Vec::new(); most];
    for outline in outlines {
        for (phase, after) in beyond.iter_mut().enumerate().take(outline.count) {
            for next in outline.successors(phase) {
                if !after.contains(&next) {
                    after.push(next);
                }
            }
        }
    }
    let mut seen = vec![false; most];
    let mut done = Vec::with_capacity(most);
    for phase in 0..most {
        push_postorder(phase, &beyond, &mut seen, &mut done);
    }
    done.reverse();
    done
}

/// Appends a phase to `done` once all its successors are there: depth-first search, which is reversed into [`phase_order`].
fn push_postorder(phase: usize, beyond: &[Vec<usize>], seen: &mut [bool], done: &mut Vec<usize>) {
    if !std::mem::replace(&mut seen[phase], true) {
        for next in &beyond[phase] {
            push_postorder(*next, beyond, seen, done);
        }
        done.push(phase);
    }
}

/// Most phases of a machine that lanes follow.
pub(super) const MAX_PHASES: usize = 16;
/// Most phases that may follow on one phase.
const MAX_SUCCESSORS: usize = 3;
/// Marks an unused entry in the list of a phase's successors.
const NO_SUCCESSOR: u8 = u8::MAX;

/// The graph of a machine's phases: which may follow on which.
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
    /// The graph of a machine with at most [`MAX_PHASES`] phases, by their laws.
    pub fn from_laws(laws: &[PhaseConstants]) -> Self {
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

    /// The graphs of some machines without repetitions.
    pub fn distinct<'a>(all: impl Iterator<Item = &'a Self>) -> Vec<Self> {
        let mut different: Vec<Self> = Vec::new();
        for outline in all {
            if different.last() != Some(outline) && !different.contains(outline) {
                different.push(*outline);
            }
        }
        different
    }

    /// True if one position alone ends a phase; also where the machine has no phase of this index.
    pub fn has_one_end(&self, phase: usize) -> bool {
        phase >= self.count || self.plain >> phase & 1 != 0
    }

    /// True if a power-law contact acts in a phase.
    pub fn has_power_law(&self, phase: usize) -> bool {
        self.presses >> phase & 1 != 0
    }

    /// Indices of the phases that may follow on a phase.
    pub fn successors(&self, phase: usize) -> impl Iterator<Item = usize> + '_ {
        let ends = self.beyond[phase].iter();
        ends.filter(|end| **end != NO_SUCCESSOR)
            .map(|end| usize::from(*end))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LoweredMachine;
    use softstop::Ratios;

    /// Through the strip, to the stop, and back.
    #[test]
    fn the_order_is_that_of_a_stroke() {
        let order = |ratios: Ratios| {
            let machine =
                LoweredMachine::new(&ratios.scene().expect("valid").check().expect("valid"));
            let outline = machine.outline.expect("for lanes");
            phase_order(&[outline], outline.count)
        };
        assert_eq!(order(Ratios::unloaded()), [0, 1]);
        let stroke = order(Ratios::loaded());
        let with_strip: Vec<_> = stroke
            .into_iter()
            .filter(|phase| ![1, 2].contains(phase))
            .collect();
        assert_eq!(with_strip, [0, 3, 5, 7, 6, 4]);
    }
}
