//! Requirements that take many simulated motions: establishing certainty, run-up from rest, missing strips. They have
//! no derivatives: `check_trials` seeks a design that meets them. Within tolerances they are made at the corners of the box.

use softstop_console::interrupt;
use softstop_dynamics::Orbit;
use softstop_dynamics::basin::Establishment;
use softstop_dynamics::missing_strips::{StopWithoutStrip, survives_missing_strips};
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::parallel;
use softstop_dynamics::run_up::RunUp;

use super::conflict::{conflict, violated_within};
use super::critical::CriticalMachines;
use super::figure::Figure;
use super::judge::{RequirementValue, violation};
use super::operating_point::OperatingPoint;
use super::problem::Problem;
use super::requirement::{Requirement, Scope};
use super::{Design, Infeasible};
use crate::robust::{Neighbours, corners};

/// Starts of the box.
pub const STARTS: usize = 1024;
/// Drive angles at which the drive is switched on or strips are missing.
pub const ANGLES: usize = 64;

/// How many motions a trial counts.
#[derive(Debug, Clone, Copy)]
pub(super) struct TrialSize {
    starts: usize,
    angles: usize,
}

/// As many as results are told by, and a quarter of them.
pub(super) const FULL: TrialSize = TrialSize {
    starts: STARTS,
    angles: ANGLES,
};
pub(super) const ROUGH: TrialSize = TrialSize {
    starts: STARTS / 4,
    angles: ANGLES / 4,
};

/// Corners of the tolerances at which trials are made, at most.
const CORNERS: usize = 16;

impl Problem {
    /// The requirements that one motion tells.
    pub(super) fn single(&self) -> impl Iterator<Item = &Requirement> {
        self.requirements.iter().filter(|it| !it.figure.is_trial())
    }

    /// The requirements that take many motions.
    pub(super) fn trials(&self) -> impl Iterator<Item = &Requirement> {
        self.requirements.iter().filter(|it| it.figure.is_trial())
    }

    /// What a design has of the requirements that take many motions, at the corners of the tolerances and in all cases too.
    ///
    /// # Errors
    /// [`OrbitError`] if a motion cannot be computed, or somebody asked to stop.
    pub fn tried(&self, design: &Design) -> Result<Vec<RequirementValue>, OrbitError> {
        let mut tried = Vec::new();
        for it in self.operating_points(design) {
            let corners = it.problem.corners(it.design);
            for own in it.tried()? {
                let worst = it.problem.tried_within(&own.requirement, &corners)?;
                let worst = worst.map(|(worst, _)| worst);
                tried.push(RequirementValue { worst, ..own });
            }
        }
        Ok(tried)
    }

    /// How far a design is from what is required of many motions of its own machine, in units of the bounds, over all cases;
    /// none if a motion cannot be computed.
    pub(super) fn trial_violation(&self, design: &Design) -> Option<f64> {
        let points = self.operating_points(design);
        let each = points.iter().map(|it| {
            let own = it.tried_or_refuted().ok()?;
            let lacks = own.iter().map(|it| it.requirement.violation(it.judged()));
            Some(lacks.sum::<f64>())
        });
        each.sum()
    }

    /// The motions at corners of the tolerances; none where the motion is lost.
    fn corners(&self, design: &Design) -> Vec<(Vec<f64>, Option<Orbit>)> {
        let is_asked = self.trials().any(|it| it.scope == Scope::Tolerances);
        let spread = self.spread(&design.machine).filter(|_| is_asked);
        spread.map_or_else(Vec::new, |spread| {
            let all = corners(self.tolerances_in_use(), CORNERS);
            let neighbours = Neighbours::new(&spread, &design.orbit);
            parallel::map(&all, |at| (at.clone(), neighbours.motion(at)))
        })
    }

