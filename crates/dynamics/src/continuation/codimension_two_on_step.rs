//! Detects a point of codimension two on a step of a curve of special points, and a fold that becomes a flip there.

use nalgebra::{DVector, Vector2};

use super::equations::{CurveNode, StepEnds};
use super::locate_zero::locate_zero;
use super::newton_corrector::curve_tangent;
use super::special_point_equations::SpecialPointEquations;
use super::{CodimensionTwo, CurvePoint, TestFunction, normal_form_coefficient};
use crate::orbit::{OrbitError, StroboscopicMap};
use crate::tolerance::SAME;

/// The point of codimension two between two nodes, if there is one; with the directions of the curve there.
pub(super) fn codimension_two_between<E: SpecialPointEquations>(
    equations: &E,
    (from, to): StepEnds<'_, E::Point>,
    [begins, ends]: [&DVector<f64>; 2],
) -> Result<Option<(CodimensionTwo, CurvePoint)>, OrbitError> {
    let (_, before) = degeneracy_test(equations, from, [begins, begins]);
    let (_, after) = degeneracy_test(equations, to, [begins, ends]);
    let changes = before * after < 0.0;
    if !changes {
        return Ok(None);
    }
    let direction = |node: &CurveNode<E::Point>| curve_tangent(equations, node, begins);
    let value = |node: &CurveNode<E::Point>| {
        let value =
            direction(node).map(|(here, _)| degeneracy_test(equations, node, [begins, &here]).1);
        value.unwrap_or(f64::NAN)
    };
    let (node, _) = locate_zero(equations, (from, to), value)?;
    let (kind, _) = degeneracy_test(equations, &node, [begins, begins]);
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

/// A function that changes its sign where the curve has a point of codimension two, at a node where it has a
/// direction; before, it had another one. Not a number where it cannot be computed. At a cusp both parameters turn
/// back, at a generalised flip the coefficient of the normal form vanishes.
fn degeneracy_test<E: SpecialPointEquations>(
    equations: &E,
    node: &CurveNode<E::Point>,
    [before, here]: [&DVector<f64>; 2],
) -> (CodimensionTwo, f64) {
    if let Some(found) = equations.resonance_test(node) {
        return found;
    }
    if equations.critical_test() != Some(TestFunction::Flip) {
        let value = along_parameters(before).dot(&along_parameters(here));
        return (CodimensionTwo::Cusp, value);
    }
    let (machines, periods) = equations.family_and_periods();
    let coefficient = equations.curve_point(node).and_then(|point| {
        let scene = machines.scene(point.parameters)?;
        normal_form_coefficient(&scene, periods, TestFunction::Flip, point.state())
    });
    let value = coefficient.ok().flatten().unwrap_or(f64::NAN);
    (CodimensionTwo::GeneralisedFlip, value)
}

/// The part of a curve's direction along the two parameters.
fn along_parameters(direction: &DVector<f64>) -> DVector<f64> {
    direction.rows(direction.len() - 2, 2).into_owned()
}

/// True if a fold between two nodes of a curve repeats after half its drive periods already: it is a flip.
pub(super) fn reaches_flip<E: SpecialPointEquations>(
    equations: &E,
    (from, to): StepEnds<'_, E::Point>,
) -> bool {
    let gap =
        |node: &CurveNode<E::Point>| half_period_gap(equations, &equations.curve_point(node).ok()?);
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

/// How far the orbits of a fold are from where they are half their drive periods later, in units of the machine's motion;
/// none if that number is odd. It vanishes where the curve ends on one of flips.
fn half_period_gap<E: SpecialPointEquations>(
    equations: &E,
    point: &CurvePoint,
) -> Option<Vector2<f64>> {
    let (machines, periods) = equations.family_and_periods();
    if equations.critical_test() != Some(TestFunction::Fold) || !periods.is_multiple_of(2) {
        return None;
    }
    let scene = machines.scene(point.parameters).ok()?;
    let map = StroboscopicMap::new(&scene, periods / 2);
    let gap = map.apply(point.state()).ok()?.end - point.state();
    let scales = scene.motion_scales();
    Some(Vector2::new(gap.x / scales.length, gap.y / scales.speed()))
}
