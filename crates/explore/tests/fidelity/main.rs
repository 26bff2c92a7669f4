//! Models of a machine: matching formulas against exact contacts, and ladders with known answers.

mod contacts;
mod ladder;
mod observed;

use softstop::{Excitation, Ratios, Release, Scene, Start, Stop};
use softstop_dynamics::Regime;
use softstop_explore::fidelity::models::{
    Contact, ContactLaw, FidelityError, MatchedProperty, ModelHierarchy, ObservedFigures, Quantity,
    cheapest, from_model, from_truth, matching,
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const FLUNG: Start = Start::new(0.0, 14.0);

/// A machine of 2 kg, so that no formula gets by without the mass.
fn machine(stop: Stop, contact_damping: f64) -> Scene {
    Scene {
        mass: 2.0,
        stiffness: 2.0,
        damping: 0.08,
        excitation: Excitation {
            amplitude: 2.0,
            frequency: 1.15,
            phase: 0.0,
        },
        clearance: 10.0,
        contact_damping,
        stop,
        piercing: None,
        rigid: None,
        followers: softstop::Ties::NONE,
        below: None,
    }
}

fn kelvin_voigt(stiffness: f64, zeta: f64, release: Release) -> Scene {
    let damping = 2.0 * zeta * (2.0 * stiffness).sqrt();
    machine(Stop::KelvinVoigt { stiffness, release }, damping)
}
