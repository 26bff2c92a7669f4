//! How a motion answers to a small change of its start or of the external force: exact directional
//! derivatives across crossings.

use nalgebra::Vector2;

use super::tangent::{Tangent, saltation};
use crate::integrator::{Arc, Crossing, CrossingKind, Motion, Observer, Simulation};
use crate::flow::Course;
use crate::trajectory::work;
