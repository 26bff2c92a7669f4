//! `softstop sweep` as users and scripts meet it.

use softstop_testing::tolerance::MOTION;
use softstop_testing::words;

use crate::SOFTSTOP;

#[test]
fn the_hysteresis_zone_of_clearance_10() {
    let report = SOFTSTOP.report("sweep --from 1.02 --to 1.4 --steps 39 --periods 300");
    assert_eq!(report.at("parameter"), "excitation.frequency");
    // Up: z = 1 up to the fold at 1.369036, which the step of 1.37 passes too slowly to settle. Down: z = 0
    // down to g0 = 1.04444.
    report.has_near(&[
        ("rate_per_period", 0.01 / 300.0, MOTION),
        ("hysteresis/0/from", 1.05, 1e-9),
        ("hysteresis/0/to", 1.36, 1e-9),
    ]);
    assert_eq!(report.list("hysteresis").len(), 1);
    let ways = ["up", "down"].map(|way| report.at(&format!("hysteresis/0/{way}/z")));
    assert_eq!(ways, ["1", "0"]);
    report.is_in("sweep.json");
    assert_eq!(report.text("sweep.csv").lines().count(), 79);
    report.shows("sweep.svg", &[]);
    assert_eq!(report.names().len(), 3);
}

#[test]
fn a_rigid_scene_is_swept_in_si_units() {
    let report = SOFTSTOP.report("sweep SCENES/rigid.toml --from 1 --to 3 --steps 21 --periods 50");
    assert_eq!(report.list("sweeps").len(), 2);
    assert_eq!(*report.at("sweeps/0/steps"), 21);
}

#[test]
fn a_machine_is_swept_downwards_along_its_mass() {
    let report = SOFTSTOP.report(
        "sweep SCENES/rigid.toml --set clearance=1 --parameter mass --from 2 --to 1 --steps 5 --periods 20",
    );
    assert_eq!([report.at("parameter"), report.at("unit")], ["mass", "kg"]);
    assert_eq!(report.list("sweeps").len(), 1);
    assert_eq!(report.at("sweeps/0/direction"), "down");
    report.shows("sweep.svg", &["mass (kg)", "before-impact velocity (m/s)"]);
}

/// With the stop at -0.5 m the place of rest of the spring lies beyond it; a stop that moves pushes the mass.
#[test]
fn a_sweep_beyond_a_rigid_stop_begins_at_rest_on_it() {
    let line =
        "sweep SCENES/rigid.toml --set clearance=-0.5 --from 1 --to 1.2 --steps 3 --periods 50";
    let report = SOFTSTOP.report(line);
    for sweep in ["sweeps/0", "sweeps/1"] {
        assert_eq!(report.number(&format!("{sweep}/steps")), 3.0);
        assert_eq!(report.number(&format!("{sweep}/put_on_stop")), 1.0);
    }
    assert_eq!(report.text("sweep.csv").lines().count(), 7);
    let line =
        "sweep SCENES/rigid.toml --parameter clearance --from 1 --to -1 --steps 5 --periods 20";
    let report = SOFTSTOP.report(line);
    assert_eq!(report.number("sweeps/0/steps"), 5.0);
    assert!(report.number("sweeps/0/put_on_stop") >= 1.0);

    let folder = tempfile::tempdir().expect("a folder");
    let output = folder.path().display().to_string();
    let line = "sweep ../docs/scenes/rigid.toml --set clearance=-0.5 --from 1 --to 1.2 --steps 2 --periods 5";
    let text = SOFTSTOP.text(&[&words(line)[..], &["--output", &output]].concat());
    assert!(text.contains("at rest on a rigid stop"), "{text}");
}

#[cfg(unix)]
#[test]
fn an_interrupted_sweep_goes_on_to_the_same_result() -> crate::Outcome {
    use std::fs;
    use std::process::Stdio;
    use std::time::{Duration, Instant};

    let folder = tempfile::tempdir()?;
    let (whole, part) = (folder.path().join("whole"), folder.path().join("part"));
    let line = "sweep --from 0.9 --to 1.1 --periods 2000 --steps";
    let run = |folder: &std::path::Path, more: &str| {
        let line = format!("{line} {more} --output {}", folder.display());
        SOFTSTOP.command(&words(&line))
    };
    let kept = part.join("sweep.part");
    let mut first = run(&part, "2000").stderr(Stdio::piped()).spawn()?;
    let deadline = Instant::now() + Duration::from_secs(20);
    while !kept.is_file() && Instant::now() < deadline {
        std::thread::sleep(Duration::from_millis(5));
    }
    // It is there already: that is no wrong usage.
    assert_eq!(run(&part, "2000 --resume").output()?.status.code(), Some(1));
    softstop_testing::kill("INT", first.id());
    assert_eq!(first.wait()?.code(), Some(130));
    assert!(kept.is_file() && !part.join("sweep.csv").exists());

    // Other arguments are another sweep.
    assert_eq!(run(&part, "1999 --resume").output()?.status.code(), Some(2));
    // What is damaged is done anew.
    let mut bytes = fs::read(&kept)?;
    *bytes.last_mut().ok_or("nothing is kept")? ^= 1;
    fs::write(&kept, bytes)?;
    // With nothing to go on with, the sweep begins.
    for folder in [&part, &whole] {
        let resumed = run(folder, "2000 --resume").output()?;
        let message = String::from_utf8_lossy(&resumed.stderr);
        assert!(resumed.status.success(), "{message}");
    }
    assert!(!kept.exists());
    for file in ["sweep.csv", "sweep.svg"] {
        assert_eq!(fs::read(part.join(file))?, fs::read(whole.join(file))?);
    }
    Ok(())
}
