//! Forces, powers and energies along the arcs of a motion.

use super::Losses;
use softstop::internals::{Phase, largest_value, work_shares};
use softstop::{Arc, CrossingKind, PhaseKind, Scene, Start, Trajectory};

/// Phases in which the mass touches the strip.
pub(super) const STRIP_PHASES: &[PhaseKind] =
    &[PhaseKind::Pierce, PhaseKind::Cut, PhaseKind::Stuck];
/// Phases in which the mass touches the stop.
const STOP_PHASES: &[PhaseKind] = &[PhaseKind::Stop, PhaseKind::Released, PhaseKind::Resting];

/// The peak on an arc of a quantity, given by the time in s since the arc's start.
fn peak_on_arc(scene: &Scene, (arc, elapsed): (&Arc<'_>, f64), value: impl Fn(f64) -> f64) -> f64 {
    let rate = |phase: &Phase| (phase.law.stiffness.abs() / scene.mass).sqrt();
    let rate = scene.excitation.frequency + arc.phase.map_or(0.0, rate);
    largest_value((0.0, elapsed), rate, value).1
}

/// Force of the drive in N, so many seconds after the start of an arc.
fn drive_force(scene: &Scene, arc: &Arc<'_>, elapsed: f64) -> f64 {
    scene.excitation.amplitude * arc.drive(elapsed).cos
}

/// Peak contact force in N on an arc; a mass that is held is pressed by what would move it.
pub fn peak_contact_force(scene: &Scene, (arc, elapsed): (&Arc<'_>, f64)) -> f64 {
    peak_on_arc(scene, (arc, elapsed), |elapsed| {
        let Start { position, velocity } = arc.at(elapsed);
        let force = match arc.phase {
            Some(phase) => phase.contact_force(position, velocity),
            None => drive_force(scene, arc, elapsed) - scene.stiffness * position,
        };
        arc.side * force
    })
}

/// Largest contact force in N of a motion in phases of these kinds; 0 if it is pressed in none.
pub(super) fn largest_contact_force_in(motion: &Trajectory, kinds: &[PhaseKind]) -> f64 {
    let arcs = motion.arc_views();
    let arcs = arcs.filter(|(arc, _)| kinds.contains(&arc.kind));
    let peaks = arcs.map(|(arc, elapsed)| peak_contact_force(&motion.scene, (&arc, elapsed)));
    peaks.fold(0.0, f64::max)
}

/// Largest contact force in N of a motion while a stop that gives way is touched.
pub(super) fn peak_compliant_stop_force(motion: &Trajectory) -> f64 {
    largest_contact_force_in(motion, STOP_PHASES)
}

/// Largest contact force in N of a motion while a stop is touched: that of a blow at a rigid one has no bound.
pub(crate) fn peak_stop_force(motion: &Trajectory) -> f64 {
    let mut crossings = motion.crossings();
    match crossings.any(|it| matches!(it.kind, CrossingKind::Rebound { .. })) {
        true => f64::INFINITY,
        false => peak_compliant_stop_force(motion),
    }
}

/// Peak power of the drive in W over a motion.
pub(super) fn peak_drive_power(motion: &Trajectory) -> f64 {
    let scene = &motion.scene;
    let peaks = motion.arc_views().map(|(arc, elapsed)| {
        peak_on_arc(scene, (&arc, elapsed), |elapsed| {
            drive_force(scene, &arc, elapsed) * arc.at(elapsed).velocity
        })
    });
    peaks.fold(0.0, f64::max)
}

/// Work of the drive in J over a motion, and where that energy is lost.
pub(super) fn supplied_and_lost_energy(motion: &Trajectory) -> (f64, Losses) {
    let scene = &motion.scene;
    let (mut supplied, mut losses) = (0.0, Losses::default());
    let is_undamped = |phase: &Phase| phase.law.damping == scene.damping;
    for kept in &motion.arcs {
        let arc = motion.observed_arc(kept);
        let lasting = work_shares(&arc, scene.mass, kept.duration);
        supplied += lasting.supplied;
        losses.impacts += lasting.bounces;
        *match arc.kind {
            PhaseKind::Free => &mut losses.free_damping,
            PhaseKind::Released if arc.phase.is_some_and(is_undamped) => &mut losses.free_damping,
            _ => &mut losses.contact_damping,
        } += lasting.damper;
        *match arc.kind {
            PhaseKind::Pierce | PhaseKind::Cut => &mut losses.strip,
            _ => &mut losses.stop,
        } += lasting.law;
        if let Some(crossing) = &kept.crossing {
            losses.impacts += crossing.lost_energy(scene.mass);
        }
    }
    (supplied, losses)
}
