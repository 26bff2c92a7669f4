//! Curves of special points in two parameters.

use super::*;
use softstop_testing::{assert_near, with_changes};

pub(super) fn plane(parameters: [Parameter; 2]) -> ParameterFamily<2> {
    ParameterFamily::new(Ratios::unloaded().scene().expect("a scene"), parameters)
        .expect("a family")
}

pub(super) fn followed(
    special: &SpecialPoint,
    periods: u64,
    family: &dyn Family<2>,
    second: f64,
    ranges: [(f64, f64); 2],
) -> Curve {
    followed_by_steps(special, periods, family, second, ranges, 0.25)
}

fn followed_by_steps(
    special: &SpecialPoint,
    periods: u64,
    family: &dyn Family<2>,
    second: f64,
    ranges: [(f64, f64); 2],
    step: f64,
) -> Curve {
    let region = CurveLimits {
        ranges,
        points: 500,
        settings: ContinuationSettings::of_curves(step),
    };
    let start = [special.point.parameter, second];
    follow_special(
        family,
        periods,
        (special.kind, special.point.state()),
        start,
        &region,
        go_on,
    )
    .expect("a curve")
}

const FREQUENCY_CLEARANCE: [Parameter; 2] = [Parameter::Frequency, Parameter::Clearance];

/// The point of a curve in frequency and clearance at a clearance that it stops at.
#[track_caller]
fn at_clearance(curve: &Curve, clearance: f64) -> &CurvePoint {
    let off = |point: &&CurvePoint| (point.parameters[1] - clearance).abs();
    let nearest = curve.points.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
    let nearest = nearest.expect("points");
    assert!(off(&nearest) < 1e-9, "{clearance}: {nearest:?}");
    nearest
}

/// s_SN over rho: the fold's curve passes through the folds of thirty digits, wherever the reference's machine differs in its
/// clearance alone.
#[test]
fn fold_curve_agrees_with_thirty_digits() {
    let fold = of_kind(&all_of_z1(), "SN").remove(0);
    let family = plane(FREQUENCY_CLEARANCE);
    let mut compared = 0;
    for expected in list(&MACHINE, "folds") {
        let ratios =
            softstop_testing::reference::ratios(expected.get("parameters").unwrap_or(expected));
        let same = Ratios {
            frequency: 1.15,
            clearance: 10.0,
            ..ratios
        } == Ratios::unloaded();
        if !same || ratios.clearance > 18.0 {
            continue;
        }
        // The curve ends exactly at the range's end.
        let range = (ratios.clearance.min(10.0), ratios.clearance.max(10.0));
        let curve = followed(&fold, 1, &family, 10.0, [(1.0, 2.0), range]);
        let hit = at_clearance(&curve, ratios.clearance);
        assert_near(
            hit.parameters[0],
            number(expected, "frequency_sn"),
            10.0 * SOLVED,
        );
        assert_near(hit.impacts[0], number(expected, "velocity_sn"), DIFFERENCED);
        assert_near(
            TestFunction::Fold.scaled_value(&hit.monodromy),
            0.0,
            10.0 * MOTION,
        );
        compared += 1;
    }
    assert_eq!(compared, 18);
}

/// The amplitude of the impact-less motion is the clearance all along its grazing curve.
#[test]
fn grazing_curve_is_closed_form() {
    let graze = of_kind(&all_of_z1(), "G").remove(1);
    let family = plane(FREQUENCY_CLEARANCE);
    let curve = followed(&graze, 1, &family, 10.0, [(0.2, 3.0), (0.5, 24.9)]);
    assert!(curve.points.len() > 10);
    for point in &curve.points {
        let [eta, rho] = point.parameters;
        let amplitude = 1.0 / (1.0 - eta * eta).hypot(0.04 * eta);
        assert_near(amplitude / rho, 1.0, 10.0 * MOTION);
    }
    // It passes over resonance, where the clearance is the highest amplitude of all.
    let highest = curve
        .points
        .iter()
        .map(|point| point.parameters[1])
        .fold(0.0, f64::max);
    assert!(highest > 24.8, "{highest}");
}

/// Along the flip's curve in frequency and stiffness the branch at another stiffness flips where the
/// curve says.
#[test]
fn flip_curve_meets_the_branch_of_another_stiffness() {
    let flip = of_kind(&all_of_z1(), "PD").remove(0);
    let family = plane([Parameter::Frequency, Parameter::StopStiffness]);
    let curve = followed(&flip, 1, &family, 7.0, [(0.9, 1.1), (7.0, 9.0)]);
    let end = curve
        .points
        .iter()
        .max_by(|a, b| a.parameters[1].total_cmp(&b.parameters[1]))
        .expect("points");
    assert_near(end.parameters[1], 9.0, 10.0 * SOLVED);
    let stiffer = with_changes("unloaded", "k4=9");
    let along = ParameterFamily::new(stiffer, [Parameter::Frequency]).expect("a family");
    let branch = follow(&along, 1, (1.15, Vector2::new(A.0, A.1)), (0.9, 1.2));
    let flips = of_kind(&branch, "PD");
    assert_near(flips[0].point.parameter, end.parameters[0], SOLVED);
}

/// Close to the resonance the end of the range may lie where Newton's method does not settle from between the ends of a
/// long step.
#[test]
fn flip_curve_comes_to_the_end_of_its_range_with_any_step() {
    let flip = of_kind(&all_of_z1(), "PD").remove(0);
    let family = plane(FREQUENCY_CLEARANCE);
    let ends = [0.04, 0.08, 0.25].map(|step| {
        let ranges = [(0.7, 1.9), (1.0, 24.5)];
        let curve = followed_by_steps(&flip, 1, &family, 10.0, ranges, step);
        assert!(matches!(curve.ends.1, CurveEnd::Range), "{:?}", curve.ends);
        at_clearance(&curve, 24.5).parameters[0]
    });
    for eta in ends {
        assert_near(eta, ends[0], 10.0 * SOLVED);
    }
}
