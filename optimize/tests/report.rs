//! The report of a run: text, JSON, tables and the page state the same; the page is whole, alone, and of what there is.

use std::fs;

use approx::assert_relative_eq;
use quick_xml::Reader;
use quick_xml::events::Event;
use serde_json::json;
use softstop_testing::{Report, files, number, words};

use crate::{Outcome, SOFTSTOP};

/// A press with a strip of 2 mm, as its user states it, with its task.
const PRESS: &str = "\
name = \"press <1> & co\"
mass = 120.0
stiffness = 2.4e6
damping = 680.0
clearance = 0.02
contact.damping = 3060.0
excitation = { amplitude = 9e3, frequency_hz = 24.0 }
stop = { model = \"preloaded\", stiffness = 1.68e7, preload_deflection = 0.02 }
piercing = { stiffness = 4.8e6, friction = 2.4e6, thickness = 0.002, travel = 0.001 }
[vary]
stop.stiffness = [5e6, 8e7]
clearance = [0.005, 0.04]
excitation.frequency_hz = [10, 40]
contact.damping = { follows = \"stop.stiffness\", factor = 1.8e-4 }
[tolerance]
clearance = 2e-4
damping = \"10 %\"
[objective]
maximise = \"impact_energy\"
[require]
stop_force = 5e5
cut_through = 5e-4
[report]
author = \"A. Engineer\"
date = 2026-11-26
";
/// Of these bytes, by `sha256sum`.
const HASH: &str = "1fd602f7e28bfe7991bfb240022e846c75f81bde1e874c21fbdacdb3959baece";

/// What a run has told, and written.
pub struct Written {
    pub text: String,
    pub page: String,
    pub report: Report,
}

fn optimize(line: &str) -> Outcome<Written> {
    design(&format!("{line} --evaluations 100 --samples 256"))
}

pub fn design(line: &str) -> Outcome<Written> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().display();
    let line = format!("optimize {line} --output {path}");
    let text = SOFTSTOP.text(&words(&line));
    let read = |name: &str| fs::read_to_string(folder.path().join(name));
    Ok(Written {
        text,
        page: read("report.html").unwrap_or_default(),
        report: Report {
            value: serde_json::from_str(&read("design.json")?)?,
            folder,
        },
    })
}

/// Reads a page to its end; how often each element begins.
fn count(page: &str, name: &str) -> Outcome<usize> {
    let mut reader = Reader::from_str(page);
    let (mut found, mut depth) = (0, 0);
    loop {
        match reader.read_event()? {
            Event::Start(tag) => {
                found += usize::from(tag.name().as_ref() == name);
                depth += 1;
            }
            Event::Empty(tag) => found += usize::from(tag.name().as_ref() == name),
            Event::End(_) => depth -= 1,
            Event::Eof => break,
            _ => {}
        }
    }
    assert_eq!(depth, 0, "all is closed");
    Ok(found)
}

/// Nothing from elsewhere, nothing that is no number.
fn stands_alone(page: &str) {
    let without = page.replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
    let without = without.replace("xmlns=\"http://www.w3.org/1999/xhtml\"", "");
    for foreign in [
        "http:", "https:", "src=", "href=", "@import", "url(", "<script", "NaN", "inf",
    ] {
        let place = without.find(foreign);
        let around = place.map(|at| without[..at].chars().rev().take(300).collect::<Vec<_>>());
        let around = around.map(|letters| letters.into_iter().rev().collect::<String>());
        assert_eq!(around, None, "{foreign}");
    }
}

/// A table as rows of cells under their heads.
fn table(report: &Report, name: &str) -> Outcome<Vec<csv::StringRecord>> {
    let mut reader = csv::Reader::from_path(report.path(name))?;
    let head = reader.headers()?.clone();
    let rows = reader.records().collect::<Result<Vec<_>, _>>()?;
    assert!(!rows.is_empty(), "{name}");
    Ok([vec![head], rows].concat())
}

#[test]
fn a_report_of_a_press_is_whole_and_stands_alone() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("press.toml");
    fs::write(&file, PRESS)?;
    let Written { text, page, report } = &optimize(&file.display().to_string())?;
    // Kept to be looked at.
    fs::write(concat!(env!("CARGO_TARGET_TMPDIR"), "/report.html"), page)?;
    stands_alone(page);
    // The policy comes before what it allows: styles in the page, and nothing from elsewhere.
    let policy = page.find("content=\"default-src 'none'; style-src 'unsafe-inline'");
    assert!(
        policy.is_some() && policy < page.find("<style>"),
        "{policy:?}"
    );
    assert_eq!(report.list("requirements").len(), 2);
    assert_eq!(page.matches("class=\"requirement\"").count(), 2);
    assert_eq!(count(page, "section")?, 11);
    // Response, motion and portrait are drawn for narrow screens, too.
    let [narrow, sources] =
        ["narrow", "source"].map(|it| page.matches(&format!("class=\"{it}\"")).count());
    assert_eq!((narrow, sources), (3, 2));
    assert_eq!(count(page, "figure")?, count(page, "svg")? - narrow + 2);
    for told in [
        "<h1>press &lt;1&gt; &amp; co</h1>",
        "s<sub>SN</sub>",
        "A. Engineer",
        "2026-11-26",
        HASH,
        "maximise = &quot;impact_energy&quot;",
        "mass 120\u{a0}kg",
        "(follows stop.stiffness)",
        "(sought)",
    ] {
        assert!(page.contains(told), "{told}");
    }
    assert_eq!(report.at("report/date"), "2026-11-26");
    assert_eq!(report.at("objective/figure"), "impact_energy");
    for told in [
        "follows stop.stiffness",
        "kinetic energy before the impact",
        "Kinetic energy before the impact: without tolerances ",
        "sought",
    ] {
        assert!(text.contains(told), "{told}");
    }
    tables(report)
}

