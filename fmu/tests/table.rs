//! The table of variables.

use softstop_fmu::StartValues;
use softstop_fmu::variables::{Access, Kind, VARIABLES, by_reference, rows_of};

#[test]
fn the_table_is_sound() {
    for variable in VARIABLES {
        let name = variable.name;
        let same = VARIABLES.iter().filter(|other| other.name == name).count();
        assert_eq!(same, 1, "{name}");
        let found = by_reference(variable.reference).expect("found by reference");
        assert_eq!(found.name, name);
        let dependencies = variable.dependencies();
        for known in dependencies
            .iter()
            .flat_map(|d| d.inputs.iter().chain(d.initial))
        {
            assert!(rows_of(known).count() > 0, "{name} depends on {known}");
            assert!(rows_of(known).all(|row| !VARIABLES[row].is_output()));
        }
    }
}

#[test]
fn defaults_lie_in_their_ranges() {
    for variable in VARIABLES {
        let Access::Parameter { slot, .. } = variable.access else {
            continue;
        };
        let (value, number) = (
            StartValues::DEFAULT.get(slot),
            StartValues::DEFAULT.number(slot),
        );
        let fits = match variable.kind {
            Kind::Real(kind) => kind.contains(value),
            Kind::Count { min, max } => number >= min && max.is_none_or(|max| number <= max),
            Kind::Boolean => number == 0 || number == 1,
            Kind::Enumeration(items) => items.items.iter().any(|item| item.value == number),
        };
        assert!(fits, "{}", variable.name);
    }
}

#[test]
fn each_parameter_has_a_slot_of_its_own() {
    let slots: Vec<_> = VARIABLES
        .iter()
        .filter_map(|variable| match variable.access {
            Access::Parameter { slot, .. } => Some(slot),
            _ => None,
        })
        .collect();
    assert_eq!(slots.len(), softstop_fmu::start::SLOTS);
    for (index, slot) in slots.iter().enumerate() {
        assert!(!slots[..index].contains(slot), "{}", VARIABLES[index].name);
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
    for variable in VARIABLES {
        let next = branches(variable.name);
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
        let names: Vec<_> = rows_of(name).map(|row| VARIABLES[row].name).collect();
        let expected: Vec<_> = (1..=8).map(|number| format!("{name}[{number}]")).collect();
        assert_eq!(names, expected);
    }
}
