//! What came of a search, and what was looked at of the design beside it.

use std::fmt::Display;

use serde::Serialize;
use softstop::Parameter;
use softstop::internals::budget;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_dynamics::basin::ErosionProfile;
use softstop_dynamics::run_up::RunUp;

use crate::design::Design;
use crate::design::judge::RequirementValue;
use crate::design::solution::Solution;

/// Places of the erosion profile beside the design's.
pub(super) const PLACES: usize = 25;

/// Work that one picture of many motions may cost, in scan windows: some minutes of a core.
const PICTURE_WINDOWS: u64 = 10_000_000_000;

/// What a picture of many motions shows, if that takes no more work than a picture may; otherwise which one the report goes
/// without, and why, in words.
pub(crate) fn for_picture<T, E: Display>(
    picture: &str,
    work: impl FnOnce() -> Result<T, E>,
) -> Result<T, String> {
    let (done, spent) = budget::run_within(PICTURE_WINDOWS, work);
    match done {
        _ if spent >= PICTURE_WINDOWS => Err(format!(
            "{picture}: it takes more than {} million scan windows",
            PICTURE_WINDOWS / 1_000_000
        )),
        Err(error) => Err(format!("{picture}: {error}")),
        Ok(done) => Ok(done),
    }
}

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

/// What came of a search.
#[derive(Debug)]
pub struct Outcome {
    /// The design and what stands beside it.
    pub solution: Solution,
    /// Searched parameters that change nothing of what is sought and required.
    pub without_effect: Vec<Parameter>,
    /// What was required, and what the design has of it.
    pub met: Vec<RequirementValue>,
    /// Zones that were computed.
    pub evaluations: u64,
    /// Whether the run was asked to end.
    pub interrupted: Option<Interrupted>,
    /// The basin along the zone, for the report, or why there is none.
    pub erosion: Option<Result<ErosionProfile, String>>,
    /// Ways to run the machine up, for the report.
    pub run_up: Option<RunUp>,
}

impl Outcome {
    /// The best design.
    pub const fn design(&self) -> &Design {
        &self.solution.found.design
    }

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
}

#[cfg(test)]
mod tests {
    use std::fmt;

    use softstop::internals::budget;

    use super::for_picture;

    #[test]
    fn a_picture_that_costs_too_much_is_left_out_with_its_reason() {
        let costs = |windows| {
            for_picture("the map", || {
                budget::charge(windows);
                Ok::<_, fmt::Error>(7)
            })
        };
        assert_eq!(costs(1_000_000), Ok(7));
        let why = costs(u64::MAX).expect_err("over its budget");
        assert_eq!(
            why,
            "the map: it takes more than 10000 million scan windows"
        );
    }
}
