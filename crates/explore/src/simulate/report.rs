//! The summary of a run, in the machine's own units.

use serde::Serialize;
use serde_json::json;
use softstop::{Machine, Start};

use super::name;
use super::run::{Outcome, Plan};
use super::tally::{Impact, Rest, Visit};
use softstop_console::arguments::title;
use softstop_console::column::{Column, Told, Units};
use softstop_console::columns;
use softstop_console::export::Report;
use softstop_console::number::NumberStyle::Seven;
use softstop_console::record::{Record, below};
use softstop_console::report::MachineReport;
use softstop_console::table::{heading, sections};

/// A run.
struct Run<'a> {
    machine: &'a Machine,
    periods: u64,
    start: Start,
    outcome: &'a Outcome,
}

fn overview<'a>() -> [Column<Run<'a>>; 7] {
    columns! { Run<'a>, it;
        "periods" [None] Plain, "drive periods" => it.periods;
        "period" [Time], "drive period" => it.machine.scene.period();
        "duration" [Time] Seven, "time" => it.outcome.duration;
        "start" [None] Plain, "start: position and velocity" => state(it.start);
        "end" [None] Plain, "end: position and velocity" => state(it.outcome.end);
        "pierced" [None] Plain, "strips pierced" => it.outcome.tally.pierced;
        "rest_count" [None] Plain, "rests" => it.outcome.tally.rest_count;
    }
}

fn impacts<'a>() -> [Column<Run<'a>>; 5] {
    columns! { Run<'a>, it;
        "count" [None] Plain, "impacts" => it.outcome.tally.impacts.count;
        "per_period" [None] Seven, "impacts per period" => it.outcome.tally.impacts.count as f64 / it.periods as f64;
        "least_before_impact_velocity" [Velocity] Seven, "lowest before-impact velocity" => it.outcome.tally.impacts.range.map(|it| it.0);
        "mean_before_impact_velocity" [Velocity] Seven, "mean" => it.outcome.tally.impacts.mean();
        "before_impact_velocity" [Velocity] Seven, "highest" => it.outcome.tally.impacts.range.map(|it| it.1);
    }
}

/// supplied = dissipated + stored, but for the defect of rounding.
fn energy() -> [Column<Outcome>; 4] {
    columns! { Outcome, it;
        "supplied" [Energy] Seven, "energy supplied" => it.tally.work.supplied;
        "dissipated" [Energy] Seven, "dissipated" => it.tally.work.dissipated;
        "stored" [Energy] Seven, "stored" => it.stored;
        "defect" [Energy] Seven, "balance, zero but for rounding" => it.defect();
    }
}

fn visits() -> [Column<(Visit, f64)>; 4] {
    columns! { (Visit, f64), it;
        "phase" [None] Plain, "which" => name(it.0.kind);
        "visits" [None] Plain, "how often it was entered" => it.0.visits;
        "time" [Time] Seven, "spent in it" => it.0.time;
        "share" [None] Percent(3), "of the run" => it.0.time / it.1;
    }
}

fn rests() -> [Column<Rest>; 4] {
    columns! { Rest, it;
        "phase" [None] Plain, "what holds the mass" => name(it.phase);
        "begin" [Time] Seven, "when" => it.begin;
        "end" [Time] Seven, "none if it lasts" => it.end;
        "position" [Length] Seven, "where" => it.position;
    }
}

fn blows() -> [Column<Impact>; 2] {
    columns! { Impact, it;
        "time" [Time] Seven, "when" => it.time;
        "before_impact_velocity" [Velocity] Seven, "how hard" => it.before_impact_velocity;
    }
}

fn state(state: Start) -> Told {
    Told {
        value: json!({ "position": state.position, "velocity": state.velocity }),
        words: format!(
            "{}   {}",
            Seven.format(state.position),
            Seven.format(state.velocity)
        ),
    }
}

/// The summary.
#[derive(Debug, Serialize)]
pub(crate) struct SimulateReport {
    machine: MachineReport,
    #[serde(flatten)]
    overview: Record,
    impacts: ImpactsReport,
    rests: Vec<Record>,
    energy: Record,
    phases: Vec<Record>,
    #[serde(skip)]
    title: String,
    #[serde(skip)]
    units: Units,
    /// All rests, also those that are not listed.
    #[serde(skip)]
    rest_count: u64,
}

#[derive(Debug, Serialize)]
struct ImpactsReport {
    #[serde(flatten)]
    figures: Record,
    /// The last ones; all stand in crossings.csv.
    last: Vec<Record>,
}

impl SimulateReport {
    pub(crate) fn new(plan: &Plan<'_>, outcome: &Outcome) -> Self {
        let (tally, machine) = (&outcome.tally, &plan.begun.machine);
        let run = Run {
            machine,
            periods: plan.periods,
            start: plan.begun.start,
            outcome,
        };
        let seen = tally.phases.iter();
        let seen: Vec<(Visit, f64)> = seen.map(|visit| (*visit, outcome.duration)).collect();
        Self {
            machine: MachineReport::of(machine),
            overview: Record::of(&overview(), &run),
            impacts: ImpactsReport {
                figures: Record::of(&impacts(), &run),
                last: Record::all(&blows(), &tally.impacts.recent),
            },
            rests: Record::all(&rests(), &tally.rests),
            energy: Record::of(&energy(), outcome),
            phases: Record::all(&visits(), &seen),
            title: format!("{} (stop: {})", title(machine), machine.scene.stop.model()),
            units: Units::of(machine),
            rest_count: tally.rest_count,
        }
    }
}

/// The chart's title.
pub(super) fn chart_title(machine: &Machine, periods: u64, drawn: u64) -> String {
    let (name, drawn) = (title(machine), periods.min(drawn));
    match drawn == periods {
        true => format!("{name}: {drawn} drive periods"),
        false => format!("{name}: the last {drawn} of {periods} drive periods"),
    }
}

/// Rests that the text lists.
const SHOWN: usize = 10;

impl Report for SimulateReport {
    fn text(&self) -> String {
        let figures = [&self.overview, &self.impacts.figures, &self.energy];
        let figures = figures.into_iter().cloned();
        let figures = figures.reduce(Record::and).unwrap_or_default();
        let shown = &self.rests[..self.rests.len().min(SHOWN)];
        let mut rests = "Rests".to_owned();
        if self.rest_count > SHOWN as u64 {
            rests += &format!(" (the first {SHOWN} of {})", self.rest_count);
        }
        let tables = [
            ("Phases visited", &self.phases[..]),
            (&rests, shown),
            ("Last impacts", &self.impacts.last),
        ];
        let tables = tables.map(|(title, rows)| (title, below(rows, &self.units)));
        heading(&format!("Motion of {}", self.title))
            + &figures.text(&self.units)
            + &sections(tables)
    }
}
