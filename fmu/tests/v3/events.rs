//! Every event is where it is, whatever the importer's step and whatever it can do with events.

use softstop_fmi3::*;

use super::unit::{HANDLINGS, Unit};
use crate::common::{self, call};
use crate::discard::BUSY;

const PERIOD: f64 = std::f64::consts::TAU / 1.15;
const SIZES: [f64; 5] = [1e-2, PERIOD / 100.0, 0.7, PERIOD, 10.0 * PERIOD];

/// Machines that strike in different ways: values of their variables.
pub const MACHINES: [&[(&str, f64)]; 6] = [
    &[],
    &[("piercing.thickness", 0.0), ("piercing.travel", 0.0)],
    // A rigid stop, with rows of bounces to rest.
    &[
        ("stop.model", 6.0),
        ("clearance", 4.0),
        ("stop.restitution", 0.3),
        ("initial.position", 0.0),
        ("initial.velocity", 5.0),
    ],
    // A stop whose force is a power of the deflection.
    &[
        ("stop.model", 4.0),
        ("stop.stiffness", 20.0),
        ("clearance", 8.0),
    ],
    &[
        ("stop.model", 3.0),
        ("clearance", 8.0),
        ("stop.loading.count", 2.0),
        ("stop.loading.from[2]", 0.5),
        ("stop.loading.stiffness[2]", 30.0),
    ],
    &[
        ("stop.model", 2.0),
        ("rigid.travel", 0.2),
        ("clearance", 7.0),
    ],
];

fn bits(unit: &Unit) -> Vec<u64> {
    common::OUTPUTS
        .iter()
        .map(|name| unit.get(name).to_bits())
        .collect()
}

/// States at all events of ten periods, and at their end.
fn events(values: &[(&str, f64)], handling: (bool, bool), size: f64) -> (Vec<Vec<u64>>, Vec<u64>) {
    let (unit, mut seen) = (Unit::begun(handling, values), Vec::new());
    unit.run(10.0 * PERIOD, size, |unit, ending| {
        let mut all = bits(unit);
        all.push(ending.time.to_bits());
        seen.push(all);
    });
    (seen, bits(&unit))
}

#[test]
fn states_are_the_same_to_the_bit_for_all_steps_and_all_importers() {
    for (machine, values) in MACHINES.iter().enumerate() {
        let (_, end) = events(values, (false, false), 10.0 * PERIOD);
        let (both, _) = events(values, (true, true), 10.0 * PERIOD);
        // Of each event the state before it and the one after it.
        let after: Vec<_> = both.iter().skip(1).step_by(2).cloned().collect();
        assert!(after.len() > 10, "machine {machine}: {}", after.len());
        for handling in HANDLINGS {
            for size in SIZES {
                let (seen, last) = events(values, handling, size);
                let what = format!("machine {machine}, {handling:?}, steps of {size}");
                assert!(last == end, "{what}: another end");
                match handling {
                    (false, false) => assert!(seen.is_empty()),
                    (false, true) => assert!(seen == after, "{what}: other events"),
                    (true, true) => assert!(seen == both, "{what}: other events"),
                    (true, false) => assert!(!seen.is_empty()),
                }
            }
        }
    }
}

#[test]
fn the_end_is_that_of_a_unit_of_fmi_2() {
    for values in MACHINES {
        let unit = common::Unit::new();
        unit.set_all(values);
        unit.begin();
        assert_eq!(unit.step(0.0, 10.0 * PERIOD), common::OK);
        let ends: Vec<_> = common::OUTPUTS
            .iter()
            .map(|name| unit.get(name).to_bits())
            .collect();
        assert_eq!(ends, events(values, (true, true), 0.7).1);
    }
}

#[test]
fn the_next_event_comes_when_it_was_said_to_come() {
    for values in MACHINES {
        let unit = Unit::begun((true, true), values);
        unit.enter_event_mode();
        let (mut next, mut point) = (unit.update(), 0.0);
        unit.leave_event_mode();
        for _ in 0..50 {
            // With steps that reach far beyond it.
            let ending = unit.step(point, 100.0);
            assert!(ending.event && ending.early, "{ending:?}");
            assert_eq!(next.map(f64::to_bits), Some(ending.time.to_bits()));
            point = ending.time;
            unit.enter_event_mode();
            next = unit.update();
            unit.leave_event_mode();
        }
    }
}

#[test]
fn an_importer_that_steps_to_the_next_event_needs_no_early_return() {
    for values in MACHINES {
        let unit = Unit::begun((true, false), values);
        unit.enter_event_mode();
        let (mut next, mut point, mut seen) = (unit.update(), 0.0, Vec::new());
        unit.leave_event_mode();
        while let Some(time) = next.filter(|time| *time < 10.0 * PERIOD) {
            let ending = unit.step(point, time - point);
            assert_eq!((ending.event, ending.early), (true, false));
            // What the importer adds up may differ from the event's time in its last digit.
            assert!((ending.time - time).abs() <= 4.0 * f64::EPSILON * time);
            point = ending.time;
            for _ in 0..2 {
                let mut all = bits(&unit);
                all.push(point.to_bits());
                seen.push(all);
                if seen.len() % 2 == 1 {
                    unit.enter_event_mode();
                    next = unit.update();
                    unit.leave_event_mode();
                }
            }
        }
        assert!(seen == events(values, (true, true), 1.0).0, "other events");
    }
}

