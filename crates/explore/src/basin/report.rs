//! What basins came to.

use serde::Serialize;
use softstop::{Dimension, Machine};
use softstop_console::arguments::title;
use softstop_console::column::{Column, Units, text};
use softstop_console::columns;
use softstop_console::export::Report;
use softstop_console::report::{MachineReport, MotionName};
use softstop_dynamics::basin::{Basins, Establishing, Grid};
use softstop_dynamics::orbit::Regime;

/// The basins of one machine.
#[derive(Debug, Serialize)]
pub struct BasinReport {
    /// The machine.
    pub machine: MachineReport,
    /// Where the cells lie.
    pub grid: Grid,
    /// The basins.
    pub basins: Vec<ClassReport>,
    /// What to beware of.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub warning: Option<String>,
    #[serde(skip)]
    title: String,
    #[serde(skip)]
    units: Units,
}

/// One basin.
#[derive(Debug, Serialize)]
pub struct ClassReport {
    /// What its motions settle on.
    #[serde(flatten)]
    pub motion: MotionName,
    /// Its hardest impact.
    pub before_impact_velocity: Option<f64>,
    /// Largest Lyapunov exponent per drive period, of what does not return.
    pub exponent: Option<f64>,
    /// Cells.
    pub cells: usize,
    /// Their share.
    pub share: f64,
    /// Lower end of Wilson's 95 % interval of it.
    pub share_low: f64,
    /// Its upper end.
    pub share_high: f64,
    /// Radius of the largest ball inside, in units of half of each axis.
    pub integrity: Option<f64>,
    /// Its centre.
    pub centre: Option<[f64; 2]>,
}

/// The certainty of z = 1 along the hysteresis zone.
#[derive(Debug, Serialize)]
pub struct CertaintyReport {
    /// The machine; its own frequency plays no part.
    pub machine: MachineReport,
    /// Where the cells lie.
    pub grid: Grid,
    /// The places.
    pub places: Vec<PlaceReport>,
    #[serde(skip)]
    title: String,
    #[serde(skip)]
    units: Units,
}

/// One place of the zone.
#[derive(Debug, Serialize)]
pub struct PlaceReport {
    /// From 0 at g0 to 1 at s_SN.
    pub place: f64,
    /// Of the drive.
    pub frequency: f64,
    /// Share of the cells that lead to z = 1.
    pub certainty: f64,
    /// Lower end of Wilson's 95 % interval of it.
    pub certainty_low: f64,
    /// Its upper end.
    pub certainty_high: f64,
    /// Radius of the largest ball inside its basin, in units of half of each axis.
    pub integrity: Option<f64>,
    /// All motions there and their shares.
    pub motions: Vec<ShareReport>,
}

/// A motion and its share of the cells.
#[derive(Debug, Serialize)]
pub struct ShareReport {
    /// The motion.
    #[serde(flatten)]
    pub motion: MotionName,
    /// Its share.
    pub share: f64,
}

impl BasinReport {
    pub(super) fn new(machine: &Machine, basins: &Basins, warning: Option<String>) -> Self {
        let class = |index| ClassReport::new(basins, index);
        Self {
            machine: MachineReport::of(machine),
            grid: basins.grid,
            basins: (0..basins.classes.len()).map(class).collect(),
            warning,
            title: title(machine),
            units: Units::of(machine),
        }
    }
}

impl ClassReport {
    fn new(basins: &Basins, index: usize) -> Self {
        let class = &basins.classes[index];
        let ball = basins.largest_ball(index);
        let orbit = class.orbit.as_ref();
        Self {
            motion: MotionName::of(&class.motion),
            before_impact_velocity: orbit.map(|orbit| orbit.before_impact_velocity()),
            exponent: class.exponents.map(|exponents| exponents.per_period[0]),
            cells: class.cells,
            share: class.share,
            share_low: class.interval[0],
            share_high: class.interval[1],
            integrity: ball.map(|ball| ball.radius),
            centre: ball.map(|ball| ball.centre),
        }
    }
}

