//! What basins came to.

use serde_json::json;
use softstop::{Dimension, Machine};
use softstop_console::arguments::title;
use softstop_console::column::{Column, Units};
use softstop_console::columns;
use softstop_console::record::{Record, below};
use softstop_console::report::{MotionName, stated_machine};
use softstop_dynamics::attractors::Attractor;
use softstop_dynamics::basin::{AxisQuantity, BasinBall, CertaintyAtPlace};
use softstop_dynamics::{Axis, Basins, Grid};

/// A row of `basin.csv`.
pub(super) type BasinRow<'a> = (&'a Attractor, Option<BasinBall>);

/// Columns of `basin.csv` that say what the motion is.
const NAMING: usize = 3;

/// The columns of `basin.csv`.
pub(super) fn columns<'a>() -> [Column<BasinRow<'a>>; 10] {
    columns! { BasinRow<'a>, it;
        "kind" [None] Plain, "of what the basin's motions settle on" => it.0.motion.json_key();
        "z" [None] Plain, "regime z = p/n, if the motion repeats" => it.0.motion.z();
        "order" [None] Plain, "impacts in each of its drive periods" => it.0.motion.order().map(ToString::to_string);
        "before_impact_velocity" [Velocity] Fixed(4), "of its hardest impact" => it.0.orbit.as_ref().map(|it| it.before_impact_velocity());
        "exponent" [None], "Lyapunov's, per drive period, unless periodic" => it.0.exponents.map(|it| it.per_period[0]);
        "cells" [None], "that belong to it" => it.0.starts;
        "share" [None] Fixed(5), "of all cells" => it.0.share;
        "share_low" [None] Fixed(5), "lower end of its 95 % interval" => it.0.interval[0];
        "share_high" [None] Fixed(5), "upper end of it" => it.0.interval[1];
        "integrity" [None] Fixed(4), "radius of the largest ball, in half axes" => it.1.map(|it| it.radius);
    }
}

fn centre<'a>() -> [Column<BasinRow<'a>>; 1] {
    columns! { BasinRow<'a>, it;
        "centre" [None], "of the largest ball" => it.1.map(|it| it.centre);
    }
}

/// The rows of `basin.csv`.
pub(super) fn rows(basins: &Basins) -> Vec<BasinRow<'_>> {
    let classes = basins.classes.iter().enumerate();
    classes
        .map(|(index, class)| (class, basins.largest_ball(index)))
        .collect()
}

/// A row of `certainty.csv`.
pub(super) type CertaintyRow<'a> = (&'a Machine, &'a CertaintyAtPlace);

/// The columns of `certainty.csv`.
pub(super) fn places<'a>() -> [Column<CertaintyRow<'a>>; 7] {
    columns! { CertaintyRow<'a>, it;
        "place" [None] Fixed(4), "0 at g0, 1 at s_SN" => it.1.place;
        "frequency" [Frequency] Fixed(6), "of the drive, in Hz where the machine states it so" => it.0.to_own(Dimension::Frequency, it.1.frequency);
        "certainty" [None] Fixed(5), "share of cells that lead to the zone's z = 1 motion, the harder of two" => it.1.certainty;
        "certainty_low" [None] Fixed(5), "lower end of its 95 % interval" => it.1.interval[0];
        "certainty_high" [None] Fixed(5), "upper end of it" => it.1.interval[1];
        "integrity" [None] Fixed(4), "radius of the largest ball, in half axes" => it.1.largest_ball().map(|it| it.radius);
        "motions" [None], "z or kind of all motions, and their shares" => motions(it.1);
    }
}

fn motions(place: &CertaintyAtPlace) -> String {
    let motions = place.basins.classes.iter().map(|class| {
        let name = MotionName::of(&class.motion);
        format!("{}: {:.6}", name.word(), class.share)
    });
    motions.collect::<Vec<_>>().join(", ")
}

/// What a machine is called, and which states were tried.
fn head(machine: &Machine, grid: &Grid) -> String {
    let [across, up] = [&grid.across, &grid.up].map(|axis| axis.cells);
    let [first, second] = [&grid.across, &grid.up].map(|axis| range(machine, axis));
    format!(
        "{}: {across} x {up} initial states with {first} and {second}\n\n",
        title(machine)
    )
}

/// Where the cells lie along an axis.
fn range(machine: &Machine, axis: &Axis) -> String {
    let (name, dimension) = match axis.quantity {
        AxisQuantity::Position => ("x", Dimension::Length),
        AxisQuantity::Velocity => ("x'", Dimension::Velocity),
        AxisQuantity::Angle => ("phi", Dimension::Angle),
    };
    let ([low, high], unit) = (axis.range, machine.unit(dimension));
    format!("{low:.4} <= {name} <= {high:.4} {unit}")
        .trim_end()
        .to_owned()
}

/// The basins of one machine, what to beware of, and the text of both.
pub(super) fn basins(
    machine: &Machine,
    basins: &Basins,
    warning: Option<String>,
) -> (Record, String) {
    let (rows, columns) = (rows(basins), columns());
    let found = rows.iter().map(|row| {
        let figures = Record::of(&columns[NAMING..], row);
        let name = MotionName::of(&row.0.motion).figures();
        name.and(figures).and(Record::of(&centre(), row))
    });
    let told = warning.iter();
    let told = told.map(|warning| format!("\nWarning: {warning}.\n"));
    let text = head(machine, &basins.grid)
        + &below(&Record::all(&columns, &rows), &Units::of(machine))
        + &told.collect::<String>();
    let result = Record::default()
        .hidden("machine", stated_machine(machine))
        .hidden("grid", json!(basins.grid))
        .hidden("basins", found.collect::<Vec<_>>());
    let result = warning
        .into_iter()
        .fold(result, |result, it| result.hidden("warning", it));
    (result, text)
}

/// The certainty of z = 1 along the hysteresis zone, and the text of it; the grid may be wider than at the machine's own
/// frequency, for the motions of the zone.
pub(super) fn certainties(
    machine: &Machine,
    (grid, widened): (&Grid, bool),
    found: &[CertaintyAtPlace],
) -> (Record, String) {
    let columns = places();
    let figures = |place| Record::of(&columns[..columns.len() - 1], &(machine, place));
    let figures: Vec<Record> = found.iter().map(figures).collect();
    let wider =
        "Wider than at the machine's own frequency, for motions of the zone lie outside that.\n\n";
    let text = "Establishing certainty of z = 1, from g0 (place 0) to s_SN (place 1)\n".to_owned()
        + &head(machine, grid)
        + if widened { wider } else { "" }
        + &below(&figures, &Units::of(machine));
    let motion = |class: &Attractor| {
        let name = MotionName::of(&class.motion).figures();
        name.hidden("share", class.share)
    };
    let places = figures.into_iter().zip(found).map(|(figures, place)| {
        let motions = place.basins.classes.iter().map(motion);
        figures.hidden("motions", motions.collect::<Vec<_>>())
    });
    let result = Record::default()
        .hidden("machine", stated_machine(machine))
        .hidden("grid", json!(grid))
        .hidden("widened", widened)
        .hidden("places", places.collect::<Vec<_>>());
    (result, text)
}
