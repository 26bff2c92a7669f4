//! Derivatives of periodic motions and of their borders, against the motions and borders of machines beside.

use nalgebra::Vector2;
use proptest::prelude::*;
use softstop::{Clock, Parameter, Ratios, Scene, Start};
use softstop_dynamics::continuation::Test;
use softstop_dynamics::slopes::{self, Border, Figure, Slopes};
use softstop_dynamics::{Orbit, zone};
use softstop_testing::tolerance::{DIFFERENCED, SOLVED};
use softstop_testing::{Meets, cases, machines};

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
        let orbit = Orbit::periodic(scene, state, periods).ok()?;
        let near = (orbit.state() - state).norm() < 1e-3 * (1.0 + state.norm());
        (near && orbit.is_stable() && !orbit.impacts.is_empty()).then_some(orbit)
    })
}

fn figures(slopes: &Slopes) -> impl Iterator<Item = &Figure> {
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
    let mut scene = orbit.scene.clone();
    let value = parameter.get(&scene)? + shift;
    parameter.set(&mut scene, value);
    scene.validate().ok()?;
    let other = Orbit::periodic(&scene, orbit.state() + shift * along, orbit.periods).ok()?;
    let meets = Meets::until(
        &scene,
        Start::from(other.state()),
        Clock::at_cycle(orbit.periods),
    );
    if other.periods != orbit.periods || meets.crossings != kinds.crossings {
        return None;
    }
    let slopes = slopes::of(&other, &[]).ok()?;
    Some(figures(&slopes).map(|figure| figure.value).collect())
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
            let Ok(slopes) = slopes::of(&orbit, &[parameter]) else { continue };
            prop_assert!((slopes.max_position.value - orbit.max_position).abs() < SOLVED * (1.0 + orbit.max_position.abs()));
            let along = Vector2::new(slopes.position.by[0], slopes.velocity.by[0]);
            let width = WIDTH * parameter.get(&scene).expect("it has").abs().max(0.05);
            let central = |width: f64| -> Option<Vec<f64>> {
                let [high, low] = [width, -width].map(|shift| beside(&orbit, parameter, shift, along, &meets));
                let pairs = high?.into_iter().zip(low?);
                Some(pairs.map(|(high, low)| (high - low) / (2.0 * width)).collect())
            };
            let (Some(far), Some(wide), Some(narrow)) = (central(3.0 * width), central(2.0 * width), central(width)) else {
                continue
            };
            let exact: Vec<f64> = figures(&slopes).map(|figure| figure.by[0]).collect();
            let size: f64 = 1.0 + exact.iter().map(|part| part.abs()).fold(0.0, f64::max);
            for (index, exact) in exact.iter().enumerate() {
                let fourth = (4.0 * narrow[index] - wide[index]) / 3.0;
                let sixth = 1.5 * narrow[index] - 0.6 * wide[index] + 0.1 * far[index];
                let (off, error) = ((sixth - exact).abs() / size, (sixth - fourth).abs() / size);
                if error < 1e-4 {
                    prop_assert!(off <= DIFFERENCED + error, "{parameter:?} {index}: {sixth} {exact} {error:e} {:?}", meets.crossings);
                }
            }
        }
    }
}

/// The paper's machines and one with a spherical stop.
fn zones() -> Vec<Scene> {
    [Ratios::unloaded(), Ratios::loaded()]
        .map(|ratios| ratios.scene().expect("valid"))
        .to_vec()
}

#[test]
fn normals_are_those_of_zones_computed_anew() {
    for scene in zones() {
        let parameters: Vec<Parameter> = Parameter::ALL
            .into_iter()
            .filter(|parameter| parameter.get(&scene).is_some())
            .collect();
        let of = |scene: &Scene| zone::hysteresis(scene).expect("a zone");
        let zone = of(&scene);
        let fold =
            Border::critical(&scene, 1, (Test::Fold, &zone.fold), &parameters).expect("smooth");
        let free = Border::free(&scene, true, &parameters).expect("grazes");
        for (index, parameter) in parameters.into_iter().enumerate() {
            if matches!(parameter, Parameter::Frequency | Parameter::Phase) {
                continue;
            }
            let value = parameter.get(&scene).expect("it has");
            let width = 1e-4 * value.abs().max(0.05);
            let frequencies = |shift: f64| {
                let mut scene = scene.clone();
                parameter.set(&mut scene, value + shift);
                let zone = of(&scene);
                [zone.frequency_sn, zone.frequency_g0]
            };
            let [ahead, behind, farther, back] =
                [1.0, -1.0, 2.0, -2.0].map(|shift| frequencies(shift * width));
            for (which, border) in [&fold, &free].into_iter().enumerate() {
                let [narrow, wide] = [
                    (ahead[which] - behind[which]) / (2.0 * width),
                    (farther[which] - back[which]) / (4.0 * width),
                ];
                let found = (4.0 * narrow - wide) / 3.0;
                assert!(
                    (found + border.normal[index]).abs() < DIFFERENCED * (1.0 + found.abs()),
                    "{parameter:?} {which}: {found} {}",
                    border.normal[index]
                );
            }
        }
    }
}
