//! The survey of a grid: scouts, the motions of all cells, and a look at what is left.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::ball::ContractionBalls;
use super::section::at_section;
use super::{BasinOptions, Basins, Grid};
use crate::attractors::catalogue::AttractorCatalogue;
use crate::ensemble::{Ensemble, Member, Outcome};
use crate::monitor::{Kept, Monitor, piece, stop_if};
use crate::orbit::OrbitError;
use softstop::internals::budget::Fork;
use softstop::{MotionError, Scene, Start};

/// Cells that go together: enough for all lanes to be busy. The tiles may not depend on how many threads
/// there are.
pub(super) const TILE: usize = 4096;
/// Cells that are brought to the section between two looks at whether to stop.
const BROUGHT: usize = 1 << 16;
/// Scouts on each axis of the grid: these cells are looked at first.
const SCOUTS: usize = 16;

/// Cells that are looked at one by one before what they have come to is kept; so many groups of the ensemble's.
const LOOKED: usize = 1024;

/// A cell that is lost, and why.
pub(super) type LostCell = (usize, String);

pub(super) struct BasinSurvey<'a> {
    pub scene: &'a Scene,
    pub grid: &'a Grid,
    pub options: BasinOptions,
    /// Counts cells.
    pub ensemble: Ensemble<'a>,
    pub catalogue: AttractorCatalogue<'a>,
    /// Balls of the orbits in the catalogue.
    pub balls: ContractionBalls,
    pub states: Vec<Start>,
    pub outcomes: Vec<Outcome>,
    /// Why the first lost cell is lost.
    pub lost: Option<LostCell>,
    pub kept: Kept<'a>,
}

/// One motion that is looked at: its latest state, the last ones, and why it ended.
type SeenCell = (Start, Vec<Start>, Option<String>);

/// Cells that were looked at.
#[derive(Serialize, Deserialize, Default)]
struct CellOutcomes {
    states: Vec<Start>,
    outcomes: Vec<Outcome>,
    /// Motions by which the catalogue has grown, in order.
    entered: Vec<Vec<Start>>,
    lost: Option<LostCell>,
}

/// The basins of a scene on a grid. The monitor is told of the cells done and of all cells; what is known is recalled.
///
/// # Errors
/// [`OrbitError::Motion`] if the scene is invalid; [`OrbitError::Stopped`].
pub fn basins(
    scene: &Scene,
    grid: &Grid,
    options: &BasinOptions,
    monitor: Monitor<'_>,
    kept: Kept<'_>,
) -> Result<Basins, OrbitError> {
    let mut ensemble = Ensemble::of(scene, monitor)?;
    ensemble.planned = grid.cells() as u64;
    let mut survey = BasinSurvey {
        scene,
        grid,
        options: *options,
        ensemble,
        catalogue: AttractorCatalogue::new(scene),
        balls: ContractionBalls::default(),
        states: Vec::new(),
        outcomes: Vec::new(),
        lost: None,
        kept,
    };
    survey.bring()?;
    survey.scout()?;
    survey.settle()?;
    survey.judge_all()?;
    survey.report()
}

/// The basins of several scenes on one grid, in order. The monitor is told of the cells done of all scenes.
///
/// # Errors
/// As [`basins`].
pub(super) fn basins_of_all<'a>(
    scenes: impl IntoIterator<Item = &'a Scene, IntoIter: ExactSizeIterator>,
    grid: &Grid,
    options: &BasinOptions,
    monitor: Monitor<'_>,
    kept: Kept<'_>,
) -> Result<Vec<Basins>, OrbitError> {
    let (scenes, each) = (scenes.into_iter(), grid.cells() as u64);
    let all = each * scenes.len() as u64;
    let one = |(index, scene)| {
        let before = each * index as u64;
        let monitor = |done, _| monitor(before + done, all);
        basins(scene, grid, options, &monitor, kept)
    };
    scenes.enumerate().map(one).collect()
}

