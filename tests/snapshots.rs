//! A machine that is kept, written to bytes, read back and restored goes on bit for bit.

use proptest::prelude::*;
use serde::Serialize;
use softstop::{Effort, InitialConditions, MotionError, Scene, Simulation, Snapshot, Start};
use softstop_testing::{cases, loaded, machines, start_below};

fn to_bytes(value: &impl Serialize) -> Vec<u8> {
    let mut bytes = Vec::new();
    ciborium::into_writer(value, &mut bytes).expect("plain data");
    bytes
}

pub fn through_bytes(machine: &Simulation) -> Simulation {
    let bytes = to_bytes(&machine.snapshot());
    let read: Snapshot = ciborium::from_reader(&*bytes).expect("what was written");
    assert_eq!(read, machine.snapshot());
    Simulation::restored(&read).expect("left behind by a machine")
}

fn assert_same(one: &Simulation, other: &Simulation) {
    assert_eq!(one.time().to_bits(), other.time().to_bits());
    assert_eq!(one.sample(), other.sample());
    assert_eq!(one.energy(), other.energy());
    assert_eq!(one.last_impact(), other.last_impact());
    assert_eq!(one.impact_count(), other.impact_count());
    assert_eq!(one.pierce_count(), other.pierce_count());
}

proptest! {
    #![proptest_config(cases(600))]

    #[test]
    fn a_restored_machine_goes_on_bit_for_bit(
        scene in machines(),
        depth in -1.0..6.0f64,
        velocity in -6.0..6.0f64,
        force in -0.5..0.5f64,
        rate in -0.1..0.1f64,
        steps in 1..40u32,
    ) {
        let start = start_below(&scene, depth, velocity);
        let Ok(mut machine) = Simulation::new(&scene, InitialConditions::from(start).at_time(0.3)) else {
            return Ok(());
        };
        let step = 0.37 * scene.period();
        let mut tuned = scene.clone();
        tuned.excitation.frequency *= 1.125;
        for number in 1..=steps {
            let end = machine.time() + step;
            if number == steps / 2 {
                machine.set_force(&[force, rate]).expect("finite");
                machine.tune(&tuned).expect("valid");
            }
            machine.advance(end).expect("bounded");
        }
        let mut restored = through_bytes(&machine);
        assert_same(&machine, &restored);
        for _ in 0..10 {
            let end = machine.time() + step;
            machine.advance(end).expect("bounded");
            restored.advance(end).expect("bounded");
            assert_same(&machine, &restored);
            restored = through_bytes(&restored);
        }
    }

    /// Bytes that are not what was written lead to an error or to some machine, never to a panic.
    #[test]
    fn altered_bytes_do_no_harm(
        scene in machines(),
        place in any::<prop::sample::Index>(),
        byte in any::<u8>(),
    ) {
        let mut machine = Simulation::new(&scene, start_below(&scene, 1.0, 3.0)).expect("valid");
        machine.advance(3.0 * scene.period()).expect("bounded");
        let mut bytes = to_bytes(&machine.snapshot());
        let place = place.index(bytes.len());
        bytes[place] = byte;
        if let Ok(read) = ciborium::from_reader::<Snapshot, _>(&*bytes)
            && let Ok(mut restored) = Simulation::restored(&read)
        {
            restored.sample();
            let _ = restored.watch(restored.time() + 1e-6, &mut Effort::windows(10_000));
        }
    }
}

#[test]
fn a_snapshot_of_another_kind_is_refused() {
    let scene = Scene {
        stop: softstop::Stop::None,
        piercing: None,
        ..loaded()
    };
    let start = Start::new(3.0, 9.0);
    let mut machine = Simulation::new(&loaded(), start).expect("valid");
    while machine.sample().phase == softstop::PhaseKind::Free {
        machine.advance(machine.time() + 0.01).expect("bounded");
    }
    machine.advance(machine.time() + 1e-6).expect("bounded");
    let text = serde_json::to_string(&scene).expect("plain data");
    let bytes = to_bytes(&machine.snapshot());
    let mut value: serde_json::Value = ciborium::from_reader(&*bytes).expect("a map");
    value["scene"] = serde_json::from_str(&text).expect("JSON");
    // JSON knows no infinity; any speed will do.
    value["motion"]["bounce_train"]["slowest"] = 0.5.into();
    let read: Snapshot = ciborium::from_reader(&*to_bytes(&value)).expect("a snapshot");
    let refused = Simulation::restored(&read).expect_err("the phase is not there");
    assert!(matches!(refused, MotionError::Snapshot { .. }), "{refused}");
}
