//! The survey of the basins on a grid: scouts, the motions of all cells, and the logs of those that are left.

use serde::{Deserialize, Serialize};

use super::bring_to_section::bring_to_section;
use super::contraction_ball::ContractionBalls;
use super::{BasinOptions, Basins, Grid};
use crate::attractors::catalogue::AttractorCatalogue;
use crate::ensemble::{Ensemble, Member, MemberStatus};
use crate::monitor::{Monitor, OptionalMemory, recall_or_compute, stop_if};
use crate::orbit::OrbitError;
use crate::parallel;
use softstop::{CheckedScene, Scene, Start};
use softstop_lanes::LoweredMachine;

/// Number of cells of a tile, which are followed together: enough for all lanes, whatever the number of threads.
pub(super) const TILE_CELLS: usize = 4096;
/// Number of cells that are brought to drive angle phi between two questions to the monitor.
const CELLS_BROUGHT_TOGETHER: usize = 1 << 16;
/// Number of scouts along each axis of the grid: cells that are classified first, so that the catalogue knows most orbits.
const SCOUTS_PER_AXIS: usize = 16;

/// Number of cells that are classified by their logs before what they have come to is stored.
const CELLS_JUDGED_TOGETHER: usize = 1024;

/// The index of a cell whose motion cannot be computed, and why.
pub(super) type LostCell = (usize, String);

/// A survey of the basins of a scene on a grid, under way: states and outcomes of the cells, and the orbits that are known.
pub(super) struct BasinSurvey<'a> {
    pub scene: CheckedScene,
    pub grid: &'a Grid,
    pub options: BasinOptions,
    /// Drive periods after which a motion that no ball holds is judged by its log, now.
    pub transient: u64,
    /// The ensemble of the cells' motions, which counts cells.
    pub ensemble: Ensemble<'a>,
    pub catalogue: AttractorCatalogue,
    /// Contraction balls of the orbits in the catalogue.
    pub balls: ContractionBalls,
    pub states: Vec<Start>,
    pub outcomes: Vec<MemberStatus>,
    /// Why the first lost cell is lost.
    pub lost: Option<LostCell>,
    pub kept: OptionalMemory<'a>,
}

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

/// The basins of a scene on a grid. The monitor is told of the cells done and of all cells; what is stored is recalled.
///
/// # Errors
/// [`OrbitError::Motion`] if the scene is invalid; [`OrbitError::Stopped`].
pub fn find_basins(
    scene: &Scene,
    grid: &Grid,
    options: &BasinOptions,
    monitor: Monitor<'_>,
    kept: OptionalMemory<'_>,
) -> Result<Basins, OrbitError> {
    let scene = scene.check()?;
    let mut ensemble = Ensemble::new(vec![LoweredMachine::new(&scene)], monitor);
    ensemble.planned = grid.cell_count() as u64;
    let mut survey = BasinSurvey {
        grid,
        options: *options,
        transient: options.transient,
        ensemble,
        catalogue: AttractorCatalogue::new(&scene),
        balls: ContractionBalls::default(),
        states: Vec::new(),
        outcomes: Vec::new(),
        lost: None,
        kept,
        scene,
    };
    survey.bring_cells_to_section()?;
    survey.scout_grid()?;
    survey.settle_cells()?;
    survey.judge_all()?;
    let first = survey.settle_slow_cells()?;
    survey.into_basins(first)
}

/// The basins of several scenes on one grid, in order. The monitor is told of the cells done of all scenes.
///
/// # Errors
/// As [`find_basins`].
pub(super) fn find_basins_of_scenes<'a>(
    scenes: impl IntoIterator<Item = &'a Scene, IntoIter: ExactSizeIterator>,
    grid: &Grid,
    options: &BasinOptions,
    monitor: Monitor<'_>,
    kept: OptionalMemory<'_>,
) -> Result<Vec<Basins>, OrbitError> {
    let (scenes, each) = (scenes.into_iter(), grid.cell_count() as u64);
    let all = each * scenes.len() as u64;
    let one = |(index, scene)| {
        let before = each * index as u64;
        let monitor = |done, _| monitor(before + done, all);
        find_basins(scene, grid, options, &monitor, kept)
    };
    scenes.enumerate().map(one).collect()
}

