//! Tasks in the user's words: what they do, what stands against them, and what is wrong with them.

use std::fs;
use std::path::Path;

use serde_json::Value;
use softstop_optimize::design::figure::Figure;

use super::{Outcome, SOFTSTOP, near, number};

/// A press with a task of its own; more is said of it below.
const PRESS: &str = r#"
name = "press"
mass = 120.0
stiffness = 2.4e6
damping = 680.0
clearance = 0.02
contact.damping = 3060.0
excitation = { amplitude = 9000.0, frequency_hz = 24.0 }
stop = { model = "preloaded", stiffness = 1.68e7, preload_deflection = 0.02 }
piercing = { stiffness = 4.8e6, friction = 2.4e6, thickness = 0.002, travel = 0.001 }

[search]
evaluations = 150
"#;

/// Its strip holds the motion: without it, it is lost after three periods from most drive angles.
const FORGETFUL: &str = r#"
mass = 1.0
stiffness = 1.0
damping = 0.0116
clearance = 8.828
contact.damping = 0.0918
excitation = { amplitude = 1.0, frequency = 1.25303 }
stop = { model = "preloaded", stiffness = 8.316, preload = 1.35 }
piercing = { stiffness = 28.623, friction = 7.260, thickness = 2.089, travel = 0.413 }

[vary]
clearance = 8.828
excitation.frequency = 1.25303
"#;

/// Lightly damped: its period doubles below grazing.
const FLIPPING: &str = r#"
mass = 1.0
stiffness = 1.0
damping = 0.02
clearance = 10.0
contact.damping = 0.02
excitation = { amplitude = 1.0, frequency = 1.2 }
stop = { model = "preloaded", stiffness = 7.0, preload = 70.0 }

[search]
evaluations = 150

[vary]
clearance = [8, 12]
stop.stiffness = 7.0
"#;

/// What is searched if nothing else is said.
const VARY: &str = "[vary]\nclearance = [0.006, 0.012]\nexcitation.frequency_hz = [10, 40]\n";

/// Runs a task; its report.
fn run(folder: &Path, more: &str) -> Result<Value, Box<dyn std::error::Error>> {
    let file = folder.join("press.toml");
    fs::write(&file, format!("{PRESS}{more}"))?;
    let (file, output) = (file.to_str().ok_or("path")?, folder.join("out"));
    let output = output.to_str().ok_or("path")?;
    super::json(&[
        "optimize",
        file,
        "--no-report",
        "--samples",
        "4096",
        "--format",
        "json",
        "--output",
        output,
    ])
}

fn requirement<'a>(report: &'a Value, name: &str) -> &'a Value {
    let all = report["requirements"].as_array();
    let found = all.and_then(|all| all.iter().find(|it| it["name"] == name));
    found.unwrap_or(&Value::Null)
}

#[test]
fn requirements_are_met_and_told_in_the_machines_units() -> Outcome {
    let folder = tempfile::tempdir()?;
    let wishes = format!(
        "{VARY}[require]\nmargin_sn = 0.5\nmargin_g0 = 0.3\nstop_force = 4.6e5\ncut_through = 5e-4\n\
         velocity = {{ least = 2 }}\nlargest_multiplier = 0.95\n"
    );
    let report = run(folder.path(), &wishes)?;
    for name in [
        "margin_sn",
        "margin_g0",
        "stop_force",
        "cut_through",
        "velocity",
    ] {
        let one = requirement(&report, name);
        assert_eq!(one["met"], true, "{name}: {report}");
        assert!(number(one, "margin") >= 0.0, "{name}");
    }
    let design = &report["design"];
    let below = number(design, "frequency_sn") - number(design, "frequency");
    near(
        number(requirement(&report, "margin_sn"), "value"),
        below,
        1e-9,
    );
    assert_eq!(requirement(&report, "margin_sn")["unit"], "Hz");
    Ok(())
}