impl CertaintyReport {
    pub(super) fn new(machine: &Machine, grid: &Grid, places: &[Establishing]) -> Self {
        let report = |place| PlaceReport::new(machine, place);
        Self {
            machine: MachineReport::of(machine),
            grid: *grid,
            places: places.iter().map(report).collect(),
            title: title(machine),
            units: Units::of(machine),
        }
    }
}

impl PlaceReport {
    fn new(machine: &Machine, place: &Establishing) -> Self {
        let basins = &place.basins;
        let motions = basins.classes.iter().map(|class| ShareReport {
            motion: MotionName::of(&class.motion),
            share: class.share,
        });
        Self {
            place: place.place,
            frequency: machine.to_own(Dimension::Frequency, place.frequency),
            certainty: place.certainty,
            certainty_low: place.interval[0],
            certainty_high: place.interval[1],
            integrity: basins.largest_ball_of(Regime::ONE).map(|ball| ball.radius),
            motions: motions.collect(),
        }
    }

    fn motions(&self) -> String {
        let motions = self.motions.iter();
        let motions = motions.map(|it| format!("{}: {:.6}", it.motion.word(), it.share));
        motions.collect::<Vec<_>>().join(", ")
    }
}

/// The columns of `basin.csv`.
pub(super) fn columns() -> [Column<ClassReport>; 10] {
    columns! { ClassReport, it;
        "kind" [None] Plain, "of what the basin's motions settle on" => it.motion.kind;
        "z" [None] Plain, "its p/n, if it repeats" => it.motion.z.as_deref();
        "order" [None] Plain, "impacts in each of its drive periods" => it.motion.order.as_deref();
        "before_impact_velocity" [Velocity] Fixed(4), "of its hardest impact" => it.before_impact_velocity;
        "exponent" [None], "Lyapunov's, per drive period, unless periodic" => it.exponent;
        "cells" [None], "that belong to it" => it.cells;
        "share" [None] Fixed(5), "of all cells" => it.share;
        "share_low" [None] Fixed(5), "lower end of its 95 % interval" => it.share_low;
        "share_high" [None] Fixed(5), "upper end of it" => it.share_high;
        "integrity" [None] Fixed(4), "radius of the largest ball, in half axes" => it.integrity;
    }
}

/// The columns of `certainty.csv`.
pub(super) fn places() -> [Column<PlaceReport>; 7] {
    columns! { PlaceReport, it;
        "place" [None] Fixed(4), "0 at g0, 1 at s_SN" => it.place;
        "frequency" [Frequency] Fixed(6), "of the drive" => it.frequency;
        "certainty" [None] Fixed(5), "share of cells that lead to z = 1" => it.certainty;
        "certainty_low" [None] Fixed(5), "lower end of its 95 % interval" => it.certainty_low;
        "certainty_high" [None] Fixed(5), "upper end of it" => it.certainty_high;
        "integrity" [None] Fixed(4), "radius of the largest ball, in half axes" => it.integrity;
        "motions" [None], "z or kind of all motions, and their shares" => it.motions();
    }
}

impl Report for BasinReport {
    fn text(&self) -> String {
        let (across, up) = (self.grid.across.cells, self.grid.up.cells);
        let warning = self.warning.as_ref();
        let warning = warning.map(|warning| format!("\nWarning: {warning}.\n"));
        format!("{}: {across} x {up} initial states\n\n", self.title)
            + &text(&columns(), &self.basins, &self.units)
            + &warning.unwrap_or_default()
    }
}

impl Report for CertaintyReport {
    fn text(&self) -> String {
        let (across, up) = (self.grid.across.cells, self.grid.up.cells);
        format!(
            "Establishing certainty of z = 1 of {}, from g0 (place 0) to s_SN (place 1), {across} x {up} initial states\n\n",
            self.title
        ) + &text(&places(), &self.places, &self.units)
    }
}