impl BasinSurvey<'_> {
    /// Advances the motions of all cells to where the drive angle is phi.
    fn bring_cells_to_section(&mut self) -> Result<(), OrbitError> {
        let cells = self.grid.cell_count();
        self.states.reserve(cells);
        self.outcomes.reserve(cells);
        for from in (0..cells).step_by(CELLS_BROUGHT_TOGETHER) {
            self.ensemble.count_work(0)?;
            let here = from..cells.min(from + CELLS_BROUGHT_TOGETHER);
            let brought = parallel::map_indices(here.len(), &|index| {
                let (start, angle) = self.grid.start_of_cell(from + index);
                bring_to_section(&self.scene, start, angle)
            });
            for (cell, result) in here.zip(brought) {
                let (state, outcome) = match result {
                    Ok(state) => (state, MemberStatus::Open),
                    Err(error) => {
                        self.lost.get_or_insert((cell, error.to_string()));
                        (self.grid.start_of_cell(cell).0, MemberStatus::Lost)
                    }
                };
                self.states.push(state);
                self.outcomes.push(outcome);
            }
        }
        Ok(())
    }

    /// Classifies the scouts, cells spread over the grid, which fills the catalogue of known orbits.
    pub(super) fn scout_grid(&mut self) -> Result<(), OrbitError> {
        let (columns, rows) = (self.grid.across.cells, self.grid.up.cells);
        let along = |cells: usize| cells.div_ceil(SCOUTS_PER_AXIS);
        let rows = (along(rows) / 2..rows).step_by(along(rows));
        let cells: Vec<usize> = rows
            .flat_map(|row| {
                let columns_here = (along(columns) / 2..columns).step_by(along(columns));
                columns_here.map(move |column| row * columns + column)
            })
            .filter(|cell| self.outcomes[*cell] == MemberStatus::Open)
            .collect();
        self.judge_cells(&cells, self.transient)
    }

    /// Keeps a lost cell of the survey, if none before it is kept.
    pub(super) fn keep_first_lost(&mut self, lost: Option<LostCell>) {
        self.lost = earlier_lost(self.lost.take(), lost);
    }

    /// Indices of the cells whose motions have not come to anything yet.
    pub(super) fn open_cells(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.outcomes.len()).filter(|cell| self.outcomes[*cell] == MemberStatus::Open)
    }

    /// Classifies all cells by their logs whose motions no contraction ball holds.
    pub(super) fn judge_all(&mut self) -> Result<(), OrbitError> {
        let open: Vec<usize> = self.open_cells().collect();
        for cells in open.chunks(CELLS_JUDGED_TOGETHER) {
            self.judge_cells(cells, 0)?;
        }
        Ok(())
    }

    /// Follows cells for some drive periods, and classifies each by its log; outcomes that are stored are recalled.
    fn judge_cells(&mut self, cells: &[usize], periods: u64) -> Result<(), OrbitError> {
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
            self.judge_anew(cells, periods)
        })?;
        if is_known {
            for log in &judged.entered {
                self.judge_log(log)?;
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

    /// Computes the logs and outcomes of cells that [`BasinSurvey::judge_cells`] finds in no store.
    fn judge_anew(&mut self, cells: &[usize], periods: u64) -> Result<CellOutcomes, OrbitError> {
        let seen = self.log_cells(cells, periods)?;
        let mut judged = CellOutcomes::default();
        for (cell, (state, log, error)) in cells.iter().zip(seen) {
            let known = self.catalogue.orbits.len();
            judged.states.push(state);
            judged.outcomes.push(match error {
                Some(error) => {
                    judged.lost.get_or_insert((*cell, error));
                    MemberStatus::Lost
                }
                None => self.judge_log(&log)?,
            });
            if self.catalogue.orbits.len() > known {
                judged.entered.push(log);
            }
            self.count_settled(&judged.outcomes[judged.outcomes.len() - 1..])?;
        }
        Ok(judged)
    }

    /// Follows cells for some drive periods, then records the log of each; motions that run in no lanes are stored one by one.
    fn log_cells(&self, cells: &[usize], periods: u64) -> Result<Vec<CellLog>, OrbitError> {
        if self.ensemble.runs_in_lanes() {
            return self.log_together(cells, periods);
        }
        let one = |cell: &usize| {
            let of = (
                "cell",
                &*self.scene,
                self.grid,
                (self.options, self.transient),
                (cell, periods),
            );
            recall_or_compute(self.kept, &of, || self.log_together(&[*cell], periods))
        };
        Ok(parallel::try_map(cells, one)?.concat())
    }

    /// Follows cells together for some drive periods, and then records the log of each.
    fn log_together(&self, cells: &[usize], periods: u64) -> Result<Vec<CellLog>, OrbitError> {
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
    fn judge_log(&mut self, log: &[Start]) -> Result<MemberStatus, OrbitError> {
        let known = self.catalogue.orbits.len();
        let outcome = self.catalogue.classify_log(log)?;
        for (index, entry) in self.catalogue.orbits.iter().enumerate().skip(known) {
            self.balls.add_orbit(index, &entry.orbit)?;
        }
        Ok(outcome)
    }
}

/// Of two lost cells the one with the smaller index.
pub(super) fn earlier_lost(one: Option<LostCell>, other: Option<LostCell>) -> Option<LostCell> {
    one.into_iter().chain(other).min()
}
