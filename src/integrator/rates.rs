//! Rates of the outputs: how they go on from the present time.

use super::outputs::Sample;
use super::simulation::Simulation;
use super::start::Start;

/// First and second time derivative of an output.
pub type Rate = (f64, f64);

/// Rates of the outputs that [`Sample`] and [`Energy`](super::Energy) hold, beyond those that are
/// outputs themselves. Right at a crossing they are those after it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Rates {
    /// Fourth derivative of the position, in m/s^4.
    pub snap: f64,
    /// Rates of the contact force, in N/s and N/s^2.
    pub contact_force: Rate,
    /// Rates of the mechanical energy, in W and W/s.
    pub mechanical: Rate,
    /// Rates of the energy supplied, in W and W/s.
    pub supplied: Rate,
    /// Rates of the energy dissipated, in W and W/s.
    pub dissipated: Rate,
}

impl Simulation {
    /// Rates of the outputs at the present time. While the mass bounces faster than can be told they are
    /// those of the rest that it comes to.
    pub fn rates(&self) -> Rates {
        let (push, rate, curvature) = self.push();
        let Some(phase) = self.motion.phase() else {
            return Rates {
                contact_force: (rate, curvature),
                ..Rates::default()
            };
        };
        let scene = &self.scene;
        let Start { position, velocity } = self.motion.state();
        let Sample {
            acceleration, jerk, ..
        } = self.sample();
        let (x, v, a) = (position, velocity, acceleration);
        // The law of force along the motion: F' = K v + C a, F'' = K a + C j + K' v + C' a.
        let (stiffness, damping) = phase.slopes(x, v);
        let (stiffening, coupling) = phase
            .hertz
            .map_or((0.0, 0.0), |hertz| hertz.curvatures(x, v));
        let bending = stiffening * v * v + 2.0 * coupling * v * a;
        let resisting = stiffness * a + damping * jerk + bending;
        let snap = (curvature - resisting) / scene.mass;

        let (k, b) = (scene.stiffness, scene.damping);
        let contact_force = (
            rate - scene.mass * jerk - b * a - k * v,
            curvature - scene.mass * snap - b * jerk - k * a,
        );
        let store = self.motion.store();
        let elastic = k * x + store.force_at(x);
        let pull = scene.mass * a + elastic;
        let mechanical = (
            pull * v,
            (scene.mass * jerk + (k + store.stiffness_at(x)) * v) * v + pull * a,
        );
        let supplied = (push * v, rate * v + push * a);
        Rates {
            snap,
            contact_force,
            mechanical,
            supplied,
            dissipated: (supplied.0 - mechanical.0, supplied.1 - mechanical.1),
        }
    }
}
