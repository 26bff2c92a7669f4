//! The velocity at which models are matched.

use super::{ContactLaw, FidelityError, ModelHierarchy, ObservedFigures, Quantity};
use softstop::{Scene, Start};

/// The before-impact velocity in m/s of the scene's own motion.
///
/// # Errors
/// [`FidelityError::NoImpact`] if it has no impact.
pub fn from_truth(observed: &ObservedFigures) -> Result<f64, FidelityError> {
    let velocity = observed.value(Quantity::BeforeImpactVelocity);
    let velocity = velocity.filter(|velocity| *velocity > 0.0);
    velocity.ok_or(FidelityError::NoImpact)
}

/// Rounds of the fixed-point iteration.
const MAX_ROUNDS: usize = 60;
/// Relative change of the velocity at which it has settled.
const SETTLED: f64 = 1e-9;

/// The model of a rung that is matched at the velocity of its own motion: all that it needs of the scene
/// is its contact, not its motion. Found by iteration from the speed that the drive alone could give.
///
/// # Errors
/// [`FidelityError::Unsettled`] if the iteration does not settle, [`FidelityError::NoImpact`] if the
/// model's motion loses its impacts, and what [`ModelHierarchy::model`] gives.
pub fn from_model(
    ladder: &ModelHierarchy,
    rung: ContactLaw,
    start: Start,
) -> Result<(Scene, ObservedFigures), FidelityError> {
    let truth = &ladder.truth;
    let mut velocity = truth.motion_scales().speed();
    let mut hint = None;
    for _ in 0..MAX_ROUNDS {
        let model = ladder.model(rung, velocity)?;
        let observed = ObservedFigures::settled(&model, hint, start)?;
        if rung == ContactLaw::Linear || model == *truth {
            return Ok((model, observed));
        }
        let next = from_truth(&observed)?;
        if (next - velocity).abs() <= SETTLED * velocity {
            return Ok((model, observed));
        }
        hint = Some(observed.start);
        velocity = next;
    }
    Err(FidelityError::Unsettled { velocity })
}
