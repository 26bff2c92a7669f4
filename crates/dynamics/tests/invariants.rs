//! What holds for every motion: independence of the way a run is divided, the energy balance,
//! Liouville's theorem, dimensional similarity.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use nalgebra::Vector2;
use proptest::prelude::*;
use softstop::{Begin, Clock, PhaseKind, Piercing, Ratios, Simulation, Start, Units};
use softstop_dynamics::StroboscopicMap;
use softstop_testing::tangent::differences;
use softstop_testing::tolerance::{GROWN, MOTION, ROUNDING, SOLVED};
use softstop_testing::{Meets, cases, loaded};

/// Machines around the paper's, loaded or not, away from the degenerate.
fn machines() -> impl Strategy<Value = Ratios> {
    (
        0.3..2.5f64,
        -1.0..12.0f64,
        0.01..0.2f64,
        0.02..0.5f64,
        1.0..200.0f64,
        0.0..100.0f64,
        any::<bool>(),
    )
        .prop_map(
            |(frequency, clearance, damping, contact_damping, stiffness, preload, loaded)| Ratios {
                frequency,
                clearance,
                damping,
                contact_damping,
                stiffness,
                preload,
                rigid: None,
                piercing: loaded.then_some(Piercing::PAPER),
            },
        )
}

fn starts() -> impl Strategy<Value = Start> {
    (-15.0..5.0f64, -10.0..15.0f64).prop_map(|(position, velocity)| Start::new(position, velocity))
}

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
        let relative = trajectory.energy_defect() / trajectory.work.supplied;
        assert_abs_diff_eq!(relative, 0.0, epsilon = 10.0 * MOTION);
        assert!(trajectory.work.dissipated > 10_000.0);
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
            abs_diff_eq!(defect, 0.0, epsilon = SOLVED * energy.dissipated.max(1.0)),
            "{defect:e} at step {step}"
        );
    }
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn energy_balances_in_every_machine(ratios in machines(), start in starts()) {
        let scene = ratios.scene().expect("valid");
        let trajectory = scene.trajectory(start, 10).expect("bounded");
        let scale = trajectory.work.supplied.abs() + trajectory.work.dissipated.abs() + 100.0;
        assert_abs_diff_eq!(trajectory.energy_defect(), 0.0, epsilon = 10.0 * MOTION * scale);
    }

    #[test]
    fn determinant_follows_liouville(ratios in machines(), start in starts()) {
        let unloaded = Ratios { piercing: None, ..ratios };
        let map = StroboscopicMap::new(&unloaded.scene().expect("valid"), 3).expect("valid");
        let meets = Meets::until(&unloaded.scene().expect("valid"), start, Clock::at_cycle(3));
        // A graze makes the entries of the product huge against its determinant.
        prop_assume!(!meets.held && meets.slowest > 1e-2 && meets.crossings.len() < 50);
        let passage = map.apply(Vector2::new(start.position, start.velocity)).expect("bounded");
        let expected = (-passage.damping_integral).exp();
        let size = passage.monodromy.norm_squared();
        assert_abs_diff_eq!(passage.monodromy.determinant(), expected, epsilon = MOTION * (1.0 + size));
    }

    #[test]
    fn tangent_is_the_derivative_of_the_map(ratios in machines(), start in starts()) {
        let scene = ratios.scene().expect("valid");
        let meets = Meets::until(&scene, start, Clock::at_cycle(2));
        prop_assume!(!meets.held && meets.slowest > 0.3 && meets.crossings.len() < 20);
        let map = StroboscopicMap::new(&scene, 2).expect("valid");
        let state = Vector2::new(start.position, start.velocity);
        let passage = map.apply(state).expect("bounded");
        let differences = differences(|state| map.image(state).expect("bounded"), state);
        let size = 1.0 + passage.monodromy.norm();
        for (found, exact) in differences.column_iter().zip(passage.monodromy.column_iter()) {
            assert!(abs_diff_eq!((found - exact).norm(), 0.0, epsilon = 1e-3 * size * size), "{found} {exact}");
        }
    }

    #[test]
    fn dimensional_machines_move_alike(
        ratios in machines(),
        mass in 0.01..100.0f64,
        stiffness in 0.1..1e4f64,
        force in 0.01..1e3f64,
    ) {
        let ratios = Ratios { clearance: ratios.clearance + 2.0, ..ratios };
        let units = Units { mass, stiffness, force };
        let one = ratios.scene().expect("valid");
        let other = ratios.dimensional(units).expect("valid");
        let length = force / stiffness;
        let rate = (stiffness / mass).sqrt();
        let plain = one.trajectory(Start::new(0.5, 1.0 ), 2).expect("bounded");
        let start = Start::new(0.5 * length, length * rate );
        let scaled = other.trajectory(start, 2).expect("bounded");
        prop_assert_eq!(plain.crossings.len(), scaled.crossings.len());
        assert_abs_diff_eq!(plain.end.position, scaled.end.position / length, epsilon = 10.0 * GROWN);
        assert_abs_diff_eq!(plain.end.velocity, scaled.end.velocity / length / rate, epsilon = 10.0 * GROWN);
    }
}

/// A mass pressed onto a preloaded stop with less than its preload bounces ever lower and comes to
/// rest on it, after a bounded number of crossings.
#[test]
fn endless_bounces_end_in_rest() {
    let mut scene = Ratios {
        clearance: 1.0,
        ..Ratios::unloaded()
    }
    .scene()
    .expect("valid");
    scene.excitation.amplitude = 0.2;
    scene.contact_damping = 4.0;
    let mut machine = Simulation::new(&scene, Start::new(0.0, 0.0)).expect("valid");
    machine.set_force(&[20.0, 0.0]).expect("finite");
    machine.advance(60.0).expect("bounded");
    let sample = machine.sample();
    assert_eq!(sample.phase, PhaseKind::Resting);
    assert_eq!((sample.position, sample.velocity), (1.0, 0.0));
    assert_abs_diff_eq!(sample.contact_force, 19.0, epsilon = 0.2);
    assert!(machine.impact_count() < 2_000_000);
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
        assert!(
            abs_diff_eq!(error, 0.0, epsilon = 1e-3 * depth),
            "{damping}: {error}"
        );
        let energy = machine.energy();
        let defect = energy.supplied - energy.dissipated - energy.mechanical + 4.5;
        assert!(
            abs_diff_eq!(defect, 0.0, epsilon = 10.0 * SOLVED * energy.supplied),
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
        assert_abs_diff_eq!(
            usual.energy().mechanical,
            other.energy().mechanical,
            epsilon = 10.0 * SOLVED * usual.energy().mechanical
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
        let mut fresh = Simulation::new(&scene, Begin::from(rest).at_time(1.0)).expect("valid");
        fresh.set_force(&[force, 0.0]).expect("finite");
        assert_ne!(freed.phase, PhaseKind::Stuck);
        for step in 1..=100 {
            let time = 1.0 + 0.01 * f64::from(step);
            held.advance(time).expect("bounded");
            fresh.advance(time).expect("bounded");
            let (a, b) = (held.sample(), fresh.sample());
            let start = 0.5 * freed.acceleration * 1e-4;
            assert_abs_diff_eq!(a.position, b.position, epsilon = 10.0 * ROUNDING);
            assert_eq!(a.phase, b.phase);
            assert!(step > 1 || abs_diff_eq!((a.position - 0.2) / start, 1.0, epsilon = 0.05));
        }
    }
}
