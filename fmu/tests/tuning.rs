//! Parameters that are tuned.

use softstop_fmi::variable::Access;
use softstop_fmi::{Imprint, Unit};
use softstop_fmu::{Machine, table};

fn output(machine: &Machine, name: &str) -> f64 {
    match table().by_name(name).map(|row| &row.access) {
        Some(Access::Continuous { value, .. }) => value(machine),
        _ => panic!("{name} is no continuous output"),
    }
}

/// Of values that cannot be none is taken over.
#[test]
fn what_is_refused_leaves_no_trace() {
    let slot = |name: &str| {
        let row = table().by_name(name);
        row.and_then(|row| row.slot()).expect("a parameter").0
    };
    for takes in ["drive.takes.speed", "drive.takes.amplitude"] {
        let mut values = Imprint::<Machine>::library().values().to_vec();
        values[slot(takes)] = 1.0;
        let mut machine = Machine::begin(&values, 0.0).expect("a machine");
        let names = ["drive.force", "drive.angle", "drive.power", "acceleration"];
        let before = names.map(|name| output(&machine, name));
        values[slot("excitation.amplitude")] = 5.0;
        values[slot("excitation.frequency")] = 3.0;
        values[slot("mass")] = -1.0;
        assert!(machine.tune(&values).is_err());
        assert_eq!(names.map(|name| output(&machine, name)), before, "{takes}");
    }
}
