//! Switching from the points of codimension two of a curve of special points to the other curves that begin there.

use std::ops::ControlFlow;

use nalgebra::Vector2;

use super::family::RestrictedFamily;
use super::follow_curve::follow_curve;
use super::follow_special_point::{end_in_flips, follow_special};
use super::impact_section_system::ImpactSectionSystem;
use super::{
    BranchLimits, CodimensionTwo, Continuation, Curve, CurveLimits, CurvePoint, Family,
    GrazingTouch, SpecialKind, TestFunction,
};
use crate::monitor::stop_if;

/// Scaled velocities of the weak impact at which folds and flips beside resonant grazing are looked for.
const WEAK_VELOCITIES: [f64; 3] = [1e-2, 1e-3, 1e-4];

/// The curves that begin in the points of codimension two of a curve: those of grazing, folds and flips in resonant grazing, and
/// in a generalised flip that of flips and that of folds of orbits of twice the period. `is_known` says of a kind of curve with
/// its drive periods whether one through the point is known already; what cannot be found is left out.
pub fn switch_curves(
    family: &dyn Family<2>,
    from: &Curve,
    region: &CurveLimits,
    mut is_known: impl FnMut(&SpecialKind, u64, &CurvePoint) -> bool,
    mut watch: impl FnMut(&CurvePoint) -> ControlFlow<()>,
) -> Vec<Curve> {
    let [folds, flips] = [TestFunction::Fold, TestFunction::Flip].map(SpecialKind::Critical);
    let mut found = Vec::new();
    for (special, point) in &from.specials {
        let others = match special {
            CodimensionTwo::Cusp => Vec::new(),
            CodimensionTwo::GeneralisedFlip if from.kind == flips => {
                vec![(folds, 2 * from.periods)]
            }
            CodimensionTwo::GeneralisedFlip => vec![(flips, from.periods / 2)],
            CodimensionTwo::ResonantGrazing(graze) => {
                let kinds = [folds, flips, SpecialKind::Grazing(*graze)];
                kinds.map(|kind| (kind, from.periods)).to_vec()
            }
        };
        for (kind, periods) in others {
            if is_known(&kind, periods, point) {
                continue;
            }
            let curve = match (special, kind) {
                (CodimensionTwo::ResonantGrazing(graze), SpecialKind::Critical(test)) => {
                    let place = (periods, graze, point.parameters);
                    follow_from_resonant_grazing(family, place, test, region, &mut watch)
                }
                _ => {
                    let start = match kind == folds {
                        true => fold_near_generalised_flip(family, from, point, region),
                        false => Some((point.state(), point.parameters)),
                    };
                    start.and_then(|(state, at)| {
                        follow_special(family, periods, (kind, state), at, region, &mut watch).ok()
                    })
                }
            };
            found.extend(curve);
        }
    }
    found
}

/// The curve of folds or flips that begins in resonant grazing.
fn follow_from_resonant_grazing(
    family: &dyn Family<2>,
    (periods, graze, parameters): (u64, &GrazingTouch, [f64; 2]),
    test: TestFunction,
    region: &CurveLimits,
    watch: &mut dyn FnMut(&CurvePoint) -> ControlFlow<()>,
) -> Option<Curve> {
    let touching = ImpactSectionSystem::of_graze(graze, (family, periods));
    let touch = touching.scaled_unknowns(&[graze.angle], parameters);
    let beside = |velocity: &f64| touching.with_weak_impact(&touch, test, *velocity).ok();
    let (critical, node) = WEAK_VELOCITIES.iter().find_map(beside)?;
    let kind = SpecialKind::Critical(test);
    let mut curve = follow_curve(&critical, kind, &node.at, region, watch).ok()?;
    end_in_flips(family, &mut curve, region);
    Some(curve)
}

/// State and parameters of a fold of orbits of twice the period beside a generalised flip on a curve of flips.
fn fold_near_generalised_flip(
    family: &dyn Family<2>,
    flips: &Curve,
    generalised: &CurvePoint,
    region: &CurveLimits,
) -> Option<(Vector2<f64>, [f64; 2])> {
    let points = &flips.points;
    let place = |point: &CurvePoint| Vector2::from(family.scaled_parameters(point.parameters));
    let off = |point: &CurvePoint| (place(point) - place(generalised)).norm();
    let nearest = (0..points.len()).min_by(|a, b| off(&points[*a]).total_cmp(&off(&points[*b])))?;
    let steps = std::iter::successors(Some(1), |step| Some(2 * step));
    let both_ways = |step: usize| [nearest.checked_sub(step), nearest.checked_add(step)];
    let mut beside = steps
        .take_while(|step| *step < points.len())
        .flat_map(both_ways)
        .flatten()
        .filter_map(|index| points.get(index));
    beside.find_map(|flip| {
        let [slope, _] = family.parameter_derivatives(flip.parameters);
        let within = off(flip) * slope;
        fold_of_doubled_orbits(family, flips.periods, flip, within, region)
    })
}

/// The first fold of the doubled orbits of a flip along the first parameter, so near to it at most. A generalised flip is
/// farther from the flip than such a fold is: that one only by the square of its distance.
fn fold_of_doubled_orbits(
    family: &dyn Family<2>,
    periods: u64,
    flip: &CurvePoint,
    within: f64,
    region: &CurveLimits,
) -> Option<(Vector2<f64>, [f64; 2])> {
    let [parameter, second] = flip.parameters;
    let fixed = RestrictedFamily { family, second };
    let along = Continuation::new(&fixed, periods)
        .with_steps(region.settings.largest_step)
        .ok()?;
    let limits = BranchLimits {
        range: (parameter - within, parameter + within),
        points: region.points,
    };
    let flip = along.find_point(parameter, flip.state()).ok()?;
    let mut begins = None;
    let branch = along.double_period(&flip, &limits, |point| {
        let is_positive = point.fold_test() > 0.0;
        stop_if(*begins.get_or_insert(is_positive) != is_positive)
    });
    let branch = branch.ok()?;
    let fold = branch.critical_points(TestFunction::Fold).next()?;
    Some((fold.state(), [fold.parameter, second]))
}
