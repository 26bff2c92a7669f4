//! Follows a curve of special points in two parameters from point to point.

use std::ops::ControlFlow;

use nalgebra::DVector;

use super::chord_and_cubic::passes_place;
use super::codimension_two_on_step::{codimension_two_between, reaches_flip};
use super::equations::{CurveNode, StepEnds};
use super::locate_zero::locate_zero;
use super::newton_corrector::correct;
use super::special_point_equations::SpecialPointEquations;
use super::stepper::Stepper;
use super::{CodimensionTwo, Curve, CurveEnd, CurveLimits, CurvePoint, SpecialKind};
use crate::orbit::OrbitError;

/// Follows the curve through the solution near a guess, in both directions.
pub(super) fn follow_curve<E: SpecialPointEquations>(
    equations: &E,
    kind: SpecialKind,
    guess: &DVector<f64>,
    region: &CurveLimits,
    watch: &mut dyn FnMut(&CurvePoint) -> ControlFlow<()>,
) -> Result<Curve, OrbitError> {
    let unknowns = guess.len();
    let mut second = DVector::zeros(unknowns);
    second[unknowns - 1] = 1.0;
    let mut first = DVector::zeros(unknowns);
    first[unknowns - 2] = 1.0;
    let start = correct(equations, guess, Some(&second))
        .or_else(|_| correct(equations, guess, Some(&first)))?;
    let (mut up, mut down) = (HalfCurve::default(), HalfCurve::default());
    let last = follow_half_curve(equations, start.clone(), &second, region, &mut up, watch)?;
    let first = match last {
        CurveEnd::Closed => CurveEnd::Closed,
        _ => follow_half_curve(equations, start.clone(), &-second, region, &mut down, watch)?,
    };
    let (mut points, mut specials) = down;
    points.reverse();
    specials.reverse();
    points.push(equations.curve_point(&start)?);
    points.extend(up.0);
    specials.extend(up.1);
    Ok(Curve {
        kind,
        periods: equations.family_and_periods().1,
        points,
        specials,
        ends: (first, last),
    })
}

/// Points after which a curve or a branch may be found closed.
pub(super) const MIN_LOOP_POINTS: usize = 8;

/// Points of a curve in one direction, and those of codimension two among them.
type HalfCurve = (Vec<CurvePoint>, Vec<(CodimensionTwo, CurvePoint)>);

/// Follows a curve in one direction from a node: why it ends.
fn follow_half_curve<E: SpecialPointEquations>(
    equations: &E,
    start: CurveNode<E::Point>,
    along: &DVector<f64>,
    region: &CurveLimits,
    (points, specials): &mut HalfCurve,
    watch: &mut dyn FnMut(&CurvePoint) -> ControlFlow<()>,
) -> Result<CurveEnd, OrbitError> {
    let origin = start.at.clone();
    let counts = E::orbit_of(&start.here.point).2;
    let mut stepper = Stepper::new(equations, start, along, &region.settings)?;
    while points.len() < region.points {
        let last = stepper.node.clone();
        let ahead = stepper.step * &stepper.direction;
        if let Some((kind, point)) = equations.resonant_grazing_within_step(&last, &ahead) {
            let _ = watch(&point);
            points.push(point.clone());
            specials.push((kind, point));
            return Ok(CurveEnd::CodimensionTwo(kind));
        }
        let next = stepper.attempt_step().map_err(CurveEnd::Lost);
        let next = next.and_then(|step| {
            if E::orbit_of(&step.node.here.point).2 != counts {
                return Err(CurveEnd::Grazing);
            }
            let end = clip_to_region(equations, (&last, &step.node), region);
            Ok((step, end.map_err(CurveEnd::Lost)?))
        });
        let (step, (node, leaves)) = match next {
            Ok(next) => next,
            Err(_) if stepper.shorten_step() => continue,
            Err(cause) => return Ok(cause),
        };
        if reaches_flip(equations, (&last, &node)) {
            return Ok(CurveEnd::Lost(OrbitError::LOST));
        }
        let directions = [&stepper.direction, &step.direction];
        let special = codimension_two_between(equations, (&last, &node), directions);
        specials.extend(special.ok().flatten());
        stepper.step_to(step);
        let closed =
            points.len() >= MIN_LOOP_POINTS && passes_place(equations, (&last, &node), &origin);
        let point = equations.curve_point(&node)?;
        let stopped = watch(&point).is_break();
        points.push(point);
        if leaves {
            return Ok(CurveEnd::Range);
        }
        if stepper.is_crawling() {
            return Ok(CurveEnd::Lost(OrbitError::LOST));
        }
        if closed {
            return Ok(CurveEnd::Closed);
        }
        if stopped {
            return Ok(CurveEnd::Stopped);
        }
    }
    Ok(CurveEnd::Points)
}

/// The end of a step of a curve, or the point on it where a parameter leaves its range, and whether one does.
fn clip_to_region<E: SpecialPointEquations>(
    equations: &E,
    (from, to): StepEnds<'_, E::Point>,
    region: &CurveLimits,
) -> Result<(CurveNode<E::Point>, bool), OrbitError> {
    let mut end = (to.clone(), false);
    for (index, (low, high)) in region.ranges.into_iter().enumerate() {
        let value = |node: &CurveNode<E::Point>| equations.parameters(&node.at)[index];
        let now = value(&end.0);
        let bound = now.clamp(low, high);
        if bound != now && value(from) != bound {
            let test = |node: &CurveNode<E::Point>| value(node) - bound;
            let (node, _) = locate_zero(equations, (from, &end.0), test)?;
            end = (node, true);
        }
    }
    Ok(end)
}
