//! The motions and ends of zone_denied.toml, which were denied or had no name until the judge
//! ([`zone_judge`](super::zone_judge)) found their like.

use serde::Deserialize;
use softstop::{Machine, Scene, Start};
use softstop_dynamics::zone::{Loss, StableRange, hysteresis, stable_ranges};
use softstop_dynamics::{BranchPoint, Orbit};

#[derive(Deserialize)]
struct Found {
    motion: Vec<Denied>,
    ends: Vec<Denied>,
}

#[derive(Deserialize)]
struct Denied {
    what: String,
    /// Near the motion.
    start: Option<[f64; 2]>,
    machine: toml::Table,
}

fn found() -> Found {
    toml::from_str(include_str!("zone_denied.toml")).expect("a list")
}

/// A machine with m = k1 = F0 = 1.
pub fn scene(machine: &toml::Table) -> Scene {
    let mut machine = machine.clone();
    for name in ["mass", "stiffness"] {
        machine.insert(name.to_owned(), 1.0.into());
    }
    let drive = machine["excitation"].as_table_mut().expect("a drive");
    drive.insert("amplitude".to_owned(), 1.0.into());
    let text = machine.to_string();
    Machine::from_toml(&text).expect("a machine").scene
}

/// True of the stable z = 1 motion near a start if it lies on a stretch of its machine.
fn is_told(machine: &toml::Table, [position, velocity]: [f64; 2]) -> bool {
    let scene = scene(machine).check().expect("valid");
    let orbit = Orbit::find_near(&scene, Start::new(position, velocity).into()).expect("a motion");
    assert!(orbit.is_stable());
    let point = BranchPoint {
        parameter: scene.excitation.frequency,
        position: orbit.position,
        velocity: orbit.velocity,
        impacts: orbit.before_impact_velocities().collect(),
        monodromy: orbit.monodromy,
    };
    let on = |one: &StableRange| one.contains_point(&scene, &point).expect("followed");
    stable_ranges(&scene).expect("stable_ranges").iter().any(on)
}

#[test]
fn motions_lie_on_stretches() {
    let all = found().motion;
    assert_eq!(all.len(), 17);
    for one in all {
        let start = one.start.expect("a start");
        assert!(is_told(&one.machine, start), "{}", one.what);
    }
}

#[test]
fn what_ends_a_stretch_has_a_name() {
    let all = found().ends;
    assert_eq!(all.len(), 4);
    for one in all {
        let stable_ranges = stable_ranges(&scene(&one.machine)).expect("stable_ranges");
        let mut ends = stable_ranges.iter().flat_map(|one| [&one.low, &one.high]);
        let is_named = |loss: &Loss| !matches!(loss, Loss::Lost(_) | Loss::Budget);
        assert!(ends.all(|end| is_named(&end.loss)), "{}", one.what);
    }
}

#[test]
fn what_bounds_no_resonance_says_what_to_do() {
    let scene = softstop_testing::with_changes("unloaded", "beta1=0 beta=0");
    let error = hysteresis(&scene).expect_err("no zone").to_string();
    assert!(error.contains("raise damping"), "{error}");
}