/// A requirement in vain, alone or against others, and the words that tell of it.
#[test]
fn conflicts_are_named_with_how_much_is_missing() -> Outcome {
    let folder = tempfile::tempdir()?;
    let cases = [
        ("velocity = 100", "velocity = "),
        ("impact_energy = 1e6", "impact_energy = "),
        ("impact_power = 1e7", "impact_power = "),
        ("stroke_work = 1e4", "stroke_work = "),
        (
            "drive_force = 1000",
            "drive_force = 9000 N: must be at most 1000 N, by 8000 N",
        ),
        ("drive_power = 1", "drive_power = "),
        ("max_position = 1e-3", "max_position = "),
        ("stroke = 1e-3", "stroke = "),
        ("stop_force = 10", "stop_force = "),
        ("cut_through = 0.5", "cut_through = "),
        ("largest_multiplier = 0.01", "largest_multiplier = "),
        ("margin_g0 = 39", "margin_g0 = "),
        ("margin_sn = 39", "margin_sn = "),
        ("clearance_margin_g0 = 1", "clearance_margin_g0 = "),
        ("clearance_margin_sn = 1", "clearance_margin_sn = "),
        ("margin_pd = 39", "margin_pd = "),
        ("certainty = 0.999", "certainty = "),
        ("integrity = 0.9", "integrity = "),
    ];
    let elsewhere = [
        "margin",
        "rigid_gap",
        "missing_strips",
        "run_up",
        "clearance_margin_pd",
    ];
    for figure in Figure::ALL.iter().map(|it| it.name()) {
        let is_here = cases
            .iter()
            .any(|it| it.0.starts_with(&format!("{figure} =")));
        assert!(is_here || elsewhere.contains(&figure), "{figure}");
    }
    for (require, told) in cases {
        let file = folder.path().join("press.toml");
        fs::write(
            &file,
            format!("{PRESS}[vary]\nclearance = [0.008, 0.009]\n[require]\n{require}\n"),
        )?;
        let output = folder.path().join("never");
        let words = [
            "optimize",
            file.to_str().ok_or("path")?,
            "--no-report",
            "--budget",
            "20",
            "--output",
            output.to_str().ok_or("path")?,
        ];
        println!("{require}");
        SOFTSTOP.ends_with(
            &words,
            1,
            &["nearest try, at clearance = 0.00", " m: ", told, "must be"],
        );
        assert!(!output.exists(), "{require}: something is left behind");
    }
    Ok(())
}

/// The same of what the press above has in plenty: another machine each.
#[test]
fn conflicts_of_other_machines_are_named_too() -> Outcome {
    let folder = tempfile::tempdir()?;
    let walled = PRESS.replace(
        "[search]",
        "rigid = { travel = 0.03, restitution = 0.8 }\n[search]",
    );
    let vary = "[vary]\nclearance = [0.008, 0.009]\n";
    let cases = [
        (
            format!("{walled}{vary}[require]\nrigid_gap = 0.03\n"),
            "must be at least 0.03 m, by 0.000",
        ),
        (
            format!("{FORGETFUL}[require]\nmargin = 0\nmissing_strips = 3\n"),
            "missing_strips = 2: must be at least 3, by 1",
        ),
        (
            format!(
                "{PRESS}[vary]\nclearance = 0.0085\nexcitation.frequency_hz = 33\n[require]\nmargin = 0\nrun_up = 6\n"
            ),
            "run_up = ",
        ),
        (
            format!("{FLIPPING}[require]\nmargin_pd = 2\n"),
            "margin_pd = 0.",
        ),
        (
            format!(
                "{PRESS}[vary]\nclearance = 0.0085\n[require]\nclearance_margin_pd = {{ most = 1e-3 }}\n"
            ),
            "clearance_margin_pd has no bound (no flip on this branch",
        ),
        (
            format!(
                "{PRESS}[vary]\nclearance = 0.008\nexcitation.frequency_hz = [34.3, 34.4]\n[require]\nmargin = 0.45\n"
            ),
            "it would have to be at least 34.300000 and at most 31.43447",
        ),
    ];
    for (task, told) in cases {
        let file = folder.path().join("machine.toml");
        fs::write(&file, task)?;
        let output = folder.path().join("never");
        let words = [
            "optimize",
            file.to_str().ok_or("path")?,
            "--no-report",
            "--output",
            output.to_str().ok_or("path")?,
        ];
        SOFTSTOP.ends_with(&words, 1, &[told, "be at "]);
        assert!(!output.exists(), "{told}: something is left behind");
    }
    Ok(())
}

/// What nothing bounds has no value, and a reason; the margin is asked for if nothing else is.
#[test]
fn what_nothing_bounds_is_told_in_words() -> Outcome {
    let folder = tempfile::tempdir()?;
    let report = run(
        folder.path(),
        "[vary]\nclearance = [0.008, 0.009]\n[require]\nclearance_margin_pd = 0.001\nmargin = 0.3\n\
         certainty = 0.1\n",
    )?;
    let flip = requirement(&report, "clearance_margin_pd");
    assert_eq!(
        (&flip["value"], &flip["margin"]),
        (&Value::Null, &Value::Null)
    );
    assert!(
        flip["note"]
            .as_str()
            .ok_or("no note")?
            .contains("no flip on this branch")
    );
    assert_eq!(flip["met"], true);
    let margin = requirement(&report, "margin");
    near(number(margin, "value"), 0.3, 1e-9);
    assert_eq!(margin["met"], true);
    let certainty = requirement(&report, "certainty")["note"].as_str();
    assert!(certainty.ok_or("no note")?.contains("1024 starts in "));
    Ok(())
}

