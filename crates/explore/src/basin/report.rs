//! What basins came to, as tables and as JSON.

use std::path::PathBuf;

use serde::Serialize;
use softstop_dynamics::basin::{Basins, Clearing, Establishing, Grid, Kind};
use softstop_dynamics::orbit::Regime;

use softstop_console::failure::Failure;
use softstop_console::output::Staged;

/// The basins of one machine.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct BasinReport {
    /// The machine.
    pub machine: String,
    /// Where the cells lie.
    pub grid: Grid,
    /// The basins.
    pub basins: Vec<ClassReport>,
    /// The files.
    pub files: Vec<String>,
}

/// One basin.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ClassReport {
    /// What its motions settle on.
    pub motion: String,
    /// Order of impacts of a periodic motion.
    pub pattern: Option<String>,
    /// Its hardest impact.
    pub velocity: Option<f64>,
    /// Largest Lyapunov exponent per drive period, of what does not return.
    pub exponent: Option<f64>,
    /// Cells.
    pub cells: usize,
    /// Their share.
    pub share: f64,
    /// Wilson's 95 % interval of it.
    pub interval: [f64; 2],
    /// Radius of the largest ball inside, in units of half of each axis.
    pub integrity: Option<f64>,
    /// Its centre.
    pub centre: Option<[f64; 2]>,
}

/// The certainty of z = 1 along the hysteresis zone.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct CertaintyReport {
    /// Where the cells lie.
    pub grid: Grid,
    /// The places.
    pub places: Vec<PlaceReport>,
    /// The files.
    pub files: Vec<String>,
}

/// One place of the zone.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct PlaceReport {
    /// From 0 at g0 to 1 at s_SN.
    pub place: f64,
    /// eta.
    pub frequency: f64,
    /// Share of the cells that lead to z = 1.
    pub certainty: f64,
    /// Wilson's 95 % interval of it.
    pub interval: [f64; 2],
    /// Radius of the largest ball inside its basin, in units of half of each axis.
    pub integrity: Option<f64>,
    /// All motions there and their shares.
    pub motions: Vec<(String, f64)>,
}

impl BasinReport {
    pub(super) fn new(machine: &str, basins: &Basins, files: &[PathBuf]) -> Self {
        let class = |index| ClassReport::new(basins, index);
        Self {
            machine: machine.to_owned(),
            grid: basins.grid,
            basins: (0..basins.classes.len()).map(class).collect(),
            files: files
                .iter()
                .map(|file| file.display().to_string())
                .collect(),
        }
    }
}

impl ClassReport {
    fn new(basins: &Basins, index: usize) -> Self {
        let class = &basins.classes[index];
        let ball: Option<Clearing> = basins.largest_ball(index);
        let (pattern, velocity) = match &class.kind {
            Kind::Periodic(orbit) => (
                Some(orbit.pattern().to_string()),
                Some(orbit.before_impact_velocity()),
            ),
            _ => (None, None),
        };
        let exponent = match &class.kind {
            Kind::Chaotic(exponents) | Kind::Unsettled(exponents) => Some(exponents.per_period[0]),
            _ => None,
        };
        Self {
            motion: class.kind.name(),
            pattern,
            velocity,
            exponent,
            cells: class.cells,
            share: class.share,
            interval: class.interval,
            integrity: ball.map(|ball| ball.radius),
            centre: ball.map(|ball| ball.centre),
        }
    }
}

impl CertaintyReport {
    pub(super) fn new(grid: &Grid, places: &[Establishing], files: &[PathBuf]) -> Self {
        Self {
            grid: *grid,
            places: places.iter().map(PlaceReport::new).collect(),
            files: files
                .iter()
                .map(|file| file.display().to_string())
                .collect(),
        }
    }
}

impl PlaceReport {
    fn new(place: &Establishing) -> Self {
        let basins = &place.basins;
        let classes = basins.classes.iter();
        Self {
            place: place.place,
            frequency: place.frequency,
            certainty: place.certainty,
            interval: place.interval,
            integrity: basins.largest_ball_of(Regime::ONE).map(|ball| ball.radius),
            motions: classes
                .map(|class| (class.kind.name(), class.share))
                .collect(),
        }
    }
}

/// Writes a row for each basin.
pub(super) fn table(report: &BasinReport, mut table: Staged) -> Result<(), Failure> {
    table.header(&[
        "motion",
        "pattern",
        "velocity",
        "exponent",
        "cells",
        "share",
        "share_low",
        "share_high",
        "integrity",
    ])?;
    for class in &report.basins {
        let ClassReport {
            motion,
            pattern,
            velocity,
            exponent,
            cells,
            share,
            interval,
            integrity,
            ..
        } = class;
        table.row(&(
            motion,
            pattern,
            velocity,
            exponent,
            cells,
            share,
            interval[0],
            interval[1],
            integrity,
        ))?;
    }
    table.close()
}

/// Writes a row for each place.
pub(super) fn certainty_table(report: &CertaintyReport, mut table: Staged) -> Result<(), Failure> {
    table.header(&[
        "place",
        "frequency",
        "certainty",
        "certainty_low",
        "certainty_high",
        "integrity",
        "motions",
    ])?;
    for place in &report.places {
        let motions = place
            .motions
            .iter()
            .map(|(name, share)| format!("{name}: {share:.6}"));
        let motions: Vec<String> = motions.collect();
        let PlaceReport {
            place,
            frequency,
            certainty,
            interval,
            integrity,
            ..
        } = place;
        table.row(&(
            place,
            frequency,
            certainty,
            interval[0],
            interval[1],
            integrity,
            motions.join(", "),
        ))?;
    }
    table.close()
}
