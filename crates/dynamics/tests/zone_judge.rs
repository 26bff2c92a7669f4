//! Zones judged by brute force: what settles on z = 1 lies on a stretch.
//!
//! Random machines, lightly damped ones among them, run from many starts in the batch engine, at frequencies on their
//! stretches and elsewhere. 100,000 machines, in some three hours of processor time:
//! `PROPTEST_CASES=100000 cargo test --release -p softstop-dynamics --test dynamics zone_judge -- --nocapture`

use std::sync::atomic::{AtomicU32, Ordering};

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use rayon::prelude::*;
use softstop::{Ratios, Release, Scene, Slope, Start, Stop, Strip};
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::zone::{Loss, StableRange, stable_ranges};
use softstop_dynamics::{BranchPoint, Orbit};
use softstop_lanes::{BatchObserver, Job, LoweredMachine};
use softstop_testing::random::{self, log_uniform};

/// Machines of the test that runs every day, and after how many progress is shown.
const MACHINES: u32 = 500;
const REPORTED: u32 = 250;
/// Frequencies of a machine; starts at each, and how long they run.
const FREQUENCIES: usize = 3;
const STARTS: usize = 32;
const PERIODS: u64 = 200;
/// Distance in scales of the motion within which Newton's method takes over from a motion that settles, or a motion is
/// known already.
const NEAR: f64 = 0.02;
/// Before-impact velocity in scales of the motion below which a motion is one that grazes.
const WEAK: f64 = 1e-3;

/// A law of a stop: four times in eight the paper's, with a strip or without.
fn stops() -> impl Strategy<Value = (Option<Stop>, Option<Strip>)> {
    let strip = (0.0..30.0f64, 0.0..30.0f64, 0.05..1.0f64, 0.0..1.0f64);
    let strip = strip.prop_map(|(stiffness, friction, thickness, travel)| Strip {
        stiffness,
        friction,
        thickness,
        travel,
    });
    let release = prop_oneof![Just(Release::Clearance), Just(Release::ZeroForce)];
    let slopes = (
        log_uniform(0.1, 1e3),
        log_uniform(1.0, 1e3),
        0.1..1.0f64,
        any::<bool>(),
    );
    let slopes = slopes.prop_map(|(first, second, from, returns)| {
        let slopes = |share: f64| {
            let slope = |from, stiffness| Slope {
                from,
                stiffness: share * stiffness,
            };
            vec![slope(0.0, first), slope(from, second)]
        };
        Stop::PiecewiseLinear {
            loading: slopes(1.0),
            unloading: if returns { slopes(0.5) } else { Vec::new() },
        }
    });
    let hertz = (log_uniform(1.0, 1e3), 1.0..2.5f64, 0.0..0.3f64);
    let hertz = hertz.prop_map(|(stiffness, exponent, dissipation)| Stop::Hertz {
        stiffness,
        exponent,
        dissipation,
    });
    let kelvin_voigt = (log_uniform(0.1, 1e4), release)
        .prop_map(|(stiffness, release)| Stop::KelvinVoigt { stiffness, release });
    let bare = |stop: Stop| (Some(stop), None);
    prop_oneof![
        20 => Just((None, None)),
        20 => strip.prop_map(|strip| (None, Some(strip))),
        10 => (0.1..0.98f64).prop_map(move |restitution| bare(Stop::Rigid { restitution })),
        10 => kelvin_voigt.prop_map(bare),
        10 => slopes.prop_map(bare),
        1 => hertz.prop_map(bare),
    ]
}

fn machines() -> impl Strategy<Value = Scene> {
    let preload = prop_oneof![1 => Just(0.0), 4 => log_uniform(0.1, 500.0)];
    let damping = (log_uniform(1e-3, 0.1), log_uniform(1e-3, 0.3));
    (
        0.2..12.0f64,
        log_uniform(0.1, 1e4),
        preload,
        damping,
        stops(),
    )
        .prop_map(
            |(clearance, stiffness, preload, (damping, contact_damping), (stop, piercing))| {
                let ratios = Ratios {
                    clearance,
                    stiffness,
                    preload,
                    damping,
                    contact_damping,
                    piercing,
                    ..Ratios::unloaded()
                };
                let scene = ratios.scene().expect("valid");
                match stop {
                    Some(stop) => Scene { stop, ..scene },
                    None => scene,
                }
            },
        )
}

/// Of each job the states at the ends of its last two drive periods.
struct Ends(Vec<[Start; 2]>);

impl BatchObserver for Ends {
    fn observed(&self) -> (bool, bool) {
        (false, true)
    }

    fn period(&mut self, job: usize, _: u64, state: Start) {
        self.0[job] = [self.0[job][1], state];
    }
}

fn point(scene: &Scene, orbit: &Orbit) -> BranchPoint {
    BranchPoint {
        parameter: scene.excitation.frequency,
        position: orbit.position,
        velocity: orbit.velocity,
        impacts: vec![orbit.before_impact_velocity()],
        monodromy: orbit.monodromy,
    }
}

/// What was found of starts.
#[derive(Default)]
struct Tally {
    /// Stable z = 1 motions that they settled on.
    motions: usize,
    /// Starts whose states one period apart are all but alike, and from which Newton's method leads to no motion, of z = 1
    /// or else.
    undecided: usize,
    /// What is not as it should be.
    wrong: Vec<String>,
}