impl BasinSurvey<'_> {
    /// Brings all cells to drive angle phi.
    fn bring(&mut self) -> Result<(), OrbitError> {
        let cells = self.grid.cells();
        self.states.reserve(cells);
        self.outcomes.reserve(cells);
        for from in (0..cells).step_by(BROUGHT) {
            self.ensemble.note(0)?;
            let here = from..cells.min(from + BROUGHT);
            let (fork, brought) = (Fork::default(), here.clone().into_par_iter());
            let brought = brought.map(|cell| fork.run_part(|| self.at_section(cell)));
            let brought: Vec<_> = brought.collect();
            fork.charge_parts();
            for (cell, result) in here.zip(brought) {
                let (state, outcome) = match result {
                    Ok(state) => (state, Outcome::Open),
                    Err(error) => {
                        self.lost.get_or_insert((cell, error.to_string()));
                        (self.grid.start(cell).0, Outcome::Lost)
                    }
                };
                self.states.push(state);
                self.outcomes.push(outcome);
            }
        }
        Ok(())
    }

    /// The state of a cell when the drive angle next is phi.
    fn at_section(&self, cell: usize) -> Result<Start, MotionError> {
        let (start, angle) = self.grid.start(cell);
        let phases = self.ensemble.machines[0].shared_phases();
        at_section(&phases, self.scene.excitation, start, angle)
    }

    /// A few cells, spread over the grid, fill the catalogue.
    fn scout(&mut self) -> Result<(), OrbitError> {
        let (columns, rows) = (self.grid.across.cells, self.grid.up.cells);
        let along = |cells: usize| cells.div_ceil(SCOUTS);
        let rows = (along(rows) / 2..rows).step_by(along(rows));
        let cells: Vec<usize> = rows
            .flat_map(|row| {
                let columns_here = (along(columns) / 2..columns).step_by(along(columns));
                columns_here.map(move |column| row * columns + column)
            })
            .filter(|cell| self.outcomes[*cell] == Outcome::Open)
            .collect();
        self.look(&cells, self.options.transient)
    }

    /// Why a cell is lost; that of the first one stands.
    pub(super) fn lose(&mut self, lost: Option<LostCell>) {
        self.lost = earlier(self.lost.take(), lost);
    }

    pub(super) fn open(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.outcomes.len()).filter(|cell| self.outcomes[*cell] == Outcome::Open)
    }

    /// Looks at all cells that no ball has caught.
    fn judge_all(&mut self) -> Result<(), OrbitError> {
        let open: Vec<usize> = self.open().collect();
        for cells in open.chunks(LOOKED) {
            self.look(cells, 0)?;
        }
        Ok(())
    }

    /// Follows cells for so many drive periods, and says of each what it has come to.
    fn look(&mut self, cells: &[usize], periods: u64) -> Result<(), OrbitError> {
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
            self.ensemble.note(cells.len() as u64)?;
        }
        let ends = looked.states.into_iter().zip(looked.outcomes);
        for (cell, (state, outcome)) in cells.iter().zip(ends) {
            (self.states[*cell], self.outcomes[*cell]) = (state, outcome);
        }
        self.lose(looked.lost);
        Ok(())
    }

    fn look_anew(&mut self, cells: &[usize], periods: u64) -> Result<CellOutcomes, OrbitError> {
        let seen = self.see(cells, periods)?;
        let mut looked = CellOutcomes::default();
        for (cell, (state, log, error)) in cells.iter().zip(seen) {
            let known = self.catalogue.orbits.len();
            looked.states.push(state);
            looked.outcomes.push(match error {
                Some(error) => {
                    looked.lost.get_or_insert((*cell, error));
                    Outcome::Lost
                }
                None => self.judge(&log)?,
            });
            if self.catalogue.orbits.len() > known {
                looked.entered.push(log);
            }
            self.ensemble.note(1)?;
        }
        Ok(looked)
    }

    /// Follows cells for so many drive periods and those of a log; motions that take long are kept one by one.
    fn see(&self, cells: &[usize], periods: u64) -> Result<Vec<SeenCell>, OrbitError> {
        if self.ensemble.is_fast() {
            return self.see_together(cells, periods);
        }
        let one = |cell: &usize| {
            let of = ("cell", self.scene, self.grid, self.options, cell, periods);
            piece(self.kept, &of, || self.see_together(&[*cell], periods))
        };
        let fork = Fork::default();
        let seen = cells.par_iter().map(|cell| fork.run_part(|| one(cell)));
        let seen = seen.collect::<Result<Vec<_>, OrbitError>>();
        fork.charge_parts();
        Ok(seen?.concat())
    }

    fn see_together(&self, cells: &[usize], periods: u64) -> Result<Vec<SeenCell>, OrbitError> {
        let logged = 2 * self.options.longest + 1;
        let members = cells.iter().map(|cell| Member::new(0, self.states[*cell]));
        let mut members: Vec<Member> = members.collect();
        // Periods are not counted, but cells.
        let go_on = |_, _| stop_if(self.ensemble.note(0).is_err());
        let ensemble = Ensemble::new(&*self.ensemble.machines, &go_on);
        let mut all: Vec<&mut Member> = members.iter_mut().collect();
        ensemble.advance(&mut all, periods + logged as u64, logged)?;
        let seen = members.into_iter();
        let seen = seen.map(|it| (it.state, it.states, it.error.map(|error| error.to_string())));
        Ok(seen.collect())
    }

    fn judge(&mut self, log: &[Start]) -> Result<Outcome, OrbitError> {
        let known = self.catalogue.orbits.len();
        let outcome = self.catalogue.judge(log)?;
        for (index, entry) in self.catalogue.orbits.iter().enumerate().skip(known) {
            self.balls.add(index, &entry.orbit)?;
        }
        Ok(outcome)
    }
}

/// The earlier of two cells that are lost, and why.
pub(super) fn earlier(one: Option<LostCell>, other: Option<LostCell>) -> Option<LostCell> {
    one.into_iter().chain(other).min()
}
