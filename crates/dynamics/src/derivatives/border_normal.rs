//! Borders of a motion over all parameters of its machine, with their normals.
//!
//! A border is a manifold in the space of the parameters; seen along the drive's frequency w it stands at w_b(p). Its normal,
//! d(w - w_b)/dp, needs first derivatives alone at a fold, -w.dP/dp / w.dP/dw with w the left null vector of M - 1, and
//! where a surface is touched; at a flip it needs those of the trace of M, which are differences along the orbit.
//! (Normal vectors on manifolds: Otten and Moennigmann 2019, arXiv 1903.05562.)

use nalgebra::{Matrix2, Vector2};

use softstop::{CheckedScene, Clock, Parameter, Scene, SceneError};

use super::motion_variation::{MotionVariation, phase_derivatives};
use crate::continuation::{
    BranchPoint, Continuation, GrazingTouch, LastArc, SpecialKind, SpecialPoint, TestFunction,
    end_derivatives_by, find_grazing,
};
use crate::orbit::OrbitError;
use crate::zone::{FrequencyFamily, Loss, ZoneEnd, ZoneError, grazing_frequencies};

/// What a border of a motion is.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum BorderKind {
    /// g0: the motion without impacts grazes the stop, above resonance or below it.
    FreeGrazing {
        /// Above resonance.
        above: bool,
    },
    /// A fold, flip or grazing of the motion.
    Motion(SpecialKind),
}

/// A border of a motion in the space of a machine's parameters, at one machine, with its normal.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Border {
    /// What the border is.
    pub kind: BorderKind,
    /// The machine, at the border: its drive has the border's frequency.
    pub scene: Scene,
    /// The motion there, and its drive periods; none for g0.
    pub point: Option<(BranchPoint, u64)>,
    /// The parameters that the normal is by.
    pub parameters: Vec<Parameter>,
    /// d(w - w_b)/d(parameter) in SI units, w_b the border's frequency in rad/s: 1 for the frequency itself. Where it is
    /// positive, a larger parameter brings the border to lower frequencies.
    pub normal: Vec<f64>,
}

impl Border {
    /// The border's frequency in rad/s.
    pub fn frequency(&self) -> f64 {
        self.scene.excitation.frequency
    }

    /// The border g0, where the motion without impacts grazes the stop, `above` resonance or below it.
    ///
    /// # Errors
    /// [`ZoneError`] if the motion without impacts does not graze there; [`ZoneError::Orbit`] for a parameter that the scene
    /// does not have.
    pub fn at_g0(scene: &Scene, above: bool, parameters: &[Parameter]) -> Result<Self, ZoneError> {
        let (below, upper) = grazing_frequencies(scene)?;
        let frequency = if above { Some(upper) } else { below };
        let w = frequency.ok_or(ZoneError::NoGrazing {
            clearance: scene.clearance,
            largest: f64::NAN,
        })?;
        let scene = scene.at_frequency(w);
        let (m, k, b) = (scene.mass, scene.stiffness, scene.damping);
        let (r, drive) = (scene.clearance, scene.excitation.amplitude);
        // r^2 ((k - m w^2)^2 + b^2 w^2) - F0^2, by the parameters.
        let spring = k - m * w * w;
        let by = |parameter: &Parameter| match parameter {
            Parameter::Mass => -2.0 * r * r * spring * w * w,
            Parameter::Suspension => 2.0 * r * r * spring,
            Parameter::Damping => 2.0 * r * r * b * w * w,
            Parameter::Amplitude => -2.0 * drive,
            Parameter::Clearance => 2.0 * drive * drive / r,
            Parameter::Frequency => r * r * (2.0 * b * b * w - 4.0 * m * w * spring),
            _ => 0.0,
        };
        for parameter in parameters {
            let lacks = || SceneError::Lacks(parameter.name());
            parameter.get(&scene).ok_or_else(lacks)?;
        }
        let followers = scene.rates_of_followers();
        let followers = followers
            .iter()
            .map(|(parameter, rate)| rate * by(parameter));
        let own = by(&Parameter::Frequency) + followers.sum::<f64>();
        Ok(Self {
            kind: BorderKind::FreeGrazing { above },
            scene,
            point: None,
            parameters: parameters.to_vec(),
            normal: parameters
                .iter()
                .map(|parameter| by(parameter) / own)
                .collect(),
        })
    }

