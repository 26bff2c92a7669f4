//! The drive led by its inputs, the moving frame, and what both do, through the C functions.

use std::f64::consts::TAU;
use std::ffi::c_int;

use crate::common::{OK, Unit};
use crate::directional::FURTHER;
use softstop_testing::assert_near;

/// Differences of some hundred roundings.
const SAME: f64 = 1e-11;
/// Force of a drive that changes its speed, by its polynomials.
const PIECEWISE: f64 = 1e-10;

fn slope(unit: &Unit, name: &str, order: c_int, value: f64) {
    assert_eq!(unit.slope(name, order, value), OK);
}

/// A unit whose drive its inputs lead, with this speed and the default amplitude.
fn led(speed: f64) -> Unit {
    let unit = Unit::new();
    unit.set_all(&[
        ("drive.takes.speed", 1.0),
        ("drive.takes.amplitude", 1.0),
        ("drive.speed", speed),
        ("drive.amplitude", 1.0),
    ]);
    unit
}

fn assert_same(one: &Unit, other: &Unit, tolerance: f64) {
    for name in [
        "position",
        "velocity",
        "drive.force",
        "impact.time",
        "energy.supplied",
        "drive.work",
    ] {
        assert_near(one.get(name), other.get(name), tolerance * 100.0);
    }
    assert_eq!(one.get("impact.count"), other.get("impact.count"));
}

/// What is not taken is not felt: the inputs may be set to anything.
#[test]
fn inputs_that_are_not_taken() {
    let (plain, set) = (Unit::new(), Unit::new());
    plain.begin();
    assert_eq!(set.set("drive.speed", 3.0), OK);
    set.begin();
    assert_eq!(set.set("drive.amplitude", 7.0), OK);
    for unit in [&plain, &set] {
        for step in 0..20 {
            assert_eq!(unit.step(1.5 * f64::from(step), 1.5), OK);
        }
    }
    for name in [
        "position",
        "velocity",
        "drive.angle",
        "drive.work",
        "contact.peak",
    ] {
        assert_eq!(plain.get(name).to_bits(), set.get(name).to_bits(), "{name}");
    }
}

/// Speeds and amplitudes that jump by the parameters or by the inputs, each or both: the same, with the angle going on.
#[test]
fn jumps_are_those_of_the_parameters() {
    let units = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].map(|(speed, amplitude)| {
        let unit = Unit::new();
        unit.set_all(&[
            ("drive.takes.speed", speed),
            ("drive.takes.amplitude", amplitude),
            ("drive.speed", 1.15),
            ("drive.amplitude", 1.0),
        ]);
        unit.begin();
        unit
    });
    let [tuned, others @ ..] = &units;
    let mut angle = 0.0;
    for (step, (speed, amplitude)) in [(1.15, 1.0), (1.3, 1.0), (0.9, 1.4), (1.15, 0.7), (2.0, 1.0)]
        .into_iter()
        .cycle()
        .take(25)
        .enumerate()
    {
        for unit in &units {
            unit.set_all(&[
                ("excitation.frequency", speed),
                ("excitation.amplitude", amplitude),
                ("drive.speed", speed),
                ("drive.amplitude", amplitude),
            ]);
            assert_near(unit.get("drive.angle"), angle, SAME);
            assert_eq!(unit.step(2.7 * step as f64, 2.7), OK);
        }
        angle += 2.7 * speed;
        for other in others {
            assert_same(tuned, other, SAME);
        }
    }
    assert!(tuned.get("impact.count") > 0.0);
}

/// A drive that runs up from rest, through zero back, and swells: the same in one step and in many.
#[test]
fn ramps_do_not_depend_on_the_step() {
    let run = |steps: u32| {
        let unit = led(-0.4);
        assert_eq!(unit.set("force", 0.1), OK);
        unit.begin();
        slope(&unit, "drive.speed", 1, 0.06);
        slope(&unit, "drive.amplitude", 1, 0.05);
        slope(&unit, "drive.amplitude", 2, -0.001);
        slope(&unit, "force", 1, 0.003);
        for step in 0..steps {
            let length = 40.0 / f64::from(steps);
            assert_eq!(unit.step(length * f64::from(step), length), OK);
        }
        unit
    };
    let coarse = run(1);
    assert_near(coarse.get("drive.angle"), -16.0 + 48.0, SAME);
    assert!(coarse.get("impact.count") > 0.0);
    for steps in [7, 400] {
        assert_same(&coarse, &run(steps), PIECEWISE);
    }
}

