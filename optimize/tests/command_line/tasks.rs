//! Tasks in the user's words, and what they do.

use serde_json::Value;
use softstop_testing::{Report, assert_near, has_near, number};

use super::SOFTSTOP;

/// The press of the refusals.
const PRESS: &str = include_str!("../refusals/press.toml");

/// What is searched if nothing else is said.
const VARY: &str = "[vary]\nclearance = [0.006, 0.012]\nexcitation.frequency_hz = [10, 40]\n";

/// Runs a task; its report, and the task's own file beside those of the design.
fn run(more: &str) -> Report {
    let line = "optimize FILE --no-report --samples 4096";
    SOFTSTOP.report_of("press.toml", &format!("{PRESS}{more}"), line)
}

fn requirement<'a>(report: &'a Report, name: &str) -> &'a Value {
    let mut all = report.list("requirements").iter();
    all.find(|it| it["name"] == name).unwrap_or(&Value::Null)
}

#[test]
fn requirements_are_met_and_told_in_the_machines_units() {
    let report = run(&format!(
        "{VARY}[require]\nmargin_sn = 0.5\nmargin_g0 = 0.3\nstop_force = 4.6e5\ncut_through = 5e-4\n\
         velocity = {{ least = 2 }}\nlargest_multiplier = 0.95\n"
    ));
    for name in [
        "margin_sn",
        "margin_g0",
        "stop_force",
        "cut_through",
        "velocity",
    ] {
        let one = requirement(&report, name);
        assert_eq!(one["met"], true, "{name}: {one}");
        assert!(number(one, "margin") >= 0.0, "{name}");
    }
    let below = report.number("design/frequency_sn") - report.number("design/frequency");
    let margin = requirement(&report, "margin_sn");
    has_near(margin, &[("value", below, 1e-9)]);
    assert_eq!(margin["unit"], "Hz");
}

/// What nothing bounds has no value, and a reason; the margin is asked for if nothing else is.
#[test]
fn what_nothing_bounds_is_told_in_words() {
    let report = run(
        "[vary]\nclearance = [0.008, 0.009]\n[require]\nclearance_margin_pd = 0.001\nmargin = 0.3\n\
         certainty = 0.1\n",
    );
    let flip = requirement(&report, "clearance_margin_pd");
    assert!(
        flip["value"].is_null() && flip["margin"].is_null(),
        "{flip}"
    );
    let margin = requirement(&report, "margin");
    has_near(margin, &[("value", 0.3, 1e-9)]);
    assert_eq!((&flip["met"], &margin["met"]), (&true.into(), &true.into()));
    let certainty = requirement(&report, "certainty");
    for (one, told) in [
        (flip, "no flip on this branch"),
        (certainty, "1024 starts in "),
    ] {
        let note = one["note"].as_str().expect("a note");
        assert!(note.contains(told), "{note}");
    }
}

#[test]
fn catalogues_and_links_hold() {
    let report = run(
        "[vary]\nclearance = [0.006, 0.012]\nstop.stiffness = { values = [1e7, 1.3e7, 1.7e7] }\n\
         contact.damping = { follows = \"stop.stiffness\", factor = 1.8e-4 }\n[require]\nmargin_sn = 0.5\n",
    );
    let parameters = report.at("design/machine/parameters");
    let stiffness = number(parameters, "stop.stiffness");
    assert!([1e7, 1.3e7, 1.7e7].contains(&stiffness), "{stiffness}");
    let damping = number(parameters, "contact.damping");
    assert_near(damping, 1.8e-4 * stiffness, 1e-9 * stiffness);
}

/// Tolerances as shares, that of the drive's speed among them, are those of the design: none of its machines is lost.
#[test]
fn machines_within_the_tolerances_keep_the_motion() {
    let report = run(&format!(
        "{VARY}[tolerance]\nclearance = \"2 %\"\nstop.stiffness = \"3 %\"\n\
         excitation.frequency_hz = \"0.5 %\"\n"
    ));
    let machines = report.at("tolerances/machines");
    assert_eq!(machines["lost"], 0, "{machines}");
    assert!(number(machines, "factor") > 1.0 - 1e-6, "{machines}");
}

/// More axes than a lattice of few points has dimensions.
#[test]
fn many_axes_are_searched_with_few_zones() {
    let plain = run("");
    let names = "mass stiffness damping clearance contact.damping excitation.amplitude stop.stiffness \
                 piercing.stiffness";
    let range = |name: &str| {
        let value = number(plain.at("design/machine/parameters"), name);
        format!("{name} = [{}, {}]\n", 0.98 * value, 1.02 * value)
    };
    let vary: String = names.split_whitespace().map(range).collect();
    let report = run(&format!("[vary]\n{vary}"));
    assert!(report.number("design/before_impact_velocity") > 0.0);
}

/// The files of a design are the same machine, and every command reads the task's file as its machine.
#[test]
fn a_design_loads_in_every_command() {
    let report = run(&format!("{VARY}[require]\nmargin_sn = 0.5\n"));
    let orbit = SOFTSTOP.value(&format!("orbit {}", report.path("design.toml").display()));
    let own = report.number("design/before_impact_velocity");
    has_near(&orbit, &[("before_impact_velocity", own, 1e-9 * own)]);
    SOFTSTOP.value(&format!("zone {}", report.path("press.toml").display()));
}

/// The least drive force for a velocity: the requirement holds the design.
#[test]
fn the_least_drive_force_for_a_velocity() {
    let report = run(
        "[vary]\nclearance = [0.006, 0.012]\nexcitation.amplitude = [4000, 12000]\n\
         [objective]\nminimise = \"drive_force\"\n[require]\nvelocity = 5\nmargin_sn = 0.5\n",
    );
    has_near(requirement(&report, "velocity"), &[("value", 5.0, 1e-6)]);
    let force = report.number("design/machine/parameters/excitation.amplitude");
    assert!((4000.0..9000.0).contains(&force), "{force}");
}
