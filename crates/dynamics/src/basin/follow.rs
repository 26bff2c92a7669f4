//! Following cells until a ball catches them.

use std::time::{Duration, Instant};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::basin_test::PERIODS_AT_ONCE;
use super::survey::{BasinSurvey, CellOutcome, TILE};
use crate::batch;
use crate::monitor::{PIECE, piece, stop_if};
use crate::orbit::OrbitError;
use softstop::Start;
use softstop::internals::budget::Fork;

/// As [`TILE`], where each motion goes alone, and takes long.
const SMALL_TILE: usize = 16;
/// How long cells are followed at most before what they have come to is kept: at first for a piece, and for so much longer
/// each time.
const LONGEST_PIECE: Duration = Duration::from_secs(5);

/// Cells that were followed together for some time.
#[derive(Serialize, Deserialize)]
struct FollowedCells {
    /// Drive periods so far.
    periods: u64,
    /// Those that a ball has caught, and the orbit; none for a lost cell.
    ended: Vec<(usize, Option<usize>)>,
    /// Those on their way, and where they are.
    left: Vec<(usize, Start)>,
    lost: Option<(usize, String)>,
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
        let followed = tiles.map(|tile| fork.part(|| self.follow(tile)));
        let followed: Result<Vec<Vec<FollowedCells>>, _> = followed.collect();
        fork.join();
        for tile in followed? {
            let last = tile.last().map(|followed| followed.left.clone());
            for (cell, state) in last.into_iter().flatten() {
                self.states[cell] = state;
            }
            for FollowedCells { ended, lost, .. } in tile {
                for (cell, orbit) in ended {
                    self.outcomes[cell] = orbit.map_or(CellOutcome::Lost, CellOutcome::Orbit);
                }
                self.lose(lost);
            }
        }
        Ok(())
    }

    /// Follows some cells, piece by piece.
    fn follow(&self, tile: &[usize]) -> Result<Vec<FollowedCells>, OrbitError> {
        let of = ("tile", self.scene, self.grid, self.options, tile[0]);
        let left = tile.iter().map(|cell| (*cell, self.states[*cell]));
        let (mut periods, mut left) = (0, left.collect::<Vec<_>>());
        let mut pieces: Vec<FollowedCells> = Vec::new();
        let mut time = PIECE;
        while periods < self.options.transient && !left.is_empty() {
            let on = || self.follow_on(std::mem::take(&mut left), periods, time);
            let next = piece(self.kept, &(of, periods), on)?;
            self.ensemble.note(next.ended.len() as u64)?;
            periods = next.periods;
            left.clone_from(&next.left);
            if let Some(last) = pieces.last_mut() {
                last.left = Vec::new();
            }
            pieces.push(next);
            time = (time + PIECE).min(LONGEST_PIECE);
        }
        Ok(pieces)
    }

    /// Follows cells on from so many drive periods for some time.
    fn follow_on(
        &self,
        left: Vec<(usize, Start)>,
        periods: u64,
        time: Duration,
    ) -> Result<FollowedCells, OrbitError> {
        let begin = Instant::now();
        let mut all = FollowedCells {
            periods,
            ended: Vec::with_capacity(left.len()),
            left,
            lost: None,
        };
        while all.periods < self.options.transient && !all.left.is_empty() && begin.elapsed() < time
        {
            let stretch = PERIODS_AT_ONCE.min(self.options.transient - all.periods);
            all.periods += stretch;
            let motions = all.left.iter().map(|(_, start)| (0, *start, stretch));
            let ask = || stop_if(self.ensemble.note(0).is_err());
            let outcomes = batch::follow(&self.ensemble.machine, motions, &mut (), ask);
            let outcomes = outcomes.ok_or(OrbitError::Stopped)?;
            let ends = std::mem::take(&mut all.left).into_iter().zip(outcomes);
            for ((cell, _), outcome) in ends {
                if let Some(error) = outcome.error {
                    all.ended.push((cell, None));
                    let lost = (cell, error.to_string());
                    all.lost = all.lost.take().into_iter().chain([lost]).min();
                } else if let Some(orbit) = self.caught(outcome.end) {
                    all.ended.push((cell, Some(orbit)));
                } else {
                    all.left.push((cell, outcome.end));
                }
            }
            self.ensemble.note(0)?;
        }
        Ok(all)
    }

    /// The orbit in one of whose balls a state lies.
    fn caught(&self, state: Start) -> Option<usize> {
        let ball = self.balls.iter().find(|(_, ball)| ball.holds(state));
        ball.map(|(orbit, _)| *orbit)
    }
}
