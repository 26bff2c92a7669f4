//! What the tolerances do to a design, and what it costs to keep them inside the zone.

use softstop_console::failure::{Failure, check_interrupt};
use softstop_console::interrupt;
use softstop_console::progress::Progress;
use softstop_dynamics::Orbit;
use softstop_dynamics::basin::wilson_interval;
use softstop_dynamics::orbit::OrbitError;

use super::outcome::Outcome;
use super::task::Job;
use crate::design::Design;
use crate::design::figure::{Figure, Sense};
use crate::design::judge::RequirementValue;
use crate::design::problem::Problem;
use crate::design::requirement::Requirement;
use crate::robust::{
    AbsoluteTolerance, CaseVerdict, EVEN, FITTED, Manifold, Nearest, Norm, SampleSize, Scatter,
    Sensitivities, Tolerances, Verdict, VerifySettings, nearest, scatter, sensitivities, verify,
    verify_in_cases, worst,
};

/// A design's machines within its tolerances.
#[derive(Debug)]
pub struct ToleranceStudy {
    /// The tolerances, in SI units.
    pub tolerances: Vec<AbsoluteTolerance>,
    /// What is required of each of its machines, in the order of the verdict.
    pub required: Vec<Requirement>,
    /// What the machines have shown.
    pub verdict: Verdict,
    /// The slowest impact in m/s that was found between the bounds, by steps down from the design or seen: of the drawing and of
    /// each case.
    pub slowest: Vec<f64>,
    /// Where the motion is lost as all tolerances grow, the nearest manifold first, if that is looked for so far: of the drawing and of
    /// each case.
    pub nearest: Vec<Vec<Nearest>>,
    /// The normal distance to where the motion is lost, if that is looked for so far.
    pub normal_distance: Option<f64>,
    /// How velocity and margins change with each tolerance.
    pub sensitivities: Sensitivities,
    /// Whose scatter it is.
    pub scatter: Option<Scatter>,
    /// What the task without tolerances leads to.
    pub without: Option<DesignWithoutTolerances>,
}

/// The best design if nothing has a tolerance and nothing is tried, and what becomes of it with them.
#[derive(Debug)]
pub struct DesignWithoutTolerances {
    /// The design.
    pub design: Design,
    /// What the machines within the tolerances about it have shown.
    pub verdict: Verdict,
    /// The slowest impact in m/s of those that keep the motion: by steps down from the design if none is lost, otherwise the least that was
    /// seen, which bounds nothing, for it falls towards the fold.
    pub slowest: f64,
}

impl ToleranceStudy {
    /// The slowest impact in m/s that was found between the bounds in the drawing or in a case.
    pub(crate) fn slowest(&self, case: Option<usize>) -> f64 {
        self.slowest[case.map_or(0, |index| index + 1)]
    }

    /// The factor by which all tolerances may grow in the drawing or in a case until the motion is lost, if that is looked for so far.
    pub(crate) fn factor(&self, case: Option<usize>) -> Option<f64> {
        let nearest = &self.nearest[case.map_or(0, |index| index + 1)];
        Some(nearest.first()?.distance)
    }

    /// Takes note of the share of the machines that violate each requirement, and of its interval.
    pub(crate) fn note_violating(&self, problem: &Problem, all: &mut [RequirementValue]) {
        let machines = self.verdict.machines;
        let is_normal = problem.has_normal_tolerances();
        for met in all {
            let violating = &self.verdict.for_case(met.case).violating;
            let mut counts = self.required.iter().zip(violating);
            if let Some((_, count)) = counts.find(|(it, _)| **it == met.requirement) {
                met.violating = Some(*count as f64 / machines as f64);
                met.interval = is_normal.then(|| wilson_interval(*count, machines));
            }
        }
    }
}

/// Tolerances up to which manifolds are looked for, as a factor.
const FARTHEST: f64 = 3.0;
/// Machines that are looked at about the design without tolerances.
const FEWER: usize = 1 << 11;

/// Looks at machines all over the tolerances, without reserve; none if everything is exact.
pub(super) fn study(job: &Job, outcome: &Outcome) -> Result<Option<ToleranceStudy>, Failure> {
    let design = outcome.design();
    let problem = job.problem.as_built();
    let spread = problem.spread(&design.machine);
    let Some(spread) = spread.filter(|_| job.samples > 0) else {
        return Ok(None);
    };
    let stopped = |error: OrbitError| Failure::from(anyhow::Error::from(error));
    let (nominal, watcher) = (&design.orbit, &interrupt::watch);
    let progress = Progress::new(job.samples as u64, "machines");
    let settings = VerifySettings::of_machines(job.samples);
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
    let points = problem.operating_points(design);
    let slowest = points.iter().map(|it| {
        let seen = verdict.for_case(it.case).slowest;
        let spread = it.problem.spread(&it.design.machine);
        spread.map_or(Ok(seen), |spread| {
            slowest(&spread, &it.design.orbit, seen).map_err(stopped)
        })
    });
    let slowest = slowest.collect::<Result<Vec<f64>, Failure>>()?;
    let nearest = points.iter().map(|it| {
        let spread = it.problem.spread(&it.design.machine);
        spread.map_or(Ok(Vec::new()), |spread| {
            distances((&spread, &it.design.orbit), Norm::Box)
        })
    });
    let nearest = nearest.collect::<Result<Vec<_>, Failure>>()?;
    let sensitivities =
        sensitivities(&spread, nominal, &design.zone).map_err(anyhow::Error::from)?;
    let motions = (nominal, &design.zone);
    let scatter = scatter(&spread.over(EVEN), motions, SampleSize::default(), watcher);
    let study = ToleranceStudy {
        slowest,
        verdict,
        required,
        nearest,
        normal_distance: distances((&spread, nominal), Norm::Ball)?
            .first()
            .map(|it| it.distance),
        sensitivities,
        scatter: scatter.map_err(stopped)?,
        without: match &outcome.solution.relaxed {
            Some(relaxed) => without(&problem, relaxed).map_err(stopped)?,
            None => None,
        },
        tolerances: spread.all().to_vec(),
    };
    check_interrupt()?;
    Ok(Some(study))
}

/// The slowest impact in m/s of the machines that keep the motion: by steps down from the nominal one, or `seen`.
fn slowest(spread: &Tolerances, nominal: &Orbit, seen: f64) -> Result<f64, OrbitError> {
    let figures = [(Figure::Velocity, Sense::Least)];
    let found = worst(spread, nominal, &figures, &interrupt::watch)?;
    let found = found.iter().map(|it| it.value);
    Ok(found.fold(seen, f64::min))
}

/// What becomes of the best design without tolerances with them; none if it has no box of them.
fn without(
    problem: &Problem,
    design: &Design,
) -> Result<Option<DesignWithoutTolerances>, OrbitError> {
    let Some(spread) = problem.spread(&design.machine) else {
        return Ok(None);
    };
    let settings = VerifySettings::of_machines(FEWER);
    let drawn = spread.over(FITTED);
    let verdict = verify(&drawn, &design.orbit, (settings, &[]), &interrupt::watch)?;
    let CaseVerdict { lost, slowest, .. } = verdict.drawing;
    Ok(Some(DesignWithoutTolerances {
        // Steps down end wherever the motion is lost.
        slowest: match lost {
            0 => self::slowest(&spread, &design.orbit, slowest)?,
            _ => slowest.min(design.before_impact_velocity()),
        },
        design: design.clone(),
        verdict,
    }))
}
