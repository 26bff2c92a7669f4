//! Derivatives of the outputs, across impacts, against differences of the motion itself.

use nalgebra::Vector2;
use proptest::prelude::*;
use softstop::internals::FrequencySensitivity;
use softstop::{Clock, Perturbation, Ratios, Scene, Sensitivity, Simulation, Start, Stop};
use softstop_testing::tangent::differences_of;
use softstop_testing::{Meets, cases, is_near, machines, start_below};

/// How many outputs there are.
const OUTPUTS: usize = 16;

/// Position, velocity, acceleration, contact force, energies, time and velocity of the last impact, of the first and of the
/// hardest one, peak and impulse of the contact force, and the work of the external force.
fn outputs(machine: &Simulation, force: &[f64]) -> [f64; OUTPUTS] {
    let (sample, energy) = (machine.sample(), machine.energy());
    let impact = machine.last_impact();
    let contacts = machine.contacts().expect("known");
    let [first, hardest] = [contacts.first, contacts.hardest].map(Option::unwrap_or_default);
    [
        sample.position,
        sample.velocity,
        sample.acceleration,
        sample.contact_force,
        energy.mechanical,
        energy.supplied,
        energy.dissipated,
        impact.map_or(0.0, |impact| impact.time),
        impact.map_or(0.0, |impact| impact.velocity),
        first.time,
        first.velocity,
        hardest.time,
        hardest.velocity,
        contacts.peak,
        contacts.impulse,
        machine.work_since_checkpoint(force).expect("known"),
    ]
}

/// Which of the outputs are energies.
const ENERGIES: std::ops::Range<usize> = 4..7;

fn derivatives(of: &Sensitivity) -> [f64; OUTPUTS] {
    [
        of.position,
        of.velocity,
        of.acceleration,
        of.contact_force,
        of.mechanical,
        of.supplied,
        of.dissipated,
        of.impact_time,
        of.impact_velocity,
        of.first.time,
        of.first.velocity,
        of.hardest.time,
        of.hardest.velocity,
        of.peak,
        of.impulse,
        of.work,
    ]
}

/// A scene with another drive frequency.
fn detuned(scene: &Scene, change: f64) -> Scene {
    let mut scene = scene.clone();
    scene.excitation.frequency += change;
    scene
}

/// The state when the drive has turned so many times, and what the exact derivative by its frequency is.
fn turned(scene: &Scene, start: Start, turns: f64) -> (Vector2<f64>, Option<Vector2<f64>>) {
    let clock = scene.clock();
    let mut motion = scene.motion(start).expect("valid");
    let mut watch = FrequencySensitivity::default();
    let until = clock.after(Clock::at_cycle(0), turns * clock.period());
    motion.advance(until, &mut watch).expect("bounded");
    motion.tell_arc(&mut watch);
    let (arc, now, state) = (motion.arc(), motion.now(), motion.state());
    let along = (&arc, motion.clock().elapsed(arc.start, now));
    let change = watch.at_drive_angle(along, state, motion.clock().time(now));
    (state.into(), change)
}

