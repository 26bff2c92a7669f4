//! The order in which a round of the loop visits the phases.

use super::phase_graph::PhaseGraph;

/// All phases of machines with these graphs, each before its successors, but for the step that closes a cycle: lanes
/// go from phase to phase in one round of the loop, and all begin the next one together.
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

/// Depth-first search: appends a phase to `done` once all its successors are there.
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
    use super::*;
    use crate::Machine;
    use softstop::Ratios;

    /// Through the strip, to the stop, and back.
    #[test]
    fn the_order_is_that_of_a_stroke() {
        let order = |ratios: Ratios| {
            let machine = Machine::new(&ratios.scene().expect("valid").check().expect("valid"));
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