    /// What the worst of some machines has of a requirement, and its coordinates; none if there are none, or it asks for nothing of
    /// them.
    fn tried_within(
        &self,
        requirement: &Requirement,
        corners: &[(Vec<f64>, Option<Orbit>)],
    ) -> Result<Option<(f64, Vec<f64>)>, OrbitError> {
        if requirement.scope == Scope::Drawing {
            return Ok(None);
        }
        let each = parallel::try_map(corners, |(at, orbit)| {
            let orbit = orbit.as_ref();
            let met = orbit.map(|orbit| self.tried_of(requirement, orbit, FULL));
            let value = met.transpose()?.map_or(f64::NAN, |met| met.judged());
            Ok::<_, OrbitError>((value, at.clone()))
        });
        let order = |(a, _): &(f64, Vec<f64>), (b, _): &(f64, Vec<f64>)| {
            let [one, other] = [a, b].map(|it| requirement.violation(*it));
            let margins = [a, b].map(|it| requirement.margin(*it));
            other
                .total_cmp(&one)
                .then(margins[0].total_cmp(&margins[1]))
        };
        Ok(each?.into_iter().min_by(order))
    }

    /// What a design that meets the requirements which take many motions has of them, at the corners of the tolerances and in
    /// all cases too.
    ///
    /// # Errors
    /// [`Infeasible`] with what it lacks; the corner that lacks most is taken note of.
    pub(super) fn pass_trials(
        &self,
        design: &Design,
        known: &mut CriticalMachines,
    ) -> Result<Vec<RequirementValue>, Infeasible> {
        let points = self.operating_points(design);
        let passed = points.iter().map(|it| {
            let passed = it.pass_trials(known.for_case_mut(it.case));
            passed.map_err(|lack| lack.in_point(self, it.case))
        });
        Ok(passed.collect::<Result<Vec<_>, _>>()?.concat())
    }

    /// Whether a design meets the requirements that take many motions, in its own machine and in those within the tolerances that
    /// are known, in all cases.
    pub(super) fn passes(
        &self,
        design: &Design,
        known: &CriticalMachines,
        effort: TrialSize,
    ) -> bool {
        self.operating_points(design).iter().all(|it| {
            let known = &known.for_case(it.case).tried;
            it.problem.passes_at_point(it.design, known, effort)
        })
    }

    /// The machines within the tolerances that were met last come first: they most likely fail.
    fn passes_at_point(&self, design: &Design, others: &[Vec<f64>], effort: TrialSize) -> bool {
        let spread = self.spread(&design.machine);
        let neighbours = spread.as_ref().map(|it| Neighbours::new(it, &design.orbit));
        let at = |neighbours: &Neighbours, at: &[f64]| {
            let mut all = self.trials().filter(|it| it.scope == Scope::Tolerances);
            let orbit = neighbours.motion(at);
            orbit.is_some_and(|orbit| all.all(|it| self.is_passed(it, &orbit, effort)))
        };
        let within = neighbours.is_none_or(|it| others.iter().rev().all(|other| at(&it, other)));
        within
            && self
                .trials()
                .all(|it| self.is_passed(it, &design.orbit, effort))
    }

    /// What a motion has of a requirement that takes many.
    fn tried_of(
        &self,
        requirement: &Requirement,
        orbit: &Orbit,
        effort: TrialSize,
    ) -> Result<RequirementValue, OrbitError> {
        let TrialSize { starts, angles } = effort;
        let watcher = &interrupt::watch;
        let mut met = RequirementValue::of(*requirement);
        match requirement.figure {
            Figure::Certainty => {
                let starts = self.established(orbit, starts)?;
                (met.value, met.starts) = (starts.share, Some(starts));
            }
            Figure::Integrity => {
                let region = self.region(orbit)?;
                let (starts, radius) =
                    Establishment::with_ball_radius(orbit, &region, starts, watcher)?;
                (met.value, met.starts) = (radius, Some(starts));
            }
            Figure::RunUp => {
                let runs = RunUp::of(orbit, &self.run_up, angles, watcher)?;
                met.value = runs.working_ways().count() as f64;
            }
            Figure::MissingStrips => {
                met.value = f64::from(survived(requirement, orbit, angles)?);
            }
            _ => {}
        }
        Ok(met)
    }

