//! Arrays of parameters as one variable each.

use softstop_fmi3::*;
use softstop_fmu::{Options, table};

use super::unit::Unit;
use crate::common::{OK, reference};

/// The value reference of `stop.loading.stiffness`, and how many elements it has.
pub const STIFFNESS: u32 = 40;
pub const ELEMENTS: usize = 8;
const FROM: u32 = 32;

const WITH_ARRAYS: Options = Options {
    exchange: false,
    clock: false,
    arrays: true,
};

const FROMS: [f64; ELEMENTS] = [0.0, 0.2, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0];
const STIFFNESSES: [f64; ELEMENTS] = [7.0, 9.0, 20.0, 50.0, 60.0, 70.0, 80.0, 90.0];

const MACHINE: [(&str, f64); 5] = [
    ("stop.model", 3.0),
    ("stop.loading.count", 4.0),
    ("clearance", 8.0),
    ("piercing.thickness", 0.0),
    ("piercing.travel", 0.0),
];

/// One instance that is told of arrays, and one that is told of elements.
fn both(initial: &[(&str, f64)]) -> [Unit; 2] {
    let units = [
        Unit::made((false, false), None, WITH_ARRAYS),
        Unit::new((false, false)),
    ];
    for (array, values) in [(FROM, &FROMS), (STIFFNESS, &STIFFNESSES)] {
        let elements: Vec<_> = (array..).take(ELEMENTS).collect();
        for (unit, of) in units.iter().zip([&[array][..], &elements]) {
            let (instance, values) = (unit.instance, values.as_ptr());
            // SAFETY: arrays as long as is said.
            let status =
                unsafe { fmi3SetFloat64(instance, of.as_ptr(), of.len(), values, ELEMENTS) };
            unit.check(status);
        }
    }
    for unit in &units {
        for (name, value) in MACHINE.iter().chain(initial) {
            unit.check(unit.set(name, *value));
        }
    }
    units
}

#[test]
fn an_array_is_its_elements_in_one_piece() {
    let units = both(&[]);
    let mut values = [f64::NAN; ELEMENTS + 2];
    let mixed = [reference("clearance"), STIFFNESS, reference("mass")];
    // SAFETY: arrays as long as is said.
    let (place, count) = (values.as_mut_ptr(), values.len());
    units[0].check(unsafe { fmi3GetFloat64(units[0].instance, mixed.as_ptr(), 3, place, count) });
    assert_eq!(
        (values[0], &values[1..=ELEMENTS], values[9]),
        (8.0, &STIFFNESSES[..], 1.0)
    );
    for unit in &units {
        unit.initialize(&[]);
        unit.step(0.0, 40.0);
    }
    let rest = table().rows().filter(|row| row.element().is_none());
    for row in rest {
        let [one, other] = [0, 1].map(|unit: usize| units[unit].read(row));
        assert_eq!(
            (one.0, one.1.to_bits()),
            (OK, other.1.to_bits()),
            "{}",
            row.name
        );
    }
    assert!(units[0].get("impact.count") > 3.0);
}

#[test]
fn derivatives_by_an_array_are_those_by_its_elements() {
    // Within the third slope.
    let [whole, elements] = both(&[("initial.position", 8.7), ("initial.velocity", 1.0)]);
    let of = ["acceleration", "energy.mechanical"].map(reference);
    let by: Vec<_> = (STIFFNESS..).take(ELEMENTS).collect();
    for unit in [&whole, &elements] {
        // SAFETY: the instance is alive.
        unit.check(unsafe { fmi3EnterInitializationMode(unit.instance, 0, 0.0, 0.0, 0, 0.0) });
    }
    let seed: Vec<_> = (0..ELEMENTS).map(|k| 1.0 + k as f64).collect();
    let along = whole.directional(&of, &[STIFFNESS], &seed);
    assert_eq!(along, elements.directional(&of, &by, &seed));
    let gradient = whole.adjoint_of(&of, &[STIFFNESS], &[1.0, 0.5], ELEMENTS);
    assert_eq!(gradient, elements.adjoint(&of, &by, &[1.0, 0.5]));
    assert!(gradient[..3].iter().all(|by| *by != 0.0) && gradient[3..] == [0.0; 5]);
}
