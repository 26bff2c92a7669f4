//! Classifies the cells of a basin survey by the logs of their motions, and those that wander by their exponents.

use serde::{Deserialize, Serialize};

use super::basin_survey::{BasinSurvey, LostCell};
use crate::ensemble::{Ensemble, Member, MemberStatus};
use crate::monitor::{recall_or_compute, stop_if};
use crate::motion_kind::MotionKind;
use crate::orbit::{LyapunovExponents, OrbitError};
use crate::parallel;
use softstop::Start;

/// Number of cells that are classified by their logs before what they have come to is stored.
const CELLS_CLASSIFIED_TOGETHER: usize = 1024;

/// The log of a cell's motion: its latest state, its last states, one each drive period, and why it ended, if it did.
type CellLog = (Start, Vec<Start>, Option<String>);

/// What some cells have come to by their logs, which is stored as one piece.
#[derive(Serialize, Deserialize, Default)]
struct CellOutcomes {
    states: Vec<Start>,
    outcomes: Vec<MemberStatus>,
    /// Logs by which the catalogue has grown, in order.
    entered: Vec<Vec<Start>>,
    lost: Option<LostCell>,
}

impl BasinSurvey<'_> {
    /// Classifies all cells by their logs whose motions no contraction ball holds.
    pub(super) fn classify_open_cells(&mut self) -> Result<(), OrbitError> {
        let open: Vec<usize> = self.open_cells().collect();
        for cells in open.chunks(CELLS_CLASSIFIED_TOGETHER) {
            self.classify_cells(cells, 0)?;
        }
        Ok(())
    }

    /// Follows cells for some drive periods, and classifies each by its log; outcomes that are stored are recalled.
    pub(super) fn classify_cells(
        &mut self,
        cells: &[usize],
        periods: u64,
    ) -> Result<(), OrbitError> {
        let of = (
            "look",
            self.scene.clone(),
            self.grid,
            self.options,
            self.transient,
            cells.first(),
            periods,
        );
        let mut is_known = true;
        let judged = recall_or_compute(self.kept, &of, || {
            is_known = false;
            self.classify_by_new_logs(cells, periods)
        })?;
        if is_known {
            for log in &judged.entered {
                self.classify_by_log(log)?;
            }
            self.count_settled(&judged.outcomes)?;
        }
        let ends = judged.states.into_iter().zip(judged.outcomes);
        for (cell, (state, outcome)) in cells.iter().zip(ends) {
            (self.states[*cell], self.outcomes[*cell]) = (state, outcome);
        }
        self.keep_first_lost(judged.lost);
        Ok(())
    }

    /// Tells the monitor of outcomes that are final, which those of wandering cells are not.
    fn count_settled(&self, outcomes: &[MemberStatus]) -> Result<(), OrbitError> {
        let settled = outcomes.iter().filter(|it| **it != MemberStatus::Wandering);
        self.ensemble.count_work(settled.count() as u64)
    }

    /// Computes the logs and outcomes of cells that [`BasinSurvey::classify_cells`] finds in no store.
    fn classify_by_new_logs(
        &mut self,
        cells: &[usize],
        periods: u64,
    ) -> Result<CellOutcomes, OrbitError> {
        let seen = self.record_logs(cells, periods)?;
        let mut judged = CellOutcomes::default();
        for (cell, (state, log, error)) in cells.iter().zip(seen) {
            let known = self.catalogue.orbits.len();
            judged.states.push(state);
            judged.outcomes.push(match error {
                Some(error) => {
                    judged.lost.get_or_insert((*cell, error));
                    MemberStatus::Lost
                }
                None => self.classify_by_log(&log)?,
            });
            if self.catalogue.orbits.len() > known {
                judged.entered.push(log);
            }
            self.count_settled(&judged.outcomes[judged.outcomes.len() - 1..])?;
        }
        Ok(judged)
    }

    /// Follows cells for some drive periods, then records the log of each; motions that run in no lanes are stored one by one.
    fn record_logs(&self, cells: &[usize], periods: u64) -> Result<Vec<CellLog>, OrbitError> {
        if self.ensemble.runs_in_lanes() {
            return self.record_logs_together(cells, periods);
        }
        let one = |cell: &usize| {
            let of = (
                "cell",
                &*self.scene,
                self.grid,
                (self.options, self.transient),
                (cell, periods),
            );
            recall_or_compute(self.kept, &of, || {
                self.record_logs_together(&[*cell], periods)
            })
        };
        Ok(parallel::try_map(cells, one)?.concat())
    }

    /// Follows cells together for some drive periods, and then records the log of each.
    fn record_logs_together(
        &self,
        cells: &[usize],
        periods: u64,
    ) -> Result<Vec<CellLog>, OrbitError> {
        let logged = 2 * self.options.longest + 1;
        let members = cells.iter().map(|cell| Member::new(0, self.states[*cell]));
        let mut members: Vec<Member> = members.collect();
        // Periods are not counted, but cells.
        let go_on = |_, _| stop_if(self.ensemble.count_work(0).is_err());
        let ensemble = Ensemble::new(&*self.ensemble.machines, &go_on);
        let mut all: Vec<&mut Member> = members.iter_mut().collect();
        ensemble.advance(&mut all, periods + logged as u64, logged)?;
        let seen = members.into_iter();
        let seen = seen.map(|it| (it.state, it.states, it.error.map(|error| error.to_string())));
        Ok(seen.collect())
    }

    /// What a motion has come to by its log; a new orbit to which it leads gets its contraction balls.
    fn classify_by_log(&mut self, log: &[Start]) -> Result<MemberStatus, OrbitError> {
        let known = self.catalogue.orbits.len();
        let outcome = self.catalogue.classify_log(log)?;
        for (index, entry) in self.catalogue.orbits.iter().enumerate().skip(known) {
            self.balls.add_orbit(index, &entry.orbit)?;
        }
        Ok(outcome)
    }

    /// The kind of motion, chaos or unsettled, of the cells that have not returned, and the exponents of the first of them;
    /// `known`: these exponents, if they were computed before.
    pub(super) fn classify_wandering_cells(
        &self,
        known: Option<LyapunovExponents>,
    ) -> Result<(MotionKind, Option<LyapunovExponents>), OrbitError> {
        let mut outcomes = self.outcomes.iter();
        let Some(cell) = outcomes.position(|outcome| *outcome == MemberStatus::Wandering) else {
            return Ok((MotionKind::Unsettled, None));
        };
        let exponents = known.map_or_else(|| self.exponents_of_cell(cell), Ok)?;
        let motion = match exponents.is_positive() {
            true => MotionKind::Chaos,
            false => MotionKind::Unsettled,
        };
        Ok((motion, Some(exponents)))
    }
}
