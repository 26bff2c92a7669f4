//! Bringing states at any drive angle to the section at drive angle phi.

use std::f64::consts::TAU;
use std::sync::Arc;

use softstop::internals::{Motion, Phases};
use softstop::{Clock, Excitation, MotionError, Start};

/// The state of a motion from a start at a drive angle in rad when that angle next is the drive's phi.
pub(crate) fn bring_to_section(
    phases: &Arc<Phases>,
    drive: Excitation,
    start: Start,
    angle: f64,
) -> Result<Start, MotionError> {
    start.validate()?;
    let turn = (drive.phase - angle).rem_euclid(TAU);
    if turn == 0.0 {
        return Ok(start);
    }
    let clock = Clock::new(drive.frequency, angle);
    let mut motion = Motion::new(phases.clone(), clock, Clock::at_cycle(0), start)?;
    motion.advance(clock.instant(turn / drive.frequency), &mut ())?;
    Ok(motion.state())
}
