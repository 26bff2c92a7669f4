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

mod bifurcation_curve;
mod branch;
mod branch_continuation;
mod branch_end;
mod branch_point;
mod branch_switching;
mod chord_and_cubic;
mod codimension_two;
mod codimension_two_on_step;
mod continuation_settings;
mod corner;
mod crossing_counts;
mod curve_switching;
mod detect_branch_end;
mod end_derivatives;
mod equations;
mod family;
mod follow_branch;
mod follow_curve;
mod follow_points;
mod follow_special_point;
mod grazing_test;
mod grazings_near_step;
mod half_branch;
mod impact_section_orbit;
mod impact_section_system;
mod locate_zero;
mod merging_orbits;
mod newton_corrector;
mod normal_form;
pub(crate) mod period_map;
mod point_between;
mod special_point;
mod special_point_equations;
mod specials_on_step;
mod step_acceptance;
mod stepper;
mod stroboscopic_section;
mod stroboscopic_shooting;
mod switching_surface;
mod symmetric_orbits;
mod test_function;

pub use crate::direction::Direction;
pub use bifurcation_curve::{Curve, CurveEnd, CurveLimits, CurvePoint};
pub use branch::Branch;
pub use branch_continuation::Continuation;
pub use branch_end::{BorderCollision, BranchEnd};
pub use branch_point::BranchPoint;
pub(crate) use chord_and_cubic::MAX_CHORD_DISTANCE;
pub use codimension_two::CodimensionTwo;
pub use continuation_settings::{BranchLimits, ContinuationSettings};
pub use curve_switching::switch_curves;
pub(crate) use end_derivatives::end_derivatives_by;
pub use family::{Family, ParameterFamily};
pub use follow_special_point::follow_special;
pub(crate) use grazing_test::find_grazing;
pub(crate) use impact_section_orbit::LastArc;
pub use normal_form::normal_form_coefficient;
pub use special_point::{GrazingTouch, SpecialKind, SpecialPoint};
pub use switching_surface::SwitchingSurface;
pub use test_function::TestFunction;
