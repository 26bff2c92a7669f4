//! Figures 6 and 8 of the paper and the exponents, as `softstop paper` draws them in draft.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// The findings of one figure.
fn findings(figure: &str, folder: &Path) -> Result<Value, Box<dyn std::error::Error>> {
    let output = Command::new(env!("CARGO_BIN_EXE_softstop-lab"))
        .args(["paper", figure, "--draft", "--format", "json", "--output"])
        .arg(folder)
        .output()?;
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let report: Value = serde_json::from_slice(&output.stdout)?;
    for file in report["figures"][0]["files"].as_array().ok_or("no files")? {
        let file = file.as_str().ok_or("no name")?;
        assert!(std::fs::metadata(file)?.len() > 50, "{file} is empty");
    }
    Ok(report["figures"][0]["findings"].clone())
}

fn near(findings: &Value, name: &str, value: f64, tolerance: f64) {
    let found = findings[name].as_f64();
    let is_near = found.is_some_and(|found| (found - value).abs() <= tolerance);
    assert!(is_near, "{name}: {found:?}, not {value}");
}

#[test]
fn folds_and_flips_are_where_they_were_found_before() -> Outcome {
    let folder = tempfile::tempdir()?;
    let found = findings("6a", folder.path())?;
    let known = [
        (2, 1.69031, 10.74),
        (6, 1.49593, 17.34),
        (10, 1.36904, 16.87),
        (14, 1.26746, 15.37),
        (18, 1.18034, 12.81),
    ];
    for (clearance, eta, velocity) in known {
        near(&found, &format!("eta_SN at rho = {clearance}"), eta, 5.1e-6);
        let name = format!("velocity at the fold at rho = {clearance}");
        near(&found, &name, velocity, 5.1e-3);
    }
    near(&found, "eta_g0 at rho = 10", 1.04444, 5.1e-6);
    near(&found, "eta_PD at rho = 10", 0.988_907, 5.1e-7);
    // The optimum clearance lies between those whose folds are weaker.
    near(&found, "rho of the hardest impact at a fold", 7.0, 1.0);
    Ok(())
}

#[test]
fn the_strip_makes_the_hysteresis_narrower() -> Outcome {
    let folder = tempfile::tempdir()?;
    let loaded = findings("6b", folder.path())?;
    let width = loaded["hysteresis width at rho = 10"].as_f64();
    assert!(width.is_some_and(|width| 0.0 < width && width < 1.36904 - 1.04444));
    // Up, z = 1 pierces to its fold; down, it is not there before g0.
    let end = |way: &str| {
        loaded[format!("eta where piercing ends on the way {way} at rho = 10")].as_f64()
    };
    assert!(end("up") > end("down"), "{:?} {:?}", end("up"), end("down"));
    Ok(())
}

#[test]
fn grazing_and_fold_are_numbered() -> Outcome {
    let folder = tempfile::tempdir()?;
    let found = findings("8", folder.path())?;
    near(&found, "eta of bifurcation 18", 1.04444, 5.1e-6);
    near(&found, "eta of bifurcation 19", 1.369_036, 5.1e-7);
    // z = 2/3 and (2/4)B are on no sweep from rest.
    let table = std::fs::read_to_string(folder.path().join("figure-8.csv"))?;
    for regime in ["2/3", "2/4"] {
        let is_there =
            |line: &str| line.starts_with("isolated") && line.contains(&format!(",{regime},"));
        assert!(table.lines().any(is_there), "no isolated z = {regime}");
    }
    Ok(())
}

#[test]
fn exponents_are_those_of_the_multipliers() -> Outcome {
    let folder = tempfile::tempdir()?;
    let found = findings("exponents", folder.path())?;
    // Trace and determinant at A: complex multipliers, so |mu|^2 = det; the period is tau = 2 pi / eta.
    let (trace, determinant, period) = (1.1998, 0.7858f64, std::f64::consts::TAU / 1.15);
    assert!(trace * trace < 4.0 * determinant);
    near(&found, "lambda at A", 0.5 * determinant.ln() / period, 1e-5);
    near(&found, "lambda without impacts", -0.02, 1e-12);
    Ok(())
}
