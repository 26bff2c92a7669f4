//! Derivatives of a scene's phases by its parameters.

use crate::error::{MotionError, SceneError};
use crate::flow::{Forces, Source};
use crate::phases::{Beyond, Law, Phase, PhaseId, PhaseKind, Phases};
use crate::scene::{Dimension, Parameter, Scene};

/// Relative step of a parameter between the two scenes whose phases are compared.
const STEP: f64 = 1.0 / 128.0;

/// Derivatives of all that a scene is lowered to, by one parameter. The drive angle is held while its frequency changes:
/// in the time w t, mass and dampers are w^2 and w times as large, and velocities are per radian.
#[derive(Debug, Clone, PartialEq)]
pub struct PhaseDerivatives {
    /// The parameter.
    pub parameter: Parameter,
    pub(super) mass: f64,
    pub(super) amplitude: f64,
    pub(super) angle: f64,
    laws: Vec<LawChange>,
    /// Derivatives of position and restitution of each surface.
    pub(super) surfaces: Vec<(f64, f64)>,
}

/// Derivatives of a linear law and of a power law.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct LawChange {
    law: Law,
    /// Derivatives of stiffness, exponent, dissipation and position of the face of a power law.
    hertz: [f64; 4],
}

impl PhaseDerivatives {
    /// The derivatives by a parameter of a valid scene with its phases.
    ///
    /// # Errors
    /// [`SceneError::Lacks`] of a parameter that the scene does not have, [`MotionError::NoDerivative`] where the scene
    /// turns into another kind of machine with it.
    pub fn new(parameter: Parameter, scene: &Scene, phases: &Phases) -> Result<Self, MotionError> {
        let name = parameter.name();
        let value = parameter.get(scene).ok_or(SceneError::Lacks(name))?;
        let mut change = Self {
            parameter,
            mass: 0.0,
            amplitude: 0.0,
            angle: 0.0,
            laws: vec![LawChange::default(); phases.phases.len()],
            surfaces: vec![(0.0, 0.0); phases.surfaces.len()],
        };
        let none = MotionError::NoDerivative { name };
        match parameter {
            Parameter::Mass => change.mass = 1.0,
            Parameter::Amplitude => change.amplitude = 1.0,
            Parameter::Phase => change.angle = 1.0,
            Parameter::Frequency => {
                change.mass = 2.0 * scene.mass / value;
                for (law, phase) in change.laws.iter_mut().zip(&phases.phases) {
                    law.law.damping = phase.law.damping / value;
                    let dissipation = phase.hertz.map_or(0.0, |hertz| hertz.dissipation);
                    law.hertz[2] = dissipation / value;
                }
            }
            Parameter::Exponent
            | Parameter::Dissipation
            | Parameter::BelowExponent
            | Parameter::BelowDissipation => {
                let (own, side) = match parameter.above() {
                    Some(twin) => (twin, -1.0),
                    None => (parameter, 1.0),
                };
                let which = if own == Parameter::Exponent { 1 } else { 2 };
                let mut found = false;
                for (law, phase) in change.laws.iter_mut().zip(&phases.phases) {
                    let is_its = phase.hertz.is_some_and(|hertz| hertz.side == side);
                    law.hertz[which] = f64::from(u8::from(is_its));
                    found |= is_its;
                }
                return found.then_some(change).ok_or(none);
            }
            _ => {
                let mut moved = scene.clone();
                let step = STEP * value.abs().max(typical_size(parameter, scene));
                parameter.set(&mut moved, value + step);
                let step = (value + step) - value;
                return change.difference(phases, &moved.phases(), step).ok_or(none);
            }
        }
        Ok(change)
    }