/// The tables hold what JSON does, rows have all columns, and numbers in them are numbers.
fn tables(report: &Report) -> Outcome {
    for name in report.names().iter().filter(|name| name.ends_with(".csv")) {
        table(report, name)?;
        let text = report.text(name);
        assert!(!text.contains("NaN") && !text.contains("inf"), "{name}");
    }
    let comparison = table(report, "comparison.csv")?;
    assert_eq!(comparison.len(), report.list("comparison").len() + 1);
    let requirements = table(report, "requirements.csv")?;
    assert_eq!(&requirements[0][0], "name");
    // Two periods of the drive, in each of which the force reaches its peak.
    let motion = table(report, "motion.csv")?;
    let number = |row: &csv::StringRecord, column: usize| row[column].parse::<f64>();
    let end = number(&motion[motion.len() - 1], 0)?;
    let periods = end * report.number("design/frequency");
    assert!((periods - 2.0).abs() < 1e-9, "{periods}");
    let peak = value_of(report, "stop_force")?;
    let mut peaks = [0.0f64; 2];
    for row in &motion[1..] {
        let period = usize::from(number(row, 0)? > 0.5 * end);
        peaks[period] = peaks[period].max(number(row, 3)?);
    }
    for found in peaks {
        assert!(
            (found / peak - 1.0).abs() < 1e-3 && found <= peak * (1.0 + 1e-9),
            "{found} {peak}"
        );
    }
    Ok(())
}

/// A task makes the same page at any time.
#[test]
fn what_is_absent_is_left_out_with_its_heading() -> Outcome {
    let line = "unloaded --vary stop.stiffness=7 --vary clearance=9:11 --margin 0";
    let [Written { page, report, .. }, again] = [optimize(line)?, optimize(line)?];
    assert_eq!(page, again.page);
    stands_alone(&page);
    for id in ["requirements", "tolerances", "sensitivities"] {
        assert!(!page.contains(&format!("id=\"{id}\"")), "{id}");
        assert!(!report.path(&format!("{id}.csv")).exists(), "{id}");
    }
    assert!(page.contains("--vary clearance=9:11"));
    assert!(page.contains("paper&#x27;s A"));
    Ok(())
}

