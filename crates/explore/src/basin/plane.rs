//! The plane of initial states as the user states it.

use std::f64::consts::TAU;
use std::str::FromStr;

use anyhow::Error;
use softstop::{Allowed, Dimension, Machine, Scene};
use softstop_dynamics::attractors::Region;
use softstop_dynamics::basin::AxisQuantity;
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::{Axis, Grid, zone};

use super::BasinArguments;
use softstop_console::failure::Failure;
use softstop_console::interrupt;

/// Two different quantities: across and upwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Plane {
    across: AxisQuantity,
    up: AxisQuantity,
}

impl FromStr for Plane {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let quantity = |name: &str| match name.trim() {
            "x" => Some(AxisQuantity::Position),
            "v" => Some(AxisQuantity::Velocity),
            "phi" => Some(AxisQuantity::Angle),
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

/// Cells on both sides of the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Size {
    /// From left to right.
    pub across: usize,
    /// From below upwards.
    pub up: usize,
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (across, up) = text.split_once(',').unwrap_or((text, text));
        let number = |part: &str| part.trim().parse().ok();
        match number(across).zip(number(up)) {
            Some((across, up)) => Ok(Self { across, up }),
            None => Err("must be a whole number, or two, as in 400,200".to_owned()),
        }
    }
}

/// Refuses values of the plane that cannot be.
///
/// # Errors
/// [`Failure::Usage`] naming the argument.
pub(super) fn check(arguments: &BasinArguments) -> Result<(), Failure> {
    Allowed::Finite.check("at", arguments.at)?;
    for (flag, range, _) in ranges(arguments) {
        for end in range.into_iter().flatten() {
            Allowed::Finite.check(flag, end)?;
        }
    }
    let hidden = ranges(arguments)
        .into_iter()
        .find(|(_, range, quantity)| range.is_some() && !arguments.plane.shows(*quantity));
    hidden.map_or(Ok(()), |(flag, ..)| {
        let message =
            format!("--{flag}: the plane does not show it; --at has the value of all cells");
        Err(Failure::usage(message))
    })
}

/// The ranges that are given, with their flags.
fn ranges(arguments: &BasinArguments) -> [(&'static str, Option<[f64; 2]>, AxisQuantity); 3] {
    [
        ("x", arguments.x, AxisQuantity::Position),
        ("v", arguments.v, AxisQuantity::Velocity),
        ("phi", arguments.phi, AxisQuantity::Angle),
    ]
}

impl Plane {
    fn shows(self, quantity: AxisQuantity) -> bool {
        self.across == quantity || self.up == quantity
    }
}

/// The grid in the box of starts, unless the arguments say it all. They are [checked](check).
pub(super) fn grid(
    arguments: &BasinArguments,
    scene: &Scene,
    region: impl FnOnce() -> Result<Region, OrbitError>,
) -> Result<Grid, Failure> {
    let Plane { across, up } = arguments.plane;
    let shows = |quantity| arguments.plane.shows(quantity);
    let is_left = |(_, range, quantity): &(_, Option<_>, _)| range.is_none() && shows(*quantity);
    let region = match ranges(arguments)[..2].iter().any(is_left) {
        true => Some(region().map_err(Error::from)?),
        false => None,
    };
    let axis = |quantity, cells| {
        let range = match quantity {
            AxisQuantity::Position => arguments.x.or(region.map(|region| region.position)),
            AxisQuantity::Velocity => arguments.v.or(region.map(|region| region.velocity)),
            AxisQuantity::Angle => arguments.phi,
        };
        Axis {
            quantity,
            range: range.unwrap_or([0.0, TAU]),
            cells,
        }
    };
    let Size {
        across: columns,
        up: rows,
    } = arguments.size;
    let mut grid = Grid::of_states(
        axis(across, columns),
        axis(up, rows),
        scene.excitation.phase,
    );
    if !shows(AxisQuantity::Position) {
        grid.state.position = arguments.at;
    } else if !shows(AxisQuantity::Velocity) {
        grid.state.velocity = arguments.at;
    } else {
        grid.angle = arguments.at;
    }
    Ok(grid)
}

/// A word of warning if the machine's own z = 1 motion does not pass the plane at its drive angle: then the shares say
/// nothing about starts near it.
pub(super) fn beyond(machine: &Machine, grid: &Grid) -> Option<String> {
    let is_own = grid.angle == machine.scene.excitation.phase;
    let shows = [grid.across.quantity, grid.up.quantity];
    if !is_own || shows.contains(&AxisQuantity::Angle) {
        return None;
    }
    let orbit = zone::find_with_monitor(&machine.scene, &interrupt::watch).ok()?;
    let outside = |axis: &Axis| {
        let value = match axis.quantity {
            AxisQuantity::Position => orbit.position,
            AxisQuantity::Velocity => orbit.velocity,
            AxisQuantity::Angle => return false,
        };
        !(axis.range[0]..=axis.range[1]).contains(&value)
    };
    let state = |value, dimension| match machine.unit(dimension) {
        "" => format!("{value:.6}"),
        unit => format!("{value:.6} {unit}"),
    };
    (outside(&grid.across) || outside(&grid.up)).then(|| {
        format!(
            "the machine's own z = 1 motion lies outside the plane, at x = {}, v = {}; --x and --v widen it",
            state(orbit.position, Dimension::Length),
            state(orbit.velocity, Dimension::Velocity)
        )
    })
}
