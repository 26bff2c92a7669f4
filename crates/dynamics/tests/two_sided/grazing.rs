//! Symmetric orbits that touch both of two stops that are alike.

use super::*;
use softstop_dynamics::Branch;
use softstop_dynamics::continuation::{
    BranchPoint, ContinuationSettings, CurveLimits, GrazingTouch, SpecialPoint, SwitchingSurface,
    follow_special,
};
use softstop_dynamics::orbit::OrbitError;
use softstop_testing::kelvin_voigt;

/// The branch of the motion on which a machine settles from rest in the middle, over frequencies.
fn branch(scene: &Scene, range: (f64, f64)) -> Branch {
    let settled = scene.trajectory(Start::new(0.0, 1.0), 400);
    let state = settled.expect("a motion").end;
    let family = ParameterFamily::new(scene.clone(), [Parameter::Frequency]).expect("a parameter");
    let from = (scene.excitation.frequency, state);
    branches::follow(&family, 1, from, range, 4000).expect("a branch")
}

/// The grazings of both stops on a branch.
fn of_both(branch: &Branch) -> Vec<(GrazingTouch, &BranchPoint)> {
    let grazes = branch
        .specials
        .iter()
        .filter_map(|special| match special.kind {
            SpecialKind::Grazing(graze) if graze.is_symmetric => Some((graze, &special.point)),
            _ => None,
        });
    grazes.collect()
}

/// Where both impacts die the motion is free, and its amplitude is the clearance: |k - m w^2 + i b w| = F / d. Soft stops let
/// the branch go on from there.
#[test]
fn both_impacts_die_where_the_free_motion_reaches_both_stops() {
    let stops = [
        (Stop::Rigid { restitution: 0.8 }, false),
        (
            Stop::Preloaded {
                stiffness: 20.0,
                preload: 5.0,
            },
            false,
        ),
        (
            Stop::KelvinVoigt {
                stiffness: 20.0,
                release: Release::Clearance,
            },
            true,
        ),
    ];
    for (stop, goes_on) in stops {
        let mut scene = machine(1.0, 0.1, 1.2, 0.8);
        scene.excitation.amplitude = 0.25;
        scene.contact_damping = 0.5;
        scene.below.as_mut().expect("a stop below").stop = stop.clone();
        scene.stop = stop;
        let half = 1.0 - 0.5 * scene.damping * scene.damping;
        let apart = (half * half - 0.75).sqrt();
        let branch = branch(&scene, (0.5, 4.0));
        let found = of_both(&branch);
        assert_eq!(found.len(), 2, "{:?} {:?}", scene.stop, branch.ends);
        for ((graze, point), square) in found.into_iter().zip([half - apart, half + apart]) {
            assert_near(point.parameter, square.sqrt(), 1e-10);
            assert_eq!((graze.dies, graze.impacts), (true, 0), "{:?}", scene.stop);
        }
        let grazes = matches!(branch.ends, (BranchEnd::Grazing, BranchEnd::Grazing));
        assert_ne!(grazes, goes_on, "{:?}", branch.ends);
        assert_eq!(
            matches!(branch.ends, (BranchEnd::Range, BranchEnd::Range)),
            goes_on
        );
    }
}