#[test]
fn what_is_wrong_with_a_task_is_told() -> Outcome {
    let folder = tempfile::tempdir()?;
    let cases: [(&str, &[&str]); 31] = [
        (
            "[require]\nmargin = { most = 0.1 }\n",
            &["require.margin", "at least"],
        ),
        (
            "[vary]\nexcitation.frequency_hz = { follows = \"stop.stiffness\", factor = 1e-6 }\n",
            &["vary.excitation.frequency_hz", "follows nothing"],
        ),
        (
            "[objective]\nminimise = \"stop_force\"\n[vary]\nstop.stiffness = [1e6, nan]\n",
            &["stop.stiffness = NaN"],
        ),
        (
            "[require]\nvelocity = nan\n",
            &["require.velocity", "finite"],
        ),
        (
            "[vary]\nclearance = [0.02, 0.01]\n",
            &["clearance = 0.02:0.01", "low must be <= high"],
        ),
        (
            "[vary]\nclearance = [0.02, nan]\n",
            &["clearance = NaN", "finite"],
        ),
        (
            "[vary]\nclearance = \"wide\"\n",
            &["vary.clearance", "range [low, high]"],
        ),
        ("[vary]\nweight = [1, 2]\n", &["vary.weight: unknown key"]),
        (
            "[vary]\nstop.stiffness = { values = [] }\n",
            &["vary.stop.stiffness", "catalogue"],
        ),
        (
            "[vary]\nstop.stiffness = { values = [1e7, -1] }\n",
            &["stop.stiffness = -1", ">= 0"],
        ),
        (
            "[vary]\nexcitation.frequency_hz = { values = [20, 21] }\n",
            &["not a catalogue"],
        ),
        (
            "[vary]\nclearance = { follows = \"clearance\", factor = 1 }\n",
            &["must follow another"],
        ),
        (
            "[tolerance]\nclearance = -1\n",
            &["tolerance.clearance = -1", ">= 0"],
        ),
        (
            "[tolerance]\nclearance = \"2 furlongs\"\n",
            &["tolerance.clearance", "2 %"],
        ),
        (
            "[tolerance]\nstop.restitution = 0.1\n",
            &["tolerance.stop.restitution"],
        ),
        (
            "[objective]\nmaximise = \"speed\"\n",
            &["objective.maximise = speed", "known are velocity"],
        ),
        (
            "[objective]\nmaximise = \"run_up\"\n",
            &["must be velocity"],
        ),
        (
            "[objective]\nmaximise = \"velocity\"\nminimise = \"stop_force\"\n",
            &["only one"],
        ),
        (
            "[require]\nspeed = 1\n",
            &["require.speed: unknown figure", "margin_sn"],
        ),
        (
            "[require]\nvelocity = \"fast\"\n",
            &["require.velocity", "must be a number"],
        ),
        (
            "[require]\nvelocity = inf\n",
            &["require.velocity", "finite"],
        ),
        (
            "[require]\nvelocity = { least = 3, most = 2 }\n",
            &["least must be <= most"],
        ),
        (
            "[require]\ncertainty = 1.5\n",
            &["certainty = 1.5", "[0, 1]"],
        ),
        (
            "[require]\nrigid_gap = 0.001\n",
            &["rigid_gap", "no rigid stop"],
        ),
        (
            "[require]\nstopforce = 3\n",
            &["require.stopforce", "did you mean stop_force?"],
        ),
        (
            "[require]\nrun_up = \"yes\"\n",
            &["require.run_up", "must be true or false"],
        ),
        (
            "[require]\nrun_up = 7\n",
            &["require.run_up = 7", "6 at most"],
        ),
        (
            "[tolerance]\ndamping = 900\n",
            &[
                "tolerance.damping = 900",
                "too wide about 680",
                "damping = -220",
            ],
        ),
        (
            "[vary]\nstop.stiffness = [1e7, 2e7]\n[tolerance]\nstop.stiffness = 3e7\n",
            &["tolerance.stop.stiffness = 3", "too wide about 2"],
        ),
        (
            "[vary]\nclearance = [\"5 mm\", \"40 mm\"]\n",
            &["vary.clearance", "in the machine's own units"],
        ),
        (
            "[tolerence]\nclearance = 0.001\n",
            &["tolerence.clearance", "did you mean tolerance?"],
        ),
    ];
    for (more, told) in cases {
        let file = folder.path().join("press.toml");
        fs::write(&file, format!("{PRESS}{more}"))?;
        let output = folder.path().join("never");
        let file = file.to_str().ok_or("path")?;
        let words = ["optimize", file, "--output", output.to_str().ok_or("path")?];
        SOFTSTOP.ends_with(&words, 2, told);
        assert!(!output.exists(), "{more}: something is left behind");
    }
    Ok(())
}

