//! Where the names of motions stand in a diagram.

use softstop::Ratios;
use softstop_dynamics::{Chain, Orbit, Step};

use super::Diagram;

/// Share of the range that a motion has to fill to be named.
const LEAST: f64 = 0.02;

/// Each motion once: eta, X'- and its name, in the middle of its longest stretch.
pub(super) fn of(diagram: &Diagram, isolated: &[Step]) -> Vec<(f64, f64, String)> {
    let (low, high) = diagram.part.range;
    let inside = |step: &&Step| (low..=high).contains(&step.value);
    let apart: Vec<&Step> = isolated.iter().filter(inside).collect();
    let mut names: Vec<(f64, (f64, f64, String))> = Vec::new();
    for steps in diagram.ways.iter().map(Chain::rising).chain([apart]) {
        // Neighbouring steps of one regime.
        for run in steps.chunk_by(|a, b| a.motion.regime() == b.motion.regime()) {
            let span = run[run.len() - 1].value - run[0].value;
            if span < LEAST * (high - low) {
                continue;
            }
            let step = run[run.len() / 2];
            let Some(name) = name(step) else { continue };
            let entry = (span, (step.value, step.hardest(), name));
            match names.iter_mut().find(|known| known.1.2 == entry.1.2) {
                Some(known) if known.0 < span => *known = entry,
                Some(_) => {}
                None => names.push(entry),
            }
        }
    }
    names.into_iter().map(|entry| entry.1).collect()
}

/// A periodic motion's name; the two of z = 2/4 differ by the order of their impacts.
fn name(step: &Step) -> Option<String> {
    let regime = step.motion.regime()?;
    if (regime.impacts, regime.periods) != (2, 4) {
        return Some(format!("z = {regime}"));
    }
    let machine = Ratios::unloaded().at_frequency(step.value);
    let orbit = Orbit::periodic(&machine.scene().ok()?, step.end.into(), 4).ok()?;
    let letter = match orbit.pattern().to_string().as_str() {
        "1-1-0-0" => 'B',
        _ => 'A',
    };
    Some(format!("z = (2/4){letter}"))
}
