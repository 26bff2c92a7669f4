//! Branches of periodic orbits in one parameter, by pseudo-arclength (Keller 1977), their
//! bifurcations, and curves of bifurcations in two parameters.
//!
//! A [`Family`] is a machine with one parameter or two left open: [`ParameterFamily`] makes one of any machine and any
//! [`Parameter`](softstop::Parameter). A [`Continuation`] follows its orbits over a number of drive periods, whether
//! stable or not, through folds; [`Continuation::branch`] finds every fold, flip and grazing on the way,
//! [`Continuation::double_period`] goes on to the orbits of twice the period, [`Continuation::branch_asymmetric`] to those that come
//! out of symmetric ones at a pitchfork, and [`follow_special`] follows a special point in two parameters.
//! [`ContinuationSettings`] holds the steps, angles and distances by which it does so.
//!
//! ```
//! use std::ops::ControlFlow;
//!
//! use nalgebra::Vector2;
//! use softstop::{Parameter, Ratios};
//! use softstop_dynamics::{BranchLimits, Continuation, ParameterFamily};
//!
//! let family = ParameterFamily::new(Ratios::unloaded().scene()?, [Parameter::Frequency])?;
//! let limits = BranchLimits { range: (1.1, 1.5), points: 500 };
//! let state = Vector2::new(6.9, 9.5);
//! let branch =
//!     Continuation::new(&family, 1).branch(1.15, state, &limits, |_| ControlFlow::Continue(()))?;
//! let fold = &branch.specials[0];
//! assert_eq!(fold.kind.symbol(), "SN");
//! assert!((fold.point.parameter - 1.369036).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arclength;
mod branch;
mod branch_switching;
mod codimension_two;
mod curve;
mod face;
mod follow;
mod grazing_test;
mod locate;
mod parameter_family;
pub(crate) mod period_map;
mod point;
mod point_between;
mod section;
mod section_orbit;
mod section_system;
mod sequence;
mod settings;
mod shooting;
mod special_curve;
mod specials_on_step;
mod step_control;
mod stepper;
mod test_function;

pub use crate::direction::Direction;
pub use branch::Branch;
pub use codimension_two::{CodimensionTwo, CurvePoint};
pub use curve::{Curve, CurveEnd, CurveLimits};
pub use face::SwitchingSurface;
pub use follow::Continuation;
pub(crate) use grazing_test::find_grazing;
pub(crate) use locate::MAX_CHORD_DISTANCE;
pub use parameter_family::ParameterFamily;
pub use point::{
    BorderCollision, BranchEnd, BranchLimits, BranchPoint, GrazingTouch, SpecialKind, SpecialPoint,
};
pub(crate) use section_orbit::LastArc;
pub use settings::ContinuationSettings;
pub(crate) use shooting::derivatives_by;
pub use special_curve::{follow_special, switch_curves};
pub use test_function::{TestFunction, normal_form_coefficient};

use std::fmt::Debug;

use softstop::{CheckedScene, MotionError};

/// Value of a parameter in units of its scale beyond which its unknown is a logarithm.
const MAX_SCALED_PARAMETER: f64 = 20.0;

/// A family of scenes along one or more parameters. To add one, implement the first three methods.
pub trait Family<const PARAMETERS: usize = 1>: Debug + Sync {
    /// The scene of the family at values of the parameters.
    ///
    /// # Errors
    /// [`MotionError`] if there is no such scene.
    fn scene(&self, parameters: [f64; PARAMETERS]) -> Result<CheckedScene, MotionError>;

    /// Typical sizes of position in m and velocity in m/s in the family.
    fn state_scales(&self) -> [f64; 2];

    /// Typical changes of the family's parameters: with the sizes of the state, the units of the arclength.
    fn parameter_scales(&self) -> [f64; PARAMETERS];

    /// d(drive frequency in rad/s) / d(parameter) of each parameter that changes nothing else: the derivatives of orbits by
    /// these are exact.
    fn by_frequency(&self) -> [Option<f64>; PARAMETERS] {
        [None; PARAMETERS]
    }
}

impl<const PARAMETERS: usize> dyn Family<PARAMETERS> + '_ {
    /// Parameters as unknowns of a continuation: in units of their scales, and where they outgrow these by a factor of twenty,
    /// as a logarithm, so that a step is a share of the parameter.
    pub fn scaled_parameters(&self, parameters: [f64; PARAMETERS]) -> [f64; PARAMETERS] {
        let scales = self.parameter_scales();
        let logarithm = |growth: f64| 1.0 + growth.ln();
        std::array::from_fn(|index| bend(parameters[index] / scales[index], logarithm))
    }

    /// The parameters of unknowns, which are the last of them: the inverse of `scaled_parameters`.
    pub fn unscaled_parameters(&self, unknowns: &[f64]) -> [f64; PARAMETERS] {
        let scales = self.parameter_scales();
        let unknowns = &unknowns[unknowns.len() - PARAMETERS..];
        let exponential = |growth: f64| (growth - 1.0).exp();
        std::array::from_fn(|index| bend(unknowns[index], exponential) * scales[index])
    }

    /// Derivatives of the parameters by the unknowns that they are.
    pub fn parameter_slopes(&self, parameters: [f64; PARAMETERS]) -> [f64; PARAMETERS] {
        let scales = self.parameter_scales();
        let slope = |index: usize| parameters[index].abs() / MAX_SCALED_PARAMETER;
        std::array::from_fn(|index| scales[index].max(slope(index)))
    }
}

/// A value up to the limit of scaled parameters, and beyond a function of how many times as large it is.
fn bend(value: f64, beyond: impl Fn(f64) -> f64) -> f64 {
    let growth = value.abs() / MAX_SCALED_PARAMETER;
    match growth > 1.0 {
        true => (MAX_SCALED_PARAMETER * beyond(growth)).copysign(value),
        false => value,
    }
}
