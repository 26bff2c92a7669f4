//! Several motions side by side, and what most of them do.

use super::{Rules, TransitionError};
use crate::attractors::{Arrival, Options, settle};
use crate::continuation::Family;
use crate::motion::MotionKind;
use crate::orbit::{Exponents, Orbit};
use crate::watch::{Kept, Watcher, piece};
use serde::{Deserialize, Serialize};
use softstop::Start;

/// Relative differences between motions started side by side.
const SPREAD: f64 = 1e-9;
/// Drive periods in each batch of an exponent.
const BATCH: u64 = 1600;

/// Finds transitions of a family's motions.
pub struct Explorer<'a, F> {
    pub(super) family: &'a F,
    pub(super) range: (f64, f64),
    pub(super) rules: Rules,
    pub(super) watcher: Watcher<'a>,
    pub(super) kept: Kept<'a>,
}

/// Where most of several motions are.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct Gathering {
    /// What they do; none if that cannot be said yet.
    pub motion: Option<MotionKind>,
    /// The orbit, if they repeat.
    pub orbit: Option<Orbit>,
    /// Those that do so.
    pub states: Vec<Start>,
}

impl<'a, F: Family + Sync> Explorer<'a, F> {
    /// A search in a range of the parameter. The watcher is told of the drive periods of one look at
    /// motions after the other.
    pub fn new(family: &'a F, range: (f64, f64), rules: Rules, watcher: Watcher<'a>) -> Self {
        Self {
            family,
            range,
            rules,
            watcher,
            kept: None,
        }
    }

    /// The same search, in which what is known is recalled.
    #[must_use]
    pub fn recalling(self, kept: Kept<'a>) -> Self {
        Self { kept, ..self }
    }

    /// Holds the parameter and lets motions settle.
    pub(super) fn hold(
        &self,
        value: f64,
        starts: &[Start],
        periods: u64,
    ) -> Result<Vec<Arrival>, TransitionError> {
        let options = Options {
            transient: periods,
            ..self.rules.survey
        };
        let scene = self.family.scene([value])?;
        Ok(settle(&scene, starts, &options, self.watcher)?)
    }

    /// What most of them do then.
    pub(super) fn gather(
        &self,
        value: f64,
        starts: &[Start],
    ) -> Result<Gathering, TransitionError> {
        let of = ("gathering", self.family.scene([value])?, starts);
        piece(self.kept, &of, || self.gather_anew(value, starts))
    }

    fn gather_anew(&self, value: f64, starts: &[Start]) -> Result<Gathering, TransitionError> {
        let arrivals = self.hold(value, starts, self.rules.patience)?;
        let (settled, wandering): (Vec<Arrival>, Vec<Arrival>) =
            arrivals.into_iter().partition(|it| it.orbit.is_some());
        if wandering.len() > settled.len() {
            let states: Vec<Start> = wandering.into_iter().map(|it| it.state).collect();
            let scene = self.family.scene([value])?;
            let (exponents, _) = Exponents::along(&scene, states[0].into(), BATCH)?;
            return Ok(Gathering {
                motion: exponents.is_positive().then_some(MotionKind::Chaos),
                orbit: None,
                states,
            });
        }
        Ok(most(settled))
    }

    /// As many motions as the rules ask for: the given ones, and others beside them.
    pub(super) fn fill(&self, states: &[Start]) -> Vec<Start> {
        let beside = |(index, state): (usize, &Start)| {
            let round = (index / states.len()) as f64;
            Start::new(
                state.position * (1.0 + SPREAD * round),
                state.velocity * (1.0 + SPREAD * round),
            )
        };
        let all = states.iter().cycle().take(self.rules.motions);
        all.enumerate().map(beside).collect()
    }
}

/// The commonest orbit of motions that have settled.
pub(super) fn most(settled: Vec<Arrival>) -> Gathering {
    let mut kinds: Vec<(MotionKind, Orbit, Vec<Start>)> = Vec::new();
    for arrival in settled {
        let Some(orbit) = arrival.orbit else { continue };
        let motion = MotionKind::of(&orbit);
        match kinds.iter_mut().find(|kind| kind.0 == motion) {
            Some(kind) => kind.2.push(arrival.state),
            None => kinds.push((motion, orbit, vec![arrival.state])),
        }
    }
    let most = kinds.into_iter().max_by_key(|kind| kind.2.len());
    let gathering = most.map(|(motion, orbit, states)| Gathering {
        motion: Some(motion),
        orbit: Some(orbit),
        states,
    });
    gathering.unwrap_or_default()
}
