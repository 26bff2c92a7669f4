//! What the log tells of calls that are carried out.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

use crate::common::{OK, Unit};
use softstop_fmi2::*;

/// A tolerance is of no use to an exact solution: it is taken, with a warning for those who listen.
#[test]
fn a_tolerance_has_no_effect() {
    let unit = Unit::new();
    let setup = || unsafe { fmi2SetupExperiment(unit.component, 1, 1e-4, 0.0, 0, 0.0) };
    assert_eq!(setup(), OK);
    assert!(unit.take_log().is_empty());
    assert_eq!(unit.listen("warnings"), OK);
    assert_eq!(setup(), OK);
    let lines = unit.take_log();
    let is_told = lines.len() == 1 && lines[0].starts_with("0 warnings tolerance = 1e-4");
    assert!(is_told, "{lines:?}");
}

/// The standard's names are taken as well; of lines a unit says which of its own categories they are. Importers that count in
/// nanoseconds come close to the end of the last step, not onto it: that is worth a warning, rounding is not.
#[test]
fn events_and_gaps_are_told_under_the_names_of_the_standard() {
    for (name, expected) in [
        (
            "logStatusWarning",
            &["0 warnings currentCommunicationPoint"][..],
        ),
        (
            "logEvents",
            &["0 events impacts: 2, strips pierced: 2; last impact at "],
        ),
        (
            "logAll",
            &[
                "0 events impacts: 2",
                "0 warnings currentCommunicationPoint",
            ],
        ),
    ] {
        let unit = Unit::new();
        unit.begin();
        assert_eq!(unit.listen(name), OK);
        assert_eq!(unit.step(0.0, 10.0), OK);
        assert_eq!(unit.step(10.0 + 4.0 * f64::EPSILON, 1e-3), OK);
        assert_eq!(unit.step(10.001 + 1e-9, 1e-3), OK);
        let lines = unit.take_log();
        assert_eq!(lines.len(), expected.len(), "{name}: {lines:?}");
        for (line, expected) in lines.iter().zip(expected) {
            assert!(line.starts_with(expected), "{name}: {lines:?}");
        }
    }
}
