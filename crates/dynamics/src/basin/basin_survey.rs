//! The survey of the basins on a grid: scouts, and what the motions of all cells have come to.

use super::contraction_ball::ContractionBalls;
use super::{BasinOptions, Basins, Grid};
use crate::attractors::catalogue::AttractorCatalogue;
use crate::ensemble::{Ensemble, MemberStatus};
use crate::monitor::{Monitor, OptionalMemory};
use crate::orbit::OrbitError;
use softstop::{CheckedScene, Scene, Start};
use softstop_lanes::LoweredMachine;

/// Number of cells of a tile, which are followed together: enough for all lanes, whatever the number of threads.
pub(super) const TILE_CELLS: usize = 4096;
/// Number of scouts along each axis of the grid: cells that are classified first, so that the catalogue knows most orbits.
const SCOUTS_PER_AXIS: usize = 16;

/// The index of a cell whose motion cannot be computed, and why.
pub(super) type LostCell = (usize, String);

/// A survey of the basins of a scene on a grid, under way: states and outcomes of the cells, and the orbits that are known.
pub(super) struct BasinSurvey<'a> {
    pub scene: CheckedScene,
    pub grid: &'a Grid,
    pub options: BasinOptions,
    /// Drive periods after which a motion that no ball holds is classified by its log, now.
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
    survey.classify_open_cells()?;
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
        self.classify_cells(&cells, self.transient)
    }

    /// Keeps a lost cell of the survey, if none before it is kept.
    pub(super) fn keep_first_lost(&mut self, lost: Option<LostCell>) {
        self.lost = earlier_lost(self.lost.take(), lost);
    }

    /// Indices of the cells of the survey whose motions have not come to anything yet.
    pub(super) fn open_cells(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.outcomes.len()).filter(|cell| self.outcomes[*cell] == MemberStatus::Open)
    }
}

/// Of two lost cells of a survey the one with the smaller index.
pub(super) fn earlier_lost(one: Option<LostCell>, other: Option<LostCell>) -> Option<LostCell> {
    one.into_iter().chain(other).min()
}
