//! `softstop continue` as users and scripts meet it: figures of Table 1 and of Fig. 6, files, messages.

use softstop::Ratios;
use softstop_dynamics::zone::grazing_frequencies;
use softstop_testing::{Report, assert_near, has_near, number_in};

use crate::{Outcome, SOFTSTOP};

/// Asserts which special points the first branch has: symbol, parameter, tolerance.
#[track_caller]
fn has_specials(report: &Report, expected: &[(&str, f64, f64)]) {
    let specials = report.list("branches/0/specials");
    for (special, (symbol, value, tolerance)) in specials.iter().zip(expected) {
        assert_eq!(special["symbol"], *symbol);
        has_near(special, &[("value", *value, *tolerance)]);
    }
    assert!(specials.len() >= expected.len(), "{specials:?}");
}

#[test]
fn the_z_1_branch_has_the_rows_of_table_1_and_its_files() -> Outcome {
    let report = SOFTSTOP.report("continue --parameter eta --from 1.5 --to 0.9");
    // Grazing in closed form.
    let (lower, upper) = grazing_frequencies(&Ratios::unloaded().scene()?)?;
    let rows = [
        ("G", lower.ok_or("none")?, 1e-10),
        ("PD", 0.988_907, 5e-7),
        ("SN", 1.369_036, 5e-7),
        ("G", upper, 1e-10),
    ];
    has_specials(&report, &rows);
    assert_eq!(report.list("branches/0/specials").len(), rows.len());
    let fold = report.at("branches/0/specials/2");
    has_near(fold, &[("before_impact_velocities/0", 16.87, 5e-3)]);
    // At a fold 1 is a multiplier: trace = 1 + determinant.
    let [trace, determinant] =
        ["trace", "determinant"].map(|key| softstop_testing::number(fold, key));
    assert_near(trace - determinant, 1.0, 1e-9);

    let rows = report.table("branches.csv");
    let mut marked = Vec::new();
    for row in &rows {
        assert!((0.9..=1.5).contains(&number_in(row, "value")));
        let modulus = |multiplier: &str| {
            let part = |part: &str| number_in(row, &format!("{multiplier}_{part}"));
            part("real").hypot(part("imaginary"))
        };
        // Between flip and fold, on the upper side, it is stable.
        let is_stable = modulus("multiplier1") < 1.0 && modulus("multiplier2") < 1.0;
        if row["special"].is_empty() {
            assert_eq!(row["stable"].parse(), Ok(is_stable));
        } else {
            marked.push(&row["special"]);
        }
    }
    assert_eq!(marked, ["G", "PD", "SN", "G"]);
    assert_eq!(*report.at("branches/0/points"), rows.len());
    report.shows(
        "branches.svg",
        &["X′₋", "η", "fold (SN)", "period 1, stable"],
    );
    Ok(())
}

/// From the flip, the fold and an unstable orbit of a branch over the frequency on, branches over the clearance begin with them,
/// and the fold's curve over both is the same from itself.
#[test]
fn branches_begin_at_points_of_earlier_ones() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("eta.json");
    let line = "continue --parameter eta --from 0.9 --to 1.5";
    let earlier = SOFTSTOP.report(line);
    std::fs::write(&file, earlier.value.to_string())?;
    let from = |point: &str| {
        let file = file.display();
        SOFTSTOP.report(&format!(
            "continue --from-point {file}:{point} --parameter rho --from 5 --to 15"
        ))
    };
    for symbol in ["PD", "SN"] {
        has_specials(&from(symbol), &[(symbol, 10.0, 1e-9)]);
    }
    let table = earlier.at("branches/0/table");
    let stable = table["stable"].as_array().ok_or("no column")?;
    let row = stable.iter().rposition(|it| it == false).ok_or("no row")?;
    let branch = from(&(row + 1).to_string());
    let own = branch.at("branches/0/table");
    let values = own["value"].as_array().ok_or("no column")?;
    let start = values.iter().position(|it| it == 10.0).ok_or("no start")?;
    for column in ["position", "velocity"] {
        let [own, earlier] =
            [&own[column][start], &table[column][row]].map(serde_json::Value::as_f64);
        assert_near(own.ok_or("none")?, earlier.ok_or("none")?, 1e-9);
    }
    let file = file.display().to_string();
    for (more, says) in [
        (":XY", "XY: must be a row of its"),
        (
            ":SN --set stop.stiffness=3",
            "stop.stiffness: is not that of this machine",
        ),
    ] {
        let line = format!("continue --parameter rho --from 5 --to 15 --from-point {file}{more}");
        let words: Vec<&str> = softstop_testing::words(&line);
        SOFTSTOP.refuses(&words, &[says]);
    }
    Ok(())
}

