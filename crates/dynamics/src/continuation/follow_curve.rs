//! Follows a curve of special points in two parameters from point to point.

use std::ops::ControlFlow;

use nalgebra::DVector;

use super::chord_and_cubic::passes_place;
use super::equations::{CurveNode, StepEnds};
use super::locate_zero::locate_zero;
use super::newton_corrector::{correct, curve_tangent};
use super::special_point_equations::{SpecialPointEquations, along_parameters};
use super::stepper::Stepper;
use super::{CodimensionTwo, Curve, CurveEnd, CurveLimits, CurvePoint, SpecialKind};
use crate::orbit::OrbitError;
use crate::tolerance::SAME;

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

/// The point of codimension two between two nodes, if there is one; with the directions of the curve there.
fn codimension_two_between<E: SpecialPointEquations>(
    equations: &E,
    (from, to): StepEnds<'_, E::Point>,
    [begins, ends]: [&DVector<f64>; 2],
) -> Result<Option<(CodimensionTwo, CurvePoint)>, OrbitError> {
    let (_, before) = equations.degeneracy_test(from, [begins, begins]);
    let (_, after) = equations.degeneracy_test(to, [begins, ends]);
    let changes = before * after < 0.0;
    if !changes {
        return Ok(None);
    }
    let direction = |node: &CurveNode<E::Point>| curve_tangent(equations, node, begins);
    let value = |node: &CurveNode<E::Point>| {
        let value =
            direction(node).map(|(here, _)| equations.degeneracy_test(node, [begins, &here]).1);
        value.unwrap_or(f64::NAN)
    };
    let (node, _) = locate_zero(equations, (from, to), value)?;
    let (kind, _) = equations.degeneracy_test(&node, [begins, begins]);
    // A curve that only turns sharply has its parameters change there, too.
    let is_found = match kind {
        CodimensionTwo::Cusp => along_parameters(&direction(&node)?.0).norm() < SAME,
        // It changes its sign as well where it grows beyond all bounds.
        CodimensionTwo::GeneralisedFlip => value(&node).abs() < before.abs().min(after.abs()),
        CodimensionTwo::ResonantGrazing(_) => true,
    };
    let point = equations.curve_point(&node)?;
    Ok(is_found.then_some((kind, point)))
}

/// True if a fold between two nodes of a curve repeats after half its drive periods already: it is a flip.
fn reaches_flip<E: SpecialPointEquations>(
    equations: &E,
    (from, to): StepEnds<'_, E::Point>,
) -> bool {
    let gap =
        |node: &CurveNode<E::Point>| equations.half_period_gap(&equations.curve_point(node).ok()?);
    let (Some(before), Some(after)) = (gap(from), gap(to)) else {
        return false;
    };
    if before.dot(&after) >= 0.0 {
        return false;
    }
    let value = |node: &CurveNode<E::Point>| gap(node).map_or(f64::NAN, |it| it.dot(&before));
    let between = locate_zero(equations, (from, to), value).ok();
    let left = between.and_then(|(node, _)| gap(&node));
    left.is_some_and(|it| it.norm() < SAME * before.norm().max(after.norm()))
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
