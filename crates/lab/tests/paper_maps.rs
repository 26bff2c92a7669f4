//! The maps of `softstop paper`: regimes, basins, certainty, each as a first look.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// What a figure found.
struct Findings(Value);

impl Findings {
    fn of(figure: &str, folder: &Path) -> Result<Self, Box<dyn std::error::Error>> {
        let output = Command::new(env!("CARGO_BIN_EXE_softstop-lab"))
            .args(["paper", figure, "--draft", "--format", "json", "--output"])
            .arg(folder)
            .output()?;
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{message}");
        let report: Value = serde_json::from_slice(&output.stdout)?;
        Ok(Self(report["figures"][0]["findings"].clone()))
    }

    #[track_caller]
    fn get(&self, name: &str) -> f64 {
        let value = self.0[name].as_f64();
        value.unwrap_or_else(|| panic!("no {name:?} in {}", self.0))
    }
}

#[test]
fn the_fold_strikes_hardest_near_clearance_seven() -> Outcome {
    let folder = tempfile::tempdir()?;
    let found = Findings::of("regimes", folder.path())?;
    // An independent integrator: 17.34 at rho = 6 and 17.27 at rho = 8.
    let velocity = found.get("unloaded: largest velocity on s_SN");
    assert!(velocity > 17.34 && velocity < 17.5, "{velocity}");
    let rho = found.get("unloaded: its clearance rho");
    assert!(rho > 6.0 && rho < 8.0, "{rho}");
    let free = found.get("unloaded: share of z = 1 or z = 0 by the way");
    let loaded = found.get("loaded: share of z = 1 or z = 0 by the way");
    assert!(loaded < free, "the hysteresis is smaller when loaded");
    assert!(fs::read(folder.path().join("regimes.png"))?.starts_with(b"\x89PNG"));

    // The curves pass through the known points of rho = 10.
    let table = fs::read_to_string(folder.path().join("regimes-boundaries.csv"))?;
    for (name, eta) in [("s_SN", 1.369_036), ("s_PD", 0.988_907)] {
        let near = table.lines().filter(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            let number = |index: usize| cells[index].parse::<f64>().unwrap_or(f64::NAN);
            cells[..2] == ["unloaded", name] && (number(3) - eta).hypot(number(4) - 10.0) < 1e-5
        });
        assert!(near.count() > 0, "{name} does not pass through {eta}, 10");
    }
    Ok(())
}

#[test]
fn three_motions_share_the_plane_at_09875() -> Outcome {
    let folder = tempfile::tempdir()?;
    let found = Findings::of("basins", folder.path())?;
    let shares = [
        "coexistence, chaos: share",
        "coexistence, z = 2/3 (1-1-0): share",
        "coexistence, z = 2/4 (1-1-0-0): share",
    ];
    let all: f64 = shares.iter().map(|name| found.get(name)).sum();
    assert!((all - 1.0).abs() < 1e-12, "{all}");
    assert!((found.get("A, z = 0: share") + found.get("A, z = 1: share") - 1.0).abs() < 1e-12);
    assert!(found.get("A, z = 1: largest ball") > found.get("near the fold, z = 1: largest ball"));
    Ok(())
}

#[test]
fn certainty_is_nearly_one_at_grazing_and_no_longer_at_the_fold() -> Outcome {
    let folder = tempfile::tempdir()?;
    let found = Findings::of("certainty", folder.path())?;
    for machine in ["unloaded", "loaded"] {
        let of = |what: &str| {
            found.get(&format!(
                "{machine}, rho = 10, starts |X|, |X′| < 2ρ: certainty {what}"
            ))
        };
        assert!(of("near g0") > 0.98, "{machine}");
        assert!(of("near s_SN") < 0.3, "{machine}");
    }
    Ok(())
}
