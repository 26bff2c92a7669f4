//! The lanes against the safe engine on random machines: the same crossings and the same end, unless rounding can change
//! them.
//!
//! `SOFTSTOP_MOTIONS`, `SOFTSTOP_PERIODS` and `SOFTSTOP_SEED` ask for other motions; with `--nocapture` it is shown how
//! many were compared.

mod aimed;
mod machines;
mod rounding;

use std::env;

use machines::{Draw, Motion};
use rayon::prelude::*;
use rounding::{ROUNDING, Reference, faces, follow};
use serde_json::json;
use softstop::{Ratios, Scene, Start, Stop};
use softstop_lanes::{InstructionLimit, Job, LoweredMachine, Outcome, run_with};

/// Motions that are drawn and run together.
const PART: u64 = 256;
/// How far apart the engines may end, in units of the error bound: 1e-9 times the growth of an error.
const APART: f64 = 1e-9 / ROUNDING;
/// Drive periods before skipped ones from which the rest of a motion is compared that rounding has changed before.
const AHEAD: u64 = 8;

/// What came of the comparison of one motion.
struct Compared {
    /// By the safe engine.
    impacts: u64,
    /// Lanes skipped periods of it.
    is_skipped: bool,
    /// Rounding can change its crossings, or it is chaotic.
    is_ambiguous: bool,
    /// Not even the rest of it, from before the skipped periods on, can be compared.
    is_left_out: bool,
    /// The engines count the same crossings and end within the error bound.
    is_same: bool,
    /// How far apart they end over the growth of an error, in m or m/s.
    distance: f64,
}

fn given(name: &str) -> Option<u64> {
    let number = env::var(name).ok()?;
    Some(number.parse().expect("a whole number in digits"))
}

fn count(all: &[Compared], is: impl Fn(&Compared) -> bool) -> usize {
    all.iter().filter(|it| is(it)).count()
}

/// Compares so many motions of so many periods, drawn from a seed, on all cores; all three may be given from outside.
fn compare(
    motions: u64,
    periods: u64,
    seed: u64,
    draw: fn(&mut Draw) -> Vec<Motion>,
) -> Vec<Compared> {
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
    let parts = (0..motions.div_ceil(PART)).into_par_iter();
    let all: Vec<Compared> = parts.flat_map_iter(part).collect();
    let compared = all.iter().filter(|it| !it.is_left_out);
    println!(
        "{motions} motions with {} impacts, {} with skipped periods: {} chaotic or changed by rounding, of which {} are not \
         compared (where {} end otherwise) and the others from before the skipped periods on; the farthest ends differ by {:.1e}",
        all.iter().map(|it| it.impacts).sum::<u64>(),
        count(&all, |it| it.is_skipped),
        count(&all, |it| it.is_ambiguous),
        count(&all, |it| it.is_left_out),
        count(&all, |it| it.is_left_out && !it.is_same),
        compared.map(|it| it.distance).fold(0.0, f64::max),
    );
    all
}

fn compare_part(motions: &[Motion], periods: u64) -> Vec<Compared> {
    let machine = |(scene, _): &Motion| LoweredMachine::new(&scene.check().expect("valid"));
    let machines: Vec<LoweredMachine> = motions.iter().map(machine).collect();
    let outcomes = in_lanes(&machines, motions, |_| periods);
    let before_skip = |index: usize| match outcomes[index].leapt {
        0 => 0,
        skipped => periods.saturating_sub(skipped + AHEAD),
    };
    let before = in_lanes(&machines, motions, before_skip);
    let compared = motions.iter().enumerate().map(|(index, (scene, start))| {
        let (outcome, whole) = (&outcomes[index], follow(scene, *start, periods));
        let is_skipped = outcome.leapt > 0;
        let reference = match whole.is_ambiguous && is_skipped {
            true => rest(scene, &before[index], periods - before_skip(index)),
            false => whole,
        };
        let (end, there) = (outcome.end, reference.end);
        let distance = (end.position - there.position).hypot(end.velocity - there.velocity);
        let counts = (outcome.impacts, outcome.crossings);
        let is_same = counts == (reference.impacts, reference.crossings)
            && distance <= APART * reference.error_bound;
        assert!(
            is_same || reference.is_ambiguous,
            "{outcome:?} in lanes, {reference:?} by the safe engine after {periods} periods of {}",
            json!({ "scene": scene, "start": [start.position, start.velocity] })
        );
        Compared {
            impacts: whole.impacts,
            is_skipped,
            is_ambiguous: whole.is_ambiguous,
            is_left_out: reference.is_ambiguous,
            is_same,
            distance: distance / reference.error_bound * ROUNDING,
        }
    });
    compared.collect()
}

