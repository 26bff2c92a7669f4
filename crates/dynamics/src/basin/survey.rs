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
use softstop::{CheckedScene, MotionError, Scene, Start};
use softstop_lanes::LoweredMachine;

/// Cells of a tile, which go together: enough for all lanes, whatever the number of threads.
pub(super) const TILE_CELLS: usize = 4096;
/// Cells that are brought to the section between two questions to the monitor.
const CELLS_BROUGHT_TOGETHER: usize = 1 << 16;
/// Scouts on each axis of the grid: these cells are judged first.
const SCOUTS_PER_AXIS: usize = 16;

/// Cells that are judged by their logs before what they have come to is stored; so many groups of the ensemble's.
const CELLS_JUDGED_TOGETHER: usize = 1024;

/// The number of a cell that is lost, and why.
pub(super) type LostCell = (usize, String);

/// A survey of the basins of a scene on a grid, under way.
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

/// The log of a cell's motion: its latest state, the last ones, and why it ended.
type CellLog = (Start, Vec<Start>, Option<String>);

/// What some cells were judged to have come to.
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
    /// Brings the states of all cells to drive angle phi.
    fn bring_cells_to_section(&mut self) -> Result<(), OrbitError> {
        let cells = self.grid.cell_count();
        self.states.reserve(cells);
        self.outcomes.reserve(cells);
        for from in (0..cells).step_by(CELLS_BROUGHT_TOGETHER) {
            self.ensemble.count_work(0)?;
            let here = from..cells.min(from + CELLS_BROUGHT_TOGETHER);
            let brought =
                parallel::map_indices(here.len(), &|index| self.cell_at_section(from + index));
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

    /// The state of a cell's motion when the drive angle next is phi.
    fn cell_at_section(&self, cell: usize) -> Result<Start, MotionError> {
        let (start, angle) = self.grid.start_of_cell(cell);
        bring_to_section(&self.scene, start, angle)
    }

    /// Judges a few cells, spread over the grid, which fill the catalogue.
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

    /// Keeps why a cell is lost; that of the first one stands.
    pub(super) fn keep_first_lost(&mut self, lost: Option<LostCell>) {
        self.lost = earlier_lost(self.lost.take(), lost);
    }

    /// The cells that have not come to anything yet.
    pub(super) fn open_cells(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.outcomes.len()).filter(|cell| self.outcomes[*cell] == MemberStatus::Open)
    }

    /// Judges all cells that no ball holds.
    pub(super) fn judge_all(&mut self) -> Result<(), OrbitError> {
        let open: Vec<usize> = self.open_cells().collect();
        for cells in open.chunks(CELLS_JUDGED_TOGETHER) {
            self.judge_cells(cells, 0)?;
        }
        Ok(())
    }

    /// Follows cells for so many drive periods, and judges each by its log; stored outcomes are recalled.
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
        let looked = recall_or_compute(self.kept, &of, || {
            is_known = false;
            self.judge_anew(cells, periods)
        })?;
        if is_known {
            for log in &looked.entered {
                self.judge_log(log)?;
            }
            self.count_settled(&looked.outcomes)?;
        }
        let ends = looked.states.into_iter().zip(looked.outcomes);
        for (cell, (state, outcome)) in cells.iter().zip(ends) {
            (self.states[*cell], self.outcomes[*cell]) = (state, outcome);
        }
        self.keep_first_lost(looked.lost);
        Ok(())
    }

    /// Counts cells but those that wander, which may be followed on.
    fn count_settled(&self, outcomes: &[MemberStatus]) -> Result<(), OrbitError> {
        let settled = outcomes.iter().filter(|it| **it != MemberStatus::Wandering);
        self.ensemble.count_work(settled.count() as u64)
    }

    /// Follows cells for so many drive periods, and judges each by its log.
    fn judge_anew(&mut self, cells: &[usize], periods: u64) -> Result<CellOutcomes, OrbitError> {
        let seen = self.log_cells(cells, periods)?;
        let mut looked = CellOutcomes::default();
        for (cell, (state, log, error)) in cells.iter().zip(seen) {
            let known = self.catalogue.orbits.len();
            looked.states.push(state);
            looked.outcomes.push(match error {
                Some(error) => {
                    looked.lost.get_or_insert((*cell, error));
                    MemberStatus::Lost
                }
                None => self.judge_log(&log)?,
            });
            if self.catalogue.orbits.len() > known {
                looked.entered.push(log);
            }
            self.count_settled(&looked.outcomes[looked.outcomes.len() - 1..])?;
        }
        Ok(looked)
    }

    /// Follows cells for so many drive periods and those of a log; motions that take long are stored one by one.
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

    /// Follows cells together for so many drive periods and those of a log.
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

    /// What a motion with a log has come to; contraction balls are added about an orbit that it turns up.
    fn judge_log(&mut self, log: &[Start]) -> Result<MemberStatus, OrbitError> {
        let known = self.catalogue.orbits.len();
        let outcome = self.catalogue.classify_log(log)?;
        for (index, entry) in self.catalogue.orbits.iter().enumerate().skip(known) {
            self.balls.add_orbit(index, &entry.orbit)?;
        }
        Ok(outcome)
    }
}

/// The earlier of two lost cells, and why.
pub(super) fn earlier_lost(one: Option<LostCell>, other: Option<LostCell>) -> Option<LostCell> {
    one.into_iter().chain(other).min()
}