    /// Whether it meets one: with few motions by what was counted, else by the lower end of its interval.
    fn is_passed(&self, requirement: &Requirement, orbit: &Orbit, effort: TrialSize) -> bool {
        let is_asked_for_one = (requirement.least, requirement.most) == (Some(1.0), None);
        if requirement.figure == Figure::RunUp && is_asked_for_one {
            let watcher = &interrupt::watch;
            return RunUp::is_possible(orbit, &self.run_up, effort.angles, watcher)
                .unwrap_or(false);
        }
        let is_met = |met: &RequirementValue| match effort.starts < STARTS {
            true => requirement.is_met(met.value),
            false => met.is_met(),
        };
        if requirement.figure == Figure::Certainty && requirement.most.is_none() {
            let least = requirement.least.unwrap_or(0.0);
            if !matches!(self.refuted_share(orbit, least), Ok(None)) {
                return false;
            }
            let is_enough = |starts: &Establishment| {
                is_met(&RequirementValue {
                    value: starts.share,
                    starts: Some(*starts),
                    ..RequirementValue::of(*requirement)
                })
            };
            let enough = self.is_established(orbit, effort.starts, is_enough);
            return enough.unwrap_or(false);
        }
        let tried = self.tried_of(requirement, orbit, effort);
        tried.is_ok_and(|met| is_met(&met))
    }
}

impl OperatingPoint<'_> {
    /// What its own machine has of the requirements that take many motions.
    fn tried(&self) -> Result<Vec<RequirementValue>, OrbitError> {
        let (case, orbit) = (self.case, &self.design.orbit);
        let own = self.problem.trials().map(|it| {
            let met = self.problem.tried_of(it, orbit, FULL)?;
            Ok(RequirementValue { case, ..met })
        });
        own.collect()
    }

    /// What its own machine has of the requirements that take many motions, or of the certainty alone, where a few starts refute it.
    fn tried_or_refuted(&self) -> Result<Vec<RequirementValue>, OrbitError> {
        let few = self.refuted_certainty()?;
        few.map_or_else(|| self.tried(), |few| Ok(vec![few]))
    }

    /// What it has of the requirements that take many motions, if it meets them.
    fn pass_trials(
        &self,
        known: &mut CriticalMachines,
    ) -> Result<Vec<RequirementValue>, Infeasible> {
        let (problem, design) = (&self.problem, self.design);
        let mut own = self.tried_or_refuted().map_err(Infeasible::unknown)?;
        for met in own.iter().filter(|it| !it.is_met()) {
            known.note_failed_trial(met.requirement.figure);
        }
        if !own.iter().all(RequirementValue::is_met) {
            let reason = conflict(&design.machine, &own);
            return Err(Infeasible::new(violation(&own), reason));
        }
        let corners = problem.corners(design);
        for met in &mut own {
            let requirement = &met.requirement;
            let worst = problem.tried_within(requirement, &corners);
            let Some((worst, at)) = worst.map_err(Infeasible::unknown)? else {
                continue;
            };
            if !requirement.is_met(worst) {
                known.tried.push(at);
                known.note_failed_trial(requirement.figure);
                let reason = violated_within(&design.machine, requirement, worst);
                return Err(Infeasible::new(requirement.violation(worst), reason));
            }
            met.worst = Some(worst);
        }
        Ok(own)
    }
}

/// Strips in a row that may be missing, as many as are asked for at most.
fn survived(requirement: &Requirement, orbit: &Orbit, angles: usize) -> Result<u32, OrbitError> {
    let most = requirement.least.unwrap_or(0.0) as u32;
    for missing in 1..=most {
        let gaps = survives_missing_strips(
            orbit,
            missing,
            StopWithoutStrip::Fixed,
            angles,
            &interrupt::watch,
        )?;
        if gaps.return_share() < 1.0 {
            return Ok(missing - 1);
        }
    }
    Ok(most)
}
