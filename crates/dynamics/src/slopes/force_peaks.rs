//! Where the contact force peaks along an arc.

use crate::tolerance::ROUNDING;
use softstop::Arc;
use softstop::internals::{Phase, PhaseId, Phases, narrow_root};

/// Pieces of an arc in which force peaks are looked for: for each rad of the fastest rate, at least and at most.
const PEAK_PIECES: (f64, f64, f64) = (2.0, 4.0, 4096.0);

/// The peaks of the contact force on an arc: times in s since its start, with position, velocity and acceleration.
pub(super) fn force_peaks<'a>(
    phases: &'a Phases,
    phase: &'a Phase,
    arc: &'a Arc<'_>,
    elapsed: f64,
) -> impl Iterator<Item = (f64, [f64; 3])> + 'a {
    let free = &phases[PhaseId::FREE].law;
    let state = move |time: f64| {
        let at = arc.at(time);
        let push = phases.amplitude * arc.drive(time).cos;
        let (x, v) = (at.position, at.velocity);
        [x, v, phases.acceleration(phase.id, x, v, push)]
    };
    let rate = move |time: f64| {
        let [x, v, a] = state(time);
        let (stiffness, damping) = phase.slopes(x, v);
        phase.side * ((stiffness - free.stiffness) * v + (damping - free.damping) * a)
    };
    let (each, least, most) = PEAK_PIECES;
    let fastest = phase.flow.modes.fastest_rate().max(phases.frequency);
    let pieces = (each * fastest * elapsed).ceil().clamp(least, most);
    let piece = elapsed / pieces;
    let mut before = rate(0.0);
    (1..=pieces as u32).filter_map(move |index| {
        let time = piece * f64::from(index);
        let here = rate(time);
        let last = std::mem::replace(&mut before, here);
        if !(last > 0.0 && here <= 0.0) {
            return None;
        }
        let ends = ((time - piece, last), (time, here));
        let found = narrow_root(ends.0, ends.1, ROUNDING * piece, |time| {
            Ok::<_, ()>(rate(time))
        });
        let time = found.ok()?.middle();
        Some((time, state(time)))
    })
}
