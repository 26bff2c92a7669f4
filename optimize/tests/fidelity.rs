//! `softstop fidelity` as users and scripts meet it.

use std::f64::consts::PI;

use serde_json::Value;
use softstop_testing::tolerance::DIFFERENCED;
use softstop_testing::{Report, has_near, number, words};

use crate::SOFTSTOP;

/// Timed once only: the times are not looked at.
fn fidelity(line: &str) -> Report {
    SOFTSTOP.report(&format!("fidelity {line} --periods 50 --repeats 1"))
}

fn model<'a>(report: &'a Report, rung: &str) -> Option<&'a Value> {
    let mut models = report.list("models").iter();
    models.find(|model| model["rung"] == rung && model["matched"].is_null())
}

#[test]
fn the_answer_follows_the_tolerance() {
    let named = |tolerance: &str| fidelity(&format!("B --tolerance {tolerance}"));
    let strict = named("1e-6");
    assert_eq!(strict.at("cheapest/rung"), "full");
    assert_eq!(strict.at("cheapest_is_scene"), true);
    strict.has_near(&[("value", 8.398_675_591_86, 1e-9)]);
    let fair = named("0.02");
    assert_eq!(fair.at("cheapest/rung"), "kelvinVoigt");
    assert_eq!(fair.at("cheapest/matched"), "duration");
    assert_eq!(fair.at("cheapest_is_scene"), false);
    assert_eq!(named("0.5").at("cheapest/rung"), "rigid");
    let linear = model(&fair, "linear").expect("linear");
    assert!(linear["error"].is_null());
    assert_eq!([&linear["kind"], &linear["z"]], ["periodic", "0"]);
}

#[test]
fn grazing_needs_no_stop_at_all() {
    let report = fidelity("B --quantity grazing-frequency --tolerance 0");
    assert_eq!(report.at("cheapest/rung"), "linear");
}

#[test]
fn a_spring_stop_is_a_spring_stop() {
    let report = fidelity("SCENES/kelvin-voigt.toml --tolerance 0");
    assert_eq!(report.at("cheapest/rung"), "kelvinVoigt");
    assert_eq!(report.at("cheapest_is_scene"), true);
    assert!(model(&report, "preloaded").is_none() && model(&report, "full").is_none());
}

#[test]
fn a_stiff_stop_may_be_taken_as_rigid() {
    let report = fidelity("SCENES/stiff.toml --tolerance 0.01");
    assert_eq!(report.at("cheapest/rung"), "rigid");
    let zeta: f64 = 0.09;
    let expected = (-PI * zeta / (1.0 - zeta * zeta).sqrt()).exp();
    let rigid = model(&report, "rigid").expect("rigid");
    has_near(
        rigid,
        &[("machine/parameters/stop.restitution", expected, 1e-9)],
    );
}

#[test]
fn a_rigid_scene_says_why_it_has_no_soft_models() {
    let report = fidelity("SCENES/rigid.toml");
    let unmatched = report.list("unmatched");
    assert_eq!(unmatched.len(), 4, "two models of two rungs");
    for missing in unmatched {
        let reason = missing["reason"].as_str().expect("a reason");
        assert!(reason.contains("takes no way and no time"), "{reason}");
    }
}

#[test]
fn structure_compares_the_regimes() {
    let report = fidelity("A --structure --points 7 --match duration");
    let tracks = report.list("structure");
    let track = |rung: &str| {
        tracks
            .iter()
            .find(|track| track["rung"] == rung)
            .expect("a track")
    };
    let fold = ("fold_frequency", 1.369_036, DIFFERENCED);
    has_near(track("preloaded"), &[("same_regime", 1.0, 0.0), fold]);
    assert!(number(track("linear"), "same_regime") < 0.7);
    assert_eq!(track("linear")["sequence_flung"], serde_json::json!(["0"]));
    let table = report.text("structure.csv");
    assert!(table.starts_with("rung,matched,start,frequency,kind,z\n"));
    assert_eq!(table.lines().count(), 1 + tracks.len() * 2 * 7);
    report.shows(
        "structure.svg",
        &["kelvinVoigt (duration)", "from rest", ">z = 0<", ">z = 1<"],
    );
    let chart = report.text("structure.svg");
    assert!(
        !chart.contains("does not repeat"),
        "the legend tells what occurs"
    );
}

#[test]
fn files_are_whole_and_text_names_the_model() {
    let line = "fidelity B --tolerance 0.02 --periods 10";
    let report = SOFTSTOP.report(line);
    let into = format!("{line} --output {}", report.folder.path().display());
    let text = SOFTSTOP.text(&words(&into));
    let told = "The cheapest model within 0.02: kelvinVoigt (duration).";
    assert!(text.contains(told), "{text}");
    let rows = report.text("fidelity.csv").lines().count();
    assert_eq!(rows, 1 + 9 * 11, "every quantity of every model");
    report.shows("fidelity.svg", &["tolerance 0.02"]);
    assert_eq!(report.names().len(), 2);
}

#[test]
fn predictive_models_know_nothing_of_the_motion() {
    let restitution = |report: &Report| {
        let rigid = model(report, "rigid").expect("rigid");
        number(rigid, "machine/parameters/stop.restitution")
    };
    let predicted = restitution(&fidelity("B --predictive"));
    assert!(predicted < restitution(&fidelity("B")) - 0.05);
}
