//! A stroke: the mass meets the stop at a given speed and is thrown back, with nothing but its
//! suspension acting on it besides. What is recorded is the force of the phases that the library
//! lowers to.

use softstop::{Arc, Crossing, CrossingKind, MotionError, PhaseKind, Scene, Start};

/// Points on an arc of a linear law.
const POINTS: u32 = 120;
/// Points on an arc of a nonlinear law, one of many that make up a contact.
const FEW: u32 = 30;
/// Drive periods after which a stroke that is still under way is cut.
const MAX_PERIODS: u64 = 100;

/// A stretch of a stroke in one phase and one direction.
#[derive(Debug, Clone, PartialEq)]
pub struct StrokePiece {
    /// The phase.
    pub kind: PhaseKind,
    /// On the way in rather than out.
    pub inward: bool,
    /// Deflection x - r in m and contact force in N.
    pub points: Vec<(f64, f64)>,
}

/// A rigid stop that was hit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rebound {
    /// Deflection in m at which it stands.
    pub deflection: f64,
    /// Velocity before in m/s.
    pub before: f64,
    /// Velocity after in m/s.
    pub after: f64,
    /// Pieces of the stroke before it.
    pub pieces_before: usize,
}

/// A full stroke in and out.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ContactStroke {
    /// Its pieces in order of time.
    pub pieces: Vec<StrokePiece>,
    /// The first hit on a rigid stop.
    pub rebound: Option<Rebound>,
    /// Speed in m/s with which the mass leaves at the clearance, if it does.
    pub exit_speed: Option<f64>,
}

impl ContactStroke {
    /// The stroke of a scene's stop, which is met at `speed` m/s, from `lead` m before the
    /// clearance and back. The drive is taken away, and the dampers unless `damped`: then what
    /// contact adds to the damping stays.
    ///
    /// # Errors
    /// [`MotionError`] if the scene is invalid.
    pub fn new(scene: &Scene, speed: f64, lead: f64, damped: bool) -> Result<Self, MotionError> {
        let scene = bare(scene, damped);
        let motion = scene.trajectory(approach(&scene, speed, lead), MAX_PERIODS)?;
        let clearance = scene.clearance;
        let leaves = |it: &&Crossing| it.position == clearance && it.velocity_after < 0.0;
        let exit = motion.crossings().find(leaves);
        let mut stroke = Self {
            exit_speed: exit.map(|it| -it.velocity_after),
            ..Self::default()
        };
        for kept in &motion.arcs {
            stroke.add(&motion.observed_arc(kept), kept.duration, clearance, lead);
            let hit = kept.crossing.as_ref();
            let hit = hit.filter(|it| matches!(it.kind, CrossingKind::Rebound { .. }));
            stroke.rebound = stroke.rebound.or(hit.map(|it| Rebound {
                deflection: it.position - clearance,
                before: it.velocity,
                after: it.velocity_after,
                pieces_before: stroke.pieces.len(),
            }));
            let last = stroke.pieces.last();
            if last.is_some_and(|piece| piece.kind == PhaseKind::Free && !piece.inward) {
                break;
            }
        }
        Ok(stroke)
    }

    /// Adds an arc, of the free flight out just the lead.
    fn add(&mut self, arc: &Arc<'_>, elapsed: f64, clearance: f64, lead: f64) {
        let Some(phase) = arc.phase else {
            return;
        };
        let speed = -arc.course.departure.velocity;
        let elapsed = match arc.kind == PhaseKind::Free && speed > 0.0 {
            true => elapsed.min(lead / speed),
            false => elapsed,
        };
        // The law of a way starts where the one before ended: with a jump, if there is one. A
        // nonlinear phase is a chain of arcs without jumps.
        let mut fresh = phase.hertz.is_none();
        let points = if fresh { POINTS } else { FEW };
        for step in 0..=points {
            let after = elapsed * f64::from(step) / f64::from(points);
            let Start { position, velocity } = arc.at(after);
            let inward = velocity > 0.0;
            let point = (
                position - clearance,
                phase.contact_force(position, velocity),
            );
            match self.pieces.last_mut() {
                Some(last) if !fresh && last.kind == arc.kind && last.inward == inward => {
                    last.points.push(point);
                }
                _ => self.pieces.push(StrokePiece {
                    kind: arc.kind,
                    inward,
                    points: vec![point],
                }),
            }
            fresh = false;
        }
    }

    /// Its largest deflection in m.
    pub fn depth(&self) -> f64 {
        self.points().map(|point| point.0).fold(0.0, f64::max)
    }

    /// All its points in order of time.
    pub fn points(&self) -> impl Iterator<Item = (f64, f64)> + Clone + '_ {
        let pieces = self.pieces.iter();
        pieces.flat_map(|piece| piece.points.iter().copied())
    }
}

fn bare(scene: &Scene, damped: bool) -> Scene {
    let mut bare = scene.clone();
    bare.excitation.amplitude = 0.0;
    bare.damping = 0.0;
    bare.contact_damping = if damped {
        scene.contact_damping - scene.damping
    } else {
        0.0
    };
    bare
}

/// The state `lead` m before the clearance from which the mass gets there with `speed`: by the
/// energy of the suspension.
fn approach(scene: &Scene, speed: f64, lead: f64) -> Start {
    let position = scene.clearance - lead;
    let climb = scene.clearance * scene.clearance - position * position;
    let square = speed * speed + scene.stiffness * climb / scene.mass;
    Start::new(position, square.max(0.0).sqrt())
}
