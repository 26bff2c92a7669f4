//! Start values and scenes are the same thing, written in two ways.

use softstop::{Below, Ratios, Release, RigidStop, Scene, SceneError, Slope, Start, Stop};
use softstop_fmu::{NotServed, StartValues};
use softstop_testing::{hertz, kelvin_voigt, preloaded, rigid_stop, slope};

const START: Start = Start::new(4.5, -2.25);

fn scene(stop: Stop, rigid: Option<RigidStop>) -> Scene {
    let scene = Ratios::loaded().scene().expect("a valid sample");
    Scene {
        clearance: 7.25,
        stop,
        rigid,
        ..scene
    }
}

fn slopes(count: usize, stiffness: f64) -> Vec<Slope> {
    let slope = |index| slope(0.1 * f64::from(index), stiffness + f64::from(index));
    (0..u32::try_from(count).expect("a small count"))
        .map(slope)
        .collect()
}

fn yielding_stops() -> Vec<Stop> {
    vec![
        kelvin_voigt(3.0, Release::Clearance),
        kelvin_voigt(3.5, Release::ZeroForce),
        Stop::PiecewiseLinear {
            loading: slopes(1, 2.0),
            unloading: vec![],
        },
        Stop::PiecewiseLinear {
            loading: slopes(8, 5.0),
            unloading: slopes(3, 1.0),
        },
        hertz(40.0, 1.75, 0.3),
        preloaded(6.0, 11.0),
    ]
}

#[test]
fn every_stop_there_and_back() {
    let behind = rigid_stop(0.75, 0.25);
    let mut scenes = vec![
        scene(Stop::None, None),
        scene(Stop::Rigid { restitution: 0.0 }, None),
    ];
    for stop in yielding_stops() {
        scenes.push(scene(stop.clone(), None));
        scenes.push(scene(stop, Some(behind)));
    }
    for stop in yielding_stops()
        .into_iter()
        .chain([Stop::Rigid { restitution: 0.5 }])
    {
        let below = Below {
            clearance: -1.5,
            stop,
        };
        scenes.push(Scene {
            below: Some(below.into()),
            ..scene(Stop::Rigid { restitution: 0.0 }, None)
        });
    }
    for scene in scenes {
        for piercing in [None, scene.piercing] {
            let scene = Scene {
                piercing,
                ..scene.clone()
            };
            let values = StartValues::from_scene(&scene, START).expect("a scene it serves");
            assert_eq!(values.scene(), scene);
            assert_eq!(values.start(), START);
        }
    }
}

#[test]
fn default_is_the_loaded_machine() {
    let sample = softstop::internals::samples::LOADED;
    let start = Start::new(sample.position, sample.velocity);
    let behind = rigid_stop(5.0, 0.6);
    let scene = Scene {
        rigid: Some(behind),
        ..sample.ratios.scene().expect("a valid sample")
    };
    assert_eq!(
        StartValues::from_scene(&scene, start).expect("a scene it serves"),
        StartValues::DEFAULT
    );
}

#[test]
fn a_rigid_stop_out_of_reach_is_left_out() {
    let behind = rigid_stop(0.75, 0.25);
    let rigid = Stop::Rigid { restitution: 0.5 };
    let values = StartValues::from_scene(&scene(rigid.clone(), Some(behind)), START);
    assert_eq!(values.expect("served").scene(), scene(rigid, None));
}

#[test]
fn scenes_without_parameters_for_them() {
    let too_many = |loading, unloading| scene(Stop::PiecewiseLinear { loading, unloading }, None);
    for (scene, list) in [
        (too_many(slopes(9, 5.0), vec![]), "stop.loading: 9 slopes"),
        (
            too_many(slopes(1, 9.0), slopes(9, 0.0)),
            "stop.unloading: 9 slopes",
        ),
    ] {
        let error = StartValues::from_scene(&scene, START).expect_err("too many slopes");
        assert!(error.to_string().contains(list), "{error}");
    }
    let behind = rigid_stop(0.75, 0.25);
    let error = StartValues::from_scene(&scene(Stop::None, Some(behind)), START);
    assert_eq!(error, Err(NotServed::NothingInFront));
    let empty = too_many(vec![], vec![]);
    let error = StartValues::from_scene(&empty, START);
    assert_eq!(error, Err(NotServed::Scene(SceneError::NoSlope)));
    let rigid = scene(Stop::Rigid { restitution: 0.5 }, None);
    let beyond = Start::new(2.0 * rigid.clearance, 0.0);
    let error = StartValues::from_scene(&rigid, beyond).expect_err("beyond the stop");
    assert!(
        error.to_string().starts_with("initial.position = "),
        "{error}"
    );
}
