//! Figures 6 and 8 of the paper and the exponents, as `softstop-lab paper` draws them in draft.

use crate::figure::Figure;
use softstop_testing::reference::FOLDS;
use softstop_testing::tolerance::{MOTION, printed};

#[test]
fn folds_and_flips_are_where_they_were_found_before() {
    let found = Figure::of("6a");
    for (clearance, velocity, eta) in FOLDS.into_iter().step_by(2) {
        found.near(&format!("eta_SN at rho = {clearance}"), eta, printed(5));
        let name = format!("velocity at the fold at rho = {clearance}");
        found.near(&name, velocity, printed(2));
    }
    found.near("eta_g0 at rho = 10", 1.04444, printed(5));
    found.near("eta_PD at rho = 10", 0.988_907, printed(6));
    // The optimum clearance lies between those whose folds are weaker.
    found.near("rho of the hardest impact at a fold", 7.0, 1.0);
}

#[test]
fn the_strip_makes_the_hysteresis_narrower() {
    let loaded = Figure::of("6b");
    let width = loaded.find("hysteresis width at rho = 10");
    assert!(width.is_some_and(|width| 0.0 < width && width < 1.36904 - 1.04444));
    // Up, z = 1 pierces to its fold; down, it is not there before g0.
    let end = |way: &str| {
        loaded.find(&format!(
            "eta where piercing ends on the way {way} at rho = 10"
        ))
    };
    assert!(end("up") > end("down"), "{:?} {:?}", end("up"), end("down"));
}

#[test]
fn grazing_and_fold_are_numbered() {
    let found = Figure::of("8");
    found.near("eta of bifurcation 18", 1.04444, printed(5));
    found.near("eta of bifurcation 19", 1.369_036, printed(6));
    // z = 2/3 and (2/4)B are on no sweep from rest.
    let table = std::fs::read_to_string(found.file("figure-8.csv")).expect("a table");
    for regime in ["2/3", "2/4"] {
        let is_there =
            |line: &str| line.starts_with("isolated") && line.contains(&format!(",{regime},"));
        assert!(table.lines().any(is_there), "no isolated z = {regime}");
    }
}

#[test]
fn exponents_are_those_of_the_multipliers() {
    let found = Figure::of("exponents");
    // Trace and determinant at A: complex multipliers, so |mu|^2 = det; the period is tau = 2 pi / eta.
    let (trace, determinant, period) = (1.1998, 0.7858f64, std::f64::consts::TAU / 1.15);
    assert!(trace * trace < 4.0 * determinant);
    found.near("lambda at A", 0.5 * determinant.ln() / period, 1e-5);
    found.near("lambda without impacts", -0.02, MOTION);
}
