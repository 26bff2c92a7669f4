//! Branches, their special points and curves of them, against closed forms, published figures and an
//! independent 30-digit integrator.

mod codimension_two;
mod curves;
mod doubling;
pub(crate) mod outgrown;

use crate::branches::{self, go_on};
use nalgebra::Vector2;
use softstop::{Parameter, Ratios, Release, Scene, Start};
use softstop_dynamics::continuation::{
    BranchEnd, ContinuationSettings, Curve, CurveEnd, CurveLimits, CurvePoint, Family, SpecialKind,
    SpecialPoint, SwitchingSurface, TestFunction, follow_special, normal_form_coefficient,
};
use softstop_dynamics::zone::grazing_frequencies;
use softstop_dynamics::{
    Branch, BranchLimits, BranchPoint, Continuation, ParameterFamily, StroboscopicMap,
};
use softstop_testing::reference::{MACHINE, list, number};
use softstop_testing::tangent::differences;
use softstop_testing::tolerance::{DIFFERENCED, GROWN, MOTION, SOLVED, printed};
use softstop_testing::{assert_near, is_near, kelvin_voigt, loaded};

type Frequencies = ParameterFamily<1>;

fn frequencies(eta: f64) -> Frequencies {
    let machine = Ratios::unloaded().at_frequency(eta);
    ParameterFamily::new(machine.scene().expect("a scene"), [Parameter::Frequency])
        .expect("a family")
}

/// The branch of period-`n` orbits of the unloaded machine near a state.
fn branch(eta: f64, n: u64, state: (f64, f64), range: (f64, f64)) -> Branch {
    let state = Vector2::new(state.0, state.1);
    follow(&frequencies(eta), n, (eta, state), range)
}

/// The branch of a family from a frequency and a state on.
fn follow(family: &Frequencies, n: u64, from: (f64, Vector2<f64>), range: (f64, f64)) -> Branch {
    branches::follow(family, n, from, range, 500).expect("a branch")
}

/// The branch of twice the period from a flip on, over the frequencies about it.
fn double(family: &impl Family<1>, n: u64, flip: &BranchPoint) -> Branch {
    double_within(family, n, flip, (0.9, 1.1))
}

/// That over some frequencies.
fn double_within(family: &dyn Family, n: u64, flip: &BranchPoint, range: (f64, f64)) -> Branch {
    let limits = BranchLimits { range, points: 500 };
    let doubled = Continuation::new(family, n).double_period(flip, &limits, go_on);
    doubled.expect("a branch of twice the period")
}

/// A branch has the same special points whatever value of the parameter it is followed from.
#[test]
fn a_branch_from_a_tiny_value_of_the_parameter_is_that_from_a_usual_one() {
    let specials = |amplitude: f64| {
        let mut scene = Ratios::unloaded().at_frequency(1.1).scene().expect("valid");
        (scene.clearance, scene.damping, scene.contact_damping) = (1.0, 0.1, 0.1);
        scene.stop = kelvin_voigt(100.0, Release::Clearance);
        scene.excitation.amplitude = amplitude;
        let settled = scene.trajectory(Start::REST, 400).expect("a motion").end;
        let family = ParameterFamily::new(scene, [Parameter::Amplitude]).expect("a parameter");
        let range = (amplitude, 1.3);
        let branch = branches::follow(&family, 1, (amplitude, settled), range, 4000);
        let branch = branch.expect("a branch");
        assert!(
            matches!(branch.ends.1, BranchEnd::Range),
            "{:?}",
            branch.ends
        );
        let specials = branch.specials.into_iter();
        let specials = specials.map(|it| (it.kind.symbol(), it.point.parameter));
        specials.collect::<Vec<_>>()
    };
    let usual = specials(0.1);
    assert_eq!(
        usual.iter().map(|it| it.0).collect::<Vec<_>>(),
        ["G", "SN", "SN"]
    );
    for tiny in [1e-5, 1e-10] {
        let found = specials(tiny);
        assert_eq!(found.len(), usual.len());
        for (found, expected) in found.iter().zip(&usual) {
            assert_eq!(found.0, expected.0);
            assert_near(found.1, expected.1, SOLVED);
        }
    }
}