    /// The border at an end of a zone of the scene.
    ///
    /// # Errors
    /// [`ZoneError`] if the end is none that has a normal.
    pub fn at_end(
        scene: &Scene,
        end: &ZoneEnd,
        parameters: &[Parameter],
    ) -> Result<Self, ZoneError> {
        match (&end.loss, end.special) {
            (Loss::FreeGrazing, _) => Self::at_g0(scene, true, parameters),
            (_, Some(kind)) => Ok(Self::at_special(scene, 1, (kind, &end.point), parameters)?),
            (_, None) => Err(OrbitError::no_derivative(parameters).into()),
        }
    }

    /// This border of a machine close by: Newton's method finds it from this one along its normal.
    ///
    /// # Errors
    /// [`ZoneError`] if it is not reached, or has no normal there.
    pub fn find_again(&self, scene: &Scene) -> Result<Self, ZoneError> {
        let parameters = &self.parameters;
        let (motion, (near, periods)) = match (self.kind, &self.point) {
            (BorderKind::Motion(kind), Some(point)) => (kind, point),
            (BorderKind::FreeGrazing { above: false }, _) => {
                return Self::at_g0(scene, false, parameters);
            }
            _ => return Self::at_g0(scene, true, parameters),
        };
        let scene = &scene.check()?;
        let family = FrequencyFamily(scene);
        let guess = BranchPoint {
            parameter: self.predicted_frequency(scene),
            ..near.clone()
        };
        let SpecialPoint { kind, point } = match motion {
            SpecialKind::Critical(test) => SpecialPoint {
                kind: motion,
                point: Continuation::new(&family, *periods).locate(&guess, test)?,
            },
            SpecialKind::Pitchfork => return Err(OrbitError::NotIsolated.into()),
            SpecialKind::Grazing(graze) => {
                let phase = scene.excitation.reduced_phase();
                find_grazing((&family, *periods), &graze, phase, guess.parameter)?
            }
        };
        Ok(Self::at_special(
            scene,
            *periods,
            (kind, &point),
            parameters,
        )?)
    }

    /// The border's frequency in rad/s of a machine close by, as its tangent predicts it.
    fn predicted_frequency(&self, scene: &Scene) -> f64 {
        let others = self.parameters.iter().zip(&self.normal);
        let others = others.filter(|(parameter, _)| **parameter != Parameter::Frequency);
        let there = scene.at_frequency(self.frequency());
        let move_by = |parameter: &Parameter| {
            let [to, from] = [&there, &self.scene].map(|scene| parameter.get(scene));
            Some(to? - from?)
        };
        let change = others.map(|(parameter, normal)| normal * move_by(parameter).unwrap_or(0.0));
        self.frequency() - change.sum::<f64>()
    }

    /// The border at a special point of a branch of z = p/n over the frequency, such as a fold, as that of a
    /// [`Zone`](crate::Zone), by the kind of the point; the frequency of the scene's drive plays no part.
    ///
    /// # Errors
    /// [`OrbitError`] where the motion has no derivatives.
    pub fn at_special(
        scene: &Scene,
        periods: u64,
        (kind, point): (impl Into<SpecialKind>, &BranchPoint),
        parameters: &[Parameter],
    ) -> Result<Self, OrbitError> {
        let kind = kind.into();
        let scene = scene.at_frequency(point.parameter).check()?;
        // The frequency, and what follows it.
        let mut along = vec![(Parameter::Frequency, 1.0)];
        along.extend(scene.rates_of_followers());
        let moved: Vec<Parameter> = along.iter().map(|(parameter, _)| *parameter).collect();
        let all = [parameters, &moved].concat();
        let rates = match kind {
            SpecialKind::Critical(TestFunction::Fold) => fold_rates(&scene, periods, point, &all)?,
            SpecialKind::Critical(test) => test_rates(&scene, periods, (test, point), &all)?,
            SpecialKind::Pitchfork => return Err(OrbitError::NotIsolated),
            SpecialKind::Grazing(graze) => grazing_rates(&scene, periods, &graze, (&all, &along))?,
        };
        let own = total_rate(&along, &rates[parameters.len()..]);
        let normal: Vec<f64> = rates[..parameters.len()]
            .iter()
            .map(|rate| rate / own)
            .collect();
        if !normal.iter().all(|part| part.is_finite()) {
            return Err(OrbitError::no_derivative(parameters));
        }
        Ok(Self {
            kind: BorderKind::Motion(kind),
            scene: scene.into(),
            point: Some((point.clone(), periods)),
            parameters: parameters.to_vec(),
            normal,
        })
    }
}

