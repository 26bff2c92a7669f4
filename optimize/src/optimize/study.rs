//! What the tolerances do to a design, and what it costs to keep them inside the zone.

use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::progress::Progress;
use softstop_dynamics::Orbit;
use softstop_dynamics::basin::wilson_interval;
use softstop_dynamics::orbit::OrbitError;

use super::outcome::Outcome;
use super::task::Job;
use crate::design::Design;
use crate::design::figure::{Figure, Sense};
use crate::design::judge::Met;
use crate::design::problem::Problem;
use crate::design::requirement::Requirement;
use crate::robust::{
    EVEN, Effort, FITTED, Manifold, Nearest, Norm, Scatter, Sensitivities, Settings, Tolerance,
    Tolerances, Verdict, Worst, nearest, scatter, sensitivities, verify, verify_in_cases, worst,
};

/// A design's machines within its tolerances.
#[derive(Debug)]
pub struct Study {
    /// The tolerances, in SI units.
    pub tolerances: Vec<Tolerance>,
    /// Before-impact velocity of the design itself in m/s.
    pub nominal: f64,
    /// What is required of each of its machines, in the order of the verdict.
    pub required: Vec<Requirement>,
    /// What the machines have shown.
    pub verdict: Verdict,
    /// The machine that strikes the least.
    pub worst: Worst,
    /// Where the motion is lost as all tolerances grow, the nearest manifold first.
    pub nearest_box: Vec<Nearest>,
    /// The factor by which all tolerances may grow in each case until the motion is lost, if that is looked for so far.
    pub factors: Vec<Option<f64>>,
    /// Where the motion is lost, by the normal distance.
    pub nearest_ball: Vec<Nearest>,
    /// How velocity and margins change with each tolerance.
    pub sensitivities: Sensitivities,
    /// Whose scatter it is.
    pub scatter: Option<Scatter>,
    /// What the task without tolerances leads to.
    pub without: Option<Without>,
}

/// The best design if nothing has a tolerance and nothing is tried, and what becomes of it with them.
#[derive(Debug)]
pub struct Without {
    /// The design.
    pub design: Design,
    /// Machines within the tolerances about it.
    pub machines: usize,
    /// Those of them that lose the motion.
    pub lost: usize,
    /// The slowest impact of the others in m/s: by steps down from the design if none is lost, otherwise the least that was
    /// seen, which bounds nothing, for it falls towards the fold.
    pub slowest: f64,
}

impl Study {
    /// Takes note of the share of the machines that violate each requirement, and of its interval.
    pub(crate) fn note_violating(&self, problem: &Problem, all: &mut [Met]) {
        let machines = self.verdict.machines;
        let is_normal = problem.has_normal_tolerances();
        for met in all {
            let violating = match met.case {
                None => &self.verdict.violating,
                Some(index) => &self.verdict.cases[index].violating,
            };
            let mut counts = self.required.iter().zip(violating);
            if let Some((_, count)) = counts.find(|(it, _)| **it == met.requirement) {
                met.violating = Some(*count as f64 / machines as f64);
                met.interval = is_normal.then(|| wilson_interval(*count, machines));
            }
        }
    }

    /// The slowest impact in m/s that was found between the bounds: by steps down from the design, or seen.
    pub fn slowest(&self) -> f64 {
        let seen = self.verdict.slowest.as_ref().map(|(_, it)| it.velocity);
        let found = self.worst.orbit.before_impact_velocity();
        seen.map_or(found, |seen| seen.min(found))
    }
}

/// Tolerances up to which manifolds are looked for, as a factor.
const FARTHEST: f64 = 3.0;
/// Machines that are looked at about the design without tolerances.
const FEWER: usize = 1 << 11;

