//! Bringing states at any drive angle to the section at drive angle phi.

use std::f64::consts::TAU;

use super::basin_survey::BasinSurvey;
use crate::ensemble::MemberStatus;
use crate::orbit::OrbitError;
use crate::parallel;
use softstop::{CheckedScene, Excitation, MotionError, Start};

/// Number of cells that are brought to drive angle phi between two questions to the monitor.
const CELLS_BROUGHT_TOGETHER: usize = 1 << 16;

/// The state of the motion from a start at drive angle `angle`, in rad, when the drive angle is next that of maps, phi.
pub(crate) fn bring_to_section(
    scene: &CheckedScene,
    start: Start,
    angle: f64,
) -> Result<Start, MotionError> {
    start.validate()?;
    let drive = scene.excitation;
    let from = Excitation {
        phase: angle,
        ..drive
    };
    let turn = (drive.reduced_phase() - from.reduced_phase()).rem_euclid(TAU);
    if turn == 0.0 {
        return Ok(start);
    }
    let mut motion = scene.clone().at_phase(angle)?.motion(start)?;
    motion.advance(motion.clock().instant(turn / drive.frequency), &mut ())?;
    Ok(motion.state())
}

impl BasinSurvey<'_> {
    /// Advances the motions of all cells to where the drive angle is phi.
    pub(super) fn bring_cells_to_section(&mut self) -> Result<(), OrbitError> {
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
}
