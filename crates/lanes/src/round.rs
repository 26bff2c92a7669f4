//! The order in which a round comes to the phases.

use super::outline::Outline;

/// All phases of machines with these outlines, each before those that follow on it, but for the step that closes a cycle: lanes go
/// from phase to phase in one round, and all begin the next one together.
pub(super) fn round(outlines: &[Outline], most: usize) -> Vec<usize> {
    let mut beyond = vec![Vec::new(); most];
    for outline in outlines {
        for (phase, after) in beyond.iter_mut().enumerate().take(outline.count) {
            for next in outline.beyond(phase) {
                if !after.contains(&next) {
                    after.push(next);
                }
            }
        }
    }
    let mut seen = vec![false; most];
    let mut done = Vec::with_capacity(most);
    for phase in 0..most {
        visit(phase, &beyond, &mut seen, &mut done);
    }
    done.reverse();
    done
}

/// Puts a phase behind all that follow on it.
fn visit(phase: usize, beyond: &[Vec<usize>], seen: &mut [bool], done: &mut Vec<usize>) {
    if !std::mem::replace(&mut seen[phase], true) {
        for next in &beyond[phase] {
            visit(*next, beyond, seen, done);
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
            let machine = Machine::new(&ratios.scene().expect("valid")).expect("valid");
            let outline = machine.outline.expect("for lanes");
            round(&[outline], outline.count)
        };
        assert_eq!(order(Ratios::unloaded()), [0, 1]);
        let stroke = order(Ratios::loaded());
        let fed: Vec<_> = stroke
            .into_iter()
            .filter(|phase| ![1, 2].contains(phase))
            .collect();
        assert_eq!(fed, [0, 3, 5, 7, 6, 4]);
    }
}
