//! What holds for the paper's machines over long runs, and where forces are in balance; what holds for every stop is in
//! `stop_invariants`.

use softstop::{InitialConditions, PhaseKind, Ratios, Simulation, Start};
use softstop_testing::tolerance::{MOTION, ROUNDING, SOLVED};
use softstop_testing::{assert_near, is_near, loaded};

#[test]
fn two_hundred_periods_do_not_depend_on_the_division() {
    for ratios in [Ratios::unloaded(), Ratios::loaded()] {
        let scene = ratios.scene().expect("valid");
        for start in [
            (0.0, 14.0),
            (-3.0, 2.0),
            (9.9, 6.0),
            (12.0, -3.0),
            (-20.0, 0.0),
        ] {
            let start = Start::new(start.0, start.1);
            let end = 200.0 * scene.period();
            let mut whole = Simulation::new(&scene, start).expect("valid");
            whole.advance(end).expect("bounded");
            let mut divided = Simulation::new(&scene, start).expect("valid");
            for step in 1..=200_000u32 {
                divided
                    .advance(end * f64::from(step) / 200_000.0)
                    .expect("bounded");
            }
            assert_eq!(whole.impact_count(), divided.impact_count());
            assert_eq!(whole.sample(), divided.sample(), "bit for bit");
            assert_eq!(whole.last_impact(), divided.last_impact());
        }
    }
}

#[test]
fn energy_balances_over_a_thousand_periods() {
    for ratios in [Ratios::unloaded(), Ratios::loaded()] {
        let scene = ratios.scene().expect("valid");
        let start = Start::new(0.0, 14.0);
        let trajectory = scene.trajectory(start, 1000).expect("bounded");
        let relative = trajectory.energy_defect() / trajectory.work().supplied;
        assert_near(relative, 0.0, 10.0 * MOTION);
        assert!(trajectory.work().dissipated > 10_000.0);
    }
}

#[test]
fn energy_balances_in_a_running_machine_that_is_pushed_and_tuned() {
    let mut scene = loaded();
    let mut machine = Simulation::new(&scene, Start::new(0.0, 14.0)).expect("valid");
    let before = machine.energy().mechanical;
    for step in 1..=400 {
        machine.advance(0.37 * f64::from(step)).expect("bounded");
        machine
            .set_force(&[0.3 * f64::from(step % 5), -0.1])
            .expect("finite");
        if step % 50 == 0 {
            scene.excitation.frequency = 1.1 + 0.001 * f64::from(step % 7);
            scene.clearance = 9.0 + 0.1 * f64::from(step % 11);
            machine.tune(&scene).expect("valid");
        }
        let energy = machine.energy();
        let defect = energy.supplied - energy.dissipated - (energy.mechanical - before);
        assert!(
            is_near(defect, 0.0, SOLVED * energy.dissipated.max(1.0)),
            "{defect:e} at step {step}"
        );
    }
}

/// A creeping contact costs no more evaluations than an ordinary one, whatever its damping: the
/// impact is found and the creep follows (x - r) b / (stiffness) in closed form.
#[test]
fn heavy_damping_creeps() {
    for damping in [1e4, 1e6, 1e8] {
        let mut scene = Ratios {
            clearance: 1.0,
            ..Ratios::unloaded()
        }
        .scene()
        .expect("valid");
        scene.excitation.amplitude = 0.0;
        scene.contact_damping = damping;
        let mut machine = Simulation::new(&scene, Start::new(0.0, 3.0)).expect("valid");
        machine.set_force(&[90.0, 0.0]).expect("finite");
        machine.advance(10.0).expect("bounded");
        let touched = machine.last_impact().expect("an impact");
        // Slow mode: damping x' + 8 x = 90 - 70 + 7, so x' = 19 / damping at x = 1; the speed of
        // the impact is lost within v m / damping.
        let dead = touched.velocity / damping;
        let time = 10.0 - touched.time;
        let depth = dead + 19.0 / 8.0 * -(-8.0 * time / damping).exp_m1();
        let error = machine.sample().position - 1.0 - depth;
        assert!(is_near(error, 0.0, 1e-3 * depth), "{damping}: {error}");
        let energy = machine.energy();
        let defect = energy.supplied - energy.dissipated - energy.mechanical + 4.5;
        assert!(
            is_near(defect, 0.0, 10.0 * SOLVED * energy.supplied),
            "{damping}: {defect:e}"
        );
    }
}

/// Without a drive its frequency has no influence: the mass bounces on, and its energy is kept.
#[test]
fn a_silent_drive_has_no_influence() {
    let machine = |frequency: f64| {
        let mut scene = Ratios {
            frequency,
            clearance: 0.0,
            ..Ratios::unloaded()
        }
        .scene()
        .expect("ok");
        (scene.damping, scene.contact_damping) = (0.0, 0.0);
        scene.excitation.amplitude = 0.0;
        let start = Start::new(-1e-9, 5e-3);
        let mut machine = Simulation::new(&scene, start).expect("valid");
        machine.set_force(&[20.0, 0.0]).expect("finite");
        machine.advance(1.0).expect("bounded");
        machine
    };
    let usual = machine(1.15);
    assert!(usual.impact_count() > 1000);
    for frequency in [1e-6, 1e-3, 50.0] {
        let other = machine(frequency);
        assert_eq!(usual.impact_count(), other.impact_count());
        assert_near(
            usual.energy().mechanical,
            other.energy().mechanical,
            10.0 * SOLVED * usual.energy().mechanical,
        );
    }
}

/// A step of the external force that frees a stuck mass gives it its full acceleration at once, as if
/// it had started from rest under that force.
#[test]
fn a_step_of_force_frees_a_stuck_mass() {
    let mut scene = loaded();
    scene.clearance = 0.0;
    scene.excitation.amplitude = 0.0;
    let rest = Start::new(0.2, 0.0);
    for force in [15.0, -3.0] {
        let mut held = Simulation::new(&scene, rest).expect("valid");
        held.set_force(&[0.2 * 20.0, 0.0]).expect("finite");
        held.advance(1.0).expect("bounded");
        assert_eq!(held.sample().phase, PhaseKind::Stuck);
        held.set_force(&[force, 0.0]).expect("finite");
        let freed = held.sample();
        let mut fresh =
            Simulation::new(&scene, InitialConditions::from(rest).at_time(1.0)).expect("valid");
        fresh.set_force(&[force, 0.0]).expect("finite");
        assert_ne!(freed.phase, PhaseKind::Stuck);
        for step in 1..=100 {
            let time = 1.0 + 0.01 * f64::from(step);
            held.advance(time).expect("bounded");
            fresh.advance(time).expect("bounded");
            let (a, b) = (held.sample(), fresh.sample());
            let start = 0.5 * freed.acceleration * 1e-4;
            assert_near(a.position, b.position, 10.0 * ROUNDING);
            assert_eq!(a.phase, b.phase);
            assert!(step > 1 || is_near((a.position - 0.2) / start, 1.0, 0.05));
        }
    }
}