/// The motions in lanes, each over its own number of drive periods.
fn in_lanes(
    machines: &[LoweredMachine],
    motions: &[Motion],
    periods: impl Fn(usize) -> u64,
) -> Vec<Outcome> {
    let job = |(machine, (_, start)): (usize, &Motion)| Job {
        machine,
        start: *start,
        periods: periods(machine),
    };
    let jobs: Vec<Job> = motions.iter().enumerate().map(job).collect();
    let outcomes = run_with(InstructionLimit::Widest, machines, &jobs, &mut ());
    assert!(outcomes.iter().all(|outcome| outcome.error.is_none()));
    outcomes
}

/// A motion from where it was before skipped periods, with what was counted up to there. It has to be short of all faces
/// there, for a state in contact does not tell the branch of the law.
fn rest(scene: &Scene, before: &Outcome, periods: u64) -> Reference {
    let is_free = faces(scene).iter().all(|face| before.end.position < *face);
    let rest = follow(scene, before.end, periods);
    Reference {
        impacts: before.impacts + rest.impacts,
        crossings: before.crossings + rest.crossings,
        is_ambiguous: rest.is_ambiguous || !is_free || before.leapt > 0,
        ..rest
    }
}

#[test]
fn both_engines_count_the_same_impacts_on_random_machines() {
    let all = compare(2000, 20, 7, |draw| vec![draw.machine()]);
    let impacts: u64 = all.iter().map(|it| it.impacts).sum();
    assert!(impacts > 5 * all.len() as u64 / 2, "{impacts}");
    // In longer motions there is more chaos.
    let is_short = given("SOFTSTOP_PERIODS").is_none();
    let ambiguous = count(&all, |it| it.is_ambiguous);
    assert!(!is_short || ambiguous < all.len() / 100, "{ambiguous}");
}

/// Faces beside turning points of settled motions, frequencies beside changes.
#[test]
fn both_engines_end_in_the_same_states_where_machines_are_aimed_at_trouble() {
    let all = compare(512, 600, 37, Draw::aimed);
    let skipped = count(&all, |it| it.is_skipped);
    assert!(skipped > 250 * all.len() / 512, "{skipped}");
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
    for (clearance, impacts, is_ambiguous) in [
        (5.0 + 1e-12, 0, true),
        (5.0 - 1e-12, 1, true),
        (5.0 + 1e-6, 0, false),
        (5.0 - 1e-4, 1, false),
        (6.0, 0, false),
        (4.0, 1, false),
    ] {
        let reference = follow(&swing(clearance), from, 1);
        assert_eq!(reference.is_ambiguous, is_ambiguous, "{clearance}");
        assert!(is_ambiguous || reference.impacts == impacts, "{clearance}");
    }
    let chaotic = Ratios::unloaded().at_frequency(0.9875).scene();
    let (chaotic, from) = (chaotic.expect("valid"), Start::new(0.0, 14.0));
    assert!(!follow(&chaotic, from, 5).is_ambiguous);
    assert!(follow(&chaotic, from, 400).is_ambiguous);
}
