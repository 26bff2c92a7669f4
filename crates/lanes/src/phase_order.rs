//! The order in which a round of the loop visits the phases of machines.

use super::lane_laws::PhaseConstants;

/// The order in which a round of the loop visits the phases of machines with these laws, of `most` phases at most: each phase
/// before its successors, but for the step that closes a cycle, so that lanes go from phase to phase in one round.
pub(super) fn phase_order<'a>(
    machines: impl Iterator<Item = &'a [PhaseConstants]>,
    most: usize,
) -> Vec<usize> {
    let mut beyond = vec![Vec::new(); most];
    for laws in machines {
        for (after, law) in beyond.iter_mut().zip(laws) {
            for next in law.successors() {
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

#[cfg(test)]
mod tests {
    use std::iter;

    use super::*;
    use crate::LoweredMachine;
    use softstop::Ratios;

    /// Through the strip, to the stop, and back.
    #[test]
    fn the_order_is_that_of_a_stroke() {
        let order = |ratios: Ratios| {
            let machine =
                LoweredMachine::new(&ratios.scene().expect("valid").check().expect("valid"));
            let laws = machine.laws.expect("for lanes");
            phase_order(iter::once(&laws[..]), laws.len())
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
