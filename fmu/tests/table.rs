//! The table of variables.

use softstop_fmi::variable::Kind;
use softstop_fmu::{StartValues, slot, table};

#[test]
fn the_table_is_sound() {
    for variable in table().rows() {
        let name = variable.name;
        let same = table().rows().filter(|other| other.name == name).count();
        assert_eq!(same, 1, "{name}");
        let found = table()
            .by_reference(variable.reference)
            .expect("found by reference");
        assert_eq!(found.name, name);
        let dependencies = variable.dependencies();
        for known in dependencies
            .iter()
            .flat_map(|d| d.inputs.iter().chain(d.initial))
        {
            assert!(
                table().rows_of(known).count() > 0,
                "{name} depends on {known}"
            );
            assert!(table().rows_of(known).all(|(_, row)| !row.is_output()));
        }
    }
}

#[test]
fn defaults_lie_in_their_ranges() {
    for variable in table().rows() {
        let Some(slot) = variable.slot() else {
            continue;
        };
        let value = StartValues::DEFAULT.get(slot);
        let fits = match variable.kind {
            Kind::Boolean => value == 0.0 || value == 1.0,
            kind => kind.contains(value),
        };
        assert!(fits, "{}", variable.name);
    }
}

#[test]
fn each_value_has_a_slot_of_its_own() {
    let slots: Vec<_> = table().rows().filter_map(|row| row.slot()).collect();
    assert_eq!(slots.len(), slot::SLOTS);
    for (index, slot) in slots.iter().enumerate() {
        assert!(
            slot.0 < slot::SLOTS && !slots[..index].contains(slot),
            "{slot:?}"
        );
    }
}

/// Structured naming: each branch of the tree in one piece, the elements of an array in order.
#[test]
fn rows_stand_depth_first() {
    let branches = |name: &str| -> Vec<String> {
        let ends = name.match_indices(['.', '[']).map(|(end, _)| end);
        ends.map(|end| name[..end].to_owned()).collect()
    };
    let mut left = Vec::<String>::new();
    let mut present = Vec::<String>::new();
    for variable in table().rows() {
        let next = branches(variable.name);
        let is_leaf = |branch: &String| table().by_name(branch).is_some();
        assert!(
            !next.iter().any(is_leaf),
            "{} is below a leaf",
            variable.name
        );
        left.extend(
            present
                .iter()
                .filter(|branch| !next.contains(branch))
                .cloned(),
        );
        for branch in &next {
            assert!(!left.contains(branch), "{} comes late", variable.name);
        }
        present = next;
    }
}

#[test]
fn elements_are_numbered_from_one() {
    for name in [
        "stop.loading.from",
        "stop.loading.stiffness",
        "stop.unloading.from",
        "stop.unloading.stiffness",
    ] {
        let names: Vec<_> = table().rows_of(name).map(|(_, row)| row.name).collect();
        let expected: Vec<_> = (1..=8).map(|number| format!("{name}[{number}]")).collect();
        assert_eq!(names, expected);
    }
}
