//! What holds for every stop: the energy balance, independence of the way a run is divided,
//! Liouville's theorem, the derivative of the map, dimensional similarity.

use nalgebra::Vector2;
use proptest::prelude::*;
use softstop::{Clock, PhaseKind, Scene, Simulation, Start};
use softstop_dynamics::StroboscopicMap;
use softstop_testing::tangent::differences;
use softstop_testing::tolerance::{GROWN, MOTION, SOLVED};
use softstop_testing::{Meets, assert_near, cases, is_near, machines, start_below, units};

proptest! {
    #![proptest_config(cases(600))]

    #[test]
    fn energy_balances(scene in machines(), depth in 0.0..6.0f64, velocity in -6.0..6.0f64) {
        let trajectory = scene
            .trajectory(start_below(&scene, depth, velocity), 10)
            .expect("bounded");
        let scale = trajectory.work().supplied.abs() + trajectory.work().dissipated.abs() + 100.0;
        assert_near(trajectory.energy_defect(), 0.0, 10.0 * MOTION * scale);
        prop_assert!(trajectory.work().dissipated > -1e-11 * scale);
    }

    #[test]
    fn division_does_not_matter(
        scene in machines(),
        depth in 0.0..6.0f64,
        velocity in -6.0..6.0f64,
        steps in 2..500u32,
    ) {
        let start = start_below(&scene, depth, velocity);
        let end = 8.3 * scene.period();
        let mut whole = Simulation::new(&scene, start).expect("valid");
        whole.advance(end).expect("bounded");
        let mut divided = Simulation::new(&scene, start).expect("valid");
        for step in 1..steps {
            divided.advance(end * f64::from(step) / f64::from(steps)).expect("bounded");
            divided.sample();
        }
        divided.advance(end).expect("bounded");
        prop_assert_eq!(whole.sample(), divided.sample());
        prop_assert_eq!(whole.impact_count(), divided.impact_count());
        prop_assert_eq!(whole.pierce_count(), divided.pierce_count());
        prop_assert_eq!(whole.last_impact(), divided.last_impact());
    }

    /// Communication points may fall on crossings, or beside them by one rounding.
    #[test]
    fn advances_may_end_at_crossings(
        scene in machines(),
        depth in 0.0..6.0f64,
        velocity in -6.0..6.0f64,
    ) {
        let start = start_below(&scene, depth, velocity);
        let end = 3.7 * scene.period();
        let until = scene.motion(start).expect("valid").clock().instant(end);
        let trajectory = scene.trajectory_until(start, until).expect("bounded");
        let mut stopping = Simulation::new(&scene, start).expect("valid");
        for crossing in trajectory.crossings() {
            let at = trajectory.clock.time(crossing.instant);
            for time in [at.next_down(), at, at.next_up()] {
                if time > stopping.time() && time < end {
                    stopping.advance(time).expect("bounded");
                    stopping.sample();
                }
            }
        }
        stopping.advance(end).expect("bounded");
        let mut whole = Simulation::new(&scene, start).expect("valid");
        whole.advance(end).expect("bounded");
        prop_assert_eq!(whole.sample(), stopping.sample());
        prop_assert_eq!(whole.impact_count(), stopping.impact_count());
    }

    #[test]
    fn determinant_follows_liouville(
        scene in machines(),
        depth in 0.0..6.0f64,
        velocity in -6.0..6.0f64,
    ) {
        let start = start_below(&scene, depth, velocity);
        let meets = Meets::until(&scene, start, Clock::at_cycle(2));
        // A graze makes the entries of the product huge against its determinant.
        prop_assume!(!meets.held && meets.slowest > 0.03 && meets.crossings.len() < 40);
        let map = StroboscopicMap::new(&scene.check().expect("valid"), 2);
        let passage = map.apply(Vector2::new(start.position, start.velocity)).expect("bounded");
        let expected = (meets.contraction - passage.damping_integral).exp();
        let size = passage.monodromy.norm_squared();
        assert_near(passage.monodromy.determinant(), expected, 10.0 * MOTION * (1.0 + size));
    }

    #[test]
    fn tangent_is_the_derivative_of_the_map(
        scene in machines(),
        depth in 0.0..6.0f64,
        velocity in -6.0..6.0f64,
    ) {
        let start = start_below(&scene, depth, velocity);
        let meets = Meets::until(&scene, start, Clock::at_cycle(1));
        prop_assume!(meets.slowest > 0.3 && meets.crossings.len() < 20);
        let map = StroboscopicMap::new(&scene.check().expect("valid"), 1);
        let state = Vector2::new(start.position, start.velocity);
        let passage = map.apply(state).expect("bounded");
        let differences = differences(|state| map.image(state).expect("bounded"), state);
        let size = 1.0 + passage.monodromy.norm();
        for (found, exact) in differences.column_iter().zip(passage.monodromy.column_iter()) {
            assert!(is_near((found - exact).norm(), 0.0, 1e-5 * size * size), "{found} {exact}");
        }
    }

    #[test]
    fn dimensional_machines_move_alike(
        scene in machines(),
        depth in 0.5..3.0f64,
        velocity in -3.0..3.0f64,
        powers in (-4..4i32, -4..8i32, -6..6i32),
    ) {
        // Powers of four, so that nothing is rounded but d^n.
        let units = units(4f64.powi(powers.0), 4f64.powi(powers.1), 4f64.powi(powers.2));
        let start = start_below(&scene, depth, velocity);
        let plain = scene.trajectory(start, 1).expect("bounded");
        let other = scene.in_units(units).expect("valid");
        let speed = units.length() * units.frequency();
        let scaled = other
            .trajectory(
                Start::new(start.position * units.length(), start.velocity * speed),
                1,
            )
            .expect("bounded");
        prop_assert_eq!(plain.crossings().count(), scaled.crossings().count());
        assert_near(plain.end.position, scaled.end.position / units.length(), GROWN);
    }
}

