//! The survey of a grid: scouts, the motions of all cells, and a look at what is left.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::ball::Ball;
use super::section::at_section;
use super::{Basins, Grid, Options};
use crate::attractors::SurveyError;
use crate::attractors::fleet::{Fleet, Voyage};
use crate::attractors::known::{Book, Standing};
use crate::watch::{Kept, Watcher, piece, stop_if};
use softstop::internals::budget::Fork;
use softstop::{MotionError, Scene, Start};

/// Cells that go together: enough for all lanes to be busy. The tiles may not depend on how many threads
/// there are.
pub(super) const TILE: usize = 4096;
/// Cells that are brought to the section between two looks at whether to stop.
const BROUGHT: usize = 1 << 16;
/// Scouts on each axis of the grid: these cells are looked at first.
const SCOUTS: usize = 16;

/// Cells that are looked at one by one before what they have come to is kept; so many groups of the fleet's.
const LOOKED: usize = 1024;

/// How it stands with a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
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
    pub options: Options,
    /// Counts cells.
    pub fleet: Fleet<'a>,
    pub book: Book<'a>,
    /// Balls of the orbits in the book.
    pub balls: Vec<(usize, Ball)>,
    pub states: Vec<Start>,
    pub fates: Vec<Fate>,
    /// Why the first lost cell is lost.
    pub lost: Option<(usize, String)>,
    pub kept: Kept<'a>,
}

/// One motion that is looked at: its latest state, the last ones, and why it ended.
type Seen = (Start, Vec<Start>, Option<String>);

/// Cells that were looked at.
#[derive(Serialize, Deserialize, Default)]
struct Looked {
    states: Vec<Start>,
    fates: Vec<Fate>,
    /// Motions by which the book has grown, in order.
    entered: Vec<Vec<Start>>,
    lost: Option<(usize, String)>,
}

/// The basins of a scene on a grid. The watcher is told of the cells done and of all cells; what is known is recalled.
///
/// # Errors
/// [`SurveyError::Motion`] if the scene is invalid; [`SurveyError::Stopped`].
pub fn basins(
    scene: &Scene,
    grid: &Grid,
    options: &Options,
    watcher: Watcher<'_>,
    kept: Kept<'_>,
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
        kept,
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
        let cells = self.grid.cells();
        self.states.reserve(cells);
        self.fates.reserve(cells);
        for from in (0..cells).step_by(BROUGHT) {
            self.fleet.note(0)?;
            let here = from..cells.min(from + BROUGHT);
            let (fork, brought) = (Fork::default(), here.clone().into_par_iter());
            let brought = brought.map(|cell| fork.part(|| self.at_section(cell)));
            let brought: Vec<_> = brought.collect();
            fork.join();
            for (cell, result) in here.zip(brought) {
                let (state, fate) = match result {
                    Ok(state) => (state, Fate::Afloat),
                    Err(error) => {
                        self.lost.get_or_insert((cell, error.to_string()));
                        (self.grid.start(cell).0, Fate::Lost)
                    }
                };
                self.states.push(state);
                self.fates.push(fate);
            }
        }
        Ok(())
    }

    /// The state of a cell when the drive angle next is phi.
    fn at_section(&self, cell: usize) -> Result<Start, MotionError> {
        let (start, angle) = self.grid.start(cell);
        let phases = self.fleet.machine[0].shared_phases();
        at_section(&phases, self.scene.excitation, start, angle)
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

    /// Why a cell is lost; that of the first one stands.
    pub(super) fn lose(&mut self, lost: Option<(usize, String)>) {
        self.lost = self.lost.take().into_iter().chain(lost).min();
    }

    pub(super) fn afloat(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.fates.len()).filter(|cell| self.fates[*cell] == Fate::Afloat)
    }

    /// Looks at all cells that no ball has caught.
    fn judge_all(&mut self) -> Result<(), SurveyError> {
        let afloat: Vec<usize> = self.afloat().collect();
        for cells in afloat.chunks(LOOKED) {
            self.look(cells, 0)?;
        }
        Ok(())
    }

    /// Follows cells for so many drive periods, and says of each what it has come to.
    fn look(&mut self, cells: &[usize], periods: u64) -> Result<(), SurveyError> {
        let of = (
            "look",
            self.scene,
            self.grid,
            self.options,
            cells.first(),
            periods,
        );
        let mut is_known = true;
        let looked = piece(self.kept, &of, || {
            is_known = false;
            self.look_anew(cells, periods)
        })?;
        if is_known {
            for log in &looked.entered {
                self.judge(log)?;
            }
            self.fleet.note(cells.len() as u64)?;
        }
        let ends = looked.states.into_iter().zip(looked.fates);
        for (cell, (state, fate)) in cells.iter().zip(ends) {
            (self.states[*cell], self.fates[*cell]) = (state, fate);
        }
        self.lose(looked.lost);
        Ok(())
    }

    fn look_anew(&mut self, cells: &[usize], periods: u64) -> Result<Looked, SurveyError> {
        let seen = self.see(cells, periods)?;
        let mut looked = Looked::default();
        for (cell, (state, log, error)) in cells.iter().zip(seen) {
            let known = self.book.orbits.len();
            looked.states.push(state);
            looked.fates.push(match error {
                Some(error) => {
                    looked.lost.get_or_insert((*cell, error));
                    Fate::Lost
                }
                None => self.judge(&log)?,
            });
            if self.book.orbits.len() > known {
                looked.entered.push(log);
            }
            self.fleet.note(1)?;
        }
        Ok(looked)
    }

    /// Follows cells for so many drive periods and those of a log; motions that take long are kept one by one.
    fn see(&self, cells: &[usize], periods: u64) -> Result<Vec<Seen>, SurveyError> {
        if self.fleet.is_fast() {
            return self.see_together(cells, periods);
        }
        let one = |cell: &usize| {
            let of = ("cell", self.scene, self.grid, self.options, cell, periods);
            piece(self.kept, &of, || self.see_together(&[*cell], periods))
        };
        let fork = Fork::default();
        let seen = cells.par_iter().map(|cell| fork.part(|| one(cell)));
        let seen = seen.collect::<Result<Vec<_>, SurveyError>>();
        fork.join();
        Ok(seen?.concat())
    }

    fn see_together(&self, cells: &[usize], periods: u64) -> Result<Vec<Seen>, SurveyError> {
        let logged = 2 * self.options.longest + 1;
        let states = cells.iter().map(|cell| Voyage::new(self.states[*cell]));
        let mut voyages: Vec<Voyage> = states.collect();
        let go_on = |_, _| stop_if(self.fleet.note(0).is_err());
        let fleet = Fleet::new(self.scene, &go_on)?;
        let mut all: Vec<&mut Voyage> = voyages.iter_mut().collect();
        fleet.sail(&mut all, periods + logged as u64, logged)?;
        let seen = voyages.into_iter();
        let seen = seen.map(|it| (it.state, it.log, it.error.map(|error| error.to_string())));
        Ok(seen.collect())
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