/// A ramp held at the middle of short steps comes to the same, with the square of their length.
#[test]
fn ramps_are_limits_of_steps() {
    let end = |steps: u32| {
        let unit = led(0.5);
        unit.begin();
        let length = 12.0 / f64::from(steps);
        for step in 0..steps {
            let time = length * f64::from(step);
            assert_eq!(
                unit.set("drive.speed", 0.5 + 0.05 * (time + 0.5 * length)),
                OK
            );
            assert_eq!(unit.step(time, length), OK);
        }
        unit.get("position")
    };
    let ramp = led(0.5);
    ramp.begin();
    slope(&ramp, "drive.speed", 1, 0.05);
    assert_eq!(ramp.step(0.0, 12.0), OK);
    let exact = ramp.get("position");
    let errors = [300, 600].map(|steps| (end(steps) - exact).abs());
    assert!(errors[0] < 1e-4, "{errors:?}");
    assert_near(errors[0] / errors[1], 4.0, 0.02);
}

/// A drive that has turned by 1.2e9 rad, at the start or since, pushes as one at the same angle without these turns, also
/// where inputs are set on the way.
#[test]
fn a_large_drive_angle_costs_no_digits() {
    const SOONER: f64 = (1_u64 << 29) as f64;
    const WAITED: f64 = 1e9 + 0.3;
    let rest = |takes: &[&str]| {
        let unit = Unit::new();
        unit.set_all(&[("initial.position", 0.0), ("initial.velocity", 0.0)]);
        takes
            .iter()
            .for_each(|name| assert_eq!(unit.set(name, 1.0), OK));
        unit
    };
    let speed = Unit::new().get("excitation.frequency");
    let angle = WAITED * speed;
    let rounding = speed.mul_add(WAITED, -angle);
    let near = rest(&[]);
    let phase = angle.sin().atan2(angle.cos()) + rounding;
    assert_eq!(near.set("excitation.phase", phase), OK);
    near.begin();
    assert_eq!(near.step(0.0, 8.0), OK);
    let later = [&[][..], &["drive.takes.amplitude"]].map(|takes| {
        let unit = rest(takes);
        unit.enter(WAITED);
        assert_eq!(unit.leave(), OK);
        assert_eq!(unit.set("drive.amplitude", 1.0), OK);
        unit
    });
    let turned = rest(&["drive.takes.speed", "drive.takes.amplitude"]);
    turned.begin();
    assert_eq!(turned.set("drive.speed", speed), OK);
    // Such a force moves nothing.
    for (force, from, until) in [(1e-300, 0.0, SOONER), (2e-300, SOONER, WAITED)] {
        assert_eq!(turned.step(from, until - from), OK);
        assert_eq!(turned.set("force", force), OK);
    }
    assert_eq!(turned.set("drive.amplitude", 1.0), OK);
    let by_amplitude = turned.derivatives(&["drive.force"], &[("drive.amplitude", 1.0)]);
    assert_near(by_amplitude.expect("available")[0], phase.cos(), 1e-12);
    for unit in later.iter().chain([&turned]) {
        for step in 0..8 {
            assert_eq!(unit.step(WAITED + f64::from(step), 1.0), OK);
            assert_eq!(unit.set("force", 1e-300 * f64::from(step)), OK);
        }
        for name in [
            "position",
            "velocity",
            "drive.force",
            "drive.power",
            "drive.work",
        ] {
            assert_near(unit.get(name), near.get(name), 1e-12);
        }
        let whole = angle + 8.0 * speed;
        assert_near(unit.get("drive.angle"), whole, 5e-7);
    }
}

/// The drive's work is the integral of its power; the balance closes over the whole unit.
#[test]
fn work_of_the_drive_and_balance() {
    let unit = led(1.15);
    assert_eq!(unit.set("force", 0.2), OK);
    assert_eq!(unit.set("base.acceleration", -0.1), OK);
    unit.begin();
    slope(&unit, "drive.speed", 1, 0.002);
    let start = unit.get("energy.mechanical");
    let (mut work, mut external) = (0.0, 0.0);
    let length = 1.0 / 256.0;
    for step in 0..5120 {
        if step == 2000 {
            assert_eq!(unit.set("force", -0.1), OK);
            slope(&unit, "base.acceleration", 1, 0.01);
        }
        let time = length * f64::from(step);
        let powers = |unit: &Unit| {
            let push = unit.get("force") - unit.get("base.acceleration");
            (unit.get("drive.power"), push * unit.get("velocity"))
        };
        let before = powers(&unit);
        assert_eq!(unit.step(time, length), OK);
        let after = powers(&unit);
        work += 0.5 * length * (before.0 + after.0);
        external += 0.5 * length * (before.1 + after.1);
    }
    assert_near(unit.get("drive.work"), work, 1e-3);
    let supplied = unit.get("energy.supplied");
    assert_near(supplied - unit.get("drive.work"), external, 1e-3);
    let balance = unit.get("energy.dissipated") + unit.get("energy.mechanical") - start;
    assert_near(supplied, balance, 1e-10 * supplied.abs());
    assert!(unit.get("pierce.count") > 2.0);
}

