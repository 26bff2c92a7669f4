//! Follows the cells of a basin survey until a contraction ball holds them, or, where they settle slowly, for longer.

use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::basin_survey::{BasinSurvey, LostCell, TILE_CELLS, earlier_lost};
use super::basin_test::PERIODS_BETWEEN_CHECKS;
use crate::ensemble::{Member, MemberStatus};
use crate::monitor::{PIECE_DURATION, recall_or_compute};
use crate::orbit::{LYAPUNOV_BATCH_PERIODS, LyapunovExponents, OrbitError};
use crate::parallel;
use softstop::Start;

/// Number of cells of a tile, which are followed together, where motions do not run in lanes and take long.
const SMALL_TILE_CELLS: usize = 16;
/// Longest time that cells are followed before what they have come to is stored as a piece; the time grows up to it.
const MAX_PIECE_TIME: Duration = Duration::from_secs(5);

/// Logarithm of the factor by which a slowly settling motion approaches its orbit before it is classified again.
const SLOW_DECAY_LOG: f64 = 23.0;
/// Most drive periods for which slowly settling motions are followed on.
const MAX_SLOW_PERIODS: u64 = 8192;

/// A followed cell: its index, the latest state of its motion, and what it has come to.
type FollowedCell = (usize, Start, MemberStatus);

/// The result of following cells together for some time, which is stored as one piece.
#[derive(Serialize, Deserialize)]
struct FollowedCells {
    /// Drive periods so far.
    periods: u64,
    cells: Vec<FollowedCell>,
    /// Why the first lost cell is lost.
    lost: Option<LostCell>,
}

