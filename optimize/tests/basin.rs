//! `softstop basin` as users and scripts meet it.

use std::fs;

use softstop_testing::tolerance::{GROWN, MOTION};
use softstop_testing::{Report, assert_near, has_near, number};

use crate::{Outcome, SOFTSTOP};

/// The names of the motions; their shares are all there is.
fn motions(report: &Report) -> Vec<&str> {
    let basins = report.list("basins").iter();
    let all: f64 = basins.clone().filter_map(|it| it["share"].as_f64()).sum();
    assert_near(all, 1.0, MOTION);
    let names = basins.map(|it| it["z"].as_str().or(it["kind"].as_str()));
    names.map(|name| name.expect("a name")).collect()
}

#[test]
fn point_a_has_two_basins_and_the_same_in_all_files() -> Outcome {
    let report = SOFTSTOP.report("basin --size 60");
    assert_eq!(motions(&report), ["0", "1"]);
    report.has_near(&[("basins/1/before_impact_velocity", 6.494_627_429, GROWN)]);
    let [low, share, high, integrity] = ["share_low", "share", "share_high", "integrity"]
        .map(|key| report.number(&format!("basins/1/{key}")));
    assert!(low < share && share < high && high - low < 0.04);
    assert!(0.0 < integrity && integrity < 1.0);
    report.is_in("basin.json");
    assert_eq!(report.text("basin.csv").lines().count(), 3);
    assert!(fs::read(report.path("basin.png"))?.starts_with(b"\x89PNG"));
    assert_eq!(report.names().len(), 3);
    Ok(())
}

#[test]
fn chaos_and_two_isolated_motions_are_found_side_by_side() {
    let report = SOFTSTOP.report("basin --set eta=0.9875 --x 0:15 --v=-20:20 --size 30");
    assert_eq!(motions(&report), ["2/3", "2/4", "chaos"]);
    assert_eq!(report.at("basins/1/order"), "1-1-0-0");
    assert!(report.number("basins/2/exponent") > 0.0);
}

#[test]
fn near_grazing_nearly_all_starts_lead_to_impacts() {
    let report = SOFTSTOP.report("basin --along-zone 3 --size 24");
    let certainty = [0, 1, 2].map(|place| report.number(&format!("places/{place}/certainty")));
    assert!(certainty[0] > 0.98 && certainty[2] < 0.2);
    assert!(certainty[0] > certainty[1] && certainty[1] > certainty[2]);
    assert_eq!(report.text("certainty.csv").lines().count(), 4);
    report.shows("certainty.svg", &[]);
}

/// Two motions with one impact coexist at the sixth place.
#[test]
fn the_certainty_along_a_zone_is_that_of_its_own_motion() -> Outcome {
    let machine = format!(
        "{}/tests/tasks/two_motions.toml",
        env!("CARGO_MANIFEST_DIR")
    );
    let report = SOFTSTOP.report(&format!("basin {machine} --along-zone 7 --size 30"));
    let motions = report.list("places/5/motions").iter();
    let single = motions.filter(|it| it["z"] == "1");
    let shares: Vec<f64> = single.filter_map(|it| it["share"].as_f64()).collect();
    let certainty = report.number("places/5/certainty");
    let [soft, hard] = shares[..] else {
        panic!("{shares:?}");
    };
    assert!(soft > 0.0 && certainty > 0.0);
    assert_near(certainty, hard, MOTION);
    Ok(())
}

#[test]
fn the_zone_takes_the_box_of_the_machine() {
    let report = |line: &str| SOFTSTOP.report(&format!("basin --size 4 {line}"));
    let along = report("--along-zone 2");
    assert_eq!(along.at("grid"), report("").at("grid"));
    assert_eq!(along.at("widened"), false);
    // At a frequency far below the zone motions are slower, and the box is made wider for those of the zone.
    let along = report("--set eta=0.2 --along-zone 2");
    assert_eq!(along.at("widened"), true);
    let high = "grid/up/range/1";
    assert!(along.number(high) > report("--set eta=0.2").number(high));
}

#[test]
fn the_sides_may_have_cells_of_their_own() {
    let report = SOFTSTOP.report("basin --size 12,30");
    assert_eq!(motions(&report), ["0", "1"]);
    assert_eq!(report.at("grid/across/cells"), 12);
    assert_eq!(report.at("grid/up/cells"), 30);
}

#[test]
fn a_rigid_scene_over_the_drive_angle() {
    let report = SOFTSTOP.report("basin SCENES/rigid.toml --plane phi,v --size 16");
    motions(&report);
    assert_eq!(report.at("grid/across/quantity"), "angle");
}

/// The loaded machine loses z = 1 at the fold s_SN = 1.293034; z = 0 is there before and after.
#[test]
fn attractors_along_a_parameter_keep_their_numbers() {
    let report =
        SOFTSTOP.report("basin loaded --parameter eta --from 1.29 --to 1.296 --steps 4 --size 30");
    let lives: Vec<_> = report.list("attractors").iter().collect();
    let [with, without] = ["1", "0"].map(|z| {
        let own = lives.iter().find(|it| it["motions"][0]["z"] == z);
        own.expect("an attractor")
    });
    assert_eq!(lives.len(), 2);
    has_near(with, &[("from", 1.29, MOTION), ("to", 1.292, MOTION)]);
    has_near(
        without,
        &[
            ("from", 1.29, MOTION),
            ("to", 1.296, MOTION),
            ("largest_share", 1.0, MOTION),
        ],
    );
    let basins = report.list("basins");
    assert_eq!(basins.len(), 6);
    for value in [1.29, 1.292] {
        let own = basins
            .iter()
            .filter(|it| (number(it, "value") - value).abs() < 1e-9);
        let shares: f64 = own.clone().map(|it| number(it, "share")).sum();
        assert_near(shares, 1.0, MOTION);
        for basin in own {
            assert!(number(basin, "share_low") < number(basin, "share"));
            assert!(number(basin, "boundary_entropy") > number(basin, "basin_entropy"));
        }
    }
    assert_eq!(report.text("attractors.csv").lines().count(), 7);
    report.shows(
        "attractors.svg",
        &[
            "share of the starts",
            "z = 1",
            "basin entropy",
            "integrity",
            "η",
        ],
    );
    report.is_in("attractors.json");
}

/// A parameter that others follow takes them along.
#[test]
fn attractors_are_found_along_a_tied_parameter() {
    let line = "--parameter excitation.frequency --from 0.795 --to 0.796 --steps 2 --size 20";
    let report = SOFTSTOP.report(&format!("basin ../docs/gallery/aberdeen.toml {line}"));
    let first = report
        .list("attractors")
        .iter()
        .map(|it| it["motions"][0]["z"].clone());
    let mut first: Vec<_> = first.collect();
    first.sort_by_key(ToString::to_string);
    assert_eq!(first, ["0", "3/5"]);
}
