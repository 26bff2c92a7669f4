//! Directions within the tolerances in which a search has met a loss of the motion, and how far the motion goes on in each,
//! with derivatives.

use crate::spread::{HomotopyEnd, along};
use softstop::Scene;
use softstop_dynamics::BranchPoint;
use softstop_dynamics::continuation::TestFunction;
use softstop_dynamics::derivatives::Border;
use softstop_dynamics::zone::Loss;

use super::Design;
use super::box_window::CornerZoneEnd;
use super::differences::differences;
use super::exact::Linearization;
use super::slope::Slope;
use super::within::ParameterJacobian;
use crate::robust::{Tolerances, is_loss};

/// Share of the box up to which a direction is followed.
const FARTHEST: f64 = 1.25;

/// By how much of them a motion fails to go on to the ends of some directions of the box of tolerances, summed; none if that is
/// more than a bound, or one cannot be followed.
pub(super) fn unreached(
    directions: &[Vec<f64>],
    spread: &Tolerances,
    here: &Design,
    farthest: f64,
) -> Option<f64> {
    directions.iter().try_fold(0.0, |sum, direction| {
        let (share, _) = end(spread, here, direction)?;
        Some(sum + (1.0 - share).max(0.0)).filter(|sum| *sum <= farthest)
    })
}

/// How far inside an end of the zone the machine at its corner of the box is, as a share of the frequency.
pub(super) fn inside(about: &Linearization<'_>, edge: &CornerZoneEnd) -> Option<Slope> {
    let rows = ParameterJacobian::at(about, &edge.corner)?;
    let scene = about
        .problem
        .spread(&about.point.machine)?
        .scene(&edge.corner);
    let (border, sign) = match &edge.fold {
        None => (Border::at_g0(&scene, true, rows.parameters()).ok()?, 1.0),
        Some(fold) => {
            let fold = (TestFunction::Fold, fold);
            let border = Border::at_special(&scene, 1, fold, rows.parameters()).ok()?;
            (border, -1.0)
        }
    };
    let unit = sign / about.problem.machine.scene.excitation.frequency;
    let (by, _) = rows.across(&border);
    Some(Slope {
        value: unit * (scene.excitation.frequency - border.frequency()),
        by: by.iter().map(|by| unit * by).collect(),
    })
}

/// Where the motion ends in a direction: at this share of it, by this.
fn end(
    spread: &Tolerances,
    here: &Design,
    direction: &[f64],
) -> Option<(f64, Option<(Loss, BranchPoint)>)> {
    let reached = along(spread, &here.orbit, direction, FARTHEST).ok()?;
    let HomotopyEnd {
        share, loss, point, ..
    } = reached;
    match loss.filter(is_loss) {
        Some(loss) => Some((share, Some((loss, point)))),
        None => Some((FARTHEST, None)),
    }
}

/// By how much of the tolerances the motion goes on beyond them in a direction.
pub(super) fn reserve(
    about: &Linearization<'_>,
    spread: &Tolerances,
    direction: &[f64],
) -> Option<Slope> {
    let (share, lost) = end(spread, about.point, direction)?;
    let value = share - 1.0;
    let Some((loss, point)) = lost else {
        let by = vec![0.0; about.frequency.len()];
        return Some(Slope { value, by });
    };
    let test = match loss {
        Loss::Fold => Some(TestFunction::Fold),
        Loss::Flip => Some(TestFunction::Flip),
        _ => None,
    };
    let by = test.and_then(|test| {
        let end: Vec<f64> = direction.iter().map(|part| share * part).collect();
        by_normal(about, &spread.scene(&end), (&end, share), (test, point))
    });
    let share = |point: &Design| {
        let spread = about.problem.spread(&point.machine)?;
        Some(vec![end(&spread, point, direction)?.0])
    };
    let differenced = || Some(differences(about.problem, about.at, &share)?.concat());
    let by = by.or_else(differenced)?;
    Some(Slope { value, by })
}

/// How the share of a direction changes at which it meets a border.
fn by_normal(
    about: &Linearization<'_>,
    scene: &Scene,
    (end, share): (&[f64], f64),
    (test, mut point): (TestFunction, BranchPoint),
) -> Option<Vec<f64>> {
    let rows = ParameterJacobian::at(about, end)?;
    point.parameter = scene.excitation.frequency;
    let border = Border::at_special(scene, 1, (test, &point), rows.parameters()).ok()?;
    let (by, outwards) = rows.across(&border);
    Some(by.iter().map(|by| -share * by / outwards).collect())
}
