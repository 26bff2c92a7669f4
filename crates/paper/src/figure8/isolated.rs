//! Motions that no sweep from rest reaches: found from starts spread over the plane, and swept from there.

use anyhow::Result;
use softstop::{Parameter, Ratios, Start};
use softstop_dynamics::attractors::{SearchOptions, find_attractors};
use softstop_dynamics::monitor::recall_or_compute;
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::{Chain, Direction, MotionKind, Orbit, Plan, SweepStep};

use super::Diagram;
use crate::diagram::{self, Job};
use crate::figure::{Detail, Studio};
use crate::table1::{paper, values};
use softstop_console::interrupt;
use softstop_console::progress::Progress;

/// How far from where they are found they are swept, at most.
const REACH: f64 = 0.02;
/// Fewest steps on which a motion is followed to be one of its own.
const SHORTEST: usize = 10;

/// Steps of all isolated motions.
pub(super) fn find(known: &[Diagram], studio: &Studio) -> Result<Vec<SweepStep>> {
    let detail = studio.detail;
    let mut found: Vec<SweepStep> = Vec::new();
    for (eta, orbit) in seeds(known, studio)? {
        if near(&found, eta).is_some_and(|step| shows(step, &orbit)) {
            continue;
        }
        let job = |way| job(eta, &orbit, way, detail);
        let jobs = vec![job(Direction::Down)?, job(Direction::Up)?];
        for chain in diagram::sweep(jobs, "steps of isolated motions", studio.kept)? {
            let apart = chain.steps.into_iter().take_while(|step| {
                let wanders = step.motion == MotionKind::Chaos;
                let mut others = known.iter().flat_map(|diagram| at(diagram, step.value));
                !wanders && !others.any(|other| diagram::same(step, other))
            });
            let apart: Vec<SweepStep> = apart.collect();
            if apart.len() >= detail.pick(SHORTEST, 2) {
                found.extend(apart);
            }
        }
        found.sort_by(|a, b| a.value.total_cmp(&b.value));
    }
    Ok(found)
}

/// Stable orbits at frequencies inside the paper's intervals that are on no sweep.
fn seeds(known: &[Diagram], studio: &Studio) -> Result<Vec<(f64, Orbit)>> {
    let detail = studio.detail;
    let options = SearchOptions {
        starts: detail.pick(128, 32),
        patience: 20_000,
        ..SearchOptions::default()
    };
    let some = detail.pick(values(&paper::INTERVALS), vec![0.9875]);
    let what = "frequencies searched for isolated motions";
    let progress = Progress::new(some.len() as u64, what);
    let mut seeds: Vec<(f64, Orbit)> = Vec::new();
    for eta in some {
        let scene = Ratios::unloaded().at_frequency(eta).scene()?;
        let orbits: Vec<Orbit> = recall_or_compute(studio.kept, &("isolated", &scene), || {
            let survey = find_attractors(&scene, &options, &interrupt::watch)?;
            let orbits = survey.attractors.into_iter().filter_map(|it| it.orbit);
            Ok::<_, OrbitError>(orbits.map(|orbit| *orbit).collect())
        })?;
        for orbit in orbits {
            let mut steps = known.iter().flat_map(|diagram| at(diagram, eta));
            if !steps.any(|step| shows(step, &orbit)) {
                seeds.push((eta, orbit));
            }
        }
        progress.step()?;
    }
    // Those in the middle of what was found lead farthest.
    let middle = 0.5 * (seeds.first().map_or(0.0, |it| it.0) + seeds.last().map_or(0.0, |it| it.0));
    seeds.sort_by(|a, b| (a.0 - middle).abs().total_cmp(&(b.0 - middle).abs()));
    Ok(seeds)
}

fn job(eta: f64, orbit: &Orbit, way: Direction, detail: Detail) -> Result<Job> {
    let range = match way {
        Direction::Up => (eta, eta + REACH),
        Direction::Down => (eta - REACH, eta),
    };
    let (steps, periods) = detail.pick((1000, 200), (60, 100));
    let plan = Plan::new(Parameter::Frequency, range, steps, periods)?;
    let start = Start::from(orbit.state());
    let chain = Chain::new(Ratios::unloaded().scene()?, way);
    Ok((Plan { start, ..plan }, vec![chain]))
}

/// True if a step shows an orbit.
fn shows(step: &SweepStep, orbit: &Orbit) -> bool {
    let (own, hardest) = (step.hardest_impact(), orbit.before_impact_velocity());
    step.motion.regime() == Some(orbit.regime())
        && (own - hardest).abs() <= diagram::APART * hardest.max(own)
}

/// The steps of both sweeps nearest to a frequency, if the diagram shows it.
fn at<'a>(diagram: &'a Diagram<'_>, eta: f64) -> impl Iterator<Item = &'a SweepStep> + use<'a> {
    let (low, high) = diagram.part.range;
    let ways = diagram.ways.iter();
    let ways = ways.filter(move |_| (low..=high).contains(&eta));
    ways.filter_map(move |chain| near(&chain.steps, eta))
}

fn near(steps: &[SweepStep], eta: f64) -> Option<&SweepStep> {
    let gap = |step: &&SweepStep| (step.value - eta).abs();
    steps.iter().min_by(|a, b| gap(a).total_cmp(&gap(b)))
}