    /// Sets the derivatives from the phases of two scenes `step` apart: every coefficient is linear in any one of the
    /// other parameters, so their difference is exact.
    fn difference(mut self, from: &Phases, to: &Phases, step: f64) -> Option<Self> {
        let slope = |from: f64, to: f64| (to - from) / step;
        let releases = |phase: &Phase| phase.kind == PhaseKind::Released;
        let released = from.phases.iter().any(releases);
        // At zero dissipation contact may only then cease to press when there is some.
        let mut others = to
            .phases
            .iter()
            .filter(|phase| released || !releases(phase));
        for (change, phase) in self.laws.iter_mut().zip(&from.phases) {
            let other = others.next().filter(|other| other.kind == phase.kind)?;
            let (a, b) = (&phase.law, &other.law);
            change.law = Law {
                damping: slope(a.damping, b.damping),
                stiffness: slope(a.stiffness, b.stiffness),
                force: slope(a.force, b.force),
            };
            if let (Some(a), Some(b)) = (&phase.hertz, &other.hertz) {
                change.hertz[0] = slope(a.stiffness, b.stiffness);
                change.hertz[3] = slope(a.origin, b.origin);
            }
        }
        if others.next().is_some() || from.surfaces.len() != to.surfaces.len() {
            return None;
        }
        let restitution = |beyond: Beyond| match beyond {
            Beyond::Wall { restitution } => restitution,
            Beyond::Phase(_) => 0.0,
        };
        let pairs = from.surfaces.iter().zip(&to.surfaces);
        self.surfaces = pairs
            .map(|(a, b)| {
                let kept = slope(restitution(a.beyond), restitution(b.beyond));
                (slope(a.position, b.position), kept)
            })
            .collect();
        Some(self)
    }

    /// Derivative of the position in m of the surface at a position.
    pub fn surface_derivative(&self, phases: &Phases, position: f64) -> f64 {
        let at = phases
            .surfaces
            .iter()
            .position(|surface| surface.position == position);
        at.map_or(0.0, |index| self.surfaces[index].0)
    }

    /// Derivative of the contact force in N at a state of a phase.
    pub fn contact_force(&self, phase: &Phase, position: f64, velocity: f64) -> f64 {
        let [own, free] = [phase.id, PhaseId::FREE].map(|id| &self.laws[id.index()]);
        let mut force = (own.law.damping - free.law.damping) * velocity
            + (own.law.stiffness - free.law.stiffness) * position
            - own.law.force;
        if let Some(hertz) = &phase.hertz {
            let [stiffness, exponent, dissipation, face] = own.hertz;
            let depth = hertz.deflection(position).max(0.0);
            let power = hertz.side * depth.powf(hertz.exponent);
            let (grip, velocity) = (hertz.dissipation_factor(velocity), hertz.side * velocity);
            let log = if power != 0.0 { depth.ln() } else { 0.0 };
            let by_stiffness = stiffness + hertz.stiffness * exponent * log;
            force += power * (by_stiffness * grip + hertz.stiffness * dissipation * velocity);
            force -= hertz.slopes(position, hertz.side * velocity).0 * face;
        }
        force
    }

    /// The forces per mass by which the parameter acts along a course in a phase, positions seen from `origin`;
    /// `drive` is the amplitude of the drive in N.
    pub(super) fn sources(&self, phase: &Phase, mass: f64, drive: f64, origin: f64) -> Forces {
        let LawChange { law: by, hertz } = &self.laws[phase.id.index()];
        let law = &phase.law;
        let heavier = self.mass / mass;
        let mut forces = [0.0; 9];
        let mut add = |source: Source, force: f64| forces[source as usize] += force / mass;
        let pull = law.force - law.stiffness * origin;
        add(
            Source::Constant,
            by.force - by.stiffness * origin - heavier * pull,
        );
        add(Source::Way, heavier * law.stiffness - by.stiffness);
        add(Source::Velocity, heavier * law.damping - by.damping);
        add(Source::Cosine, self.amplitude - heavier * drive);
        add(Source::Sine, -drive * self.angle);
        if let Some(own) = &phase.hertz {
            let [stiffness, exponent, dissipation, face] = *hertz;
            add(Source::Power, heavier * own.stiffness - stiffness);
            add(Source::Gripped, -own.stiffness * dissipation);
            add(Source::Logarithm, -own.stiffness * exponent);
            add(Source::Steepness, own.stiffness * own.exponent * face);
        }
        forces
    }
}

/// A typical size of a parameter that may be zero.
fn typical_size(parameter: Parameter, scene: &Scene) -> f64 {
    let scales = scene.motion_scales();
    let stiffness = scene.mass * scales.rate * scales.rate;
    match parameter.about().dimension {
        Dimension::Length => scales.length,
        Dimension::Stiffness => stiffness,
        Dimension::Damping => scene.mass * scales.rate,
        Dimension::Force => stiffness * scales.length,
        _ => 1.0,
    }
}