/// A drive angle at time 0 of many turns is the one without them: in a motion bit for bit, in an orbit and its branch to
/// rounding. Sums of angles at 1e8 rad are good to 1e-8.
#[test]
fn whole_turns_of_the_drive_angle_change_nothing() {
    let turned = 1e8_f64;
    let found = [turned, turned.sin().atan2(turned.cos())].map(|phase| {
        let mut scene = unloaded();
        scene.excitation.phase = phase;
        let end = scene.trajectory(Start::REST, 50).expect("a motion").end;
        let orbit = softstop_dynamics::orbit::find(&scene).expect("an orbit");
        let (eta, state) = (scene.excitation.frequency, orbit.state());
        let family = ParameterFamily::new(scene, [Parameter::Frequency]).expect("a parameter");
        (end, state, follow(&family, 1, (eta, state), (0.5, 2.0)))
    });
    let [many, none] = &found;
    assert_eq!(many.0, none.0);
    assert_near((many.1 - none.1).norm(), 0.0, MOTION);
    assert_eq!(symbols(&none.2), ["G", "PD", "SN", "G"]);
    assert_eq!(symbols(&many.2), symbols(&none.2));
    for (many, none) in many.2.specials.iter().zip(&none.2.specials) {
        assert_near(many.point.parameter, none.point.parameter, MOTION);
    }
}

/// The z = 1 branch through the paper's point A, and states of others (settled from arbitrary starts).
const A: (f64, f64) = (6.901_267_951_548, 9.516_655_745_459);
const HALF: (f64, f64) = (9.214_320, 3.694_000);
const TWO_THIRDS: (f64, f64) = (9.265_438, 3.715_005);
const TWO_QUARTERS_B: (f64, f64) = (9.360_532, 3.830_784);
const TENTH: (f64, f64) = (8.206_329, 2.189_225);

fn unloaded() -> Scene {
    Ratios::unloaded().scene().expect("valid")
}

fn all_of_z1() -> Branch {
    branch(1.15, 1, A, (0.5, 2.0))
}

fn of_kind(branch: &Branch, symbol: &str) -> Vec<SpecialPoint> {
    let specials = branch.specials.iter();
    let found = specials.filter(|special| special.kind.symbol() == symbol);
    found.cloned().collect()
}

fn symbols(branch: &Branch) -> Vec<&'static str> {
    let specials = branch.specials.iter();
    specials.map(|special| special.kind.symbol()).collect()
}

/// From one grazing to the other: flip, fold, and at both ends the impact dies in the impact-less motion
/// whose amplitude is the clearance, which has a closed form.
#[test]
fn z1_goes_from_grazing_over_flip_and_fold_to_grazing() {
    let branch = all_of_z1();
    assert_eq!(symbols(&branch), ["G", "PD", "SN", "G"]);
    let (below, above) = grazing_frequencies(&unloaded()).expect("a boundary");
    let [low, flip, fold, high] = &branch.specials[..] else {
        panic!("{branch:?}");
    };
    assert_near(low.point.parameter, below.expect("one below"), MOTION);
    assert_near(high.point.parameter, above, MOTION);
    assert_near(flip.point.parameter, 0.988_907, printed(6));
    assert_near(fold.point.parameter, 1.369_036, printed(6));
    assert_near(fold.point.before_impact_velocity(), 16.87, printed(2));
    assert!(matches!(
        branch.ends,
        (BranchEnd::Grazing, BranchEnd::Grazing)
    ));
}

