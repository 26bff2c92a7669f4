//! Derivatives of periodic motions, against the motions of machines beside.

use nalgebra::Vector2;
use proptest::prelude::*;
use softstop::{Clock, Parameter, Ratios, Scene, Start, Stop};
use softstop_dynamics::derivatives::{self, DifferentiatedFigure, OrbitDerivatives};
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::{Orbit, zone};
use softstop_testing::tangent::differences_of;
use softstop_testing::tolerance::{DIFFERENCED, SOLVED};
use softstop_testing::{Meets, assert_near, cases, hertz, machines};

/// Share of a parameter over which differences are taken.
const WIDTH: f64 = 2e-4;
/// Drive periods after which a motion has settled.
const SETTLED: u64 = 300;

/// A stable motion with impacts that a machine settles on.
fn settled(scene: &Scene, start: Start) -> Option<Orbit> {
    let mut motion = scene.motion(start).ok()?;
    motion.advance(Clock::at_cycle(SETTLED), &mut ()).ok()?;
    let state: Vector2<f64> = motion.state().into();
    (1..4).find_map(|periods| {
        let orbit = Orbit::find_periodic(scene, state, periods).ok()?;
        let near = (orbit.state() - state).norm() < 1e-3 * (1.0 + state.norm());
        (near && orbit.is_stable() && !orbit.impacts.is_empty()).then_some(orbit)
    })
}

fn figures(slopes: &OrbitDerivatives) -> impl Iterator<Item = &DifferentiatedFigure> {
    let strikes = slopes.impacts.iter();
    let strikes = strikes.flat_map(|strike| [&strike.time, &strike.velocity]);
    [
        &slopes.position,
        &slopes.velocity,
        &slopes.max_position,
        &slopes.min_position,
        &slopes.supplied,
    ]
    .into_iter()
    .chain(&slopes.peak_force)
    .chain(strikes)
}

/// The figures of the motion at another value of a parameter.
fn beside(
    orbit: &Orbit,
    parameter: Parameter,
    shift: f64,
    along: Vector2<f64>,
    kinds: &Meets,
) -> Option<Vec<f64>> {
    let mut scene = Scene::clone(&orbit.scene);
    let value = parameter.get(&scene)? + shift;
    parameter.set(&mut scene, value);
    scene.validate().ok()?;
    let other = Orbit::find_periodic(&scene, orbit.state() + shift * along, orbit.periods).ok()?;
    let meets = Meets::until(
        &scene,
        Start::from(other.state()),
        Clock::at_cycle(orbit.periods),
    );
    if other.periods != orbit.periods || meets.crossings != kinds.crossings {
        return None;
    }
    let slopes = derivatives::differentiate_orbit(&other, &[]).ok()?;
    let invariants = [other.monodromy.trace(), other.monodromy.determinant()];
    let figures = figures(&slopes).map(|figure| figure.value);
    Some(figures.chain(invariants).collect())
}