proptest! {
    #![proptest_config(cases(1500))]

    #[test]
    fn sensitivities_are_derivatives(
        scene in machines(),
        depth in -0.5..6.0f64,
        velocity in -6.0..6.0f64,
        force in -0.3..0.3f64,
        rate in -0.1..0.1f64,
        bend in prop_oneof![Just(0.0), -0.1..0.1f64],
        span in 0.05..1.2f64,
        towards in (-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64),
    ) {
        let start = start_below(&scene, depth, velocity);
        let end = span * scene.period();
        let drive = scene.excitation;
        let until = Clock::new(drive.frequency, drive.phase).after(Clock::at_cycle(0), end);
        prop_assume!(Simulation::new(&scene, start).is_ok());
        let pushed = |width: f64| [force + width * towards.2, rate, bend];
        let run = |width: f64| {
            let start = Start::new(start.position + width * towards.0, start.velocity + width * towards.1);
            let mut machine = Simulation::new(&scene, start).expect("valid");
            machine.set_force(&pushed(width)).expect("finite");
            machine.advance(end).expect("bounded");
            machine
        };
        prop_assume!(Simulation::new(&scene, Start { position: start.position + 1e-3, ..start }).is_ok());
        let way = |width: f64| {
            Meets::until(&scene, Start { position: start.position + width, ..start }, until)
        };
        let meets = way(0.0);
        prop_assume!(meets.slowest > 0.2 && meets.crossings.len() < 12);
        prop_assume!([-1e-3, 1e-3].iter().all(|width| way(*width).crossings == meets.crossings));
        let machine = run(0.0);
        let same = |width: f64| {
            let other = run(width);
            other.sample().phase == machine.sample().phase
                && other.impact_count() == machine.impact_count()
        };
        prop_assume!([-3e-4, -2e-4, -1e-4, 1e-4, 2e-4, 3e-4].iter().all(|width| same(*width)));
        let by = Perturbation { position: towards.0, velocity: towards.1, force: towards.2 };
        let exact = derivatives(&machine.sensitivity(&by, &pushed(0.0)).expect("known"));
        let beside = |width: f64| Some(outputs(&run(width), &pushed(width)).to_vec());
        for (n, (found, error)) in differences_of(beside, 1e-4).expect("known").into_iter().enumerate() {
            let size = 1.0 + exact[n].abs();
            prop_assume!(error < 1e-2 * size);
            // Energies are known to 1e-10 of the motion's, so their differences to 1e-5.
            let noise = if ENERGIES.contains(&n) { 1e-5 } else { 1e-6 };
            let allowed = noise * size + 3.0 * error;
            assert!(is_near(found, exact[n], allowed), "{n}: {found} {} {:?}", exact[n], meets.crossings);
        }
    }
    #[test]
    fn answers_to_the_drives_frequency_are_derivatives(
        scene in machines(),
        depth in -0.5..6.0f64,
        velocity in -6.0..6.0f64,
        turns in 0.05..2.2f64,
    ) {
        let start = start_below(&scene, depth, velocity);
        prop_assume!(Simulation::new(&scene, start).is_ok());
        let way = |change: f64| {
            let scene = detuned(&scene, change);
            let clock = scene.clock();
            let end = clock.after(Clock::at_cycle(0), turns * clock.period());
            Meets::until(&scene, start, end)
        };
        let meets = way(0.0);
        prop_assume!(meets.slowest > 0.2 && meets.crossings.len() < 12);
        prop_assume!([-1e-3, 1e-3].iter().all(|change| way(*change).crossings == meets.crossings));
        let (_, exact) = turned(&scene, start, turns);
        prop_assume!(exact.is_some());
        let exact = exact.expect("in closed form");
        let central = |width: f64| {
            let [high, low] = [width, -width].map(|change| turned(&detuned(&scene, change), start, turns).0);
            (high - low) / (2.0 * width)
        };
        let (wide, narrow) = (central(2e-4), central(1e-4));
        let (found, error) = ((4.0 * narrow - wide) / 3.0, (wide - narrow).norm());
        let size = 1.0 + exact.norm();
        prop_assume!(error < 1e-2 * size);
        assert!((found - exact).norm() <= 1e-6 * size + 3.0 * error, "{found} {exact} {:?}", meets.crossings);
    }
}

#[test]
fn power_laws_answer_to_the_drives_frequency_in_closed_form() {
    for exponent in [1.5, 2.0, 1.3] {
        for dissipation in [0.0, 0.1] {
            let mut scene = Ratios::unloaded().scene().expect("the paper's machine");
            scene.stop = Stop::Hertz {
                stiffness: 150.0,
                exponent,
                dissipation,
            };
            let start = Start::new(6.9, 9.5);
            let (_, exact) = turned(&scene, start, 1.0);
            let state = |change: f64| turned(&detuned(&scene, change), start, 1.0).0;
            let found = (state(1e-5) - state(-1e-5)) / 2e-5;
            let exact = exact.expect("in closed form");
            assert!(
                (found - exact).norm() <= 1e-6 * exact.norm(),
                "{found} {exact}"
            );
        }
    }
}