/// Looks at machines all over the tolerances, without reserve; none if everything is exact.
pub(super) fn study(job: &Job, outcome: &Outcome) -> Result<Option<Study>, Failure> {
    let design = outcome.design();
    let problem = job.problem.as_built();
    let spread = problem.spread(&design.machine);
    let Some(spread) = spread.filter(|_| job.samples > 0) else {
        return Ok(None);
    };
    let stopped = |error: OrbitError| match interrupt::requested() {
        true => Failure::Interrupted,
        false => Failure::Run(error.into()),
    };
    let (nominal, watcher) = (&design.orbit, &interrupt::watch);
    let progress = Progress::new(job.samples as u64, "machines");
    let settings = Settings::of_machines(job.samples);
    let required = problem.required_of_each();
    let Some(drawn) = problem.drawn(design) else {
        return Ok(None);
    };
    let verdict = verify_in_cases(&drawn, (settings, &required), &progress.watcher());
    let verdict = verdict.map_err(stopped)?;
    drop(progress);
    let distances = |(spread, nominal): (&Tolerances, &Orbit), norm| {
        let mut found = nearest(spread, nominal, norm, FARTHEST, watcher).map_err(stopped)?;
        let is_loss =
            |it: &Nearest| it.manifold != Manifold::Hysteresis || design.zone.is_hysteresis();
        found.retain(is_loss);
        Ok::<_, Failure>(found)
    };
    let cases = problem.in_cases();
    let factors = cases.iter().zip(&design.cases).map(|(case, it)| {
        let Some(spread) = case.spread(&it.machine) else {
            return Ok(None);
        };
        let nearest = distances((&spread, &it.orbit), Norm::Box)?;
        Ok::<_, Failure>(nearest.first().map(|it| it.distance))
    });
    let factors = factors.collect::<Result<_, _>>()?;
    let sensitivities =
        sensitivities(&spread, nominal, &design.zone).map_err(anyhow::Error::from)?;
    let study = Study {
        nominal: design.before_impact_velocity(),
        verdict,
        worst: slowest(&spread, nominal).map_err(stopped)?,
        required,
        nearest_box: distances((&spread, nominal), Norm::Box)?,
        factors,
        nearest_ball: distances((&spread, nominal), Norm::Ball)?,
        sensitivities,
        scatter: scatter(
            &spread.over(EVEN),
            (nominal, problem.zone),
            Effort::default(),
            watcher,
        )
        .map_err(stopped)?,
        without: outcome
            .solution
            .relaxed
            .as_ref()
            .map(|it| without(&problem, it))
            .transpose()
            .map_err(stopped)?
            .flatten(),
        tolerances: spread.all().to_vec(),
    };
    match interrupt::requested() {
        true => Err(Failure::Interrupted),
        false => Ok(Some(study)),
    }
}

/// The machine that strikes the least.
fn slowest(spread: &Tolerances, nominal: &Orbit) -> Result<Worst, OrbitError> {
    let figures = [(Figure::Velocity, Sense::Least)];
    let mut found = worst(spread, nominal, &figures, &interrupt::watch)?;
    found.pop().ok_or(OrbitError::NotIsolated)
}

/// What becomes of the best design without tolerances with them; none if it has no box of them.
fn without(problem: &Problem, design: &Design) -> Result<Option<Without>, OrbitError> {
    let Some(spread) = problem.spread(&design.machine) else {
        return Ok(None);
    };
    let settings = Settings::of_machines(FEWER);
    let drawn = spread.over(FITTED);
    let verdict = verify(&drawn, &design.orbit, (settings, &[]), &interrupt::watch)?;
    // Steps down end wherever the motion is lost.
    let seen = verdict.slowest.as_ref().map(|(_, it)| it.velocity);
    let slowest = match verdict.lost {
        0 => slowest(&spread, &design.orbit)?.value,
        _ => design.before_impact_velocity(),
    };
    Ok(Some(Without {
        machines: verdict.machines,
        lost: verdict.lost,
        slowest: seen.map_or(slowest, |seen| seen.min(slowest)),
        design: design.clone(),
    }))
}