/// The derivative by the frequency, from the rates of what moves along it.
fn total_rate(along: &[(Parameter, f64)], rates: &[f64]) -> f64 {
    let pairs = along.iter().zip(rates);
    pairs.map(|((_, rate), by)| rate * by).sum()
}

/// The normal of a border at a fold, up to a factor: w . dP/dp with w the left null vector of M - 1.
fn fold_rates(
    scene: &CheckedScene,
    periods: u64,
    point: &BranchPoint,
    parameters: &[Parameter],
) -> Result<Vec<f64>, OrbitError> {
    let variation = MotionVariation::of_motion(scene, point.state(), periods, parameters)?;
    let a = variation.monodromy.matrix - Matrix2::identity();
    let candidates = [Vector2::new(a.m21, -a.m11), Vector2::new(a.m22, -a.m12)];
    let speed = scene.scales().rate;
    let size = |w: &Vector2<f64>| w.x.hypot(w.y * speed);
    let [first, second] = candidates;
    let null = if size(&first) > size(&second) {
        first
    } else {
        second
    };
    let forced = variation.columns[2..].iter();
    Ok(forced.map(|column| null.dot(&column.xy())).collect())
}

/// The normal of a border at a flip or a Neimark-Sacker point, up to a factor: derivatives of 1 + tr + det, or of det, along the
/// orbit. Folds have [`fold_rates`].
fn test_rates(
    scene: &CheckedScene,
    periods: u64,
    (test, point): (TestFunction, &BranchPoint),
    parameters: &[Parameter],
) -> Result<Vec<f64>, OrbitError> {
    let variation = MotionVariation::of_motion(scene, point.state(), periods, parameters)?;
    let rates = variation.stability_rates(scene, periods)?.into_iter();
    let rate = |[trace, determinant]: [f64; 2]| match test {
        TestFunction::NeimarkSacker => determinant,
        TestFunction::Fold | TestFunction::Flip => trace + determinant,
    };
    Ok(rates.map(rate).collect())
}

/// The normal of a border at a grazing orbit, up to a factor: -dw/dp of the drive frequency w at which the orbit
/// grazes, solved with the drive angle of the touch from rest at the surface to rest there. What moves along the frequency stands
/// last among the parameters.
fn grazing_rates(
    scene: &CheckedScene,
    periods: u64,
    graze: &GrazingTouch,
    (parameters, along): (&[Parameter], &[(Parameter, f64)]),
) -> Result<Vec<f64>, OrbitError> {
    let missing = || OrbitError::no_derivative(parameters);
    if graze.is_symmetric {
        // What moves one stop alone leaves no symmetric orbit.
        return Err(missing());
    }
    let scene = scene.clone().at_phase(graze.angle)?;
    let place = graze.surface.surface_position(&scene).ok_or_else(missing)?;
    let start = Vector2::new(place, 0.0);
    let motion =
        LastArc::carry_past(&scene, start, (graze.crossings, Clock::at_cycle(periods)))?.motion;
    let all = [parameters, &[Parameter::Phase]].concat();
    let by = phase_derivatives(&scene, &all)?;
    let ends = end_derivatives_by((&motion, start, true), &by).ok_or_else(missing)?;
    let drift = |index: usize| {
        let (end, begin) = ends[index];
        end - begin * Vector2::x()
    };
    let last = parameters.len();
    let by_frequency = along.iter().enumerate().map(|(index, (_, rate))| {
        let column = last - along.len() + index;
        *rate * drift(column)
    });
    let (by_angle, by_frequency) = (drift(last), by_frequency.sum::<Vector2<f64>>());
    let matrix = Matrix2::from_columns(&[by_angle, by_frequency]);
    let inverse = matrix.try_inverse().ok_or_else(missing)?;
    Ok((0..last).map(|index| (inverse * drift(index)).y).collect())
}
