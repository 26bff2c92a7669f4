//! Machines one by one: what lanes hand over, and the ends of periods.

use super::*;
use softstop_testing::{hertz, kelvin_voigt};

#[test]
fn what_lanes_cannot_follow_the_scalar_engine_does() {
    let mut scene = Ratios::unloaded().scene().expect("valid");
    scene.stop = hertz(100.0, 1.2, 0.1);
    let machine = LoweredMachine::new(&scene.check().expect("valid"));
    assert!(!machine.is_for_lanes());
    let from = Start {
        position: 0.0,
        velocity: 14.0,
    };
    let job = |start, periods| Job {
        machine: 0,
        start,
        periods,
    };
    let bad = Start {
        position: f64::NAN,
        velocity: 0.0,
    };
    let jobs = [job(from, PERIODS), job(bad, 1), job(from, 0)];
    let outcomes = run(&[machine], &jobs, &mut ());
    assert_eq!((outcomes[0].end, outcomes[0].impacts), scalar(&scene, from));
    assert!(outcomes[1].error.is_some());
    assert_eq!((outcomes[2].end, outcomes[2].impacts), (from, 0));
}

/// A motion alone in a lane.
pub fn in_a_lane(
    scene: &Scene,
    start: Start,
    periods: u64,
    watch: &mut dyn BatchObserver,
) -> Outcome {
    let machines = [LoweredMachine::new(&scene.check().expect("valid"))];
    let job = Job {
        machine: 0,
        start,
        periods,
    };
    let outcome = run(&machines, &[job], watch).remove(0);
    assert_eq!(outcome.error, None);
    outcome
}

pub fn one_by_one(
    scene: &Scene,
    start: Start,
    periods: u64,
    watch: &mut dyn BatchObserver,
) -> (Start, u64) {
    let outcome = in_a_lane(scene, start, periods, watch);
    (outcome.end, outcome.impacts)
}

/// A motion by the safe engine: its end, impacts and crossings.
pub fn safely(scene: &Scene, start: Start, periods: u64) -> (Start, u64, u64) {
    let mut meets = Meets::default();
    let mut motion = scene.motion(start).expect("valid");
    let end = Clock::at_cycle(periods);
    motion.advance(end, &mut meets).expect("bounded");
    let crossings = meets.crossings.len() as u64;
    (motion.state(), meets.impacts, crossings)
}

#[test]
fn a_machine_without_a_stop_moves_on() {
    let mut scene = Ratios::unloaded().scene().expect("valid");
    scene.stop = Stop::None;
    for index in 0..50 {
        let start = start(index, &scene);
        let (end, impacts) = one_by_one(&scene, start, PERIODS, &mut ());
        assert_eq!(impacts, 0);
        assert!(distance(end, scalar(&scene, start).0) < 1e-11);
    }
}

/// Hears of periods, so that lanes stop at their ends.
pub struct Periods;

impl BatchObserver for Periods {
    fn observed(&self) -> (bool, bool) {
        (false, true)
    }
}

#[test]
fn an_impact_at_the_very_end_of_a_period_is_counted_once() {
    for index in 0..400 {
        let mut scene = Ratios::unloaded().scene().expect("valid");
        scene.stop = kelvin_voigt(10.0, Release::Clearance);
        scene.excitation.frequency = between(0.5, 2.0, spread(index, 1));
        scene.clearance = 1e3;
        let start = start(index, &scene);
        let (there, _) = scalar_for(&scene, start, 1);
        if there.position <= start.position.max(0.5) || there.velocity <= 0.1 {
            continue;
        }
        scene.clearance = there.position;
        let (_, impacts) = one_by_one(&scene, start, 3, &mut Periods);
        let (_, expected) = scalar_for(&scene, start, 3);
        assert_eq!(impacts, expected, "{index}: {scene:?} from {start:?}");
    }
}

#[test]
fn endless_bounces_under_a_slow_drive_are_left_to_the_safe_engine() {
    let mut ratios = Ratios::unloaded();
    (ratios.clearance, ratios.frequency) = (0.5, 0.002);
    let scene = ratios.scene().expect("valid");
    let start = Start {
        position: 5.75,
        velocity: -6.6,
    };
    let found = one_by_one(&scene, start, 1, &mut ());
    assert_eq!(found, scalar_for(&scene, start, 1));
    assert!(found.1 > 10_000, "{found:?}");
}

/// Writes down what it hears of the periods of one job.
#[derive(Default)]
struct EachPeriod(Vec<(u64, Start)>);

