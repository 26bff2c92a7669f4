//! What is proven, with all that a checker needs to prove it again from the equations alone.

use nalgebra::Vector2;
use serde::Serialize;
use softstop::Scene;

use crate::ProofError;
use crate::approximate::{Touch, critical, motion};
use crate::arcs::Enclosed;
use crate::interval::Interval;
use crate::krawczyk::{Equations, approximate, prove};
use crate::machine::Machine;
use crate::motion::{Event, Motion, Problem};
use crate::number::Number;

/// What is to be proven of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Claim {
    /// That it exists at its machine's own frequency.
    Orbit,
    /// That it ends in a fold at a frequency near its machine's own.
    Fold,
    /// That it doubles its period in a flip at a frequency near its machine's own.
    Flip,
    /// That it touches a surface at a frequency near its machine's own.
    Grazing(Touch),
}

/// One event of a proven motion, and the arc that follows it.
#[derive(Debug, Clone, Serialize)]
pub struct ProvenEvent {
    /// The event.
    #[serde(flatten)]
    pub event: Event,
    /// Times in s since the event that divide the arc into parts.
    pub division: Vec<f64>,
}

/// A proof. Its numbers are doubles, each with as many digits as tell it from all others; an interval is the pair of its
/// bounds.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct Certificate {
    /// What this is.
    pub format: &'static str,
    /// `orbit`, `fold`, `flip` or `grazing`.
    pub claim: &'static str,
    /// The machine's laws, and what ends each, in SI units or with m = k1 = F0 = 1.
    pub laws: Machine,
    /// Drive periods after which the motion repeats, and no fewer.
    pub periods: u64,
    /// Impacts in them.
    pub impacts: usize,
    /// Its events in order of time.
    pub events: Vec<ProvenEvent>,
    /// The component of the tangent that is 1, at a fold and a flip.
    pub pinned: Option<usize>,
    /// A box that holds exactly one solution: drive angle in rad, position in m and velocity in m/s of each event, at a fold and a flip the tangent, and but for an orbit the drive's frequency in rad/s.
    pub unique: Vec<Interval>,
    /// A box around that solution.
    pub enclosure: Vec<Interval>,
    /// The drive's frequency in rad/s.
    pub frequency: Interval,
    /// Trace of the monodromy matrix, without touches.
    pub trace: Interval,
    /// Its determinant.
    pub determinant: Interval,
    /// Of an orbit `stable` if both multipliers are proven to lie inside the unit circle, `unstable` if one is proven to lie
    /// outside; else, and at a bifurcation, `undecided`.
    pub stability: &'static str,
}

impl Equations for (&Motion, Problem) {
    fn residuals<T: Number>(&self, unknowns: &[T]) -> Vec<T> {
        self.0.residuals(self.1, unknowns)
    }
}

impl Certificate {
    /// Proves a claim about the motion of a scene that a state at time 0 leads to within a number of drive periods. The motion
    /// in floating point is the beginning of a search, not a part of the proof.
    ///
    /// # Errors
    /// [`ProofError`] if there is no proof.
    pub fn new(
        scene: &Scene,
        state: Vector2<f64>,
        periods: u64,
        claim: Claim,
    ) -> Result<Self, ProofError> {
        let touch = match claim {
            Claim::Grazing(touch) => Some(touch),
            Claim::Orbit | Claim::Fold | Claim::Flip => None,
        };
        let (motion, guess) = motion(scene, state, periods, touch)?;
        let frequency = scene.excitation.frequency;
        let with_tangent = |problem| {
            critical(&motion, &guess, frequency, problem).ok_or(ProofError::NoConvergence)
        };
        let (problem, guess) = match claim {
            Claim::Orbit => (Problem::Orbit { frequency }, guess),
            Claim::Grazing(_) => (Problem::Grazing, [guess, vec![frequency]].concat()),
            Claim::Fold => with_tangent(|pinned| Problem::Fold { pinned })?,
            Claim::Flip => with_tangent(|pinned| Problem::Flip { pinned })?,
        };
        let system = (&motion, problem);
        let near = approximate(&system, &guess).ok_or(ProofError::NoConvergence)?;
        let zero = prove(&system, &near).ok_or(ProofError::NoBox)?;
        let own = motion.unknowns();
        let enclosed = Enclosed {
            motion: &motion,
            unknowns: &zero.enclosure[..own],
            frequency: match problem {
                Problem::Orbit { frequency } => Interval::point(frequency),
                _ => zero.enclosure[zero.enclosure.len() - 1],
            },
        };
        if !motion.has_no_shorter_period(enclosed.unknowns) {
            return Err(ProofError::ShorterPeriod);
        }
        let divisions = enclosed.divisions()?;
        let (trace, determinant) = enclosed.monodromy();
        if !trace.is_bounded() || !determinant.is_bounded() {
            return Err(ProofError::Unbounded);
        }
        let events = motion.events.iter().zip(divisions);
        let events = events.map(|(event, division)| ProvenEvent {
            event: *event,
            division,
        });
        Ok(Self {
            format: "softstop certificate 1",
            claim: match claim {
                Claim::Orbit => "orbit",
                Claim::Fold => "fold",
                Claim::Flip => "flip",
                Claim::Grazing(_) => "grazing",
            },
            laws: motion.machine.clone(),
            periods,
            impacts: motion.impacts(),
            events: events.collect(),
            pinned: match problem {
                Problem::Fold { pinned } | Problem::Flip { pinned } => Some(pinned),
                _ => None,
            },
            frequency: enclosed.frequency,
            unique: zero.unique,
            enclosure: zero.enclosure,
            trace,
            determinant,
            stability: match claim {
                Claim::Orbit => stability(trace, determinant),
                Claim::Fold | Claim::Flip | Claim::Grazing(_) => "undecided",
            },
        })
    }
}

/// By Jury's conditions.
fn stability(trace: Interval, determinant: Interval) -> &'static str {
    let conditions = [
        Interval::ONE - trace + determinant,
        Interval::ONE + trace + determinant,
        Interval::ONE - determinant,
    ];
    if conditions.iter().all(|it| it.is_positive()) {
        "stable"
    } else if conditions.iter().any(|it| it.is_negative()) {
        "unstable"
    } else {
        "undecided"
    }
}
