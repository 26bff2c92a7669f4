//! The plane of initial states as the user states it.

use std::f64::consts::TAU;
use std::str::FromStr;

use softstop::Scene;
use softstop_dynamics::basin::{Axis, Grid, Quantity};

use super::BasinArguments;
use softstop_console::failure::Failure;
use softstop_console::machine::finite;

/// Half of the range of positions, in units of the motion's length.
const FAR: f64 = 2.0;

/// Two different quantities: across and upwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Plane {
    across: Quantity,
    up: Quantity,
}

impl FromStr for Plane {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let quantity = |name: &str| match name.trim() {
            "x" => Some(Quantity::Position),
            "v" => Some(Quantity::Velocity),
            "phi" => Some(Quantity::Angle),
            _ => None,
        };
        let pair = text.split_once(',');
        let pair = pair.and_then(|(across, up)| Some((quantity(across)?, quantity(up)?)));
        match pair {
            Some((across, up)) if across != up => Ok(Self { across, up }),
            _ => Err("must be two different ones of x, v and phi, as in x,v".to_owned()),
        }
    }
}

/// The grid for a scene.
pub(super) fn grid(arguments: &BasinArguments, scene: &Scene) -> Result<Grid, Failure> {
    finite("at", arguments.at)?;
    let drive = scene.excitation;
    let free = drive.amplitude / (scene.mass * drive.frequency * drive.frequency);
    let length = scene.clearance.abs().max(free);
    let length = FAR * if length > 0.0 { length } else { 1.0 };
    let wall = scene.wall().map_or(f64::INFINITY, |wall| wall.position);
    let axis = |quantity| {
        let speed = length * drive.frequency;
        let range = match quantity {
            Quantity::Position => arguments.x.unwrap_or([-length, length.min(wall)]),
            Quantity::Velocity => arguments.v.unwrap_or([-speed, speed]),
            Quantity::Angle => arguments.phi.unwrap_or([0.0, TAU]),
        };
        Axis {
            quantity,
            range,
            cells: arguments.size,
        }
    };
    let Plane { across, up } = arguments.plane;
    let mut grid = Grid::states(axis(across), axis(up), drive.phase);
    let shared = |quantity| across != quantity && up != quantity;
    if shared(Quantity::Position) {
        grid.state.position = arguments.at;
    } else if shared(Quantity::Velocity) {
        grid.state.velocity = arguments.at;
    } else {
        grid.angle = arguments.at;
    }
    Ok(grid)
}