#[test]
fn the_other_side_of_the_same_grazing() {
    let branch = branch(1.15, 1, (-3.0, 0.5), (0.96, 2.0));
    assert!(matches!(
        branch.ends,
        (BranchEnd::Grazing, BranchEnd::Range)
    ));
    let graze = &branch.specials[0];
    let (_, above) = grazing_frequencies(&unloaded()).expect("a boundary");
    assert_near(graze.point.parameter, above, MOTION);
    match graze.kind {
        SpecialKind::Grazing(graze) => {
            assert!(
                !graze.dies && graze.impacts == 0 && graze.surface == SwitchingSurface::Clearance
            );
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(branch.points[branch.points.len() - 1].parameter, 2.0);
}

/// Rows 7, 11 and 12 of the paper's Table 1 are grazings of z = 1/10, (2/4)B and 2/3, with the digits of
/// an independent integrator.
#[test]
fn grazing_ends_the_subharmonic_motions() {
    let rows = [
        (0.95365, 10, TENTH, 0.953_802_5),
        (0.9875, 4, TWO_QUARTERS_B, 0.983_055_2),
        (0.9875, 3, TWO_THIRDS, 0.986_778_9),
    ];
    for (eta, n, state, expected) in rows {
        let branch = branch(eta, n, state, (0.9, 1.1));
        let grazings = of_kind(&branch, "G");
        let near =
            |special: &&SpecialPoint| is_near(special.point.parameter, expected, 10.0 * GROWN);
        assert!(
            grazings.iter().any(|special| near(&special)),
            "{grazings:?}"
        );
    }
}

/// Rows 13, 16 and 17. The figures to check against were found by sweeps, which see a doubling only
/// when it has grown: they lie up to 2.5e-6 beyond the points at which a multiplier is -1.
#[test]
fn flips_of_the_subharmonic_motions() {
    let rows = [
        (0.9886, 2, HALF, 0.988_495_6),
        (0.9875, 4, TWO_QUARTERS_B, 0.992_706_3),
        (0.9875, 3, TWO_THIRDS, 1.005_452),
    ];
    for (eta, n, state, expected) in rows {
        let branch = branch(eta, n, state, (0.9, 1.1));
        let flips = of_kind(&branch, "PD");
        assert_eq!(flips.len(), 1);
        assert_near(flips[0].point.parameter, expected, 2.5e-6);
        let multiplier = flips[0].point.monodromy;
        assert_near(
            1.0 + multiplier.trace() + multiplier.determinant(),
            0.0,
            SOLVED,
        );
    }
}

/// The loaded machine touches the stop behind the strip at both ends; between them flip and fold.
#[test]
fn inner_surfaces_end_a_branch_too() {
    let family = ParameterFamily::new(loaded(), [Parameter::Frequency]).expect("a family");
    let orbit = softstop_dynamics::orbit::find(&loaded()).expect("z = 1");
    let branch = follow(&family, 1, (1.15, orbit.state()), (0.5, 2.0));
    assert_eq!(symbols(&branch), ["G", "PD", "SN", "G"]);
    for end in [&branch.specials[0], &branch.specials[3]] {
        match end.kind {
            SpecialKind::Grazing(graze) => {
                assert!(
                    graze.surface == SwitchingSurface::Stop && graze.dies && graze.impacts == 1
                );
            }
            other => panic!("{other:?}"),
        }
        let mut ratios = Ratios::loaded();
        ratios.frequency = end.point.parameter;
        let scene = ratios.scene().expect("a scene");
        let map = StroboscopicMap::new(&scene.check().expect("a map"), 1);
        let highest = map.max_position(end.point.state()).expect("a motion");
        assert_near(highest, scene.stop_position(), 10.0 * SOLVED);
    }
}

/// Begun at either end of its range, a branch ends there at once: no point lies beyond it or is told at another parameter
/// than its own.
#[test]
fn a_branch_from_an_end_of_its_range() {
    let whole = all_of_z1();
    let from = &whole.points[whole.points.len() / 2];
    let eta = from.parameter;
    for (low, high) in [(eta, 2.0), (0.5, eta)] {
        let found = branch(eta, 1, (from.position, from.velocity), (low, high));
        assert!(
            matches!(found.ends, (BranchEnd::Range, _) | (_, BranchEnd::Range)),
            "{:?}",
            found.ends
        );
        for point in &found.points {
            assert!((low..=high).contains(&point.parameter), "{point:?}");
            let machine = Ratios::unloaded().at_frequency(point.parameter);
            let map = StroboscopicMap::new(
                &machine.scene().expect("a scene").check().expect("valid"),
                1,
            );
            let image = map.image(point.state()).expect("a passage");
            assert_near(image, point.state(), SOLVED);
        }
    }
}

/// Both ways along the branch, and from another start on it, give the same points to 1e-10.
#[test]
fn start_and_direction_do_not_matter() {
    let one = all_of_z1();
    let at = &one.points[one.points.len() / 4];
    let other = branch(at.parameter, 1, (at.position, at.velocity), (0.5, 2.0));
    assert_eq!(one.specials.len(), other.specials.len());
    for (a, b) in one.specials.iter().zip(&other.specials) {
        assert_near(a.point.parameter, b.point.parameter, SOLVED);
    }
    let reached: Vec<_> = one
        .specials
        .iter()
        .map(|special| special.point.parameter)
        .collect();
    let mut flips = of_kind(&one, "PD");
    let flip = flips.remove(0).point;
    let back = branch(0.97, 1, (low_state(&one).x, low_state(&one).y), (0.5, 2.0));
    assert_near(
        of_kind(&back, "PD")[0].point.parameter,
        flip.parameter,
        SOLVED,
    );
    assert_near(of_kind(&back, "SN")[0].point.parameter, reached[2], SOLVED);
}

/// A state near the branch at eta = 0.97, unstable there.
fn low_state(branch: &Branch) -> Vector2<f64> {
    let off = |point: &&BranchPoint| (point.parameter - 0.97).abs();
    let nearest = branch
        .points
        .iter()
        .min_by(|a, b| off(a).total_cmp(&off(b)));
    nearest.expect("points").state()
}

#[test]
fn the_same_again() {
    let (one, other) = (all_of_z1(), all_of_z1());
    assert_eq!(one.points.len(), other.points.len());
    for (a, b) in one.points.iter().zip(&other.points) {
        assert_eq!((a.parameter, a.state()), (b.parameter, b.state()));
        assert_eq!((&a.impacts, a.monodromy), (&b.impacts, b.monodromy));
    }
}

/// Fold and flip by the map alone, without its exact Jacobian.
#[test]
fn finite_differences_confirm_fold_and_flip() {
    let branch = all_of_z1();
    for (symbol, sign) in [("SN", -1.0), ("PD", 1.0)] {
        let point = of_kind(&branch, symbol).remove(0).point;
        let mut ratios = Ratios::unloaded();
        ratios.frequency = point.parameter;
        let map =
            StroboscopicMap::new(&ratios.scene().expect("a scene").check().expect("valid"), 1);
        let matrix = differences(|state| map.image(state).expect("an image"), point.state());
        let test = 1.0 + sign * matrix.trace() + matrix.determinant();
        assert_near(test, 0.0, DIFFERENCED);
    }
}

/// Beside the fold there are two orbits or none, where the square root says.
#[test]
fn two_orbits_before_a_fold_and_none_beyond() {
    let branch = all_of_z1();
    let fold = of_kind(&branch, "SN").remove(0).point;
    let follower_family = frequencies(1.15);
    let continuation = Continuation::new(&follower_family, 1);
    let beside = |eta: f64, sign: f64, size: f64| {
        let m = fold.monodromy;
        let along = Vector2::new(m.m12, 1.0 - m.m11).normalize();
        continuation.find_point(eta, fold.state() + sign * size * along)
    };
    let eta = fold.parameter - 1e-6;
    let stable = [1.0, -1.0].map(|sign| beside(eta, sign, 0.02).expect("an orbit").is_stable());
    assert_eq!(stable.iter().filter(|stable| **stable).count(), 1);
    assert!(beside(fold.parameter + 1e-6, 1.0, 0.02).is_err());
}

/// Smaller steps lead to the same special points; settings with which nothing can be followed are refused by name.
#[test]
fn settings_change_the_points_of_a_branch_but_not_what_is_found_on_it() {
    let family = frequencies(0.95);
    let start = branch(0.95, 1, (0.0, 14.0), (0.9, 1.1)).points[0].clone();
    let with = |settings| Continuation::new(&family, 1).with_settings(settings);
    let limits = BranchLimits {
        range: (0.9, 1.1),
        points: 2000,
    };
    let found = |largest_step| {
        let settings = ContinuationSettings {
            largest_step,
            ..ContinuationSettings::default()
        };
        with(settings)
            .expect("valid")
            .branch(start.parameter, start.state(), &limits, go_on)
            .expect("a branch")
    };
    let (coarse, fine) = (found(0.25), found(0.01));
    assert!(fine.points.len() > 2 * coarse.points.len());
    assert_eq!(fine.specials.len(), coarse.specials.len());
    assert!(!fine.specials.is_empty());
    for (one, other) in fine.specials.iter().zip(&coarse.specials) {
        assert_near(one.point.parameter, other.point.parameter, SOLVED);
    }
    let refused = |settings| with(settings).err().map(|error| error.to_string());
    let usual = ContinuationSettings::default();
    for (wrong, named) in [
        (0.0, "0"),
        (-1.0, "-1"),
        (f64::NAN, "NaN"),
        (f64::INFINITY, "inf"),
    ] {
        let smallest_step = wrong;
        let expected = format!("smallest_step = {named}: must be finite and > 0");
        let settings = ContinuationSettings {
            smallest_step,
            ..usual
        };
        assert_eq!(refused(settings), Some(expected));
    }
    let step_growth = 1.0;
    assert!(
        refused(ContinuationSettings {
            step_growth,
            ..usual
        })
        .is_some()
    );
    let short = Continuation::new(&family, 1).with_steps(1e-6);
    let short = short.err().map(|error| error.to_string());
    let expected = "largest_step = 1e-6: must be at least crawling_step";
    assert_eq!(short.as_deref(), Some(expected));
}