/// In ratios, with m = k1 = F0 = 1, a preload is the deflection times the stiffness of the stop, in every column.
#[test]
fn preloads_of_ratio_machines_are_of_one_kind_in_a_row() -> Outcome {
    let vary = "--vary stop.stiffness=2:3 --vary clearance=10:12 --no-report";
    for (machine, deflection) in [("unloaded", 10.0), ("loaded", 4.0), ("loaded", 0.0)] {
        let set = format!("stop.preload_deflection={deflection}");
        let report = optimize(&format!("{machine} --set {set} {vary}"))?.report;
        let rows = report.list("comparison");
        let row = |name: &str| {
            rows.iter()
                .find(|row| row["quantity"] == name)
                .ok_or("a row")
        };
        let stiffness = row("stiffness of the stop")?;
        let (force, bend) = (
            row("preload of the stop")?,
            row("preload of the stop as a deflection")?,
        );
        for column in ["design", "A", "B"] {
            let [force, bend, stiffness] = [force, bend, stiffness].map(|row| number(row, column));
            assert_relative_eq!(force, bend * stiffness, max_relative = 1e-12);
            assert!(column == "design" || (force - 70.0).abs() < 1e-12);
        }
        assert_eq!(bend["design"], deflection);
        let limit = report.at("design/at_limits/0");
        assert_eq!(limit, "stop.stiffness: lower bound");
    }
    Ok(())
}

/// Where a range spans decades, so does the axis of its map, whose rows are a constant factor apart.
#[test]
fn maps_of_decades_are_logarithmic() -> Outcome {
    let line = "unloaded --vary stop.stiffness=1:2000 --vary clearance=10";
    let report = optimize(line)?.report;
    let map = table(&report, "map-1.csv")?;
    let stiffness = map[1..].iter().map(|row| row[1].parse::<f64>());
    let mut stiffness = stiffness.collect::<Result<Vec<_>, _>>()?;
    stiffness.dedup();
    assert_eq!(stiffness.len(), 40);
    for pair in stiffness.windows(2) {
        let rows = (pair[1] / pair[0]).ln() / 2000f64.ln();
        assert!((rows * 40.0 - 1.0).abs() < 1e-9, "{pair:?}");
    }
    report.shows(
        "map-1.svg",
        &[">10⁰</text>", ">10¹</text>", ">10²</text>", ">10³</text>"],
    );
    Ok(())
}

/// An older result is not taken for a new one.
/// A report and its tables do not stay beside the design of a later run without them; a file that no run has written does.
#[test]
fn files_in_place_of_older_ones_and_removed_ones_are_told() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().to_str().ok_or("path")?;
    let line = "optimize --vary stop.stiffness=7 --vary clearance=9:11 --evaluations 100 --output";
    let line = Vec::from_iter(line.split(' ').chain([path]));
    let own = folder.path().join("own.csv");
    let (first, tables) = (SOFTSTOP.text(&line), files(folder.path()).len());
    fs::write(&own, "1,2\n")?;
    let second = SOFTSTOP.text(&[&line[..], &["--no-report"]].concat());
    let older = [first, second.clone()].map(|it| it.matches(", in place of an older one)").count());
    assert_eq!(older, [0, 5]);
    assert_eq!(second.matches(" (of an earlier run)").count(), tables - 5);
    assert_eq!(files(folder.path()).len(), 5 + 1);
    assert!(own.exists());
    Ok(())
}

/// A soft stop without preload: a zone of 3e-4 of its frequency.
#[test]
fn a_zone_that_hardly_a_drive_can_hold_is_warned_of() -> Outcome {
    let line = "loaded --vary clearance=12 --vary stop.stiffness=1 --set stop.preload=0";
    let Written { text, page, report } = optimize(line)?;
    let warning = report.at("warnings/0").as_str().ok_or("a warning")?;
    let told = "of its frequency: hardly a drive keeps within it";
    assert!(
        warning.starts_with("the zone is ") && warning.contains(told),
        "{warning}"
    );
    assert!(warning.contains("require.margin_g0"), "{warning}");
    assert!(text.contains(&format!("Warning: {warning}.")));
    assert_eq!(page.matches(told).count(), 1);
    Ok(())
}

