//! What holds for every polynomial force: it does not matter how it is written, set anew or how the run is
//! divided; energies balance; the order of interpolation is the one to be expected; nothing hangs.

mod exact;
mod refused;

use approx::{assert_relative_eq, relative_eq};
use proptest::prelude::*;
use softstop::internals::Polynomial;
use softstop::{
    AppliedForce, Clock, Excitation, HIGHEST_ORDER, MotionError, PhaseKind, Ratios, Scene,
    Simulation, Start, Stop,
};
use softstop_testing::tolerance::MOTION;
use softstop_testing::{cases, hertz, is_near, loaded, machines, start_below};

const SEVENTH: [f64; 8] = [0.2, -0.1, 0.15, -0.02, -0.03, 0.02, -0.006, 0.0008];

/// A machine whose force is set at the start.
fn pushed(scene: &Scene, start: Start, force: &[f64]) -> Simulation {
    let mut machine = Simulation::new(scene, start).expect("valid");
    machine.set_force(force).expect("finite");
    machine
}

/// A lone mass before a stop: neither spring nor damper nor drive.
fn bare(stop: Stop) -> Scene {
    Scene {
        stiffness: 0.0,
        damping: 0.0,
        contact_damping: 0.0,
        clearance: 1.0,
        excitation: Excitation {
            amplitude: 0.0,
            frequency: 1e-3,
            phase: 0.0,
        },
        piercing: None,
        rigid: None,
        stop,
        ..Ratios::unloaded().scene().expect("valid")
    }
}

const AT_REST: Start = Start::new(0.0, 0.0);

#[test]
fn a_polynomial_that_is_a_ramp_is_the_ramp() {
    for ratios in [Ratios::unloaded(), Ratios::loaded()] {
        let scene = ratios.scene().expect("valid");
        let start = Start::new(3.0, 11.0);
        let ramp = [0.3, 0.02];
        let mut closed = pushed(&scene, start, &ramp);
        let mut stepped = pushed(&scene, start, &[0.3, 0.02, 0.0, 0.0, 0.0, 0.0, 0.0, 1e-290]);
        for period in 1..=10 {
            let time = f64::from(period) * scene.period();
            closed.advance(time).expect("bounded");
            stepped.advance(time).expect("bounded");
            let (a, b) = (closed.sample(), stepped.sample());
            assert!(
                relative_eq!(
                    a.position,
                    b.position,
                    epsilon = 10.0 * MOTION,
                    max_relative = 10.0 * MOTION
                ),
                "{period}: {a:?} {b:?}"
            );
            assert!(
                relative_eq!(
                    a.velocity,
                    b.velocity,
                    epsilon = 10.0 * MOTION,
                    max_relative = 10.0 * MOTION
                ),
                "{period}: {a:?} {b:?}"
            );
            assert_eq!(closed.impact_count(), stepped.impact_count());
        }
        assert!(closed.impact_count() > 5);
    }
}

#[test]
fn a_kept_trajectory_is_the_run_under_the_same_forces() {
    let rigid = Stop::Rigid { restitution: 0.6 };
    for stop in [loaded().stop, hertz(50.0, 1.5, 0.1), rigid] {
        let scene = Scene { stop, ..loaded() };
        let start = Start::new(3.0, 11.0);
        let force = |index: u32| AppliedForce {
            from: 1.7 * f64::from(index),
            derivatives: SEVENTH[..1 + index as usize % 8].to_vec(),
        };
        let forces: Vec<AppliedForce> = (0..30).map(force).collect();
        let end = Clock::at_cycle(8);
        let kept = scene.trajectory_with_forces(start, end, &forces, &mut ());
        let kept = kept.expect("bounded");
        let mut run = Simulation::new(&scene, start).expect("valid");
        let until = kept.clock.time(end);
        for force in forces.iter().filter(|force| force.from < until) {
            run.advance(force.from).expect("bounded");
            let state = kept.at(kept.clock.instant(force.from)).expect("within");
            let sample = run.sample();
            assert_relative_eq!(state.position, sample.position, epsilon = MOTION);
            assert_relative_eq!(state.velocity, sample.velocity, epsilon = MOTION);
            run.set_force(&force.derivatives).expect("finite");
        }
        run.advance(until).expect("bounded");
        let sample = run.sample();
        assert_relative_eq!(kept.end.position, sample.position, epsilon = MOTION);
        assert_relative_eq!(kept.end.velocity, sample.velocity, epsilon = MOTION);
        assert_eq!(kept.impacts().count() as u64, run.impact_count());
        assert!(run.impact_count() > 1);
        assert!(kept.energy_defect().abs() < 1e-11 * kept.work().dissipated);
    }
}

#[test]
fn forces_of_a_kept_trajectory_come_in_order() {
    let force = |from| AppliedForce {
        from,
        derivatives: vec![1.0],
    };
    for times in [[2.0, 1.0], [-1.0, 1.0], [f64::NAN, 1.0]] {
        let forces = times.map(force);
        let kept = loaded().trajectory_with_forces(AT_REST, Clock::at_cycle(2), &forces, &mut ());
        assert!(matches!(kept, Err(MotionError::TimeBackwards { .. })));
    }
}

#[test]
fn setting_what_holds_anyway_changes_nothing() {
    let scene = loaded();
    let start = Start::new(3.0, 11.0);
    let force = Polynomial::new(SEVENTH);
    let mut once = pushed(&scene, start, &SEVENTH);
    let mut again = once.clone();
    for step in 1..=500 {
        let time = 0.017 * f64::from(step);
        again.advance(time).expect("bounded");
        again
            .set_force(force.shifted(time).derivatives())
            .expect("finite");
    }
    once.advance(8.5).expect("bounded");
    again.advance(8.5).expect("bounded");
    let (a, b) = (once.sample(), again.sample());
    assert!(once.impact_count() > 0);
    assert_relative_eq!(
        a.position,
        b.position,
        epsilon = MOTION,
        max_relative = MOTION
    );
    assert_relative_eq!(
        a.velocity,
        b.velocity,
        epsilon = MOTION,
        max_relative = MOTION
    );
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn energies_balance_and_division_does_not_matter(
        scene in machines(),
        depth in 0.0..3.0f64,
        velocity in -3.0..6.0f64,
        force in prop::array::uniform8(-1.0..1.0f64),
        degree in 2..8usize,
    ) {
        let mut force = force;
        for (order, derivative) in force.iter_mut().enumerate() {
            *derivative = if order > degree { 0.0 } else { *derivative };
        }
        let start = start_below(&scene, depth, velocity);
        let mut machine = Simulation::new(&scene, start).expect("valid");
        let before = machine.energy().mechanical;
        machine.set_force(&force).expect("finite");
        let mut whole = machine.clone();
        for step in 1..=200 {
            machine.advance(1e-4 * f64::from(step * step)).expect("bounded");
            let _ = (machine.sample(), machine.energy());
        }
        whole.advance(4.0).expect("bounded");
        prop_assert_eq!(whole.sample(), machine.sample());
        prop_assert_eq!(whole.last_impact(), machine.last_impact());
        let energy = machine.energy();
        prop_assert_eq!(whole.energy(), energy);
        let defect = energy.supplied - energy.dissipated - (energy.mechanical - before);
        let turnover = energy.supplied.abs() + energy.dissipated + energy.mechanical.abs();
        assert!(is_near(defect, 0.0, 10.0 * MOTION * turnover.max(1.0)), "{:e} of {:e}", defect, turnover);
    }
}
