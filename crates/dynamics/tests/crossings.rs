//! What the orbits of a branch cross, counted on their motions: each change of it is a grazing that the branch tells.

use crate::branches;
use nalgebra::Vector2;
use softstop::internals::turning_points;
use softstop::{
    Below, CheckedScene, CrossingKind, Machine, Parameter, Release, Scene, Start, Stop,
};
use softstop_dynamics::continuation::{BranchEnd, SpecialKind, SwitchingSurface};
use softstop_dynamics::{Branch, BranchPoint, ParameterFamily};
use softstop_testing::scenes::{hertz, kelvin_voigt, piercing, preloaded, rigid_stop, slope};

/// Kinetic energy at a crossing, or distance of a turning point from a face, in units of the machines, which have them about 1,
/// below which rounding tells what an orbit crosses.
const KNOWN: f64 = 1e-12;

/// How often an orbit crosses each face; none where its start is not known well enough to tell.
fn crossings(scene: &CheckedScene, point: &BranchPoint, periods: u64) -> Option<Vec<usize>> {
    let motion = scene.trajectory(Start::new(point.position, point.velocity), periods);
    let motion = motion.expect("a motion");
    let drift = (Vector2::from(motion.end) - point.state()).norm();
    let faces = SwitchingSurface::ALL
        .into_iter()
        .filter_map(|face| face.surface_position(scene));
    let faces: Vec<f64> = faces.collect();
    let is_at = |position: f64, face: f64| (position - face).abs() < 1e-13;
    let met = motion.crossings().filter(|it| {
        let kinds = matches!(
            it.kind,
            CrossingKind::Surface { .. } | CrossingKind::Rebound { .. }
        );
        kinds && faces.iter().any(|face| is_at(it.position, *face))
    });
    let met: Vec<_> = met
        .map(|it| (it.position, 0.5 * it.velocity * it.velocity))
        .collect();
    let turns = motion.arc_views().flat_map(|(arc, elapsed)| {
        [true, false]
            .into_iter()
            .flat_map(move |back| turning_points(arc.course, elapsed, back))
    });
    let distances =
        turns.flat_map(|turn| faces.iter().map(move |face| (turn.position - face).abs()));
    let energies = met.iter().map(|it| it.1);
    let nearest = distances.chain(energies).fold(f64::INFINITY, f64::min);
    let is_known = drift < 1e-9 && nearest > KNOWN.max(10.0 * drift);
    let count = |face: &f64| met.iter().filter(|it| is_at(it.0, *face)).count();
    is_known.then(|| faces.iter().map(count).collect())
}

/// Fails where two neighbouring points of a branch cross something else and no grazing lies between them, and where what they
/// cross is known of less than half of the points.
#[track_caller]
fn each_change_is_told(machine: &Machine, parameter: Parameter, branch: &Branch) {
    let mut last = None;
    let mut is_told = true;
    let mut known = 0;
    for point in &branch.points {
        if let Some(special) = branch.special_at(point) {
            is_told |= matches!(special.kind, SpecialKind::Grazing(_));
            continue;
        }
        let mut machine = machine.clone();
        machine.set(parameter, point.parameter);
        let scene = machine.check(None).expect("a scene");
        let Some(now) = crossings(&scene, point, branch.periods) else {
            continue;
        };
        let is_same = last.as_ref().is_none_or(|last| *last == now);
        assert!(
            is_same || is_told,
            "{last:?} -> {now:?} at {}",
            point.parameter
        );
        (last, is_told) = (Some(now), false);
        known += 1;
    }
    let all = branch.points.len();
    assert!(2 * known > all, "{known} of {all}");
}

/// A machine at a clearance of 1 m from its stop, driven with an amplitude and a frequency.
fn machine(stop: Stop, damping: f64, (amplitude, frequency): (f64, f64)) -> Scene {
    let mut scene = Scene {
        damping,
        contact_damping: damping,
        clearance: 1.0,
        ..Scene::of_stop(stop)
    };
    (scene.excitation.amplitude, scene.excitation.frequency) = (amplitude, frequency);
    scene
}

/// That with a stop on the other side, so much farther off.
fn between(scene: Scene, apart: f64, stop: Stop) -> Scene {
    let clearance = scene.clearance + apart;
    Scene {
        below: Some(Box::new(Below { clearance, stop })),
        ..scene
    }
}

