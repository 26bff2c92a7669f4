//! The stops from soft to rigid, all with the same restitution.

use std::f64::consts::PI;

use softstop::{Release, Scene, Slope, Stop};
use softstop_dynamics::zone::grazing_frequencies;

/// The clearance rho of the diagrams.
pub(super) const CLEARANCE: f64 = 2.0;
/// Damping b1 of the free flight: beta1 = 0.02.
const DAMPING: f64 = 0.04;
/// Restitution R of all stops.
pub(super) const RESTITUTION: f64 = 0.6;
/// Before-impact velocity at which different laws go equally deep.
const MATCHED: f64 = 3.0;

/// A stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Law {
    /// Spring and damper with stiffness k2 (Fig. 2a).
    KelvinVoigt(f64),
    /// Two slopes, the second one five times the first, that take up as much energy (Fig. 2b).
    TwoSlopes(f64),
    /// A sphere, that takes up as much energy (Fig. 2c).
    Hertz(f64),
    /// Newton's (Fig. 1c).
    Rigid,
}

impl Law {
    /// What it is called.
    pub(super) fn name(self) -> String {
        match self {
            Self::KelvinVoigt(stiffness) => format!("k₂/k₁ = {stiffness}"),
            Self::TwoSlopes(stiffness) => format!("two slopes, like k₂/k₁ = {stiffness}"),
            Self::Hertz(stiffness) => format!("Hertz, like k₂/k₁ = {stiffness}"),
            Self::Rigid => format!("rigid, R = {RESTITUTION}"),
        }
    }

    /// The law, and the stiffness k2 that it has or is like; 0 if rigid.
    fn stop(self) -> (Stop, f64) {
        match self {
            Self::KelvinVoigt(stiffness) => {
                let release = Release::Clearance;
                (Stop::KelvinVoigt { stiffness, release }, stiffness)
            }
            Self::TwoSlopes(stiffness) => {
                // k d^2/2 = a d^2/2 + (b - a) (d/2)^2/2 with b = 5 a: a = k/2.
                let first = 0.5 * stiffness;
                let slope = |from, stiffness| Slope { from, stiffness };
                let second = slope(0.5 * depth(stiffness), 5.0 * first);
                let stop = Stop::PiecewiseLinear {
                    loading: vec![slope(0.0, first), second],
                    unloading: Vec::new(),
                };
                (stop, stiffness)
            }
            Self::Hertz(stiffness) => {
                // k d^2/2 = 2/5 h d^(5/2)
                let stop = Stop::Hertz {
                    stiffness: 1.25 * stiffness / depth(stiffness).sqrt(),
                    exponent: 1.5,
                    dissipation: 0.0,
                };
                (stop, stiffness)
            }
            Self::Rigid => {
                let restitution = RESTITUTION;
                (Stop::Rigid { restitution }, 0.0)
            }
        }
    }

    /// The machine with m = k1 = F0 = 1.
    pub(super) fn scene(self, frequency: f64, clearance: f64) -> Scene {
        let (stop, stiffness) = self.stop();
        let mut scene = Scene {
            damping: DAMPING,
            clearance,
            contact_damping: DAMPING + damping_ratio() * (2.0 * stiffness.sqrt()),
            ..Scene::of_stop(stop)
        };
        scene.excitation.frequency = frequency;
        scene
    }
}

/// How deep a spring goes that is hit at the velocity of matching.
fn depth(stiffness: f64) -> f64 {
    MATCHED / stiffness.sqrt()
}

/// The damping ratio of a contact, half a period of its own vibration, with restitution R =
/// exp(-pi zeta / sqrt(1 - zeta^2)).
fn damping_ratio() -> f64 {
    let decrement = -RESTITUTION.ln();
    decrement / decrement.hypot(PI)
}

/// The frequencies at which the impact-less motion grazes. The lower one is 0 if already the static
/// deflection is larger than the clearance.
pub(super) fn grazing(clearance: f64) -> (f64, f64) {
    let found = grazing_frequencies(&Law::Rigid.scene(1.0, clearance));
    found.map_or((0.0, f64::NAN), |(below, above)| {
        (below.unwrap_or(0.0), above)
    })
}