#[test]
fn an_impact_is_seen_from_both_sides() {
    for (restitution, model) in [(None, 5.0), (Some(0.6), 6.0)] {
        let values = [
            ("stop.model", model),
            ("piercing.thickness", 0.0),
            ("piercing.travel", 0.0),
        ];
        let unit = Unit::begun((true, true), &values);
        let ending = unit.step(0.0, 50.0);
        let velocity = unit.get("velocity");
        assert_eq!((unit.get("impact.count"), unit.get("phase")), (0.0, 1.0));
        assert!((unit.get("position") - 10.0).abs() <= 4e-15 && velocity > 0.0);
        assert_eq!(unit.get("contact.force"), 0.0);
        unit.enter_event_mode();
        // Until the event is handled its state before it is there to be read, whatever is set.
        assert_eq!(unit.set("force", 0.25), common::OK);
        assert_eq!(unit.get("velocity"), velocity);
        unit.update();
        let after = unit.get("velocity");
        match restitution {
            None => assert!((after - velocity).abs() <= 4e-15 && unit.get("contact.force") > 60.0),
            Some(restitution) => assert!((after + restitution * velocity).abs() < 1e-14),
        }
        assert_eq!(
            (unit.get("impact.count"), unit.get("impact.step.count")),
            (1.0, 1.0)
        );
        assert_eq!(unit.get("impact.time"), ending.time);
        assert!((unit.get("impact.velocity") - velocity).abs() <= 4e-15);
        unit.leave_event_mode();
        // What was set holds from then on.
        let acceleration = unit.get("acceleration");
        assert_eq!(unit.set("force", 0.0), common::OK);
        unit.step(ending.time, 1e-12);
        assert!((acceleration - unit.get("acceleration") - 0.25).abs() < 1e-6);
    }
}

#[test]
fn events_under_a_drive_that_is_followed_in_pieces() {
    // It crawls, so that its time is resolved by the parameter's frequency.
    let values = [
        ("drive.takes.speed", 1.0),
        ("drive.speed", 0.06),
        ("excitation.amplitude", 40.0),
    ];
    let after = |handling, size| {
        let (seen, last) = events(&values, handling, size);
        let skipped = usize::from(handling == (true, true));
        (
            seen.into_iter()
                .skip(skipped)
                .step_by(skipped + 1)
                .collect::<Vec<_>>(),
            last,
        )
    };
    let (one, other) = (after((true, true), 0.7), after((false, true), 0.7));
    assert!(one.0.len() > 10 && one == other);
    let number = |bits: &u64| f64::from_bits(*bits);
    for handling in HANDLINGS {
        let (_, last) = after(handling, PERIOD);
        for (one, other) in last.iter().zip(&one.1) {
            assert!((number(one) - number(other)).abs() < 1e-8 * number(one).abs().max(1.0));
        }
    }
}

#[test]
fn a_state_at_an_event_leads_on_bit_for_bit() {
    let (one, other) = (Unit::begun((true, true), &[]), Unit::new((true, true)));
    let ending = one.step(0.0, 50.0);
    other.take_up(&one);
    let state = one.keep();
    let mut ends = Vec::new();
    for unit in [&one, &other] {
        unit.enter_event_mode();
        unit.update();
        unit.leave_event_mode();
        unit.step(ending.time, 0.01);
        ends.push(unit.everything());
    }
    assert_eq!(ends[0], ends[1]);
    // Without event mode there is no such state.
    let without = Unit::new((false, true));
    // SAFETY: both are alive.
    let status = unsafe { fmi3SetFMUState(without.instance, state) };
    assert_eq!(status, common::ERROR);
    one.free(state);
}

#[test]
fn states_of_another_fmu_are_refused() {
    let unit = Unit::begun((false, false), &[]);
    let (mut foreign, before) = (unit.keep(), unit.everything());
    let (instance, state, mut size) = (unit.instance, foreign, 0);
    let mut bytes = unit.bytes_of(state);
    common::switch_guid(state);
    // SAFETY: the instance and the state are alive, a place as long as is said.
    let calls = unsafe {
        [
            call!(fmi3GetFMUState(instance, &raw mut foreign)),
            call!(fmi3SetFMUState(instance, state)),
            call!(fmi3SerializedFMUStateSize(instance, state, &raw mut size)),
            call!(fmi3SerializeFMUState(
                instance,
                state,
                bytes.as_mut_ptr(),
                bytes.len()
            )),
            call!(fmi3FreeFMUState(instance, &raw mut foreign)),
        ]
    };
    let lines = unit.take_log();
    assert_eq!(lines.len(), calls.len(), "{lines:?}");
    for ((function, status), line) in calls.iter().zip(lines) {
        let words = format!("{function}: the FMU state is of another FMU, or is none");
        assert!(*status == common::ERROR && line.contains(&words), "{line}");
    }
    assert_eq!((foreign, size), (state, 0));
    bytes[12] ^= 1;
    assert_eq!(unit.try_state_of(&bytes).0, common::ERROR);
    assert!(unit.take_log()[0].contains("another GUID"));
    common::switch_guid(state);
    unit.go_back(state);
    assert_eq!(unit.everything(), before);
    unit.free(state);
}

/// Other than in FMI 2.0, where it is carried out in part.
#[test]
fn a_step_of_too_many_impacts_is_taken_back() {
    let [unit, direct] = [(); 2].map(|()| Unit::begun((false, false), &BUSY));
    let before = unit.everything();
    assert_eq!(unit.try_step(0.0, 1e9).0, common::DISCARD);
    assert_eq!(unit.everything(), before);
    for unit in [&unit, &direct] {
        unit.step(0.0, 1.0);
    }
    assert_eq!(unit.everything(), direct.everything());
}