#[test]
fn folds_over_clearance_are_those_of_fig_6() {
    let report = SOFTSTOP.report(
        "continue --parameter eta --from 1.1 --to 1.8 --second rho --second-from 2 --second-to 18",
    );
    let mut curves = report.list("curves/curves").iter();
    let fold = curves
        .find(|curve| curve["symbol"] == "SN")
        .expect("a fold");
    let is_rising = softstop_testing::number(fold, "from/1") < 10.0;
    let (low, high) = if is_rising {
        ("from", "to")
    } else {
        ("to", "from")
    };
    for (end, eta, rho) in [(low, 1.690_31, 2.0), (high, 1.180_34, 18.0)] {
        let places = [0, 1].map(|index| format!("{end}/{index}"));
        has_near(fold, &[(&places[0], eta, 1e-5), (&places[1], rho, 1e-9)]);
    }
    assert!(report.path("curves.csv").exists() && report.path("curves.svg").exists());
}

/// Resonant grazing of the loaded machine, where its curves of grazing, flips and folds meet; the JSON has their points.
#[test]
fn curves_tell_where_they_meet_and_have_their_points() {
    let report = SOFTSTOP.report(
        "continue loaded --parameter eta --from 0.9 --to 1.7 --second rho --second-from 2 --second-to 24",
    );
    let curves = report.list("curves/curves");
    let found = curves.iter().flat_map(|curve| {
        assert_eq!(
            curve["table"]["value"].as_array().map(Vec::len),
            Some(points(curve))
        );
        curve["specials"].as_array().expect("a list")
    });
    let mut on = Vec::new();
    for special in found.filter(|it| it["name"] == "resonant grazing") {
        has_near(
            special,
            &[
                ("values/0", 1.004_846_261_4, 1e-9),
                ("values/1", 21.832_067_109, 1e-8),
            ],
        );
        on.push(special["on"].as_str().expect("a symbol"));
    }
    on.sort_unstable();
    assert_eq!(on, ["G", "PD", "SN"]);
    let branch = report.at("branches/0");
    let marked = branch["table"]["special"]
        .as_array()
        .expect("a column")
        .iter();
    let marked: Vec<_> = marked.filter(|it| *it != "").collect();
    assert_eq!(marked, ["G", "PD", "SN", "G"]);
    report.shows("curves.svg", &["resonant grazing (RG)"]);
}

/// Symbols of the curves in two parameters with the drive periods of their orbits, sorted.
fn kinds(report: &Report) -> Vec<String> {
    let curves = report.list("curves/curves").iter();
    let kinds =
        curves.map(|it| format!("{}{}", it["symbol"].as_str().unwrap_or(""), it["periods"]));
    let mut kinds: Vec<_> = kinds.collect();
    kinds.sort_unstable();
    kinds
}

/// Special points of doubled branches begin curves, too, and those that begin none are listed.
#[test]
fn special_points_of_doubled_branches_are_followed_in_two_parameters() {
    let line = "continue --parameter eta --from 0.95 --to 1.5 --second rho --second-from 9 --second-to 11 --double 1";
    let report = SOFTSTOP.report(line);
    let specials = report.list("branches/1/specials").len();
    let of_doubled = |it: &&serde_json::Value| it["periods"] == 2;
    let curves = report.list("curves/curves").iter().filter(of_doubled);
    let not_followed = report.list("curves/not_followed").iter().filter(of_doubled);
    assert_eq!(curves.count() + not_followed.count(), specials);
    assert_eq!(kinds(&report), ["G1", "G1", "G2", "PD1", "SN1"]);
}