impl BasinSurvey<'_> {
    /// Follows all open cells of the survey until a contraction ball holds their motions or the transient is over.
    pub(super) fn settle_cells(&mut self) -> Result<(), OrbitError> {
        let open: Vec<usize> = self.open_cells().collect();
        let tile = if self.ensemble.runs_in_lanes() {
            TILE_CELLS
        } else {
            SMALL_TILE_CELLS
        };
        for (cells, lost) in parallel::try_map_chunks(&open, tile, |tile| self.follow_tile(tile))? {
            for (cell, state, outcome) in cells {
                (self.states[cell], self.outcomes[cell]) = (state, outcome);
            }
            self.keep_first_lost(lost);
        }
        Ok(())
    }

    /// Follows the cells of a tile, piece by piece, until a contraction ball holds them; returns them and the first lost cell.
    fn follow_tile(
        &self,
        tile: &[usize],
    ) -> Result<(Vec<FollowedCell>, Option<LostCell>), OrbitError> {
        let of = (
            "tile",
            &*self.scene,
            self.grid,
            (self.options, self.transient),
            tile[0],
        );
        let open = |cell: &usize| (*cell, self.states[*cell], MemberStatus::Open);
        let mut left: Vec<FollowedCell> = tile.iter().map(open).collect();
        let (mut ended, mut lost) = (Vec::new(), None);
        let (mut periods, mut time) = (0, PIECE_DURATION);
        while periods < self.transient && !left.is_empty() {
            let on = || self.follow_cells_for(&left, periods, time);
            let next = recall_or_compute(self.kept, &(of, periods), on)?;
            let all = next.cells.into_iter();
            let (open, come): (Vec<_>, Vec<_>) = all.partition(|it| it.2 == MemberStatus::Open);
            self.ensemble.count_work(come.len() as u64)?;
            ended.extend(come);
            (periods, left, lost) = (next.periods, open, earlier_lost(lost, next.lost));
            time = (time + PIECE_DURATION).min(MAX_PIECE_TIME);
        }
        ended.extend(left);
        Ok((ended, lost))
    }

    /// Follows cells together for some computing time, from `periods` drive periods on.
    fn follow_cells_for(
        &self,
        cells: &[FollowedCell],
        mut periods: u64,
        time: Duration,
    ) -> Result<FollowedCells, OrbitError> {
        // What is not stored is no piece; and a browser has no such clock.
        let begin = self.kept.map(|_| Instant::now());
        let is_whole = || begin.is_some_and(|begin| begin.elapsed() >= time);
        let members = cells.iter().map(|cell| Member::new(0, cell.1));
        let mut members: Vec<Member> = members.collect();
        let mut open: Vec<&mut Member> = members.iter_mut().collect();
        while periods < self.transient && !open.is_empty() && !is_whole() {
            let stretch = PERIODS_BETWEEN_CHECKS.min(self.transient - periods);
            periods += stretch;
            self.ensemble
                .advance_batch::<false, false, _>(&mut open, stretch)?;
            for member in &mut open {
                if let Some(orbit) = self.balls.orbit_holding(member.state)
                    && member.error.is_none()
                {
                    member.status = MemberStatus::Arrived(orbit);
                }
            }
            open.retain(|member| member.status == MemberStatus::Open);
            self.ensemble.count_work(0)?;
        }
        let mut all = FollowedCells {
            periods,
            cells: Vec::with_capacity(cells.len()),
            lost: None,
        };
        for (
            (cell, ..),
            Member {
                state,
                status: outcome,
                error,
                ..
            },
        ) in cells.iter().zip(members)
        {
            all.cells.push((*cell, state, outcome));
            let lost = error.map(|error| (*cell, error.to_string()));
            all.lost = earlier_lost(all.lost, lost);
        }
        Ok(all)
    }

    /// Follows wandering cells for longer where they settle slowly, which the exponents of three of them show: their largest is
    /// negative beyond doubt. Each is followed for as long as it takes to gain [`SLOW_DECAY_LOG`]; the orbits that they come to
    /// hold the other cells. Returns the exponents of the first wandering cell, if it was not followed on.
    pub(super) fn settle_slow_cells(&mut self) -> Result<Option<LyapunovExponents>, OrbitError> {
        let cells = 0..self.outcomes.len();
        let wandering = cells.filter(|cell| self.outcomes[*cell] == MemberStatus::Wandering);
        let wandering: Vec<usize> = wandering.collect();
        let Some(last) = wandering.len().checked_sub(1) else {
            return Ok(None);
        };
        let mut sample = vec![0, last / 2, last];
        sample.dedup();
        let (mut periods, mut first) = (0, None);
        for index in sample {
            match self.exponents_of_cell(wandering[index]) {
                Ok(exponents) => {
                    first = first.or((index == 0).then_some(exponents));
                    if exponents.is_negative() {
                        let needed = (SLOW_DECAY_LOG / -exponents.per_period[0]).ceil() as u64;
                        periods = periods.max(needed);
                    }
                }
                Err(OrbitError::Stopped) => return Err(OrbitError::Stopped),
                _ => {}
            }
        }
        if periods > self.transient && periods <= MAX_SLOW_PERIODS {
            (self.transient, first) = (periods, None);
            for cell in &wandering {
                self.outcomes[*cell] = MemberStatus::Open;
            }
            self.scout_grid()?;
            self.settle_cells()?;
            self.classify_open_cells()?;
        }
        let left = self
            .outcomes
            .iter()
            .filter(|it| **it == MemberStatus::Wandering);
        self.ensemble.count_work(left.count() as u64)?;
        Ok(first)
    }

    /// The Lyapunov exponents along the motion of a cell from its latest state on.
    pub(super) fn exponents_of_cell(&self, cell: usize) -> Result<LyapunovExponents, OrbitError> {
        let (state, ask) = (self.states[cell].into(), || self.ensemble.count_work(0));
        let (exponents, _) = LyapunovExponents::along_motion_with_monitor(
            &self.scene,
            state,
            LYAPUNOV_BATCH_PERIODS.0,
            ask,
        )?;
        Ok(exponents)
    }
}