#[test]
fn catalogues_and_links_hold() -> Outcome {
    let folder = tempfile::tempdir()?;
    let wishes = "[vary]\nclearance = [0.006, 0.012]\nstop.stiffness = { values = [1e7, 1.3e7, 1.7e7] }\n\
                  contact.damping = { follows = \"stop.stiffness\", factor = 1.8e-4 }\n[require]\nmargin_sn = 0.5\n";
    let report = run(folder.path(), wishes)?;
    let parameters = &report["design"]["machine"]["parameters"];
    let stiffness = number(parameters, "stop.stiffness");
    assert!([1e7, 1.3e7, 1.7e7].contains(&stiffness), "{stiffness}");
    near(
        number(parameters, "contact.damping"),
        1.8e-4 * stiffness,
        1e-9 * stiffness,
    );
    Ok(())
}

/// Tolerances as shares, that of the drive's speed among them, are those of the design: none of its machines is lost.
#[test]
fn machines_within_the_tolerances_keep_the_motion() -> Outcome {
    let folder = tempfile::tempdir()?;
    let wishes = format!(
        "{VARY}[tolerance]\nclearance = \"2 %\"\nstop.stiffness = \"3 %\"\n\
         excitation.frequency_hz = \"0.5 %\"\n"
    );
    let report = run(folder.path(), &wishes)?;
    let machines = &report["tolerances"]["machines"];
    assert_eq!(machines["lost"], 0, "{machines}");
    assert!(number(machines, "factor") > 1.0 - 1e-6, "{machines}");
    Ok(())
}

/// More axes than a lattice of few points has dimensions.
#[test]
fn many_axes_are_searched_with_few_zones() -> Outcome {
    let folder = tempfile::tempdir()?;
    let names = [
        "mass",
        "stiffness",
        "damping",
        "clearance",
        "contact.damping",
    ];
    let axes = [
        "excitation.amplitude",
        "stop.stiffness",
        "piercing.stiffness",
    ];
    let report = run(folder.path(), "")?;
    let parameters = &report["design"]["machine"]["parameters"];
    let range = |name: &&str| {
        let value = number(parameters, name);
        format!("{name} = [{}, {}]\n", 0.98 * value, 1.02 * value)
    };
    let vary: String = names.iter().chain(&axes).map(range).collect();
    let report = run(folder.path(), &format!("[vary]\n{vary}"))?;
    assert!(number(&report["design"], "before_impact_velocity") > 0.0);
    Ok(())
}

/// The files of a design are the same machine, and every command reads the task's file as its machine.
#[test]
fn a_design_loads_in_every_command() -> Outcome {
    let folder = tempfile::tempdir()?;
    let report = run(
        folder.path(),
        &format!("{VARY}[require]\nmargin_sn = 0.5\n"),
    )?;
    let written = folder.path().join("out/design.toml");
    let orbit = super::json(&["orbit", written.to_str().ok_or("path")?, "--format", "json"])?;
    let (own, found) = (
        number(&report["design"], "before_impact_velocity"),
        number(&orbit, "before_impact_velocity"),
    );
    near(own, found, 1e-9 * own);
    let task = folder.path().join("press.toml");
    super::json(&["zone", task.to_str().ok_or("path")?, "--format", "json"])?;
    Ok(())
}

/// The least drive force for a velocity: the requirement holds the design.
#[test]
fn the_least_drive_force_for_a_velocity() -> Outcome {
    let folder = tempfile::tempdir()?;
    let wishes = "[vary]\nclearance = [0.006, 0.012]\nexcitation.amplitude = [4000, 12000]\n\
                  [objective]\nminimise = \"drive_force\"\n[require]\nvelocity = 5\nmargin_sn = 0.5\n";
    let report = run(folder.path(), wishes)?;
    near(number(requirement(&report, "velocity"), "value"), 5.0, 1e-6);
    let force = number(
        &report["design"]["machine"]["parameters"],
        "excitation.amplitude",
    );
    assert!((4000.0..9000.0).contains(&force), "{force}");
    Ok(())
}
