//! What is kept of some drive periods says what a run of them says, at walls, at rest and up to the bound on its arcs.

use nalgebra::Vector2;
use proptest::prelude::*;
use softstop::{
    Clock, Crossing, CrossingKind, Instant, MotionError, Observer, PhaseKind, Ratios, Scene,
    Simulation, Start, Stop,
};
use softstop_dynamics::StroboscopicMap;
use softstop_testing::tolerance::MOTION;
use softstop_testing::{Meets, assert_near, cases, machines, start_below};

/// Drive periods of the random motions.
const PERIODS: u64 = 5;

fn rigid(restitution: f64) -> Scene {
    let mut scene = Scene {
        clearance: 0.2,
        ..Scene::of_stop(Stop::Rigid { restitution })
    };
    scene.excitation.frequency = 0.5;
    scene
}

/// What a run is told of its crossings.
#[derive(Default)]
struct Crossings(Vec<(Instant, CrossingKind)>);

impl Observer for Crossings {
    fn crossing(&mut self, crossing: &Crossing) {
        self.0.push((crossing.instant, crossing.kind));
    }
}

fn map(scene: &Scene, periods: u64) -> StroboscopicMap {
    StroboscopicMap::new(&scene.check().expect("a map"), periods)
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn states_after_each_period_are_those_of_a_run_that_ends_there(
        scene in machines(),
        depth in 0.0..6.0f64,
        velocity in -6.0..6.0f64,
    ) {
        let state = Vector2::from(start_below(&scene, depth, velocity));
        let (lowest, highest) = scene.reach();
        let kept = map(&scene, PERIODS).trajectory(state).expect("bounded");
        for periods in 0..=PERIODS {
            let after = kept.at_cycle(periods);
            let run = map(&scene, periods).image(state).expect("bounded");
            assert_near((after - run).norm(), 0.0, MOTION * (1.0 + run.norm()));
            prop_assert!((lowest..=highest).contains(&after.x), "{after}");
        }
        let end = Clock::at_cycle(PERIODS);
        let of_kept: Vec<_> = kept.crossings().map(|it| (it.instant, it.kind)).collect();
        let mut run = Crossings::default();
        scene.motion(state.into()).expect("valid").advance(end, &mut run).expect("bounded");
        prop_assert_eq!(of_kept, run.0);
        let whole = kept.up_to(Clock::at_cycle(PERIODS + 1));
        prop_assert_eq!((whole.end, whole.arcs.len()), (kept.end, kept.arcs.len()));
    }

    #[test]
    fn energies_of_a_kept_motion_are_those_of_a_simulation(
        scene in machines(),
        depth in 0.0..6.0f64,
        velocity in -6.0..6.0f64,
    ) {
        let start = start_below(&scene, depth, velocity);
        let kept = scene.trajectory(start, PERIODS).expect("bounded");
        let mut run = Simulation::new(&scene, start).expect("valid");
        let before = run.energy().mechanical;
        run.advance(kept.clock.time(Clock::at_cycle(PERIODS))).expect("bounded");
        let after = run.energy();
        let size = before.abs() + after.mechanical.abs() + after.supplied.abs() + after.dissipated;
        assert_near(kept.stored(), after.mechanical - before, MOTION * (1.0 + size));
        let work = kept.work();
        assert_near(work.supplied, after.supplied, MOTION * (1.0 + size));
        assert_near(work.dissipated, after.dissipated, MOTION * (1.0 + size));
    }
}

/// The mass comes to rest on the wall within each period: after complete chatter it is held until the drive pulls it off.
#[test]
fn a_period_that_begins_and_ends_at_rest_keeps_the_crossings_of_its_held_arcs() {
    let mut scene = rigid(0.3);
    scene.excitation.amplitude = 3.0;
    let mut held = 0;
    for phase in (0..24).map(|step| 0.27 * f64::from(step)) {
        scene.excitation.phase = phase;
        let settled = map(&scene, 40).image(Vector2::zeros()).expect("bounded");
        let kept = map(&scene, 2).trajectory(settled).expect("bounded");
        let kinds: Vec<_> = kept.crossings().map(|it| it.kind).collect();
        let met = Meets::until(&scene, settled.into(), Clock::at_cycle(2));
        assert_eq!(kinds, met.crossings, "at phase {phase}");
        let last = kept.arcs.last().expect("an arc");
        if last.kind == PhaseKind::Resting && last.start < Clock::at_cycle(2) {
            assert_eq!(kept.end, Start::new(scene.clearance, 0.0));
            assert_eq!(kept.at_cycle(2), kept.end.into(), "at phase {phase}");
            held += 1;
        }
    }
    assert!(held >= 3, "{held} of 24");
}

/// A motion of more arcs than are kept is an error that says where it stopped; its image and impacts are counted without.
#[test]
fn periods_with_too_many_arcs_are_refused_but_their_image_is_not() {
    let scene = Ratios::unloaded().scene().expect("valid");
    let long = map(&scene, 140_000);
    let start = Vector2::new(0.0, 14.0);
    let Err(MotionError::Endless { time, .. }) = long.trajectory(start) else {
        panic!("kept, or refused for another reason");
    };
    let periods = time / scene.period();
    assert!((60_000.0..140_000.0).contains(&periods), "{periods}");
    assert!(matches!(
        long.apply(start),
        Err(MotionError::Endless { .. })
    ));
    assert!(long.image(start).expect("bounded").norm() < 100.0);
}
