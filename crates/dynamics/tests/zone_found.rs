//! What `zone` lists of lightly damped machines, `orbit` finds: at frequencies within each stretch of stable z = 1, however
//! narrow.
//!
//! 2,000 machines, in some 40 minutes of processor time:
//! `PROPTEST_CASES=2000 cargo test --release -p softstop-dynamics --test dynamics zone_found -- --nocapture`

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use softstop::{Ratios, Scene};
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::zone::{Loss, StableRange, find, find_among, stable_ranges};
use softstop_testing::random::{self, log_uniform};
use softstop_testing::tolerance::GROWN;
use softstop_testing::with_changes;

/// Machines of the test that runs every day.
const MACHINES: u32 = 20;
/// Frequencies within a stretch.
const FREQUENCIES: u32 = 20;
/// Machines after which progress is shown.
const REPORTED: usize = 50;

/// Machines with damping ratios from 1e-5 to 1e-2, in flight and in contact.
fn machines() -> impl Strategy<Value = Scene> {
    let damping = (log_uniform(1e-5, 1e-2), log_uniform(1e-5, 1e-2));
    let stop = (
        log_uniform(0.2, 12.0),
        log_uniform(0.1, 1e4),
        log_uniform(0.1, 500.0),
    );
    (damping, stop).prop_map(
        |((damping, contact_damping), (clearance, stiffness, preload))| {
            let ratios = Ratios {
                clearance,
                stiffness,
                preload,
                damping,
                contact_damping,
                ..Ratios::unloaded()
            };
            ratios.scene().expect("valid")
        },
    )
}

/// What is wrong at a frequency of a stretch.
fn wrong(scene: &Scene, all: &[StableRange], stable_range: &StableRange) -> Option<String> {
    let orbit = match find_among(scene, all, &unmonitored) {
        Ok(orbit) => orbit,
        Err(error) => return Some(error.to_string()),
    };
    let checked = scene.check().expect("valid");
    let on = stable_range.point_at(&checked, scene.excitation.frequency);
    let least = on
        .ok()
        .flatten()
        .map_or(0.0, |point| point.before_impact_velocity());
    let velocity = orbit.before_impact_velocity();
    let closes = orbit
        .residual()
        .is_ok_and(|(gap, rounding)| gap <= rounding);
    let holds = orbit.is_stable() && closes && velocity > (1.0 - GROWN) * least;
    (!holds).then(|| format!("velocity {velocity} where {least} is, closes: {closes}"))
}

/// The stretches of a machine, and what is wrong within them.
fn searched(scene: &mut Scene) -> (Vec<StableRange>, Vec<String>) {
    let all = stable_ranges(scene).expect("a machine");
    let mut denied = Vec::new();
    for stable_range in &all {
        let (low, high) = (stable_range.low.frequency, stable_range.high.frequency);
        for part in 0..FREQUENCIES {
            let share = (f64::from(part) + 0.5) / f64::from(FREQUENCIES);
            scene.excitation.frequency = low + share * (high - low);
            let told = wrong(scene, &all, stable_range).map(|wrong| format!("{wrong}: {scene:?}"));
            denied.extend(told.inspect(|told| eprintln!("{told}")));
        }
    }
    (all, denied)
}

#[test]
fn what_zone_lists_orbit_finds() {
    let config = random::cases(MACHINES);
    let count = config.cases as usize;
    let mut runner = TestRunner::new(config);
    let mut draw = || {
        machines()
            .new_tree(&mut runner)
            .expect("a machine")
            .current()
    };
    let (mut listed, mut narrow, mut denied) = (0, 0, Vec::new());
    for machine in 0..count {
        let (all, wrong) = searched(&mut draw());
        let is_narrow = |stable_range: &&StableRange| {
            let (low, high) = (stable_range.low.frequency, stable_range.high.frequency);
            high - low < 1e-3 * high
        };
        listed += all.len();
        narrow += all.iter().filter(is_narrow).count();
        denied.extend(wrong);
        if (machine + 1).is_multiple_of(REPORTED) || machine + 1 == count {
            eprintln!(
                "{} of {count} machines, {listed} stable_ranges, {narrow} narrow, {FREQUENCIES} frequencies each, {} denied",
                machine + 1,
                denied.len()
            );
        }
    }
    assert!(
        listed > count && narrow > 0,
        "{listed} stable_ranges, {narrow} narrow"
    );
    assert!(denied.is_empty(), "{denied:#?}");
}