#[test]
fn starts_that_the_evaluations_leave_out_are_counted() -> Outcome {
    let Written { text, report, .. } = optimize("loaded --no-report")?;
    assert_eq!(report.number("search/ascents/left_out"), 2.0);
    let told = "each ascent counts as 80 zones, so that 2 further starts are left out";
    assert!(text.contains(told), "{text}");
    assert_eq!(report.value.get("warnings"), None);
    Ok(())
}

/// Nothing is ever in contact with a rigid stop, so its damping there changes nothing; the clearance does.
#[test]
fn what_is_searched_without_effect_is_named() -> Outcome {
    let line = "../docs/scenes/rigid.toml --no-report --vary clearance=5:20";
    let Written { text, report, .. } = optimize(&format!("{line} --vary contact.damping=0:1"))?;
    assert_eq!(report.at("without_effect"), &json!(["contact.damping"]));
    let told = "Without effect on what is sought and required of the motion: contact.damping.";
    assert!(text.contains(told));
    assert!(optimize(line)?.report.value.get("without_effect").is_none());
    Ok(())
}

/// With a margin of 0.1 a design of another ridge is nearly as good as the best.
#[test]
fn a_distant_design_that_is_nearly_as_good_is_told() -> Outcome {
    let line = "unloaded --vary stop.stiffness=7 --vary clearance=2:22 --margin 0.1";
    let Written { text, page, report } = optimize(line)?;
    assert_eq!(report.list("rivals").len(), 1);
    let velocity = report.number("rivals/0/velocity");
    let told = format!("is nearly as good: {velocity:.3} at clearance");
    assert!(page.contains(&told), "{told}");
    assert!(text.contains("Nearly as good"));
    // Each value stands under the key of the machine's file, in its unit.
    for axis in report.list("search/axes") {
        let key = axis["parameter"].as_str().ok_or("a key")?;
        let value = report.at("rivals/0")[key].as_f64().ok_or(key)?;
        let [low, high] = ["low", "high"].map(|end| axis[end].as_f64());
        assert!(low.ok_or(key)? <= value && value <= high.unwrap_or(f64::INFINITY));
    }
    Ok(())
}

/// The paper's point A, with nothing to search, and what is required of it.
fn held(require: &str) -> Report {
    let text = "machine = \"unloaded\"\n[vary]\nclearance = 10\nstop.stiffness = 7\nexcitation.frequency = 1.15\n";
    let task = format!("{text}[require]\n{require}\n");
    SOFTSTOP.report_of("task.toml", &task, "optimize --config FILE")
}

/// The value of what is required.
fn value_of(report: &Report, name: &str) -> Outcome<f64> {
    let mut all = report.list("requirements").iter();
    Ok(number(
        all.find(|it| it["name"] == name).ok_or("no requirement")?,
        "value",
    ))
}

/// Nothing can be moved: the design is the machine itself, with its whole report.
#[test]
fn a_machine_without_anything_to_search_is_reported() {
    let report = held("margin = 0.1");
    report.has_near(&[("design/before_impact_velocity", 6.494_627_429_363, 1e-9)]);
    assert!(report.text("report.html").contains("</html>"));
}

/// All starts close to the motion lead to it, half of those of the usual box.
#[test]
fn certainty_is_told_of_the_box_that_is_stated() -> Outcome {
    let near = "starts = { position = [6.8, 7.0], velocity = [9.4, 9.6] }";
    let value = |name: &str, require: &str| value_of(&held(require), name);
    let certainty = value("certainty", &format!("certainty = 0.5\n{near}"))?;
    assert_eq!(certainty, 1.0);
    // The motion, at (6.901268, 9.516656), is nearest to the upper velocity.
    let ball = value("integrity", &format!("integrity = 0.5\n{near}"))?;
    assert!((ball - 0.833_44).abs() < 1e-4, "{ball}");
    let usual = value("certainty", "certainty = 0.4")?;
    assert!((0.5..0.6).contains(&usual), "{usual}");
    Ok(())
}
