//! The maps of `softstop-lab paper`: regimes, basins, certainty, each as a first look.

use softstop_testing::tolerance::MOTION;
use std::fs;

use crate::figure::Figure;
use softstop_testing::assert_near;

type Outcome = std::io::Result<()>;

#[test]
fn the_fold_strikes_hardest_near_clearance_seven() -> Outcome {
    let found = Figure::of("regimes");
    // An independent integrator: 17.34 at rho = 6 and 17.27 at rho = 8.
    let velocity = found.get("unloaded: largest velocity on s_SN");
    assert!(velocity > 17.34 && velocity < 17.5, "{velocity}");
    let rho = found.get("unloaded: its clearance rho");
    assert!(rho > 6.0 && rho < 8.0, "{rho}");
    let free = found.get("unloaded: share of z = 1 or z = 0 by the way");
    let loaded = found.get("loaded: share of z = 1 or z = 0 by the way");
    assert!(loaded < free, "the hysteresis is smaller when loaded");
    assert!(fs::read(found.file("regimes.png"))?.starts_with(b"\x89PNG"));

    // The curves pass through the known points of rho = 10.
    let table = fs::read_to_string(found.file("regimes-boundaries.csv"))?;
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
    let found = Figure::of("basins");
    let shares = [
        "coexistence, chaos: share",
        "coexistence, z = 2/3 (1-1-0): share",
        "coexistence, z = 2/4 (1-1-0-0): share",
    ];
    let all: f64 = shares.iter().map(|name| found.get(name)).sum();
    assert_near(all, 1.0, MOTION);
    let both = found.get("A, z = 0: share") + found.get("A, z = 1: share");
    assert_near(both, 1.0, MOTION);
    assert!(found.get("A, z = 1: largest ball") > found.get("near the fold, z = 1: largest ball"));
    Ok(())
}

#[test]
fn certainty_is_nearly_one_at_grazing_and_no_longer_at_the_fold() -> Outcome {
    let found = Figure::of("certainty");
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