/// A moving frame is a force against its acceleration.
#[test]
fn the_frame_moves() {
    let (pushed, moved) = (Unit::new(), Unit::new());
    for unit in [&pushed, &moved] {
        assert_eq!(unit.set("mass", 1.25), OK);
    }
    assert_eq!(pushed.set("force", 0.25), OK);
    assert_eq!(moved.set("base.acceleration", -0.2), OK);
    for unit in [&pushed, &moved] {
        unit.begin();
    }
    slope(&pushed, "force", 2, 0.0125);
    slope(&moved, "base.acceleration", 2, -0.01);
    for unit in [&pushed, &moved] {
        assert_eq!(unit.step(0.0, 9.0), OK);
    }
    assert_same(&pushed, &moved, SAME);
    let force = moved.get("drive.force") - 1.25 * moved.get("base.acceleration");
    let frame = force - 1.25 * moved.get("acceleration");
    assert_near(moved.get("frame.force"), frame, SAME);
}

/// What is told of a step of many impacts is what many steps tell.
#[test]
fn contacts_of_a_step() {
    for model in [2.0, 3.0, 4.0, 5.0, 6.0] {
        let unit = || {
            let unit = Unit::new();
            assert_eq!(unit.set("stop.model", model), OK);
            unit.begin();
            assert_eq!(unit.step(0.0, 1.0), OK);
            unit
        };
        let (coarse, fine) = (unit(), unit());
        assert_eq!(coarse.step(1.0, 30.0), OK);
        let (mut impulse, mut peak, mut sampled) = (0.0, 0.0f64, 0.0f64);
        let (mut impacts, mut pierced, mut times, mut hardest) = (0.0, 0.0, Vec::new(), (0.0, 0.0));
        for step in 0..30_000 {
            assert_eq!(fine.step(1.0 + 1e-3 * f64::from(step), 1e-3), OK);
            impulse += fine.get("contact.impulse");
            peak = peak.max(fine.get("contact.peak"));
            sampled = sampled.max(fine.get("contact.force"));
            pierced += fine.get("pierce.step.count");
            let count = fine.get("impact.step.count");
            if count > 0.0 {
                impacts += count;
                times.push((
                    fine.get("impact.step.first.time"),
                    fine.get("impact.step.first.velocity"),
                ));
                let one = (
                    fine.get("impact.step.hardest.velocity"),
                    fine.get("impact.step.hardest.time"),
                );
                hardest = if one > hardest { one } else { hardest };
            }
        }
        assert_eq!(coarse.get("impact.step.count"), impacts, "{model}");
        assert_eq!(coarse.get("pierce.step.count"), pierced);
        assert!(impacts >= 4.0);
        assert_near(coarse.get("contact.impulse"), impulse, 1e-8);
        assert_near(coarse.get("contact.peak"), peak, 1e-8);
        assert!(
            peak >= sampled && peak - sampled < 1e-2 * peak,
            "{model} {peak} {sampled}"
        );
        let first = (
            coarse.get("impact.step.first.time"),
            coarse.get("impact.step.first.velocity"),
        );
        assert_near(first.0, times[0].0, 1e-9);
        assert_near(first.1, times[0].1, 1e-9);
        assert_near(coarse.get("impact.step.hardest.velocity"), hardest.0, 1e-8);
        // Setting an input does not take it away.
        let before = coarse.get("contact.impulse");
        assert_eq!(coarse.set("force", 0.3), OK);
        assert_eq!(coarse.get("contact.impulse"), before);
        assert_eq!(coarse.get("impact.step.count"), impacts);
    }
}

/// The impulse is what is left of the balance of momentum over whole periods.
#[test]
fn impulse_of_a_period() {
    let unit = Unit::new();
    unit.begin();
    let period = TAU / 1.15;
    let mut sums = (0.0, 0.0);
    let steps = 4000;
    for step in 0..steps {
        let length = period / f64::from(steps);
        assert_eq!(unit.step(length * f64::from(step), length), OK);
        sums = (
            sums.0 + length * unit.get("position"),
            sums.1 + unit.get("contact.impulse"),
        );
    }
    // k1 times the integral of the position, and the impulse, balance each other.
    assert_near(sums.1, -sums.0, 1e-3);
    assert!(sums.1 > 5.0);
}

/// A state kept on the way through a ramp goes on bit for bit, and tells the same of the last step.
#[test]
fn states_on_a_ramp() {
    let unit = led(0.3);
    unit.begin();
    slope(&unit, "drive.speed", 1, 0.05);
    slope(&unit, "drive.amplitude", 1, 0.1);
    assert_eq!(unit.step(0.0, 30.0), OK);
    let other = led(9.0);
    other.begin();
    assert_eq!(other.take_up(&unit.serialized()), OK);
    let by = [("initial.position", 1.0), ("drive.speed", 1.0)];
    let read = |unit: &Unit| {
        let values = FURTHER.map(|name| unit.get(name).to_bits());
        (values, unit.derivatives(&FURTHER, &by))
    };
    assert_eq!(read(&unit), read(&other));
    for unit in [&unit, &other] {
        assert_eq!(unit.step(30.0, 5.0), OK);
    }
    assert_eq!(
        FURTHER.map(|name| unit.get(name).to_bits()),
        FURTHER.map(|name| other.get(name).to_bits())
    );
}