/// From the points of codimension two of the flips begin curves of folds, of the orbits and of those of twice the period, and
/// from a point of these another one of grazing.
#[test]
fn curves_switch_in_points_of_codimension_two() {
    let line =
        "continue --parameter eta --from 0.5 --to 2 --second rho --second-from 1 --second-to 24";
    assert_eq!(kinds(&SOFTSTOP.report(line)), ["G1", "G1", "PD1", "SN1"]);
    let report = SOFTSTOP.report(&format!("{line} --switch 3"));
    assert_eq!(
        kinds(&report),
        ["G1", "G1", "G2", "PD1", "PD2", "SN1", "SN1", "SN2", "SN4"]
    );
    report.shows("curves.svg", &["generalised flip (GPD)", "cusp (CP)"]);
}

/// At the upper graze of this machine the branch turns back in a nonsmooth fold, and no curve of folds begins there: that costs none
/// of the others.
#[test]
fn a_special_point_without_a_curve_is_told_beside_the_others() {
    let line = "continue SCENES/kelvin-voigt-zero-force.toml --parameter excitation.frequency --from 0.6 --to 1.6 \
                --second clearance --second-from 2 --second-to 18";
    let report = SOFTSTOP.report(line);
    let curves = report.list("curves/curves").iter();
    let kinds: Vec<_> = curves.map(|it| it["symbol"].as_str()).collect();
    assert_eq!(kinds, [Some("G"), Some("SN"), Some("G")]);
    let failures = report.list("curves/not_followed");
    assert_eq!(failures.len(), 1);
    assert_eq!(
        [&failures[0]["symbol"], &failures[0]["name"]],
        ["SN", "nonsmooth fold"]
    );
    has_near(&failures[0], &[("value", 1.044_440_044, 1e-8)]);
    assert!(
        failures[0]["reason"]
            .as_str()
            .is_some_and(|it| it.contains("Newton"))
    );
}

fn points(curve: &serde_json::Value) -> usize {
    softstop_testing::number(curve, "points") as usize
}

/// With m = 4 kg and k1 = 16 N/m eta = 1 is 2 rad/s.
#[test]
fn a_machine_in_si_units_is_followed_along_eta() {
    let specials = [("eta", 0.9, 1.6), ("excitation.frequency", 1.8, 3.2)].map(|(name, from, to)| {
        let line = format!(
            "continue ../docs/scenes/rigid.toml --set mass=4 --set stiffness=16 --set excitation.amplitude=16 \
             --set damping=0.32 --set excitation.frequency=2.3 --parameter {name} --from {from} --to {to}"
        );
        SOFTSTOP.report(&line).list("branches/0/specials").to_vec()
    });
    assert_eq!(specials[0], specials[1]);
    assert!(!specials[0].is_empty());
}

#[test]
fn a_mass_that_bounces_without_end_is_no_obstacle() {
    // Pressed on a stop at its place of rest; doubling there once ran without end.
    let report = SOFTSTOP.report(
        "continue --set stop.preload=1 --set rho=0 --double 1 --parameter eta --from 0.9 --to 1.5",
    );
    assert_eq!(report.at("branches/0/specials/0/symbol"), "PD");
}

#[test]
fn ranges_end_where_no_machine_is_beyond() {
    let report = SOFTSTOP.report("continue --parameter Fp --from 0 --to 200");
    report.has_near(&[
        ("branches/0/from", 0.0, 1e-12),
        ("branches/0/to", 200.0, 1e-12),
    ]);
    assert_eq!(report.at("branches/0/ends/0"), "the range ends");
}

/// A tooth between two stops, which touches neither beyond the last grazing: any place in the backlash is an orbit.
#[test]
fn a_branch_ends_where_a_free_mass_touches_nothing() -> Outcome {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/scenes/rattle.toml");
    let wide = "--set clearance=1.5 --set stop.below.clearance=1.5 --set contact.damping=20";
    let line = format!(
        "continue {scene} {wide} --orbit 2/1 --parameter excitation.frequency --from 0.2 --to 8"
    );
    let report = SOFTSTOP.report(&line);
    let mut table = csv::Reader::from_path(report.path("branches.csv"))?;
    let rows: Vec<csv::StringRecord> = table.records().collect::<Result<_, _>>()?;
    let free = rows.iter().filter(|row| &row[5] == "0");
    assert!(
        free.clone().all(|row| &row[12] == "G"),
        "{:?}",
        free.collect::<Vec<_>>()
    );
    let ends = report.list("branches/0/ends");
    assert!(
        ends.iter()
            .any(|end| end.as_str() == Some("the orbit grazes")),
        "{ends:?}"
    );
    Ok(())
}