/// A chatter that is looked into shows its bounces, ever smaller, and ends in rest.
#[test]
fn a_chatter_can_be_watched() {
    let scene = Scene {
        stop: softstop::Stop::Rigid { restitution: 0.6 },
        clearance: 0.0,
        ..softstop::Ratios {
            frequency: 0.3,
            ..softstop::Ratios::unloaded()
        }
        .scene()
        .expect("valid")
    };
    let start = Start::new(-1.0, 0.0);
    let trajectory = scene.trajectory(start, 2).expect("bounded");
    let chatter = trajectory
        .arcs
        .iter()
        .find(|arc| arc.kind == PhaseKind::Chatter)
        .expect("a chatter");
    assert!(chatter.duration > 0.0 && chatter.duration < 1e-6);
    let begin = trajectory.clock.time(chatter.start);
    let mut machine = Simulation::new(&scene, start).expect("valid");
    machine.advance(begin).expect("bounded");
    for k in 1..100 {
        machine
            .advance(begin + chatter.duration * f64::from(k) / 100.0)
            .expect("bounded");
        let sample = machine.sample();
        assert!(sample.position <= 0.0 && sample.position > -1e-14);
        assert!(sample.velocity.abs() < 1e-6);
    }
    machine.advance(begin + 2.0 * chatter.duration).expect("ok");
    assert_eq!(machine.sample().phase, PhaseKind::Resting);
}

/// A mass that is pressed onto a stop comes to rest on it, after a bounded number of impacts: on a preloaded one, with less than
/// its preload, by the contact's damper, on an elastic rigid one by the damper of the mass alone.
#[test]
fn endless_bounces_end_in_rest() {
    let unloaded = softstop::Ratios::unloaded().scene().expect("valid");
    let mut preloaded = Scene {
        clearance: 1.0,
        contact_damping: 4.0,
        ..unloaded.clone()
    };
    preloaded.excitation.amplitude = 0.2;
    let elastic = Scene {
        stop: softstop::Stop::Rigid { restitution: 1.0 },
        clearance: 1.0,
        damping: 2.0,
        ..unloaded
    };
    for (scene, time) in [(preloaded, 60.0), (elastic, 1000.0)] {
        let mut machine = Simulation::new(&scene, Start::new(0.0, 0.0)).expect("valid");
        machine.set_force(&[20.0, 0.0]).expect("finite");
        let before = machine.energy().mechanical;
        machine.advance(time).expect("bounded");
        let sample = machine.sample();
        assert_eq!(sample.phase, PhaseKind::Resting);
        assert_eq!((sample.position, sample.velocity), (1.0, 0.0));
        assert_near(sample.contact_force, 19.0, scene.excitation.amplitude);
        assert!(machine.impact_count() < 2_000_000);
        let energy = machine.energy();
        let defect = energy.supplied - energy.dissipated - (energy.mechanical - before);
        assert_near(defect, 0.0, 10.0 * SOLVED * energy.supplied);
    }
}

/// A motion that has bounced for long goes on as one that begins in its state: what counts as rest does
/// not depend on bounces of earlier strokes.
#[test]
fn rest_has_no_memory_of_earlier_strokes() {
    let mut scene = softstop::Ratios {
        frequency: 0.2,
        clearance: 0.0,
        ..softstop::Ratios::unloaded()
    }
    .scene()
    .expect("valid");
    scene.damping = 1.0;
    scene.excitation.phase = std::f64::consts::PI;
    let start = Start::new(-1.0, 0.0);
    let mut motion = scene.motion(start).expect("valid");
    motion
        .advance(Clock::at_cycle(400), &mut ())
        .expect("bounded");
    let mut fresh = scene.motion(motion.state()).expect("valid");
    let (mut late, mut early) = (Meets::default(), Meets::default());
    motion
        .advance(Clock::at_cycle(401), &mut late)
        .expect("bounded");
    fresh
        .advance(Clock::at_cycle(1), &mut early)
        .expect("bounded");
    assert!(early.crossings.len() > 100);
    assert_eq!(late.crossings, early.crossings);
    assert_eq!(motion.state(), fresh.state());
}

/// A plastic impact forgets the velocity but not the time of the hit: the tangent is that of the map.
#[test]
fn the_tangent_of_a_plastic_impact() {
    let scene = Scene {
        stop: softstop::Stop::Rigid { restitution: 0.0 },
        clearance: 0.5,
        ..softstop::Ratios::unloaded().scene().expect("valid")
    };
    let map = StroboscopicMap::new(&scene.check().expect("valid"), 1);
    let state = Vector2::new(-1.0, 0.0);
    let passage = map.apply(state).expect("bounded");
    assert_eq!(passage.impacts.len(), 1);
    let differences = differences(|state| map.image(state).expect("bounded"), state);
    for (found, exact) in differences
        .column_iter()
        .zip(passage.monodromy.column_iter())
    {
        assert!(found.norm() > 1e-2);
        assert!(
            is_near((found - exact).norm(), 0.0, 10.0 * GROWN),
            "{found} {exact}"
        );
    }
}
