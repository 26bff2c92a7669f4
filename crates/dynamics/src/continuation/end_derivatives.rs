//! Derivatives of the end of a motion by parameters, from one replay of the motion.

use std::ops::Range;

use nalgebra::{DVector, Vector2};

use crate::tolerance::DIFFERENCE_WIDTH;
use softstop::internals::{ParameterSensitivity, PhaseDerivatives};
use softstop::{CheckedScene, Trajectory};

/// Derivatives of the end of a motion, in m and m/s, by unknowns of its scene, and of the position of its start, which moves
/// with a surface that it lies at; none where the motion has no derivatives.
pub(super) fn end_derivatives(
    orbit: (&Trajectory, Vector2<f64>, bool),
    (place, unknowns): (&DVector<f64>, Range<usize>),
    scene_at: impl Fn(&DVector<f64>) -> Option<CheckedScene>,
) -> Option<Vec<(Vector2<f64>, f64)>> {
    let by = unknowns.map(|unknown| {
        let towards = |step: f64| {
            let mut moved = place.clone();
            moved[unknown] += step;
            PhaseDerivatives::between(&orbit.0.scene, &scene_at(&moved)?, step)
        };
        towards(DIFFERENCE_WIDTH).or_else(|| towards(-DIFFERENCE_WIDTH))
    });
    end_derivatives_by(orbit, &by.collect::<Option<Vec<_>>>()?)
}

/// Derivatives of the end of a motion, and of the position of its start, by what changes the phases of its scene.
pub(crate) fn end_derivatives_by(
    (trajectory, start, at_surface): (&Trajectory, Vector2<f64>, bool),
    by: &[PhaseDerivatives],
) -> Option<Vec<(Vector2<f64>, f64)>> {
    let scene = &trajectory.scene;
    let mut sensitivity = ParameterSensitivity::new(scene.phases(), by);
    trajectory.replay(&mut sensitivity);
    let [from_position, from_velocity, forced @ ..] = sensitivity.columns()? else {
        return None;
    };
    let derivatives = forced.iter().zip(by).map(|(forced, by)| {
        // Velocities are per radian there.
        let faster = by.frequency * Vector2::new(0.0, trajectory.end.velocity)
            - by.frequency * start.y * from_velocity.xy();
        let moved = match at_surface {
            true => by.surface_derivatives(scene.phases(), start.x).0,
            false => 0.0,
        };
        (forced.xy() + faster + moved * from_position.xy(), moved)
    });
    Some(derivatives.collect())
}
