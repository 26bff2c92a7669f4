//! Holds the whole box of tolerances. A search knows the ends of the zone; what else is lost within the box, a fold inside
//! the zone, a flip, an inner grazing, is looked for about what it has found. Each such place becomes a constraint, and the
//! design moves until there are no more.

use softstop_console::interrupt;
use softstop_dynamics::zone::Loss;
use softstop_explore::zone::lost_by;

use super::ascent::ascend_from;
use super::coordinates::Candidate;
use super::problem::Problem;
use super::reach::LossDirections;
use super::{Design, Infeasible};
use crate::robust::{Manifold, Norm, Tolerances, first_losses, nearest};

/// How often a design is moved.
const ROUNDS: usize = 12;
/// Share of the tolerances that is rounding.
const ROUNDING: f64 = 1e-7;
/// Directions that are added at once, at most.
const MOST: usize = 4;
/// Places of the zone from which a design is sought anew.
const PLACES: [f64; 5] = [0.5, 0.3, 0.7, 0.1, 0.9];

/// What is lost of a design within its tolerances.
#[derive(Debug, Clone)]
struct Lost {
    /// In this direction of the box.
    direction: Vec<f64>,
    /// At this share of the way.
    share: f64,
    /// By this, in words.
    by: String,
}

/// A design with its whole box.
#[derive(Debug, Clone)]
pub(super) struct Robust {
    pub candidate: Candidate,
    /// What had to be known for that.
    pub known: LossDirections,
}

/// The best design about this one of which no machine within the tolerances loses the motion.
///
/// # Errors
/// [`Infeasible`] with how much is lacking if there is none.
pub(super) fn enforce_tolerance_box(
    problem: &Problem,
    start: &Candidate,
) -> Result<Robust, Infeasible> {
    let mut known = LossDirections::default();
    let mut candidate = start.clone();
    let mut lack: Option<Infeasible> = None;
    for _ in 0..ROUNDS {
        let before = known.directions.len();
        let Err(lost) = look(problem, &candidate.design, &mut known) else {
            return Ok(Robust { candidate, known });
        };
        if known.directions.len() == before {
            return Err(lost);
        }
        if lack.as_ref().is_none_or(|it| lost.gap < it.gap) {
            lack = Some(lost);
        }
        let next = again(problem, &known, &candidate).next();
        candidate = next.ok_or_else(|| lack.clone().unwrap_or_else(untold))?;
    }
    Err(lack.unwrap_or_else(untold))
}

/// Looks all around, and takes note of what was not known.
///
/// # Errors
/// [`Infeasible`] with how much is lacking if machines lose the motion, or cannot be computed.
pub(super) fn look(
    problem: &Problem,
    design: &Design,
    known: &mut LossDirections,
) -> Result<(), Infeasible> {
    let Some(spread) = problem.spread(&design.machine) else {
        return Ok(());
    };
    let lost = lost(&spread, design)?;
    let lacking = lost.first().map(lacking);
    known
        .directions
        .extend(lost.into_iter().map(|it| it.direction));
    lacking.map_or(Ok(()), Err)
}

impl Problem {
    /// Whether a design has its whole box.
    ///
    /// # Errors
    /// [`Infeasible`] with how much is lacking.
    pub fn has_box(&self, design: &Design) -> Result<(), Infeasible> {
        look(self, design, &mut LossDirections::default())
    }
}

fn untold() -> Infeasible {
    Infeasible::unknown("the machines within the tolerances could not be computed")
}

fn lacking(lost: &Lost) -> Infeasible {
    Infeasible {
        gap: 1.0 - lost.share,
        reason: format!(
            "within the tolerances the motion is lost ({}): it goes on over {:.4} of them only",
            lost.by, lost.share
        ),
    }
}

/// The best designs with what is known of the box, from one, and from other places of its zone.
fn again<'a>(
    problem: &'a Problem,
    known: &'a LossDirections,
    from: &'a Candidate,
) -> impl Iterator<Item = Candidate> + 'a {
    let places = [from.design.place].into_iter().chain(PLACES);
    places.filter_map(|place| ascend_from(problem, known, (&from.unit, place)))
}

/// The directions of the box in which the motion is lost within it.
fn lost(spread: &Tolerances, design: &Design) -> Result<Vec<Lost>, Infeasible> {
    let found = nearest(spread, &design.orbit, Norm::Box, 1.0, &interrupt::watch);
    let found = found.map_err(Infeasible::unknown)?;
    let nearest = found.into_iter().filter_map(|it| match it.manifold {
        Manifold::Motion(loss) => Some((it.at, loss)),
        Manifold::Hysteresis => None,
    });
    let mut told = told(nearest);
    if told.is_empty() {
        told = self::told(first_losses(spread, &design.orbit));
    }
    told.sort_by(|a, b| a.share.total_cmp(&b.share));
    told.truncate(MOST);
    Ok(told)
}

/// What ends the motion where the box touches it, in words.
pub(super) fn touched(problem: &Problem, design: &Design) -> Option<String> {
    let spread = problem.spread(&design.machine)?;
    let farthest = 1.0 + ROUNDING;
    let found = nearest(
        &spread,
        &design.orbit,
        Norm::Box,
        farthest,
        &interrupt::watch,
    )
    .ok()?;
    found.into_iter().find_map(|it| match it.manifold {
        Manifold::Motion(loss) => Some(lost_by(&loss)),
        Manifold::Hysteresis => None,
    })
}

/// What is lost at these places of the box, but at its border.
fn told(all: impl IntoIterator<Item = (Vec<f64>, Loss)>) -> Vec<Lost> {
    let lost = all.into_iter().map(|(at, loss)| {
        let share = at
            .iter()
            .fold(f64::MIN_POSITIVE, |most, part| most.max(part.abs()));
        Lost {
            direction: at.iter().map(|part| part / share).collect(),
            share,
            by: lost_by(&loss),
        }
    });
    lost.filter(|it| it.share < 1.0 - ROUNDING).collect()
}

/// Whether a place lies at the border of the box, or beyond it.
pub(super) fn is_at_edge(at: &[f64]) -> bool {
    at.iter().any(|part| part.abs() >= 1.0 - ROUNDING)
}