/// Where soft stops are nearly alike, the orbit meets one right after the other: both touches are found, each by itself, however
/// little lies between them.
#[test]
fn touches_of_stops_that_are_nearly_alike_are_told_apart() {
    for (apart, release) in [
        (1e-4, Release::Clearance),
        (1e-8, Release::Clearance),
        (-1e-8, Release::Clearance),
        (1e-12, Release::Clearance),
        (-1e-8, Release::ZeroForce),
        (1e-12, Release::ZeroForce),
    ] {
        let mut scene = machine(1.0, 0.1, 1.1, 0.8);
        let stiffness = 50.0;
        scene.stop = Stop::KelvinVoigt { stiffness, release };
        (scene.clearance, scene.contact_damping) = (1.0, 0.1);
        let (clearance, stop) = (1.0 + apart, scene.stop.clone());
        scene.below = Some(Box::new(Below { clearance, stop }));
        let settled = scene.trajectory(Start::new(0.0, 1.0), 400);
        let state = settled.expect("a motion").end;
        let family = ParameterFamily::new(scene, [Parameter::Amplitude]).expect("a parameter");
        let branch = branches::follow(&family, 1, (1.0, state), (0.01, 1.3), 4000);
        let specials = branch.expect("a branch").specials.into_iter();
        let grazes = specials.filter_map(|special| match special.kind {
            SpecialKind::Grazing(graze) => Some((graze.surface, special.point.parameter)),
            _ => None,
        });
        let mut faces: Vec<SwitchingSurface> = Vec::new();
        for (face, parameter) in grazes {
            // |k - m w^2 + i b w| times the clearance.
            assert_near(parameter, 0.21f64.hypot(0.11), 10.0 * apart.abs() + 1e-10);
            faces.push(face);
        }
        faces.sort_by_key(|face| *face == SwitchingSurface::Below);
        assert_eq!(
            faces,
            [SwitchingSurface::Clearance, SwitchingSurface::Below],
            "{apart} {release:?}"
        );
    }
}

/// The branch of the motion between two stops along the clearance of that above, from where it presses on this one to where it no
/// longer does, and the amplitude of the free motion. The stop below is nearer than that by a share.
fn along_clearance(frequency: f64, stop: Stop, nearer: f64) -> (Branch, f64) {
    let mut scene = machine(1.0, 0.1, frequency, 0.8);
    let spring = 1.0 - frequency * frequency;
    let amplitude = scene.excitation.amplitude / spring.hypot(0.1 * frequency);
    (scene.clearance, scene.contact_damping) = (0.98 * amplitude, 0.1);
    let clearance = amplitude * (1.0 - nearer);
    scene.below = Some(Box::new(Below {
        clearance,
        stop: stop.clone(),
    }));
    scene.stop = stop;
    let (start, settled) = (scene.clearance, scene.trajectory(Start::new(0.0, 1.0), 400));
    let family = ParameterFamily::new(scene, [Parameter::Clearance]).expect("a parameter");
    let (state, range) = (settled.expect("a motion").end, (start, 1.1 * amplitude));
    let branch = branches::follow(&family, 1, (start, state), range, 4000);
    (branch.expect("a branch"), amplitude)
}

/// The faces that are grazed on a branch, whether a crossing dies there, and the parameter.
fn touches(branch: &Branch) -> Vec<(SwitchingSurface, bool, f64)> {
    let touch = |special: &SpecialPoint| match special.kind {
        SpecialKind::Grazing(graze) => Some((graze.surface, graze.dies, special.point.parameter)),
        _ => None,
    };
    branch.specials.iter().filter_map(touch).collect()
}

/// The orbit leaves the stop below, comes back to it as it presses less and less on that above, and leaves this one where the
/// free motion just reaches it: on one step, after which it crosses one face less often and the other more often.
#[test]
fn touches_that_come_and_go_on_one_step_are_told_each() {
    for nearer in [1e-6, 1e-9] {
        let stop = kelvin_voigt(1.0, Release::Clearance);
        let (branch, amplitude) = along_clearance(0.5, stop, nearer);
        let [left, back, free] = touches(&branch)[..] else {
            panic!("{:?}", touches(&branch));
        };
        let kinds = [left, back, free].map(|(face, dies, _)| (face, dies));
        let (below, above) = (SwitchingSurface::Below, SwitchingSurface::Clearance);
        assert_eq!(kinds, [(below, true), (below, false), (above, true)]);
        assert!(left.2 < back.2 && back.2 < free.2);
        assert_near(free.2, amplitude, 0.1 * nearer);
    }
}

