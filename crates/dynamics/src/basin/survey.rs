//! Following the motions of all cells.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::ball::Ball;
use super::{Basins, Grid, Options};
use crate::attractors::SurveyError;
use crate::attractors::fleet::{Fleet, Voyage};
use crate::attractors::known::{Book, Standing};
use crate::watch::{Watcher, stop_if};
use softstop::internals::Motion;
use softstop::{Clock, MotionError, Scene, Start};
use softstop_lanes::Job;

/// Cells that go together: enough for all lanes to be busy. The tiles may not depend on how many threads
/// there are.
const TILE: usize = 4096;
/// Drive periods between two looks at where the motions are.
const STRETCH: u64 = 16;
/// Scouts on each axis of the grid: these cells are looked at first.
const SCOUTS: usize = 16;

/// How it stands with a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fate {
    /// On its way.
    Afloat,
    /// On this orbit of the book.
    Orbit(usize),
    AtRest,
    /// It has not returned.
    Wandering,
    Lost,
}

pub(super) struct Survey<'a> {
    pub scene: &'a Scene,
    pub grid: &'a Grid,
    options: Options,
    /// Counts cells.
    fleet: Fleet<'a>,
    pub book: Book<'a>,
    /// Balls of the orbits in the book.
    balls: Vec<(usize, Ball)>,
    pub states: Vec<Start>,
    pub fates: Vec<Fate>,
    /// Why the first lost cell is lost.
    pub lost: Option<(usize, MotionError)>,
}

/// A cell that was followed: its number, its fate, its state.
type Followed = (usize, Fate, Start, Option<MotionError>);

/// The basins of a scene on a grid. The watcher is told of the cells done and of all cells.
///
/// # Errors
/// [`SurveyError::Motion`] if the scene is invalid; [`SurveyError::Stopped`].
pub fn basins(
    scene: &Scene,
    grid: &Grid,
    options: &Options,
    watcher: Watcher<'_>,
) -> Result<Basins, SurveyError> {
    let mut fleet = Fleet::new(scene, watcher)?;
    fleet.planned = grid.cells() as u64;
    let mut survey = Survey {
        scene,
        grid,
        options: *options,
        fleet,
        book: Book::new(scene),
        balls: Vec::new(),
        states: Vec::new(),
        fates: Vec::new(),
        lost: None,
    };
    survey.bring()?;
    survey.scout()?;
    survey.settle()?;
    survey.judge_all()?;
    survey.report()
}