impl BatchObserver for EachPeriod {
    fn observed(&self) -> (bool, bool) {
        (false, true)
    }

    fn period(&mut self, _: usize, cycle: u64, state: Start) {
        self.0.push((cycle, state));
    }
}

/// Motions that never meet the stop again leap; who watches them hears of each period all the same.
#[test]
fn a_leap_comes_to_where_the_periods_do() {
    for (index, damping) in (0..60).zip([0.02, 0.05, 0.2].into_iter().cycle()) {
        let mut ratios = Ratios::unloaded().at_frequency(1.36);
        ratios.damping = damping;
        let scene = ratios.scene().expect("valid");
        let start = start(index, &scene);
        for periods in [5, 60, 997] {
            let mut each = EachPeriod::default();
            let (last, counted) = one_by_one(&scene, start, periods, &mut each);
            let mut motion = scene.motion(start).expect("valid");
            let mut meets = Meets::default();
            for (cycle, (told, state)) in (1..=periods).zip(&each.0) {
                motion
                    .advance(Clock::at_cycle(cycle), &mut meets)
                    .expect("bounded");
                assert_eq!(*told, cycle);
                let exact = motion.state();
                assert!(distance(*state, exact) < 1e-10, "{state:?} for {exact:?}");
            }
            assert_eq!((each.0.len() as u64, counted), (periods, meets.impacts));
            let (end, impacts) = one_by_one(&scene, start, periods, &mut ());
            assert_eq!(impacts, counted);
            assert!(distance(end, last) < 1e-11, "{end:?} for {last:?}");
        }
    }
}

/// The stop lets go so gently that each period is handed over just after that: the state alone, rounded, would have it
/// let go again.
#[test]
fn a_release_before_a_handing_over_is_counted_once() {
    let mut scene = Ratios::unloaded().scene().expect("valid");
    scene.excitation.frequency = 1.2163176370887587;
    (scene.damping, scene.clearance) = (0.13521975858568694, 1.9729499601366405);
    scene.contact_damping = 0.2930588834400743;
    scene.stop = kelvin_voigt(89.65661092882665, Release::ZeroForce);
    let (position, velocity) = (-1.8661909629556042, 0.7786930774679091);
    let start = Start::new(position, velocity);
    let outcome = in_a_lane(&scene, start, 600, &mut ());
    assert_eq!(outcome.crossings, safely(&scene, start, 600).2);
    assert!(outcome.handed_over > 0);
}

/// Contact takes damping away: it would pull at first, and the mass moves on as if it were free until the stop presses.
#[test]
fn a_contact_that_would_pull_at_first_is_handed_over_as_released() {
    let mut scene = Ratios::unloaded().scene().expect("valid");
    scene.excitation.frequency = 0.921887305313236;
    (scene.damping, scene.clearance) = (0.06302900706962594, 7.578978897315506);
    scene.contact_damping = 0.000171133978576001;
    scene.stop = kelvin_voigt(865.8420934406535, Release::ZeroForce);
    let start = Start::new(-3.4008997014310474, -5.889542254762304);
    let outcome = in_a_lane(&scene, start, 20, &mut ());
    let (end, impacts, crossings) = safely(&scene, start, 20);
    assert_eq!((outcome.impacts, outcome.crossings), (impacts, crossings));
    assert!(distance(outcome.end, end) < 1e-11 && outcome.handed_over > 0);
}

/// Where a mass comes to rest in each period, its motion repeats to the last bit: what is skipped then is what a run counts.
#[test]
fn motions_that_come_to_rest_are_counted_as_by_a_run_of_all_periods() {
    let mut skipped = 0;
    for index in 0..60 {
        let share = f64::from(index) / 60.0;
        let mut scene = Scene {
            clearance: 0.5 * (share * 7.0).sin(),
            ..Scene::of_stop(Stop::Rigid {
                restitution: 0.8 * (share * 11.0).fract(),
            })
        };
        scene.excitation.frequency = 0.11 + 0.6 * (share * 3.0).fract();
        let start = Start::new(scene.clearance - 0.2, 1.0);
        for periods in [40, 977] {
            let outcome = in_a_lane(&scene, start, periods, &mut ());
            let (end, impacts, crossings) = safely(&scene, start, periods);
            assert_eq!(
                (outcome.impacts, outcome.crossings),
                (impacts, crossings),
                "{scene:?}"
            );
            assert!(distance(outcome.end, end) < 1e-11, "{scene:?}");
            skipped += usize::from(outcome.handed_over == periods);
        }
    }
    assert!(skipped > 60, "{skipped}");
}