/// Where the free motion just reaches the stop above it would be beyond the one below: no orbit touches as it does, and the
/// branch ends before, in the touch of the stop below.
#[test]
fn what_would_cross_another_stop_does_not_graze() {
    for (preload, nearer) in [(1e-3, 1e-6), (1e-2, 1e-4)] {
        let stiffness = 0.2;
        let stop = Stop::Preloaded { stiffness, preload };
        let (branch, amplitude) = along_clearance(0.3, stop, nearer);
        assert!(
            matches!(branch.ends.1, BranchEnd::Grazing),
            "{:?}",
            branch.ends
        );
        let touches = touches(&branch);
        let [(SwitchingSurface::Below, false, parameter)] = touches[..] else {
            panic!("{touches:?}");
        };
        assert!(parameter < amplitude);
    }
}

/// Where both turning points rise to the stops the orbit still has the closed form: on its way from the stop above it comes back
/// up to that stop, and no farther.
#[test]
fn both_turning_points_arrive_where_the_closed_form_comes_back_up_to_the_stop() {
    let scene = machine(1.0, 0.04, 1.8, 0.8);
    let branch = branch(&scene, (0.3, 4.0));
    assert!(matches!(
        branch.ends,
        (BranchEnd::Grazing, BranchEnd::Range)
    ));
    let found = of_both(&branch);
    let [(graze, point)] = found[..] else {
        panic!("{found:?}");
    };
    assert_eq!((graze.dies, graze.impacts), (false, 2));
    let at = scene.at_frequency(point.parameter);
    let exact = Symmetric::of(&at, true);
    assert_near(point.impacts[0], exact.velocity, 1e-9);
    let w = at.excitation.frequency;
    let response = 1.0 / Complex::new(at.stiffness - at.mass * w * w, at.damping * w);
    let position = |share: f64| {
        let free = transition(at.damping, at.stiffness, share * PI / w) * exact.free;
        free.x + (response * Complex::from_polar(1.0, exact.angle + share * PI)).re
    };
    // Down from the stop, up again, and down to the other: the highest of the turning points between.
    let shares: Vec<f64> = (200..=1000).map(|it| f64::from(it) * 1e-3).collect();
    let highest = shares
        .into_iter()
        .max_by(|a, b| position(*a).total_cmp(&position(*b)));
    let (mut low, mut high) = highest.map(|it| (it - 1e-3, it + 1e-3)).expect("shares");
    for _ in 0..60 {
        let (a, b) = ((2.0 * low + high) / 3.0, (low + 2.0 * high) / 3.0);
        match position(a) < position(b) {
            true => low = a,
            false => high = b,
        }
    }
    assert_near(position(low), at.clearance, 1e-11);
}

/// Where the stops cease to be alike no orbit touches both: a curve follows both by what leaves them alike alone.
#[test]
fn curves_of_both_touches_stay_with_stops_that_are_alike() {
    let scene = machine(1.0, 0.04, 1.8, 0.8);
    let branch = branch(&scene, (0.3, 4.0));
    let [(graze, point)] = of_both(&branch)[..] else {
        panic!("a grazing of both");
    };
    let curve = |second: Parameter, value: f64, range: (f64, f64)| {
        let plane = [Parameter::Frequency, second];
        let family = ParameterFamily::new(scene.clone(), plane).expect("parameters");
        let region = CurveLimits {
            ranges: [(0.3, 4.0), range],
            points: 400,
            settings: ContinuationSettings::of_curves(0.05),
        };
        let kind = SpecialKind::Grazing(graze);
        let (orbit, from) = ((1, point.state()), [point.parameter, value]);
        follow_special(&family, orbit.0, (kind, orbit.1), from, &region, go_on)
    };
    let refused = curve(Parameter::Clearance, scene.clearance, (0.3, 0.8));
    assert!(matches!(refused, Err(OrbitError::NotAlike)), "{refused:?}");
    let amplitude = scene.excitation.amplitude;
    let scaled = curve(Parameter::Amplitude, amplitude, (0.5, 2.0)).expect("a curve");
    assert!(scaled.points.len() > 20);
    for point in &scaled.points {
        let [velocity, other] = point.impacts[..] else {
            panic!("{point:?}");
        };
        assert_near(velocity, other, 1e-9);
    }
}
