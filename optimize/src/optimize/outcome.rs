//! What came of a search, and what was looked at of the design beside it.

use serde::Serialize;
use softstop::Parameter;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_dynamics::basin::ErosionProfile;
use softstop_dynamics::run_up::RunUp;

use super::pareto::CheckedFront;
use crate::design::Design;
use crate::design::constraint::ActiveLimit;
use crate::design::front::Front;
use crate::design::judge::Met;
use crate::design::requirement::Requirement;
use crate::design::search::{Ascents, Resolution};

/// Places of the erosion profile beside the design's.
pub(super) const PLACES: usize = 25;

/// What a run was doing when it was asked to end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Interrupted {
    /// It searched: its design is the best until then.
    Search,
    /// It had found its design and looked at it.
    Report,
}

impl Interrupted {
    /// What is written of it.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Search => "the best design of an interrupted search, not the optimum",
            Self::Report => "found by the whole search; interrupted before its report was made",
        }
    }

    /// What is said in the end.
    pub(super) const fn closing(self) -> &'static str {
        match self {
            Self::Search => {
                "interrupted: the best design so far is written; the same line with --resume goes on with the search"
            }
            Self::Report => {
                "interrupted: the design is written, without its report; the same line with --resume makes that"
            }
        }
    }
}

/// The share of the machines that violate a requirement.
pub(super) struct Violating {
    pub requirement: Requirement,
    /// The index of the case, if it is one.
    pub case: Option<usize>,
    pub share: f64,
    /// Its 95 % interval if the machines are drawn from normal tolerances.
    pub interval: Option<[f64; 2]>,
}

/// What came of a search.
#[derive(Debug)]
pub struct Outcome {
    /// The best design.
    pub design: Design,
    /// Standard deviations of normal tolerances that it keeps.
    pub deviations: f64,
    /// All that holds it back.
    pub limits: Vec<ActiveLimit>,
    /// Searched parameters that change nothing of what is sought and required.
    pub without_effect: Vec<Parameter>,
    /// The best design if nothing has a tolerance and nothing is tried.
    pub relaxed: Option<Design>,
    /// Others nearly as good, far from it.
    pub rivals: Vec<Design>,
    /// What was required, and what the design has of it.
    pub met: Vec<Met>,
    /// Zones that were computed.
    pub evaluations: u64,
    /// How fine it was looked for, if trials were in the way.
    pub resolution: Option<Resolution>,
    /// What the search took.
    pub ascents: Ascents,
    /// Whether the run was asked to end.
    pub interrupted: Option<Interrupted>,
    /// The basin along the zone, for the report.
    pub erosion: Option<ErosionProfile>,
    /// Ways to run the machine up, for the report.
    pub run_up: Option<RunUp>,
    /// What more of one good costs of another, for the report.
    pub fronts: Vec<Front>,
    /// The designs among which one can choose, if more than one thing is sought.
    pub pareto: Option<CheckedFront>,
}

impl Outcome {
    /// Goes on with the run; none, and the run is marked as interrupted, once it was asked to end.
    pub(super) fn go_on<T>(
        &mut self,
        what: impl FnOnce(&Self) -> Result<T, Failure>,
    ) -> Result<Option<T>, Failure> {
        if self.interrupted.is_some() {
            return Ok(None);
        }
        let done = what(self);
        if !interrupt::requested() {
            return done.map(Some);
        }
        interrupt::save();
        self.interrupted = Some(Interrupted::Report);
        Ok(None)
    }

    /// Takes note of the share of the machines within the tolerances that violate each requirement, and of its interval.
    pub(super) fn note_violating(&mut self, shares: impl Iterator<Item = Violating>) {
        for it in shares {
            let mut met = self.met.iter_mut();
            let is_own = |met: &&mut Met| met.requirement == it.requirement && met.case == it.case;
            if let Some(met) = met.find(is_own) {
                met.violating = Some(it.share);
                met.interval = it.interval;
            }
        }
    }
}
