//! The share of starts that lead to a motion, and where few of them tell that it is too small.

use softstop_console::interrupt;
use softstop_dynamics::Orbit;
use softstop_dynamics::attractors::{Region, starting_box};
use softstop_dynamics::basin::{Establishment, SLOW_DECAY};
use softstop_dynamics::orbit::OrbitError;

use super::Design;
use super::critical::CriticalMachines;
use super::figure::Figure;
use super::judge::RequirementValue;
use super::operating_point::OperatingPoint;
use super::problem::Problem;
use super::trial::STARTS;
use crate::robust::Neighbours;

/// Starts that are counted first: where they show that far too few lead to a motion, no more are.
const FIRST_STARTS: usize = STARTS / 16;
/// Exponent of e of the probability that so few of the first starts lead to a motion to which enough of all do.
const REFUTING_EXPONENT: f64 = 14.0;

impl Problem {
    /// The least share of starts that lead to the motion of a design, of its own machine or of those within the tolerances that
    /// are known, in all cases, by the lower end of its interval; none if a motion is lost.
    pub(super) fn least_certainty(&self, design: &Design, known: &CriticalMachines) -> Option<f64> {
        let needed = self.least_share().unwrap_or(0.0);
        let share = |orbit: &Orbit| {
            let refuted = self.refuted_share(orbit, needed).ok()?;
            let starts = refuted.map_or_else(|| self.established(orbit, STARTS), Ok);
            Some(starts.ok()?.interval[0])
        };
        let mut least = f64::INFINITY;
        for it in self.operating_points(design) {
            least = least.min(share(&it.design.orbit)?);
            let Some(spread) = it.problem.spread(&it.design.machine) else {
                continue;
            };
            let neighbours = Neighbours::new(&spread, &it.design.orbit);
            for at in &known.for_case(it.case).tried {
                least = least.min(share(&neighbours.motion(at)?)?);
            }
        }
        Some(least)
    }

    /// The share of starts that must lead to a motion, if any.
    pub(super) fn least_share(&self) -> Option<f64> {
        let mut all = self.trials();
        all.find(|it| it.figure == Figure::Certainty)?.least
    }

    /// The share of starts that lead to a motion.
    ///
    /// # Errors
    /// As [`Problem::tried`].
    pub(super) fn established(
        &self,
        orbit: &Orbit,
        starts: usize,
    ) -> Result<Establishment, OrbitError> {
        let region = self.region(orbit)?;
        Establishment::within_region(orbit, &region, starts, &interrupt::watch)
    }

    /// What the first starts show of the share that leads to a motion, if motions decay so slowly that to follow all would take
    /// minutes, and that is certainly smaller than a share.
    pub(super) fn refuted_share(
        &self,
        orbit: &Orbit,
        share: f64,
    ) -> Result<Option<Establishment>, OrbitError> {
        if share <= 0.0 || !settles_slowly(orbit) {
            return Ok(None);
        }
        let first = self.established(orbit, FIRST_STARTS)?;
        Ok(Some(first).filter(|it| is_refuted((it.share, FIRST_STARTS), share)))
    }

    /// Whether the share of starts that lead to a motion is enough, without counting all of them.
    pub(super) fn is_established(
        &self,
        orbit: &Orbit,
        starts: usize,
        is_enough: impl Fn(&Establishment) -> bool,
    ) -> Result<bool, OrbitError> {
        let (region, watcher) = (self.region(orbit)?, &interrupt::watch);
        Establishment::is_enough_within_region(orbit, &region, starts, is_enough, watcher)
    }

    /// The box of starts: what the task states of it, before a rigid stop, or that of all commands.
    pub(super) fn region(&self, orbit: &Orbit) -> Result<Region, OrbitError> {
        match &self.starts {
            Some(region) => Ok(region.clipped_at_stops(&orbit.scene)),
            None => starting_box(&orbit.scene, &interrupt::watch),
        }
    }
}

impl OperatingPoint<'_> {
    /// The certainty that is required, as the first starts show it, if they refute it.
    pub(super) fn refuted_certainty(&self) -> Result<Option<RequirementValue>, OrbitError> {
        let (case, orbit) = (self.case, &self.design.orbit);
        let mut required = self.problem.trials();
        let required = required.find(|it| it.figure == Figure::Certainty && it.least.is_some());
        let Some(requirement) = required else {
            return Ok(None);
        };
        let least = requirement.least.unwrap_or(0.0);
        let refuted = self.problem.refuted_share(orbit, least)?;
        Ok(refuted.map(|starts| RequirementValue {
            case,
            value: starts.share,
            starts: Some(starts),
            ..RequirementValue::of(*requirement)
        }))
    }
}

/// Whether motions near an orbit decay so slowly that a basin test does not follow all of them to their end: a start then takes so
/// many periods that a share far too small is told by the first ones.
fn settles_slowly(orbit: &Orbit) -> bool {
    relative_decay(orbit) < 1.0
}

/// The decay of motions near an orbit, in units of the least with which a basin test follows all of them to their end.
fn relative_decay(orbit: &Orbit) -> f64 {
    let slowest = orbit.monodromy.multipliers()[0].norm();
    -slowest.ln() / (SLOW_DECAY * orbit.periods as f64)
}

impl Design {
    /// The relative decay of the motions near its own, the least of all cases.
    pub(super) fn relative_decay(&self) -> f64 {
        let all = self.points().map(|it| relative_decay(&it.orbit));
        all.fold(f64::INFINITY, f64::min)
    }
}

/// Whether so small a share of so many starts would be met with a probability of less than `e^-14` if a share of all that is
/// least led to the motion (Chernoff 1952).
fn is_refuted((share, starts): (f64, usize), least: f64) -> bool {
    let part = |own: f64, other: f64| match own {
        0.0 => 0.0,
        own => own * (own / other).ln(),
    };
    let divergence = part(share, least) + part(1.0 - share, 1.0 - least);
    share < least && starts as f64 * divergence > REFUTING_EXPONENT
}

#[cfg(test)]
mod tests {
    use super::is_refuted;

    #[test]
    fn only_a_share_far_below_is_refuted() {
        assert!(is_refuted((0.0, 64), 0.2));
        assert!(is_refuted((0.5, 64), 0.9) && is_refuted((0.5, 64), 1.0));
        assert!(!is_refuted((0.0, 64), 0.1));
        assert!(!is_refuted((0.15, 64), 0.2) && !is_refuted((0.3, 64), 0.2));
        assert!(!is_refuted((1.0, 64), 1.0));
    }
}
