//! Follows a special point of a branch in two parameters: the curve of special points through it.

use std::ops::ControlFlow;

use nalgebra::Vector2;

use super::continuation_settings::ContinuationSettings;
use super::follow_curve::follow_curve;
use super::impact_section_system::ImpactSectionSystem;
use super::stroboscopic_shooting::{CriticalShooting, Shooting};
use super::{
    CodimensionTwo, Curve, CurveEnd, CurveLimits, CurvePoint, Family, SpecialKind, TestFunction,
};
use crate::orbit::{Monodromy, OrbitError};
use softstop::MotionError;

/// Follows a special point, of this kind and with this state at time 0, in both directions of two parameters.
/// `parameters` are its own: that of the branch and the value of the second; `watch` sees each point as it comes.
///
/// # Errors
/// [`OrbitError`] if the point is not a special one of this family, or by settings with which no curve can be followed.
pub fn follow_special(
    family: &dyn Family<2>,
    periods: u64,
    special: (SpecialKind, Vector2<f64>),
    parameters: [f64; 2],
    region: &CurveLimits,
    mut watch: impl FnMut(&CurvePoint) -> ControlFlow<()>,
) -> Result<Curve, OrbitError> {
    region.settings.validate().map_err(MotionError::from)?;
    let mut found =
        follow_without_flip_end(family, periods, special, parameters, region, &mut watch)?;
    end_in_flips(family, &mut found, region);
    Ok(found)
}

/// Follows a special point as [`follow_special`] does, without the last point of folds that end in flips.
fn follow_without_flip_end(
    family: &dyn Family<2>,
    periods: u64,
    (kind, state): (SpecialKind, Vector2<f64>),
    parameters: [f64; 2],
    region: &CurveLimits,
    watch: &mut dyn FnMut(&CurvePoint) -> ControlFlow<()>,
) -> Result<Curve, OrbitError> {
    match kind {
        SpecialKind::Critical(test) => {
            let shooting = Shooting::new(family, periods);
            let guess = shooting.scaled_unknowns(state, parameters);
            let critical = CriticalShooting { shooting, test };
            match ImpactSectionSystem::at_orbit((family, periods), test, state, parameters)? {
                Some((at_impact, impact)) => follow_curve(&at_impact, kind, &impact, region, watch)
                    .or_else(|_| follow_curve(&critical, kind, &guess, region, watch)),
                None => follow_curve(&critical, kind, &guess, region, watch),
            }
        }
        SpecialKind::Pitchfork => Err(OrbitError::NotIsolated),
        SpecialKind::Grazing(graze) => {
            let touching = ImpactSectionSystem::of_graze(&graze, (family, periods));
            let guess = touching.scaled_unknowns(&[graze.angle], parameters);
            follow_curve(&touching, kind, &guess, region, watch)
        }
    }
}

/// Points and steps, in those of the region, of the curve of flips on which a generalised flip is looked for.
const FLIP_SEARCH: (usize, f64) = (5, 0.1);

/// Gives curves of folds that end near a generalised flip, singular there, their last point by that of flips.
pub(super) fn end_in_flips(family: &dyn Family<2>, folds: &mut Curve, region: &CurveLimits) {
    let is_fold = folds.kind == SpecialKind::Critical(TestFunction::Fold);
    if !is_fold || !folds.periods.is_multiple_of(2) {
        return;
    }
    let special = CodimensionTwo::GeneralisedFlip;
    for end in [&mut folds.ends.1, &mut folds.ends.0] {
        // After two turns the curve runs as before.
        if let (CurveEnd::Lost(_), Some(last)) = (&*end, folds.points.last())
            && let Some(flip) = generalised_flip_near(family, folds.periods / 2, last, region)
        {
            folds.points.push(flip.clone());
            folds.specials.push((special, flip));
            *end = CurveEnd::CodimensionTwo(special);
        }
        folds.points.reverse();
        folds.specials.reverse();
    }
}

/// The generalised flip near a point of a curve of folds of twice the period, as one of those, if there is one.
fn generalised_flip_near(
    family: &dyn Family<2>,
    periods: u64,
    point: &CurvePoint,
    region: &CurveLimits,
) -> Option<CurvePoint> {
    let (points, share) = FLIP_SEARCH;
    let step = share * region.settings.largest_step;
    let region = CurveLimits {
        points,
        settings: ContinuationSettings {
            largest_step: step,
            crawling_step: share * region.settings.crawling_step,
            ..region.settings
        },
        ..*region
    };
    let flip = (SpecialKind::Critical(TestFunction::Flip), point.state());
    let go_on = &mut |_: &_| ControlFlow::Continue(());
    let flips = follow_without_flip_end(family, periods, flip, point.parameters, &region, go_on);
    let place = |point: &CurvePoint| Vector2::from(family.scaled_parameters(point.parameters));
    let is_near = |found: &CurvePoint| (place(found) - place(point)).amax() <= step * points as f64;
    let specials = flips.ok()?.specials.into_iter();
    let flips = specials.filter(|it| it.0 == CodimensionTwo::GeneralisedFlip);
    let flip = flips.map(|it| it.1).find(is_near)?;
    Some(CurvePoint {
        impacts: flip.impacts.repeat(2),
        monodromy: Monodromy::product(&[flip.monodromy; 2]),
        ..flip
    })
}