/// A stretch of a relative width of 1e-4, where no start and no lattice shows the motion: its state is known.
#[test]
fn a_motion_of_a_narrow_stretch() {
    let scene = with_changes(
        "unloaded",
        "rho=0.32501198094201733 beta1=0.00022857649680422946 beta=0.0004507634334646064 \
         k4=3.496589449532183 Fp=0.2733947917988244",
    );
    let scene = scene.at_frequency(0.386);
    let orbit = find(&scene).expect("a motion");
    assert!(
        (orbit.position - 0.4762689079367844).abs() < GROWN,
        "{orbit:?}"
    );
    assert!(
        (orbit.velocity - 0.000336828461386103).abs() < GROWN,
        "{orbit:?}"
    );
    assert!(orbit.is_stable() && orbit.impacts.len() == 1);
}

/// A multiplier goes beyond -1 and comes back within one step of the branch, from 0.37771 to 0.37933.
#[test]
fn two_flips_within_a_step_end_stretches() {
    let mut scene = with_changes(
        "unloaded",
        "rho=0.2832226066120024 beta1=0.0012148818882863175 beta=0.0001960139797589023 \
         k4=3.9492412507357204 Fp=0.21496140549193749",
    );
    let (all, denied) = searched(&mut scene);
    assert!(denied.is_empty(), "{denied:#?}");
    let inside = |stable_range: &&StableRange| {
        stable_range.low.frequency < 0.3785 && stable_range.high.frequency > 0.3785
    };
    assert_eq!(all.iter().find(inside).map(|it| it.low.frequency), None);
    let flips = |stable_range: &&StableRange| stable_range.high.loss == Loss::Flip;
    assert!(
        all.iter()
            .filter(flips)
            .any(|it| (it.high.frequency - 0.377714).abs() < 1e-6)
    );
}

/// Damping ratios in flight and in contact, clearance, stiffness and preload; the frequencies at which the motion flips and,
/// just below, at which its impact dies. Between the two a multiplier goes from -1 to -infinity.
const FLIPS_BEFORE_GRAZING: [([f64; 5], [f64; 2]); 2] = [
    (
        [
            0.0017391823259052705,
            0.0043075509119084405,
            9.303307171846928,
            153.2197384783231,
            0.23137923390610787,
        ],
        [0.944802560, 0.944754777],
    ),
    (
        [
            0.004086157986911333,
            0.0002517934845052399,
            5.499280966757399,
            61.84584745466044,
            0.1415598268639402,
        ],
        [0.904732081, 0.904603991],
    ),
];

#[test]
fn a_flip_right_before_a_grazing_ends_a_stretch() {
    for ([damping, contact_damping, clearance, stiffness, preload], [flip, grazing]) in
        FLIPS_BEFORE_GRAZING
    {
        let ratios = Ratios {
            clearance,
            damping,
            contact_damping,
            stiffness,
            preload,
            ..Ratios::unloaded()
        };
        let (all, denied) = searched(&mut ratios.scene().expect("valid"));
        assert!(denied.is_empty(), "{denied:#?}");
        let ends = |at: f64| {
            all.iter()
                .find(|it| (it.low.frequency - at).abs() < 1e-8)
                .map(|it| &it.low.loss)
        };
        assert_eq!([ends(flip), ends(grazing)], [Some(&Loss::Flip), None]);
    }
}
