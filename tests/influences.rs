//! Derivatives of a motion by every parameter of its machine, across impacts, against differences of the motion itself.

use nalgebra::Vector3;
use proptest::prelude::*;
use softstop::internals::{ParameterSensitivity, PhaseDerivatives};
use softstop::{Below, Clock, CrossingKind, Parameter, Scene, Start, Stop};
use softstop_testing::tangent::differences_of;
use softstop_testing::tolerance::DIFFERENCED;
use softstop_testing::{Meets, cases, machines, start_below};

/// Share of a parameter, or of 1, over which differences are taken.
const WIDTH: f64 = 2e-4;

/// State and energy supplied after some drive periods, and what happened.
fn after(scene: &Scene, start: Start, periods: u64) -> Option<(Vector3<f64>, Vec<CrossingKind>)> {
    scene.validate().ok()?;
    let motion = scene.trajectory(start, periods).ok()?;
    let kinds = motion.crossings().map(|crossing| crossing.kind).collect();
    let Start { position, velocity } = motion.end;
    let supplied = motion.work().supplied;
    Some((Vector3::new(position, velocity, supplied), kinds))
}

/// The exact derivative of the same by a parameter.
fn exact(scene: &Scene, start: Start, periods: u64, parameter: Parameter) -> Option<Vector3<f64>> {
    let scene = scene.check().ok()?;
    let phases = scene.phases();
    let by = [PhaseDerivatives::new(parameter, &scene).ok()?];
    let mut influence = ParameterSensitivity::new(phases, &by);
    let mut motion = scene.motion(start).ok()?;
    motion
        .advance(Clock::at_cycle(periods), &mut influence)
        .ok()?;
    motion.tell_arc(&mut influence);
    let columns = influence.columns()?;
    let mut change = columns[2];
    if parameter == Parameter::Frequency {
        let w = scene.excitation.frequency;
        change -= columns[1] * (start.velocity / w);
        change.y += motion.state().velocity / w;
    }
    Some(change)
}

/// Differences, with an estimate of their error; none where the motion meets something else beside.
fn differences(
    scene: &Scene,
    start: Start,
    periods: u64,
    parameter: Parameter,
) -> Option<(Vector3<f64>, f64)> {
    let value = parameter.get(scene)?;
    let width = WIDTH * value.abs().max(0.05);
    let (_, kinds) = after(scene, start, periods)?;
    let beside = |shift: f64| {
        let mut scene = scene.clone();
        parameter.set(&mut scene, value + shift);
        let (end, others) = after(&scene, start, periods)?;
        (others == kinds).then(|| end.as_slice().to_vec())
    };
    let found = differences_of(beside, width)?;
    let error = Vector3::from_fn(|index, _| found[index].1).norm();
    Some((Vector3::from_fn(|index, _| found[index].0), error))
}

/// With some dissipation a stop may cease to press, without any it may not; the other stop has some.
#[test]
fn dissipation_of_one_of_two_stops_may_begin_at_zero() {
    let hertz = |dissipation: f64| Stop::Hertz {
        stiffness: 20.0,
        exponent: 1.5,
        dissipation,
    };
    let scene = |[above, below]: [f64; 2]| Scene {
        clearance: 0.5,
        below: Some(Box::new(Below {
            clearance: 0.5,
            stop: hertz(below),
        })),
        ..Scene::of_stop(hertz(above))
    };
    let start = Start::new(0.0, 1.0);
    let width = 1e-6;
    for (parameter, from, to) in [
        (Parameter::Dissipation, [0.0, 0.3], [width, 0.3]),
        (Parameter::BelowDissipation, [0.3, 0.0], [0.3, width]),
    ] {
        let [(before, kinds), (beside, others)] =
            [from, to].map(|of| after(&scene(of), start, 2).expect("bounded"));
        assert_eq!(kinds, others);
        let found = exact(&scene(from), start, 2, parameter).expect("derivatives");
        let difference = (beside - before) / width;
        let size = found.norm();
        assert!(size > 1e-3, "{parameter:?}: {found}");
        assert!(
            (difference - found).norm() < 1e-4 * size,
            "{found} {difference}"
        );
    }
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn influences_of_parameters_are_derivatives(
        scene in machines(),
        depth in -0.5..6.0f64,
        velocity in -6.0..6.0f64,
        periods in 1..3u64,
    ) {
        let scene = Scene { clearance: 0.3 * scene.clearance, ..scene };
        let start = start_below(&scene, depth, velocity);
        prop_assume!(scene.motion(start).is_ok());
        let meets = Meets::until(&scene, start, Clock::at_cycle(periods));
        prop_assume!(meets.slowest > 0.1 && meets.crossings.len() < 16);
        for parameter in Parameter::ALL {
            let Some((found, error)) = differences(&scene, start, periods, parameter) else { continue };
            let size = 1.0 + found.norm();
            if error > 1e-4 * size { continue }
            let Some(exact) = exact(&scene, start, periods, parameter) else { continue };
            let off = (found - exact).norm();
            prop_assert!(off <= DIFFERENCED * size + error, "{parameter:?}: {found} {exact} {error:e} {:?}", meets.crossings);
        }
    }
}
