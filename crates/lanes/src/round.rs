//! The order in which a round comes to the phases.

use super::law::Constants;
use super::machine::Machine;

/// All phases of these machines, each before those that follow on it, but for the step that closes a cycle: lanes go
/// from phase to phase in one round, and all begin the next one together.
pub(super) fn round<'a>(machines: impl Iterator<Item = &'a Machine> + Clone) -> Vec<usize> {
    let laws = || {
        let machines = machines.clone();
        machines.filter_map(|machine| machine.laws.as_deref())
    };
    let most = laws().map(<[Constants]>::len).max().unwrap_or(1);
    let mut beyond = vec![Vec::new(); most];
    for (phase, law) in laws().flat_map(|laws| laws.iter().enumerate()) {
        for next in law.beyond() {
            if !beyond[phase].contains(&next) {
                beyond[phase].push(next);
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
    use softstop::Ratios;

    /// Through the strip, to the stop, and back.
    #[test]
    fn the_order_is_that_of_a_stroke() {
        let machine =
            |ratios: Ratios| Machine::new(&ratios.scene().expect("valid")).expect("valid");
        assert_eq!(round([&machine(Ratios::unloaded())].into_iter()), [0, 1]);
        let stroke = round([&machine(Ratios::loaded())].into_iter());
        let fed: Vec<_> = stroke
            .into_iter()
            .filter(|phase| ![1, 2].contains(phase))
            .collect();
        assert_eq!(fed, [0, 3, 5, 7, 6, 4]);
    }
}
