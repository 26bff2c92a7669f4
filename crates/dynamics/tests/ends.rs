//! Every accepted machine ends within a budget of work, or says that it would not, and always the same.
//!
//! The programs on many more machines: `python3 tests/ends/run.py machines`.

use proptest::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use softstop::internals::budget;
use softstop::{MotionError, Scene, Start};
use softstop_dynamics::attractors::{SearchOptions, find_attractors};
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::orbit::find;
use softstop_dynamics::settled::Settling;
use softstop_testing::machines::machines;
use softstop_testing::random;

/// Budgets in scan windows: what most searches cost, and what none of them does.
const BUDGETS: [u64; 2] = [3_000, 2_000_000];

/// A machine whose numbers are changed by up to eight powers of ten, if it is one.
fn extreme() -> impl Strategy<Value = Scene> {
    let powers = prop::collection::vec(prop_oneof![Just(0.0), -8.0..8.0f64], 5);
    let changed = (machines(), powers).prop_map(|(mut scene, powers)| {
        let factor = |index: usize| 10.0_f64.powf(powers[index]);
        scene.stiffness *= factor(0);
        scene.clearance *= factor(1);
        scene.damping *= factor(2);
        scene.contact_damping *= factor(3);
        scene.excitation.frequency *= factor(4);
        scene
    });
    changed.prop_filter("no machine", |scene| scene.validate().is_ok())
}

/// What three searches come to within a budget each, in words, and what they cost; words only where the budget lasts.
fn answers(scene: &Scene, windows: u64) -> [(Option<String>, u64); 3] {
    let told = |(words, spent): (String, u64)| ((spent < windows).then_some(words), spent);
    let options = SearchOptions {
        starts: 8,
        transient: 60,
        longest: 8,
        patience: 10_000,
        ..SearchOptions::default()
    };
    let settling = Settling {
        periods: 60,
        watched: 32,
        ..Settling::default()
    };
    let start = Start::new(scene.clearance - scene.clearance.abs(), 0.0);
    [
        told(budget::run_within(windows, || format!("{:?}", find(scene)))),
        told(budget::run_within(windows, || {
            format!("{:?}", find_attractors(scene, &options, &unmonitored))
        })),
        told(budget::run_within(windows, || {
            format!(
                "{:?}",
                settling.follow_motions(&[(scene, start)], &unmonitored)
            )
        })),
    ]
}

fn threads(count: usize) -> ThreadPool {
    let pool = ThreadPoolBuilder::new().num_threads(count);
    pool.build().expect("threads")
}

proptest! {
    #![proptest_config(random::cases(60))]

    /// A budget that lasts changes nothing.
    #[test]
    fn every_search_ends_within_its_budget_and_always_the_same(scene in extreme()) {
        let [_, ample] = BUDGETS.map(|windows| {
            let alone = threads(1).install(|| answers(&scene, windows));
            let together = threads(3).install(|| answers(&scene, windows));
            for (alone, together) in alone.iter().zip(&together) {
                assert_eq!(alone.0, together.0);
                assert!(alone.1 <= windows && together.1 <= windows);
            }
            alone
        });
        for (within, amply) in ample.into_iter().zip(answers(&scene, 2 * BUDGETS[1])) {
            if within.0.is_some() {
                prop_assert_eq!(within, amply);
            }
        }
    }
}

#[test]
fn a_spent_budget_ends_every_motion_at_once() {
    let scene = softstop_testing::scenes::unloaded(1.15);
    let (stopped, spent) = budget::run_within(0, || {
        let mut motion = scene.motion(Start::new(6.9, 9.5)).expect("a start");
        let until = motion.clock().instant(1000.0);
        motion.watch(until, &mut ())
    });
    let ended = matches!(stopped, Err(MotionError::OverBudget { .. }));
    assert!(ended && spent == 0, "{stopped:?}");
}