proptest! {
    #![proptest_config(cases(250))]

    #[test]
    fn slopes_of_periodic_motions_are_derivatives(
        scene in machines(),
        position in -2.0..2.0f64,
        velocity in -3.0..3.0f64,
    ) {
        let scene = Scene { clearance: 0.4 * scene.clearance, ..scene };
        let start = Start::new(scene.clearance.min(position), velocity);
        let Some(orbit) = settled(&scene, start) else { return Ok(()) };
        let meets = Meets::until(&scene, Start::from(orbit.state()), Clock::at_cycle(orbit.periods));
        let parameters: Vec<Parameter> = Parameter::ALL.into_iter().filter(|parameter| parameter.get(&scene).is_some()).collect();
        for parameter in parameters {
            let Ok(slopes) = derivatives::differentiate_orbit(&orbit, &[parameter]) else { continue };
            prop_assert!((slopes.max_position.value - orbit.max_position).abs() < SOLVED * (1.0 + orbit.max_position.abs()));
            let along = Vector2::new(slopes.position.by[0], slopes.velocity.by[0]);
            let width = WIDTH * parameter.get(&scene).expect("it has").abs().max(0.05);
            let beside = |shift: f64| beside(&orbit, parameter, shift, along, &meets);
            let Some(differences) = differences_of(beside, width) else { continue };
            let Ok(stability) = derivatives::differentiate_stability(&orbit, &[parameter]) else {
                continue;
            };
            let invariants = [&stability.trace, &stability.determinant];
            let exact = figures(&slopes).chain(invariants).map(|figure| figure.by[0]);
            let exact: Vec<f64> = exact.collect();
            let size: f64 = 1.0 + exact.iter().map(|part| part.abs()).fold(0.0, f64::max);
            for (index, (exact, (found, error))) in exact.iter().zip(differences).enumerate() {
                let (off, error) = ((found - exact).abs() / size, error / size);
                if error < 1e-4 {
                    prop_assert!(off <= DIFFERENCED + error, "{parameter:?} {index}: {found} {exact} {error:e} {:?}", meets.crossings);
                }
            }
        }
    }
}

/// No number is claimed where there is no derivative.
#[test]
fn where_there_is_no_derivative_none_is_told() {
    let scene = Ratios::unloaded().scene().expect("valid");
    let orbit = softstop_dynamics::orbit::find(&scene).expect("an orbit");
    let lacks =
        derivatives::differentiate_orbit(&orbit, &[Parameter::Exponent]).expect_err("has none");
    assert!(lacks.to_string().contains("stop.exponent"), "{lacks}");
    // At a fold the motion turns back.
    let zone = zone::hysteresis(&scene).expect("a zone");
    let fold = zone.orbit_of(&zone.high.point).expect("is there");
    let turned = derivatives::differentiate_orbit(&fold, &[Parameter::Clearance]);
    assert_eq!(turned, Err(OrbitError::NotIsolated));
    // A power law of exponent 1 is a spring, and becomes another law beside.
    let spring = hertz(7.0, 1.0, 0.0);
    let spring = Scene {
        stop: spring,
        ..scene.clone()
    };
    let orbit = softstop_dynamics::orbit::find(&spring).expect("an orbit");
    assert!(derivatives::differentiate_orbit(&orbit, &[Parameter::StopStiffness]).is_ok());
    let other =
        derivatives::differentiate_orbit(&orbit, &[Parameter::Exponent]).expect_err("another law");
    assert!(other.to_string().contains("no derivative"), "{other}");
}

/// A mass that chatters until it rests on a rigid stop forgets its start; what follows has all derivatives.
#[test]
fn after_chatter_derivatives_go_on() {
    let stop = Stop::Rigid { restitution: 0.5 };
    let mut scene = Scene {
        damping: 0.1,
        clearance: -0.4,
        ..Scene::of_stop(stop)
    };
    scene.excitation.frequency = 0.4;
    let orbit = settled(&scene, Start::new(-0.5, 0.0)).expect("settles");
    assert!(orbit.chatters());
    for parameter in [
        Parameter::Clearance,
        Parameter::Mass,
        Parameter::Frequency,
        Parameter::Restitution,
    ] {
        let slopes = derivatives::differentiate_orbit(&orbit, &[parameter]).expect("known");
        let along = Vector2::new(slopes.position.by[0], slopes.velocity.by[0]);
        let value = parameter.get(&scene).expect("it has");
        let supplied = |shift: f64| {
            let mut scene = scene.clone();
            parameter.set(&mut scene, value + shift);
            let orbit =
                Orbit::find_periodic(&scene, orbit.state() + shift * along, 1).expect("near");
            derivatives::differentiate_orbit(&orbit, &[])
                .expect("known")
                .supplied
                .value
        };
        let central = |width: f64| (supplied(width) - supplied(-width)) / (2.0 * width);
        let found = (4.0 * central(1e-4) - central(2e-4)) / 3.0;
        assert_near(found, slopes.supplied.by[0], DIFFERENCED);
    }
}
