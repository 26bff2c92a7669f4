//! Following cells until a ball catches them.

use std::time::{Duration, Instant};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::basin_test::PERIODS_AT_ONCE;
use super::survey::{BasinSurvey, LostCell, TILE, earlier};
use crate::ensemble::{Member, Outcome};
use crate::monitor::{PIECE, piece};
use crate::orbit::OrbitError;
use softstop::Start;
use softstop::internals::budget::Fork;

/// As [`TILE`], where each motion goes alone, and takes long.
const SMALL_TILE: usize = 16;
/// How long cells are followed at most before what they have come to is kept: at first for a piece, and for so much longer
/// each time.
const LONGEST_PIECE: Duration = Duration::from_secs(5);

/// A cell, where its motion is, and what it has come to.
type FollowedCell = (usize, Start, Outcome);

/// Cells that were followed together for some time.
#[derive(Serialize, Deserialize)]
struct FollowedCells {
    /// Drive periods so far.
    periods: u64,
    cells: Vec<FollowedCell>,
    /// Why the first lost cell is lost.
    lost: Option<LostCell>,
}

impl BasinSurvey<'_> {
    /// Follows all cells that are open until a ball catches them or the transient is over.
    pub(super) fn settle(&mut self) -> Result<(), OrbitError> {
        let open: Vec<usize> = self.open().collect();
        let tile = if self.ensemble.is_fast() {
            TILE
        } else {
            SMALL_TILE
        };
        let (fork, tiles) = (Fork::default(), open.par_chunks(tile));
        let followed = tiles.map(|tile| fork.run_part(|| self.follow(tile)));
        let followed: Result<Vec<_>, OrbitError> = followed.collect();
        fork.charge_parts();
        for (cells, lost) in followed? {
            for (cell, state, outcome) in cells {
                (self.states[cell], self.outcomes[cell]) = (state, outcome);
            }
            self.lose(lost);
        }
        Ok(())
    }

    /// Follows some cells, piece by piece; why the first lost one is lost.
    fn follow(&self, tile: &[usize]) -> Result<(Vec<FollowedCell>, Option<LostCell>), OrbitError> {
        let of = ("tile", self.scene, self.grid, self.options, tile[0]);
        let open = |cell: &usize| (*cell, self.states[*cell], Outcome::Open);
        let mut left: Vec<FollowedCell> = tile.iter().map(open).collect();
        let (mut ended, mut lost) = (Vec::new(), None);
        let (mut periods, mut time) = (0, PIECE);
        while periods < self.options.transient && !left.is_empty() {
            let on = || self.follow_on(&left, periods, time);
            let next = piece(self.kept, &(of, periods), on)?;
            let all = next.cells.into_iter();
            let (open, come): (Vec<_>, Vec<_>) = all.partition(|it| it.2 == Outcome::Open);
            self.ensemble.note(come.len() as u64)?;
            ended.extend(come);
            (periods, left, lost) = (next.periods, open, earlier(lost, next.lost));
            time = (time + PIECE).min(LONGEST_PIECE);
        }
        ended.extend(left);
        Ok((ended, lost))
    }

    /// Follows cells on from so many drive periods for some time.
    fn follow_on(
        &self,
        cells: &[FollowedCell],
        mut periods: u64,
        time: Duration,
    ) -> Result<FollowedCells, OrbitError> {
        let begin = Instant::now();
        let members = cells.iter().map(|cell| Member::new(0, cell.1));
        let mut members: Vec<Member> = members.collect();
        let mut open: Vec<&mut Member> = members.iter_mut().collect();
        while periods < self.options.transient && !open.is_empty() && begin.elapsed() < time {
            let stretch = PERIODS_AT_ONCE.min(self.options.transient - periods);
            periods += stretch;
            self.ensemble
                .advance_batch::<false, false, _>(&mut open, stretch)?;
            for member in &mut open {
                if let Some(orbit) = self.balls.caught(member.state)
                    && member.error.is_none()
                {
                    member.outcome = Outcome::Arrived(orbit);
                }
            }
            open.retain(|member| member.outcome == Outcome::Open);
            self.ensemble.note(0)?;
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
                outcome,
                error,
                ..
            },
        ) in cells.iter().zip(members)
        {
            all.cells.push((*cell, state, outcome));
            let lost = error.map(|error| (*cell, error.to_string()));
            all.lost = earlier(all.lost, lost);
        }
        Ok(all)
    }
}
