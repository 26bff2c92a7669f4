//! The lanes against the safe engine on random machines: the same crossings and the same end, unless rounding can change
//! them.
//!
//! `SOFTSTOP_MOTIONS`, `SOFTSTOP_PERIODS` and `SOFTSTOP_SEED` ask for other motions; with `--nocapture` the tally is shown.

mod aimed;
mod doubt;
mod random_machines;

use std::env;

use doubt::{ROUNDING, Verdict, judge, levels};
use random_machines::{Draw, Motion};
use rayon::prelude::*;
use softstop::{Ratios, Scene, Start, Stop};
use softstop_lanes::{Instructions, Job, Machine, Outcome, run_with};

/// Motions that are drawn and run together.
const PART: u64 = 256;
/// How far apart the engines may end, in units of the errors that come together: 1e-9 times the growth of an error.
const APART: f64 = 1e-9 / ROUNDING;
/// Drive periods before a leap from which the rest of a motion is compared that rounding has changed before.
const AHEAD: u64 = 8;

/// What came of a comparison.
#[derive(Debug, Default)]
struct Tally {
    motions: u64,
    /// Motions whose crossings rounding can change, or that are chaotic.
    chaotic: u64,
    /// Impacts of all motions, by the safe engine.
    impacts: u64,
    /// Motions that lanes leapt over in part.
    leapt: u64,
    /// Chaotic ones of those that were compared from just before the leap on.
    compared_from_leap: u64,
    /// The farthest that the engines end apart in a motion that is not chaotic, over the growth of an error, in m or m/s.
    farthest: f64,
}

impl Tally {
    fn and(self, other: Self) -> Self {
        Self {
            motions: self.motions + other.motions,
            chaotic: self.chaotic + other.chaotic,
            impacts: self.impacts + other.impacts,
            leapt: self.leapt + other.leapt,
            compared_from_leap: self.compared_from_leap + other.compared_from_leap,
            farthest: self.farthest.max(other.farthest),
        }
    }
}

fn given(name: &str) -> Option<u64> {
    let number = env::var(name).ok()?;
    Some(number.parse().expect("a whole number in digits"))
}

/// Compares so many motions of so many periods, drawn from a seed, on all cores; all three may be given from outside.
fn compare(motions: u64, periods: u64, seed: u64, draw: fn(&mut Draw) -> Vec<Motion>) -> Tally {
    let given = |name, usual| given(name).unwrap_or(usual);
    let motions = given("SOFTSTOP_MOTIONS", motions);
    let periods = given("SOFTSTOP_PERIODS", periods);
    let seed = given("SOFTSTOP_SEED", seed);
    let part = |part| {
        let (mut drawn, mut numbers) = (Vec::new(), Draw::new(seed, part));
        let count = PART.min(motions - part * PART) as usize;
        while drawn.len() < count {
            drawn.extend(draw(&mut numbers));
        }
        drawn.truncate(count);
        compare_part(&drawn, periods)
    };
    let parts = (0..motions.div_ceil(PART)).into_par_iter().map(part);
    let tally = parts.reduce(Tally::default, Tally::and);
    println!("{tally:?}");
    tally
}

fn compare_part(motions: &[Motion], periods: u64) -> Tally {
    let machine = |(scene, _): &Motion| Machine::new(&scene.check().expect("valid"));
    let machines: Vec<Machine> = motions.iter().map(machine).collect();
    let outcomes = in_lanes(&machines, motions, |_| periods);
    let until_leap = |index: usize| match outcomes[index].leapt {
        0 => 0,
        leapt => periods.saturating_sub(leapt + AHEAD),
    };
    let before = in_lanes(&machines, motions, until_leap);
    let mut tally = Tally::default();
    for (index, (scene, start)) in motions.iter().enumerate() {
        let outcome = &outcomes[index];
        let mut verdict = judge(scene, *start, periods);
        tally.motions += 1;
        tally.chaotic += u64::from(verdict.doubtful);
        tally.impacts += verdict.impacts;
        tally.leapt += u64::from(outcome.leapt > 0);
        if verdict.doubtful && outcome.leapt > 0 {
            verdict = from_leap(scene, &before[index], periods - until_leap(index));
            tally.compared_from_leap += u64::from(!verdict.doubtful);
        }
        if verdict.doubtful {
            continue;
        }
        let (end, there) = (outcome.end, verdict.end);
        let apart = (end.position - there.position).hypot(end.velocity - there.velocity);
        tally.farthest = tally.farthest.max(apart / verdict.errors * ROUNDING);
        let counts = (outcome.impacts, outcome.crossings);
        assert!(
            counts == (verdict.impacts, verdict.crossings) && apart <= APART * verdict.errors,
            "{outcome:?} in lanes, {verdict:?} by the safe engine: {scene:?} from {start:?}"
        );
    }
    tally
}