impl Survey<'_> {
    /// Brings all cells to drive angle phi.
    fn bring(&mut self) -> Result<(), SurveyError> {
        let brought: Vec<Result<Start, MotionError>> = (0..self.grid.cells())
            .into_par_iter()
            .map(|cell| {
                if cell % TILE == 0 {
                    self.fleet.note(0)?;
                }
                Ok(self.at_section(cell))
            })
            .collect::<Result<_, SurveyError>>()?;
        for (cell, result) in brought.into_iter().enumerate() {
            let (state, fate) = match result {
                Ok(state) => (state, Fate::Afloat),
                Err(error) => {
                    self.lost.get_or_insert((cell, error));
                    (self.grid.start(cell).0, Fate::Lost)
                }
            };
            self.states.push(state);
            self.fates.push(fate);
        }
        Ok(())
    }

    /// The state of a cell when the drive angle next is phi.
    fn at_section(&self, cell: usize) -> Result<Start, MotionError> {
        let (start, angle) = self.grid.start(cell);
        start.validate()?;
        let drive = self.scene.excitation;
        let turn = (drive.phase - angle).rem_euclid(TAU);
        if turn == 0.0 {
            return Ok(start);
        }
        let clock = Clock::new(drive.frequency, angle);
        let phases = self.fleet.machine[0].shared_phases();
        let mut motion = Motion::new(phases, clock, Clock::at_cycle(0), start)?;
        motion.advance(clock.instant(turn / drive.frequency), &mut ())?;
        Ok(motion.state())
    }

    /// A few cells, spread over the grid, fill the book.
    fn scout(&mut self) -> Result<(), SurveyError> {
        let (columns, rows) = (self.grid.across.cells, self.grid.up.cells);
        let along = |cells: usize| cells.div_ceil(SCOUTS);
        let rows = (along(rows) / 2..rows).step_by(along(rows));
        let cells: Vec<usize> = rows
            .flat_map(|row| {
                let columns_here = (along(columns) / 2..columns).step_by(along(columns));
                columns_here.map(move |column| row * columns + column)
            })
            .filter(|cell| self.fates[*cell] == Fate::Afloat)
            .collect();
        self.look(&cells, self.options.transient)
    }

    /// Follows all cells that are afloat until a ball catches them or the transient is over.
    fn settle(&mut self) -> Result<(), SurveyError> {
        let afloat: Vec<usize> = self.afloat().collect();
        let followed: Vec<Vec<Followed>> = afloat
            .par_chunks(TILE)
            .map(|tile| self.follow(tile))
            .collect::<Result<_, _>>()?;
        for (cell, fate, state, error) in followed.into_iter().flatten() {
            self.states[cell] = state;
            self.set(cell, fate, error);
        }
        Ok(())
    }

    fn set(&mut self, cell: usize, fate: Fate, error: Option<MotionError>) {
        self.fates[cell] = fate;
        if let Some(error) = error
            && self.lost.as_ref().is_none_or(|(first, _)| cell < *first)
        {
            self.lost = Some((cell, error));
        }
    }

    fn afloat(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.fates.len()).filter(|cell| self.fates[*cell] == Fate::Afloat)
    }

    fn follow(&self, tile: &[usize]) -> Result<Vec<Followed>, SurveyError> {
        let mut followed = Vec::with_capacity(tile.len());
        let left = tile.iter().map(|cell| (*cell, self.states[*cell]));
        let mut left: Vec<(usize, Start)> = left.collect();
        let mut periods = 0;
        while periods < self.options.transient && !left.is_empty() {
            let stretch = STRETCH.min(self.options.transient - periods);
            periods += stretch;
            let job = |(_, start): &(usize, Start)| Job {
                machine: 0,
                start: *start,
                periods: stretch,
            };
            let jobs: Vec<Job> = left.iter().map(job).collect();
            let outcomes = softstop_lanes::run(&self.fleet.machine, &jobs, &mut ());
            let before = left.len();
            let ends = std::mem::take(&mut left).into_iter().zip(outcomes);
            for ((cell, _), outcome) in ends {
                if outcome.error.is_some() {
                    followed.push((cell, Fate::Lost, outcome.end, outcome.error));
                } else if let Some(orbit) = self.caught(outcome.end) {
                    followed.push((cell, Fate::Orbit(orbit), outcome.end, None));
                } else {
                    left.push((cell, outcome.end));
                }
            }
            self.fleet.note((before - left.len()) as u64)?;
        }
        let left = left.into_iter();
        followed.extend(left.map(|(cell, end)| (cell, Fate::Afloat, end, None)));
        Ok(followed)
    }

    /// The orbit in one of whose balls a state lies.
    fn caught(&self, state: Start) -> Option<usize> {
        let ball = self.balls.iter().find(|(_, ball)| ball.holds(state));
        ball.map(|(orbit, _)| *orbit)
    }

    /// Looks at all cells that no ball has caught.
    fn judge_all(&mut self) -> Result<(), SurveyError> {
        let afloat: Vec<usize> = self.afloat().collect();
        for cells in afloat.chunks(TILE) {
            self.look(cells, 0)?;
        }
        Ok(())
    }

    /// Follows cells for so many drive periods, and says of each what it has come to.
    fn look(&mut self, cells: &[usize], periods: u64) -> Result<(), SurveyError> {
        let logged = 2 * self.options.longest + 1;
        let states = cells.iter().map(|cell| Voyage::new(self.states[*cell]));
        let mut voyages: Vec<Voyage> = states.collect();
        let go_on = |_, _| stop_if(self.fleet.note(0).is_err());
        let fleet = Fleet::new(self.scene, &go_on)?;
        let mut all: Vec<&mut Voyage> = voyages.iter_mut().collect();
        fleet.sail(&mut all, periods + logged as u64, logged)?;
        for (cell, voyage) in cells.iter().zip(voyages) {
            self.states[*cell] = voyage.state;
            let fate = match voyage.error {
                Some(_) => Fate::Lost,
                None => self.judge(&voyage.log)?,
            };
            self.set(*cell, fate, voyage.error);
            self.fleet.note(1)?;
        }
        Ok(())
    }

    fn judge(&mut self, log: &[Start]) -> Result<Fate, SurveyError> {
        let known = self.book.orbits.len();
        let standing = self.book.judge(log)?;
        for (index, entry) in self.book.orbits.iter().enumerate().skip(known) {
            let balls = Ball::all(&entry.orbit)?;
            let balls = balls.into_iter().map(|ball| (index, ball));
            self.balls.extend(balls);
        }
        Ok(match standing.orbit() {
            Some(orbit) => Fate::Orbit(orbit),
            None if standing == Standing::AtRest => Fate::AtRest,
            None => Fate::Wandering,
        })
    }
}
