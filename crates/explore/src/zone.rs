//! `softstop zone`: the hysteresis zone between grazing and fold, and all stretches of stable z = 1.

use anyhow::anyhow;
use clap::Args;

use crate::continuation::met;
use softstop::{Dimension, Machine, Parameter};
use softstop_console::arguments::{CommandArguments, refuse_without_zone, title};
use softstop_console::column::{Column, Units};
use softstop_console::columns;
use softstop_console::export;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::record::{Record, below};
use softstop_console::report;
use softstop_console::table::heading;
use softstop_dynamics::Zone;
use softstop_dynamics::continuation::SwitchingSurface;
use softstop_dynamics::zone::{
    Loss, StableRange, ZoneError, grazing_frequencies, hysteresis_and_stable_ranges,
};

const EXAMPLES: &str = "\
Examples:
  softstop zone unloaded --set clearance=10
      the paper's Fig. 8: from g0 = 1.04444 to s_SN = 1.369036
  softstop zone loaded --set clearance=10 --set stop.stiffness=12 --format json
      with a stiffer stop, for programs
  softstop zone docs/scenes/kelvin-voigt.toml --set stop.stiffness=50
      any machine with any stop, in the units of its file

Between g0, where the motion without impacts just reaches the clearance (above resonance),
and the fold s_SN, where the z = 1 motion ends, both motions exist; the start decides which
one is seen. The drive frequency plays no part here.

Besides, all stretches of frequency with a stable z = 1 motion are listed, those below g0 and isolas among
them: where each begins and ends, by what, and its hardest impact. A zone with several folds has several.
Of a machine without a zone it is told why there is none (JSON: no_zone), and the stretches, if any.";

/// Arguments of `softstop zone`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ZoneArguments {
    /// How it prints its result, the machine, and what it may cost.
    #[command(flatten)]
    pub common: CommandArguments,
}

/// Finds both ends of the zone and prints them.
pub fn run(arguments: &ZoneArguments) -> Result<(), Failure> {
    let machine = arguments.common.machine_without_start()?;
    refuse_without_zone(&machine)?;
    let why = "the zone is a range of drive frequencies, whatever the machine's own";
    let stated = &arguments.common.machine;
    stated.refuse(&machine, Parameter::Frequency, why)?;
    let (zone, all) = arguments.common.limit.budget.limit(|| {
        let (zone, all) = hysteresis_and_stable_ranges(&machine.scene, &interrupt::watch);
        Ok((zone, all.map_err(|error| anyhow!(error))?))
    })?;
    let zone = zone.map_err(|error| error.in_units_of(&machine));
    match zone {
        Err(ZoneError::Orbit(error)) if all.is_empty() => {
            let place = format!("no hysteresis zone found of {}", title(&machine));
            Err(anyhow!(error).context(place).into())
        }
        zone => {
            let (result, text) = report(&machine, &zone, &all);
            export::print(&result, text, arguments.common.format)
        }
    }
}

/// A machine with its hysteresis zone, if it has one.
#[derive(Clone, Copy)]
struct ZoneRow<'a> {
    machine: &'a Machine,
    zone: Option<&'a Zone>,
}

/// A stable range of a machine.
type StableRangeRow<'a> = (ZoneRow<'a>, &'a StableRange);

/// Zone, why there is none if so, and stretches, with the text of them.
fn report(
    machine: &Machine,
    zone: &Result<Zone, ZoneError>,
    all: &[StableRange],
) -> (Record, String) {
    let why = zone.as_ref().err().map(ToString::to_string);
    let zone = zone.as_ref().ok();
    let row = ZoneRow { machine, zone };
    let rows: Vec<StableRangeRow<'_>> = all.iter().map(|range| (row, range)).collect();
    let stretches = Record::all(&stable_range_columns(), &rows);
    let zone = Record::of(&columns(), &row);
    let units = &Units::of(machine);
    let told = report::machine(machine, &[Parameter::Frequency]).and(zone.clone());
    let no_zone = why.iter().map(|why| format!("No zone: {why}\n"));
    let text = heading("Hysteresis zone of the z = 1 motion")
        + &told.text(units)
        + &no_zone.collect::<String>()
        + "\n"
        + &heading("Stretches of stable z = 1")
        + &below(&stretches, units);
    let result = zone.hidden("no_zone", why);
    let result = result.hidden("stretches", stretches);
    (result.and(report::stated(machine)), text)
}

fn own(machine: &Machine, frequency: f64) -> f64 {
    machine.to_own(Dimension::Frequency, frequency)
}

fn grazing(machine: &Machine) -> Option<f64> {
    let (_, above) = grazing_frequencies(&machine.scene).ok()?;
    Some(own(machine, above))
}

fn columns<'a>() -> [Column<ZoneRow<'a>>; 3] {
    columns! { ZoneRow<'a>, it;
        "frequency_g0" [Frequency] Six, "grazing g0" => grazing(it.machine);
        "frequency_sn" [Frequency] Six, "fold s_SN" => it.zone.map(|zone| own(it.machine, zone.high.frequency));
        "velocity_sn" [Velocity] Six, "before-impact velocity at the fold" => it.zone.map(|zone| zone.high.point.before_impact_velocity());
    }
}

fn stable_range_columns<'a>() -> [Column<StableRangeRow<'a>>; 7] {
    columns! { StableRangeRow<'a>, it;
        "from" [Frequency] Six, "lower end" => own(it.0.machine, it.1.low.frequency);
        "from_by" [None] Plain, "what ends it there" => lost_by(&it.1.low.loss);
        "to" [Frequency] Six, "upper end" => own(it.0.machine, it.1.high.frequency);
        "to_by" [None] Plain, "what ends it there" => lost_by(&it.1.high.loss);
        "hardest" [Velocity] Six, "highest before-impact velocity" => it.1.hardest.before_impact_velocity();
        "hardest_at" [Frequency] Six, "where" => own(it.0.machine, it.1.hardest.parameter);
        "in_zone" [None] Plain, "part of the hysteresis zone" => it.0.zone.is_some_and(|zone| it.1.is_part_of(zone));
    }
}

/// What ends a motion as its machine changes, in words.
pub fn lost_by(loss: &Loss) -> String {
    let word = match loss {
        Loss::Fold => "fold",
        Loss::FreeGrazing => "g0",
        Loss::Flip => "flip",
        Loss::NeimarkSacker => "Neimark-Sacker",
        Loss::Pitchfork => "pitchfork",
        Loss::Grazing => "grazing: its impact dies",
        Loss::AnotherImpact => "grazing: another impact comes up",
        Loss::Inner(SwitchingSurface::Pierced) => "grazing where the strip is pierced",
        Loss::Inner(SwitchingSurface::Wall) => "grazing of the rigid stop",
        Loss::Inner(SwitchingSurface::Below) => "grazing of the stop below",
        Loss::Inner(_) => "grazing of the stop",
        Loss::Border(border) => return format!("border collision: {}", met(*border)),
        Loss::Range => "not followed farther",
        Loss::Budget => "too many points",
        Loss::Unstable => "too unstable to follow",
        Loss::Lost(error) => return error.to_string(),
        _ => "something else",
    };
    word.to_owned()
}