/// The motions in lanes, each over its own number of drive periods.
fn in_lanes(
    machines: &[Machine],
    motions: &[Motion],
    periods: impl Fn(usize) -> u64,
) -> Vec<Outcome> {
    let job = |(machine, (_, start)): (usize, &Motion)| Job {
        machine,
        start: *start,
        periods: periods(machine),
    };
    let jobs: Vec<Job> = motions.iter().enumerate().map(job).collect();
    let outcomes = run_with(Instructions::Widest, machines, &jobs, &mut ());
    assert!(outcomes.iter().all(|outcome| outcome.error.is_none()));
    outcomes
}

/// The rest of a motion from where it was before a leap, with what was counted up to there. It has to be short of all
/// faces there, for a state in contact does not tell the branch of the law.
fn from_leap(scene: &Scene, before: &Outcome, periods: u64) -> Verdict {
    let is_free = levels(scene)
        .iter()
        .all(|level| before.end.position < *level);
    let rest = judge(scene, before.end, periods);
    Verdict {
        impacts: before.impacts + rest.impacts,
        crossings: before.crossings + rest.crossings,
        doubtful: rest.doubtful || !is_free || before.leapt > 0,
        ..rest
    }
}

#[test]
fn both_engines_count_the_same_impacts_on_random_machines() {
    let tally = compare(2000, 20, 7, |draw| vec![draw.machine()]);
    assert!(tally.impacts > 5 * tally.motions / 2, "{tally:?}");
    // In longer motions there is more chaos.
    let is_short = given("SOFTSTOP_PERIODS").is_none();
    assert!(
        !is_short || tally.chaotic < tally.motions / 100,
        "{tally:?}"
    );
}

/// Faces beside turning points of settled motions, frequencies beside changes.
#[test]
fn both_engines_end_in_the_same_states_where_machines_are_aimed_at_trouble() {
    let tally = compare(512, 600, 37, Draw::aimed);
    assert!(tally.leapt > 250 * tally.motions / 512, "{tally:?}");
}

#[test]
fn draws_repeat_themselves_and_are_of_all_kinds() {
    let unloaded = Ratios::unloaded().scene().expect("valid").stop;
    let mut kinds = [0; 4];
    let (mut one, mut same, mut other) = (Draw::new(3, 0), Draw::new(3, 0), Draw::new(3, 1));
    for _ in 0..90 {
        let drawn = one.machine();
        assert_eq!(drawn, same.machine());
        assert_ne!(drawn.0, other.machine().0);
        let kind = match &drawn.0 {
            scene if scene.piercing.is_some() => 0,
            scene if matches!(scene.stop, Stop::Hertz { .. }) => 1,
            scene => 2 + usize::from(scene.stop == unloaded),
        };
        kinds[kind] += 1;
    }
    assert!(kinds.iter().all(|count| *count > 10), "{kinds:?}");
}

/// A motion without drive that swings to a height: it turns there.
fn swing(clearance: f64) -> Scene {
    let ratios = Ratios {
        clearance,
        damping: 0.0,
        ..Ratios::unloaded()
    };
    let mut scene = ratios.scene().expect("valid");
    scene.excitation.amplitude = 0.0;
    scene
}

#[test]
fn only_what_rounding_can_change_is_left_out() {
    let from = Start::new(-5.0, 0.0);
    for (clearance, impacts, doubtful) in [
        (5.0 + 1e-12, 0, true),
        (5.0 - 1e-12, 1, true),
        (5.0 + 1e-6, 0, false),
        (5.0 - 1e-4, 1, false),
        (6.0, 0, false),
        (4.0, 1, false),
    ] {
        let verdict = judge(&swing(clearance), from, 1);
        assert_eq!(verdict.doubtful, doubtful, "{clearance}");
        assert!(doubtful || verdict.impacts == impacts, "{clearance}");
    }
    let chaotic = Ratios::unloaded().at_frequency(0.9875).scene();
    let (chaotic, from) = (chaotic.expect("valid"), Start::new(0.0, 14.0));
    assert!(!judge(&chaotic, from, 5).doubtful);
    assert!(judge(&chaotic, from, 400).doubtful);
}