/// The stable z = 1 motions that starts settle on, and how many of these are undecided.
fn settled(scene: &Scene, starts: &[(f64, f64)]) -> (Vec<BranchPoint>, usize) {
    let size = scene.clearance.max(1.0);
    let job = |&(reach, angle): &(f64, f64)| Job {
        machine: 0,
        start: Start::new(
            (reach * size * angle.cos()).min(scene.clearance),
            reach * size * angle.sin(),
        ),
        periods: PERIODS,
    };
    let jobs: Vec<Job> = starts.iter().map(job).collect();
    let mut ends = Ends(vec![[Start::REST; 2]; jobs.len()]);
    let machine = LoweredMachine::new(&scene.check().expect("valid"));
    softstop_lanes::run(&[machine], &jobs, &mut ends);
    let apart =
        |a: Start, b: Start| (a.position - b.position).hypot(a.velocity - b.velocity) / size;
    let (mut found, mut undecided) = (Vec::<BranchPoint>::new(), 0);
    for [before, last] in ends.0 {
        let known =
            |point: &BranchPoint| apart(Start::new(point.position, point.velocity), last) < NEAR;
        if apart(before, last) > NEAR || found.iter().any(known) {
            continue;
        }
        let orbit = match Orbit::find_near(scene, last.into()) {
            Ok(orbit) => orbit,
            Err(OrbitError::OtherRegime { .. }) => continue,
            Err(_) => {
                undecided += 1;
                continue;
            }
        };
        let velocity = orbit.before_impact_velocity();
        if orbit.is_stable() && !orbit.chatters() && velocity > WEAK {
            found.push(point(scene, &orbit));
        }
    }
    (found, undecided)
}

/// A machine, the frequencies at which it runs, as shares, and where it starts.
type Case = (Scene, Vec<(f64, bool)>, Vec<(f64, f64)>);

fn judge((scene, shares, starts): &Case) -> Tally {
    let mut tally = Tally::default();
    let all = match stable_ranges(scene) {
        Ok(all) => all,
        Err(error) => {
            tally.wrong.push(format!("{error} of {scene:?}"));
            return tally;
        }
    };
    let unnamed = |loss: &Loss| matches!(loss, Loss::Lost(_) | Loss::Budget);
    let ends = all.iter().flat_map(|one| [&one.low, &one.high]);
    let unnamed = ends.filter(|end| unnamed(&end.loss));
    let unnamed = unnamed.map(|end| format!("{end:?} of {scene:?}"));
    tally.wrong.extend(unnamed);
    for (share, anywhere) in shares {
        let mut scene = scene.clone();
        scene.excitation.frequency = frequency(&all, *share, *anywhere);
        let (points, undecided) = settled(&scene, starts);
        tally.motions += points.len();
        tally.undecided += undecided;
        let checked = scene.check().expect("valid");
        let denied = points.iter().filter(|point| {
            let on = |one: &StableRange| one.contains_point(&checked, point).unwrap_or(false);
            !all.iter().any(on)
        });
        let told = denied.map(|point| format!("{point:?} lies on no stable_range of {scene:?}"));
        tally.wrong.extend(told);
    }
    tally
}

/// A frequency on a stretch, or anywhere from 0.4 to 2.4.
fn frequency(all: &[StableRange], share: f64, anywhere: bool) -> f64 {
    let place = share * all.len() as f64;
    match all.get(place as usize) {
        Some(one) if !anywhere => {
            one.low.frequency + place.fract() * (one.high.frequency - one.low.frequency)
        }
        _ => 0.4 * 6f64.powf(share),
    }
}

#[test]
fn what_settles_on_z_1_lies_on_a_stretch() {
    let config = random::cases(MACHINES);
    let count = config.cases;
    let mut runner = TestRunner::new(config);
    let shares = prop::collection::vec((0.0..1.0f64, any::<bool>()), FREQUENCIES);
    let starts =
        prop::collection::vec((log_uniform(0.3, 60.0), 0.0..std::f64::consts::TAU), STARTS);
    let strategy = (machines(), shares, starts);
    let mut draw = || strategy.new_tree(&mut runner).expect("a machine").current();
    let cases: Vec<Case> = (0..count).map(|_| draw()).collect();
    let pool = rayon::ThreadPoolBuilder::new().build().expect("threads");
    let done = AtomicU32::new(0);
    let judge = |case| {
        let judged = judge(case);
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        if done.is_multiple_of(REPORTED) || !judged.wrong.is_empty() {
            eprintln!("{done} of {count} machines {:?}", judged.wrong);
        }
        judged
    };
    let judged: Vec<Tally> = pool.install(|| cases.par_iter().map(judge).collect());
    let sum = |part: fn(&Tally) -> usize| judged.iter().map(part).sum::<usize>();
    let (motions, undecided) = (sum(|one| one.motions), sum(|one| one.undecided));
    let starts = cases.len() * FREQUENCIES * STARTS;
    let wrong: Vec<&String> = judged.iter().flat_map(|one| &one.wrong).collect();
    let denied = wrong.len();
    println!(
        "{count} machines, {motions} motions, {denied} wrong, {undecided} of {starts} starts undecided"
    );
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(
        motions as u32 > count,
        "{motions} motions of {count} machines"
    );
}
