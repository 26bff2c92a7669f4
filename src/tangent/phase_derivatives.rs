//! Derivatives of a scene's phases by its parameters.

use crate::checked_scene::CheckedScene;
use crate::error::{MotionError, SceneError};
use crate::flow::{ForceBasis, ForceCoefficients};
use crate::phases::{Beyond, LawCoefficients, Phase, PhaseId, PhaseKind, Phases};
use crate::scene::{Dimension, Parameter, Scene};

/// Relative step of a parameter between the two scenes whose phases are compared.
const RELATIVE_STEP: f64 = 1.0 / 128.0;

/// Derivatives of all that a scene is lowered to, by one parameter. The drive angle is held while its frequency changes:
/// in the time w t, mass and dampers are w^2 and w times as large, and velocities are per radian.
#[derive(Debug, Clone, PartialEq)]
pub struct PhaseDerivatives {
    /// Derivative of the logarithm of the drive's frequency.
    pub frequency: f64,
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
    law: LawCoefficients,
    /// Derivatives of stiffness, exponent, dissipation and position of the face of a power law.
    hertz: [f64; 4],
}

impl PhaseDerivatives {
    /// The derivatives by a parameter of a scene.
    ///
    /// # Errors
    /// [`SceneError::Lacks`] of a parameter that the scene does not have, [`MotionError::NoDerivative`] where the scene
    /// turns into another kind of machine with it.
    pub fn new(parameter: Parameter, scene: &CheckedScene) -> Result<Self, MotionError> {
        let name = parameter.name();
        let value = parameter.get(scene).ok_or(SceneError::Lacks(name))?;
        let mut moved = Scene::clone(scene);
        let step = RELATIVE_STEP * value.abs().max(typical_size(parameter, scene));
        parameter.set(&mut moved, value + step);
        let step = (value + step) - value;
        // Its phases alone are asked for, and a step beyond the range of the parameter changes no kind of law.
        let found = Self::between(scene, &CheckedScene::of_valid(moved, None), step);
        found.ok_or(MotionError::NoDerivative { name })
    }

    /// The derivatives of a scene towards another one, by a parameter that is `step` larger there: where every coefficient is
    /// linear in it, as in any parameter that no other follows, their difference is exact. None where the other is another
    /// kind of machine.
    pub fn between(scene: &CheckedScene, moved: &CheckedScene, step: f64) -> Option<Self> {
        let (phases, moved_phases) = (scene.phases(), moved.phases());
        let slope = |from: f64, to: f64| (to - from) / step;
        let (drive, moved_drive) = (&scene.excitation, &moved.excitation);
        let frequency = slope(drive.frequency, moved_drive.frequency) / drive.frequency;
        // At zero dissipation contact may only then cease to press when there is some.
        let mut others = moved_phases.phases.iter().peekable();
        let is_released = |phase: &&Phase| phase.kind == PhaseKind::Released;
        let mut laws = Vec::with_capacity(phases.phases.len());
        for phase in &phases.phases {
            if !is_released(&phase) {
                others.next_if(is_released);
            }
            let other = others.next().filter(|other| other.kind == phase.kind)?;
            let (a, b) = (&phase.law, &other.law);
            let law = LawCoefficients {
                damping: slope(a.damping, b.damping) + frequency * a.damping,
                stiffness: slope(a.stiffness, b.stiffness),
                force: slope(a.force, b.force),
            };
            let hertz = match (&phase.hertz, &other.hertz) {
                (Some(a), Some(b)) => [
                    slope(a.stiffness, b.stiffness),
                    slope(a.exponent, b.exponent),
                    slope(a.dissipation, b.dissipation) + frequency * a.dissipation,
                    slope(a.origin, b.origin),
                ],
                (None, None) => [0.0; 4],
                _ => return None,
            };
            laws.push(LawChange { law, hertz });
        }
        others.next_if(is_released);
        if others.next().is_some() || phases.surfaces.len() != moved_phases.surfaces.len() {
            return None;
        }
        let restitution = |beyond: Beyond| match beyond {
            Beyond::Wall { restitution } => restitution,
            Beyond::Phase(_) => 0.0,
        };
        let pairs = phases.surfaces.iter().zip(moved_phases.surfaces.iter());
        let surfaces = pairs.map(|(a, b)| {
            let kept = slope(restitution(a.beyond), restitution(b.beyond));
            (slope(a.position, b.position), kept)
        });
        Some(Self {
            frequency,
            mass: slope(scene.mass, moved.mass) + 2.0 * scene.mass * frequency,
            amplitude: slope(drive.amplitude, moved_drive.amplitude),
            angle: slope(drive.phase, moved_drive.phase),
            laws,
            surfaces: surfaces.collect(),
        })
    }

    /// Derivatives by the parameter of position in m and restitution of the surface between phases that lies at a position.
    pub fn surface_derivatives(&self, phases: &Phases, position: f64) -> (f64, f64) {
        let mut surfaces = phases.surfaces.iter();
        let found = surfaces.position(|surface| surface.position == position);
        found.map_or((0.0, 0.0), |index| self.surfaces[index])
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
            force -= hertz.force_derivatives(position, hertz.side * velocity).0 * face;
        }
        force
    }

    /// The forces per mass by which the parameter acts along a course in a phase, positions seen from `origin`;
    /// `drive` is the amplitude of the drive in N.
    pub(super) fn sources(
        &self,
        phase: &Phase,
        mass: f64,
        drive: f64,
        origin: f64,
    ) -> ForceCoefficients {
        let LawChange { law: by, hertz } = &self.laws[phase.id.index()];
        let law = &phase.law;
        let heavier = self.mass / mass;
        let mut forces = [0.0; 9];
        let mut add = |source: ForceBasis, force: f64| forces[source as usize] += force / mass;
        let pull = law.force - law.stiffness * origin;
        add(
            ForceBasis::Constant,
            by.force - by.stiffness * origin - heavier * pull,
        );
        add(ForceBasis::Way, heavier * law.stiffness - by.stiffness);
        add(ForceBasis::Velocity, heavier * law.damping - by.damping);
        add(ForceBasis::Cosine, self.amplitude - heavier * drive);
        add(ForceBasis::Sine, -drive * self.angle);
        if let Some(own) = &phase.hertz {
            let [stiffness, exponent, dissipation, face] = *hertz;
            add(ForceBasis::Power, heavier * own.stiffness - stiffness);
            add(ForceBasis::Gripped, -own.stiffness * dissipation);
            add(ForceBasis::Logarithm, -own.stiffness * exponent);
            add(ForceBasis::Steepness, own.stiffness * own.exponent * face);
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
