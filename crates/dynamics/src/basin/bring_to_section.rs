//! Bringing states at any drive angle to the section at drive angle phi.

use std::f64::consts::TAU;

use softstop::{CheckedScene, Excitation, MotionError, Start};

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
