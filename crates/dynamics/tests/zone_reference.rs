//! Grazing boundary and fold against 30-digit values.

use softstop::{Ratios, Scene};
use softstop_dynamics::zone::{grazing_frequencies, hysteresis, stable_ranges};
use softstop_testing::reference::{MACHINE, list, number, ratios};
use softstop_testing::tolerance::{DIFFERENCED, GROWN, ROUNDING, SOLVED};
use softstop_testing::{assert_near, is_near};

fn scene(ratios: &Ratios) -> Scene {
    ratios.scene().expect("valid")
}

#[test]
fn grazing_is_closed_form() {
    for expected in list(&MACHINE, "boundaries") {
        let machine = Ratios {
            clearance: number(expected, "clearance"),
            damping: number(expected, "damping"),
            ..Ratios::unloaded()
        };
        let (below, above) = grazing_frequencies(&scene(&machine)).expect("a boundary");
        assert_near(above, number(expected, "frequency_g0"), ROUNDING);
        match (below, expected["frequency_low"].is_null()) {
            (Some(below), false) => {
                assert_near(below, number(expected, "frequency_low"), ROUNDING);
            }
            (None, true) => {}
            other => panic!("{other:?} against {expected}"),
        }
    }
}

/// At rho = 22 the loaded machine's z = 1 motion at g0 ends otherwise than in a fold: the
/// reference's fold lies below g0.
fn has_no_zone(ratios: &Ratios) -> bool {
    ratios.piercing.is_some() && ratios.clearance == 22.0
}

#[test]
fn folds_agree_with_thirty_digits() {
    let mut compared = 0;
    for expected in list(&MACHINE, "folds") {
        let ratios = ratios(expected.get("parameters").unwrap_or(expected));
        let Ok(zone) = hysteresis(&scene(&ratios)) else {
            assert!(has_no_zone(&ratios), "no zone at {ratios:?}");
            continue;
        };
        compared += 1;
        assert!(
            is_near(
                zone.high.frequency,
                number(expected, "frequency_sn"),
                SOLVED
            ),
            "frequency of {expected}"
        );
        assert!(
            is_near(
                zone.high.point.before_impact_velocity(),
                number(expected, "velocity_sn"),
                DIFFERENCED
            ),
            "velocity of {expected}"
        );
    }
    assert_eq!(compared, list(&MACHINE, "folds").len() - 1);
}

#[test]
fn orbits_within_the_zone_agree_with_thirty_digits() {
    let records = list(&MACHINE, "zone");
    let mut compared = 0;
    for expected in records.iter().filter(|record| record["stable"] == true) {
        let clearance = number(expected, "clearance");
        let loaded = expected["regime"] == "loaded";
        let base = if loaded {
            Ratios::loaded()
        } else {
            Ratios::unloaded()
        };
        let ratios = Ratios { clearance, ..base };
        let Ok(zone) = hysteresis(&scene(&ratios)) else {
            assert!(has_no_zone(&ratios), "no zone at {ratios:?}");
            continue;
        };
        let orbit = zone.orbit_at(number(expected, "s")).expect("an orbit");
        let velocity = number(expected, "before_impact_velocity");
        let error = orbit.before_impact_velocity() - velocity;
        // Below this clearance two stable z = 1 motions coexist in a part of the zone; the
        // reference follows one of them, the zone gives the stronger.
        let unique = clearance >= 1.5;
        let agrees = is_near(error, 0.0, GROWN) || (!unique && error > 0.0);
        assert!(agrees, "{expected}: {error:e} off");
        compared += 1;
    }
    assert!(
        compared > 50,
        "only {compared} of {} compared",
        records.len()
    );
}

/// The highest before-impact velocity along a zone lies before its fold.
#[test]
fn peaks_agree_with_thirty_digits() {
    let peaks = list(&MACHINE, "peaks");
    assert!(peaks.len() >= 11);
    for expected in peaks.iter().filter(|peak| number(peak, "clearance") > 1.5) {
        let loaded = expected["regime"] == "loaded";
        let base = if loaded {
            Ratios::loaded()
        } else {
            Ratios::unloaded()
        };
        let clearance = number(expected, "clearance");
        let machine = scene(&Ratios { clearance, ..base });
        let zone = hysteresis(&machine).expect("a zone");
        let share = |frequency: f64| {
            (frequency - zone.frequency_g0) / (zone.high.frequency - zone.frequency_g0)
        };
        let velocity = |share: f64| {
            zone.orbit_at(share)
                .expect("an orbit")
                .before_impact_velocity()
        };
        let peak = share(number(expected, "frequency"));
        let highest = velocity(peak);
        assert!(
            is_near(
                highest,
                number(expected, "before_impact_velocity"),
                10.0 * SOLVED
            ),
            "{expected}"
        );
        let stable_ranges = stable_ranges(&machine).expect("stable_ranges");
        let tops = stable_ranges.iter().filter(|one| one.is_part_of(&zone));
        let tops = tops.map(|one| one.hardest.before_impact_velocity());
        assert_near(tops.fold(0.0, f64::max), highest, 10.0 * SOLVED);
        assert!(velocity(peak - 1e-3) < highest && velocity(peak + 1e-3) < highest);
    }
}