/// Follows the motion that a machine settles on, which repeats after some periods, to where it grazes, merges or leaves the range.
#[track_caller]
fn follow(scene: Scene, parameter: Parameter, periods: u64) {
    let settled = scene
        .trajectory(Start::new(0.0, 1.0), 300)
        .expect("a motion")
        .end;
    let machine = Machine::from(scene);
    let own = machine.value(parameter).expect("a value");
    let family = ParameterFamily::new(machine.clone(), [parameter]).expect("a family");
    let range = (0.85 * own, 1.3 * own);
    let branch = branches::follow(&family, periods, (own, settled), range, 1500);
    let branch = branch.expect("a branch");
    assert_eq!(branch.periods, periods);
    for end in [&branch.ends.0, &branch.ends.1] {
        let is_reached = matches!(
            end,
            BranchEnd::Range | BranchEnd::Grazing | BranchEnd::Merged
        );
        assert!(is_reached, "{end:?} at {own}");
    }
    each_change_is_told(&machine, parameter, &branch);
}

/// Stops on both sides at almost the same distance: touches of both come together.
#[test]
fn touches_of_stops_at_almost_one_distance_are_told() {
    let stop = preloaded(5.775, 0.2736);
    let scene = machine(stop.clone(), 0.2847, (0.2943, 1.0107));
    follow(between(scene, 1e-6, stop), Parameter::Frequency, 1);
    let (hard, lossy) = (
        Stop::Rigid { restitution: 0.8 },
        Stop::Rigid { restitution: 0.3 },
    );
    let scene = machine(hard.clone(), 0.1121, (0.5494, 0.712));
    follow(between(scene, 1e-4, lossy.clone()), Parameter::Amplitude, 1);
    let scene = machine(lossy.clone(), 0.1132, (0.802, 0.4642));
    follow(between(scene, 1e-8, lossy.clone()), Parameter::Amplitude, 1);
    let mut scene = machine(lossy, 0.1092, (4.4057, 2.2356));
    scene.contact_damping = 0.0;
    let soft = kelvin_voigt(0.5418, Release::ZeroForce);
    follow(between(scene, 1e-4, soft), Parameter::Frequency, 1);
    let mut scene = machine(
        kelvin_voigt(6.366, Release::ZeroForce),
        0.06172,
        (0.13586, 1.0317),
    );
    scene.contact_damping = 0.5;
    follow(between(scene, 1e-6, hard), Parameter::Frequency, 1);
}

/// Stops close behind one another: what comes up to the last one comes up to the first one right before.
#[test]
fn touches_of_stops_close_behind_one_another_are_told() {
    let loading = vec![slope(0.0, 5.346), slope(1e-6, 89.9)];
    let unloading = Vec::new();
    let mut scene = machine(
        Stop::PiecewiseLinear { loading, unloading },
        0.2232,
        (0.2891, 0.9133),
    );
    scene.rigid = Some(rigid_stop(1e-4, 0.3));
    follow(scene, Parameter::Frequency, 2);
    let mut scene = machine(hertz(1.0, 1.5, 0.1), 0.2108, (2.1193, 1.5411));
    scene.piercing = Some(piercing(11.1, 8.284, 1e-4, 0.01));
    scene.rigid = Some(rigid_stop(1e-6, 0.8));
    follow(scene, Parameter::Frequency, 1);
    let mut scene = machine(
        kelvin_voigt(0.7417, Release::ZeroForce),
        0.03369,
        (2.7912, 1.8806),
    );
    scene.contact_damping = 0.0;
    scene.piercing = Some(piercing(17.52, 3.108, 0.1, 0.01));
    scene.rigid = Some(rigid_stop(1e-6, 0.8));
    follow(scene, Parameter::Frequency, 1);
}

/// What lies on the last step of a branch, before it merges into another one, is told, too.
#[test]
fn touches_right_before_a_merging_are_told() {
    let mut scene = machine(
        hertz(35.668_714, 1.5, 0.1),
        0.105_622_8,
        (1.050_762_8, 0.549_454),
    );
    scene.contact_damping = 0.5;
    follow(scene, Parameter::Amplitude, 4);
}
