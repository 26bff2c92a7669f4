//! The summary of a run, in the machine's own units.

use serde_json::json;
use softstop::{Impact, Start};

use super::begin::RunPlan;
use super::name;
use super::run::RunOutcome;
use super::tally::{PhaseVisit, RestInterval};
use softstop_console::arguments::title;
use softstop_console::column::{Column, Told, Units};
use softstop_console::columns;
use softstop_console::number::NumberStyle::Seven;
use softstop_console::record::{Record, below};
use softstop_console::report::stated_machine;
use softstop_console::table::{heading, sections};

fn overview<'a>() -> [Column<RunOutcome<'a>>; 7] {
    columns! { RunOutcome<'a>, it;
        "periods" [None] Plain, "drive periods" => it.plan.periods;
        "period" [Time], "drive period" => it.plan.machine.scene.period();
        "duration" [Time] Seven, "time" => it.duration;
        "start" [None] Plain, "start: position and velocity" => state(it.plan.machine.start);
        "end" [None] Plain, "end: position and velocity" => state(it.end);
        "pierced" [None] Plain, "strips pierced" => it.tally.pierced;
        "rest_count" [None] Plain, "rests" => it.tally.rest_count;
    }
}

fn impacts<'a>() -> [Column<RunOutcome<'a>>; 5] {
    columns! { RunOutcome<'a>, it;
        "count" [None] Plain, "impacts" => it.tally.impacts.count;
        "per_period" [None] Seven, "impacts per period" => it.tally.impacts.count as f64 / it.plan.periods as f64;
        "least_before_impact_velocity" [Velocity] Seven, "lowest before-impact velocity" => it.tally.impacts.range.map(|it| it.0);
        "mean_before_impact_velocity" [Velocity] Seven, "mean" => it.tally.impacts.mean();
        "before_impact_velocity" [Velocity] Seven, "highest" => it.tally.impacts.range.map(|it| it.1);
    }
}

/// supplied = dissipated + stored, but for the defect of rounding.
fn energy<'a>() -> [Column<RunOutcome<'a>>; 4] {
    columns! { RunOutcome<'a>, it;
        "supplied" [Energy] Seven, "energy supplied" => it.tally.work.supplied;
        "dissipated" [Energy] Seven, "dissipated" => it.tally.work.dissipated.max(0.0);
        "stored" [Energy] Seven, "stored" => it.stored;
        "defect" [Energy] Seven, "balance, zero but for rounding" => it.defect();
    }
}

fn visits() -> [Column<(PhaseVisit, f64)>; 4] {
    columns! { (PhaseVisit, f64), it;
        "phase" [None] Plain, "which" => name(it.0.kind);
        "visits" [None] Plain, "how often it was entered" => it.0.visits;
        "time" [Time] Seven, "spent in it" => it.0.time;
        "share" [None] Percent(3), "of the run" => it.0.time / it.1;
    }
}

fn rests() -> [Column<RestInterval>; 4] {
    columns! { RestInterval, it;
        "phase" [None] Plain, "what holds the mass" => name(it.phase);
        "begin" [Time] Seven, "when" => it.begin;
        "end" [Time] Seven, "none if it lasts" => it.end;
        "position" [Length] Seven, "where" => it.position;
    }
}

fn blows() -> [Column<Impact>; 2] {
    columns! { Impact, it;
        "time" [Time] Seven, "when" => it.time;
        "before_impact_velocity" [Velocity] Seven, "how hard" => it.velocity;
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

/// The chart's title.
pub(super) fn chart_title(plan: &RunPlan) -> String {
    let (name, periods) = (title(&plan.machine), plan.periods);
    let drawn = periods.min(plan.drawn);
    match drawn == periods {
        true => format!("{name}: {drawn} drive periods"),
        false => format!("{name}: the last {drawn} of {periods} drive periods"),
    }
}

/// Rests that the text lists.
const SHOWN: usize = 10;

/// The summary and the text of it; all impacts stand in crossings.csv, here the last ones.
pub(crate) fn report(outcome: &RunOutcome<'_>) -> (Record, String) {
    let (tally, machine) = (&outcome.tally, &outcome.plan.machine);
    let seen = tally.phases.iter();
    let seen: Vec<(PhaseVisit, f64)> = seen.map(|visit| (*visit, outcome.duration)).collect();
    let phases = Record::all(&visits(), &seen);
    let rests = Record::all(&rests(), &tally.rests);
    let last = Record::all(&blows(), &tally.impacts.recent);
    let overview = Record::of(&overview(), outcome);
    let impacts = Record::of(&impacts(), outcome);
    let energy = Record::of(&energy(), outcome);

    let units = Units::of(machine);
    let figures = overview.clone().and(impacts.clone()).and(energy.clone());
    let mut title_of_rests = "Rests".to_owned();
    if tally.rest_count > SHOWN as u64 {
        title_of_rests += &format!(" (the first {SHOWN} of {})", tally.rest_count);
    }
    let tables = [
        ("Phases visited", &phases[..]),
        (&title_of_rests, &rests[..rests.len().min(SHOWN)]),
        ("Last impacts", &last),
    ];
    let tables = tables.map(|(title, rows)| (title, below(rows, &units)));
    let (name, stop) = (title(machine), machine.scene.stop.model());
    let text = heading(&format!("Motion of {name} (stop: {stop})"))
        + &figures.text(&units)
        + &sections(tables);

    let result = Record::default()
        .hidden("machine", stated_machine(machine))
        .and(overview)
        .hidden("impacts", impacts.hidden("last", last))
        .hidden("rests", rests)
        .hidden("energy", energy)
        .hidden("phases", phases);
    (result, text)
}
