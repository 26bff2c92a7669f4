//! A hundred million periods: time is carried as whole periods and a rest, so neither the drive angle
//! nor the motion loses accuracy.

use softstop::internals::{Motion, samples};
use softstop::{Clock, InitialConditions, Ratios, Scene, Simulation, Start, Stop};
use softstop_testing::tolerance::MOTION;
use softstop_testing::{assert_near, hertz};

const PERIODS: u64 = 100_000_000;

fn start() -> Start {
    Start::new(samples::UNLOADED.position, samples::UNLOADED.velocity)
}

/// The impact-less motion after 10^8 periods is the particular solution at drive angle phi, to the
/// last digits: x = Re(e^(i phi) / (1 - eta^2 + 2 i beta1 eta)).
#[test]
fn the_impactless_motion_keeps_its_phase() {
    for (frequency, phase) in [(1.15f64, 0.0f64), (0.05, 1.0), (19.75, -2.0), (0.9, 3.0)] {
        let mut scene = Ratios {
            frequency,
            clearance: 100.0,
            ..Ratios::unloaded()
        }
        .scene()
        .expect("valid");
        scene.excitation.phase = phase;
        let mut motion = scene.motion(Start::new(0.0, 0.0)).expect("valid");
        motion
            .advance(Clock::at_cycle(PERIODS), &mut ())
            .expect("bounded");
        let (real, imaginary) = (1.0 - frequency * frequency, 0.04 * frequency);
        let size = real * real + imaginary * imaginary;
        let position = (real * phase.cos() + imaginary * phase.sin()) / size;
        let velocity = frequency * (imaginary * phase.cos() - real * phase.sin()) / size;
        let state = motion.state();
        let scale = 1.0 / size.sqrt();
        assert_near(state.position, position, 2e-15 * scale);
        assert_near(state.velocity, velocity, 2e-15 * scale * frequency.max(1.0));
    }
}

/// A motion that begins 10^8 periods later is the same, bit for bit.
#[test]
fn a_motion_does_not_depend_on_the_epoch() {
    let base = Ratios::unloaded().scene().expect("valid");
    let stops = [
        base.stop.clone(),
        Stop::Rigid { restitution: 0.6 },
        hertz(50.0, 1.5, 0.1),
    ];
    for stop in stops {
        let scene = Scene {
            stop,
            ..base.clone()
        };
        let run = |from: u64| {
            let mut motion = Motion::new(
                &scene.check().expect("valid"),
                Clock::at_cycle(from),
                start(),
            )
            .expect("valid");
            motion
                .advance(Clock::at_cycle(from + 50), &mut ())
                .expect("bounded");
            motion.state()
        };
        assert_eq!(run(0), run(PERIODS));
    }
}

fn stays_on_its_orbit(periods: u64) {
    let scene = Ratios::unloaded().scene().expect("valid");
    let mut motion = scene.motion(start()).expect("valid");
    motion
        .advance(Clock::at_cycle(periods), &mut ())
        .expect("bounded");
    let state = motion.state();
    // The sample holds twelve decimals.
    assert_near(state.position, samples::UNLOADED.position, MOTION);
    assert_near(state.velocity, samples::UNLOADED.velocity, MOTION);
}

#[test]
fn a_motion_with_impacts_stays_on_its_orbit() {
    stays_on_its_orbit(100_000);
}

/// All impacts of 10^8 periods, one after the other: some two minutes with
/// `cargo test --release --test engine long_runs -- --ignored`.
#[test]
#[ignore = "takes minutes"]
fn a_motion_stays_on_its_orbit_for_a_hundred_million_periods() {
    stays_on_its_orbit(PERIODS);
}

/// At absolute times of 10^8 periods a communication point is given to 2^-53 of itself; the machine
/// is then where the exact motion is at that very time.
#[test]
fn late_communication_points_are_taken_as_they_are() {
    let scene = Ratios::unloaded().scene().expect("valid");
    let begin = 1e8 * scene.period();
    let mut machine =
        Simulation::new(&scene, InitialConditions::from(start()).at_time(begin)).expect("valid");
    let clock = Clock::new(scene.excitation.frequency, 0.0);
    let mut motion = Motion::new(
        &scene.check().expect("valid"),
        clock.instant(begin),
        start(),
    )
    .expect("valid");
    for step in 1..=100 {
        let time = begin + 0.37 * f64::from(step);
        machine.advance(time).expect("bounded");
        motion
            .advance(clock.instant(time), &mut ())
            .expect("bounded");
    }
    assert_eq!(machine.sample().position, motion.state().position);
    // Impacts stand in the grid of such times.
    let impact = machine.last_impact().expect("impacts");
    assert!(impact.time > begin && impact.velocity > 1.0);
}
