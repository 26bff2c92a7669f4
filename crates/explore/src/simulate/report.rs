//! The summary of a run: plain data whose field names are the keys of the JSON, and its text.

use std::collections::BTreeMap;

use serde::Serialize;
use softstop::{Dimension, Machine, PhaseKind, Start};

use super::run::{DRAWN, Outcome};
use super::tally::{Impact, Rest};
use super::{CHART, CROSSINGS, MOTION, SimulateArguments, name};
use softstop_console::arguments::title;
use softstop_console::output::Folder;
use softstop_console::report::MachineReport;
use softstop_console::table::{Row, figure, heading, row, table};

/// A state.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct State {
    position: f64,
    velocity: f64,
}

/// What the impacts were.
#[derive(Debug, Clone, Serialize)]
struct ImpactsReport {
    count: u64,
    per_period: f64,
    least_before_impact_velocity: Option<f64>,
    mean_before_impact_velocity: Option<f64>,
    /// The largest one.
    before_impact_velocity: Option<f64>,
    /// The last ones; all stand in crossings.csv.
    last: Vec<Impact>,
}

/// supplied = dissipated + stored, but for the defect of rounding; in J.
#[derive(Debug, Clone, Copy, Serialize)]
struct EnergyReport {
    supplied: f64,
    dissipated: f64,
    stored: f64,
    defect: f64,
}

#[derive(Debug, Clone, Serialize)]
struct PhaseReport {
    phase: PhaseKind,
    visits: u64,
    /// In s.
    time: f64,
    share: f64,
}

/// The summary, in the machine's own units.
#[derive(Debug, Clone, Serialize)]
pub(super) struct SimulateReport {
    machine: MachineReport,
    #[serde(skip)]
    title: String,
    #[serde(skip)]
    stop: &'static str,
    periods: u64,
    period: f64,
    duration: f64,
    start: State,
    end: State,
    impacts: ImpactsReport,
    pierced: u64,
    rest_count: u64,
    rests: Vec<Rest>,
    energy: EnergyReport,
    phases: Vec<PhaseReport>,
    files: BTreeMap<&'static str, String>,
}

impl SimulateReport {
    pub(super) fn new(
        arguments: &SimulateArguments,
        machine: &Machine,
        start: Start,
        outcome: &Outcome,
        folder: &Folder,
    ) -> Self {
        let tally = &outcome.tally;
        let files = [
            ("motion_csv", MOTION),
            ("crossings_csv", CROSSINGS),
            ("svg", CHART),
        ];
        Self {
            machine: MachineReport::of(machine),
            title: title(machine),
            stop: machine.scene.stop.model(),
            periods: arguments.periods,
            period: machine.scene.period(),
            duration: outcome.duration,
            start: state(start),
            end: state(outcome.end),
            impacts: impacts(outcome, arguments.periods),
            pierced: tally.pierced,
            rest_count: tally.rest_count,
            rests: tally.rests.clone(),
            energy: energy(outcome),
            phases: phases(outcome),
            files: files
                .map(|(kind, name)| (kind, folder.place(name).display().to_string()))
                .into(),
        }
    }

    /// The chart's title.
    pub(super) fn title(&self) -> String {
        let drawn = self.periods.min(DRAWN);
        let file = &self.title;
        if drawn == self.periods {
            format!("{file}: {drawn} drive periods")
        } else {
            format!("{file}: the last {drawn} of {} drive periods", self.periods)
        }
    }

    /// The summary for people.
    pub(super) fn text(&self, machine: &Machine) -> String {
        let title = format!("Motion of {} (stop: {})", self.title, self.stop);
        let mut text = heading(&title);
        text += &table(&self.overview(machine));
        text += "\nPhases visited\n";
        text += &table(&self.visited(machine));
        text += &self.rests_text(machine);
        text += &self.last_impacts(machine);
        text.push('\n');
        for path in self.files.values() {
            text += &format!("Written: {path}\n");
        }
        text
    }

    fn overview(&self, machine: &Machine) -> Vec<Row> {
        let label = |what: &str, dimension| machine.label(what, "", dimension);
        let state = |when: &str| {
            let position = label("position", Dimension::Length);
            format!(
                "{when}: {position}, {}",
                label("velocity", Dimension::Velocity)
            )
        };
        let energies = |what: &str| label(what, Dimension::Energy);
        let impacts = &self.impacts;
        let or_none = |value: Option<f64>| value.map_or_else(|| "-".into(), figure);
        let pair = |state: State| [figure(state.position), figure(state.velocity)];
        let energy = &self.energy;
        vec![
            row("drive periods", [self.periods.to_string()]),
            row(&label("time", Dimension::Time), [figure(self.duration)]),
            row(&state("start"), pair(self.start)),
            row(&state("end"), pair(self.end)),
            row("impacts", [impacts.count.to_string()]),
            row("  per period", [figure(impacts.per_period)]),
            row(
                &label("  lowest before-impact velocity", Dimension::Velocity),
                [or_none(impacts.least_before_impact_velocity)],
            ),
            row(
                &label("  mean", Dimension::Velocity),
                [or_none(impacts.mean_before_impact_velocity)],
            ),
            row(
                &label("  highest", Dimension::Velocity),
                [or_none(impacts.before_impact_velocity)],
            ),
            row("strips pierced", [self.pierced.to_string()]),
            row("rests", [self.rest_count.to_string()]),
            row(&energies("energy supplied"), [figure(energy.supplied)]),
            row(&energies("  dissipated"), [figure(energy.dissipated)]),
            row(&energies("  stored"), [figure(energy.stored)]),
            row(
                &energies("  balance, zero but for rounding"),
                [figure(energy.defect)],
            ),
        ]
    }

    fn visited(&self, machine: &Machine) -> Vec<Row> {
        let head = row(
            "  phase",
            [
                "visits".to_owned(),
                machine.label("time", "", Dimension::Time),
                "share".to_owned(),
            ],
        );
        let rows = self.phases.iter().map(|seen| {
            let share = format!("{:.3} %", 100.0 * seen.share);
            let cells = [seen.visits.to_string(), figure(seen.time), share];
            row(&format!("  {}", name(seen.phase)), cells)
        });
        std::iter::once(head).chain(rows).collect()
    }

    fn rests_text(&self, machine: &Machine) -> String {
        if self.rests.is_empty() {
            return String::new();
        }
        let head = row(
            "  held by",
            [
                machine.label("begin", "", Dimension::Time),
                machine.label("end", "", Dimension::Time),
                machine.label("position", "", Dimension::Length),
            ],
        );
        let rows = self.rests.iter().take(SHOWN).map(|rest| {
            let end = rest.end.map_or_else(|| "lasts".into(), figure);
            let cells = [figure(rest.begin), end, figure(rest.position)];
            row(&format!("  {}", name(rest.phase)), cells)
        });
        let rows: Vec<Row> = std::iter::once(head).chain(rows).collect();
        let more = if self.rest_count > SHOWN as u64 {
            format!(" (the first {SHOWN} of {})", self.rest_count)
        } else {
            String::new()
        };
        format!("\nRests{more}\n{}", table(&rows))
    }

    fn last_impacts(&self, machine: &Machine) -> String {
        if self.impacts.last.is_empty() {
            return String::new();
        }
        let head = row(
            &machine.label("  time", "", Dimension::Time),
            [machine.label("velocity", "", Dimension::Velocity)],
        );
        let rows = self.impacts.last.iter().map(|impact| {
            let velocity = figure(impact.before_impact_velocity);
            row(&format!("  {}", figure(impact.time)), [velocity])
        });
        let rows: Vec<Row> = std::iter::once(head).chain(rows).collect();
        format!("\nLast impacts\n{}", table(&rows))
    }
}

/// Rests that the text lists.
const SHOWN: usize = 10;

const fn state(state: Start) -> State {
    State {
        position: state.position,
        velocity: state.velocity,
    }
}

fn impacts(outcome: &Outcome, periods: u64) -> ImpactsReport {
    let impacts = &outcome.tally.impacts;
    ImpactsReport {
        count: impacts.count,
        per_period: impacts.count as f64 / periods as f64,
        least_before_impact_velocity: impacts.range.map(|range| range.0),
        mean_before_impact_velocity: impacts.mean(),
        before_impact_velocity: impacts.range.map(|range| range.1),
        last: impacts.recent.clone(),
    }
}

fn energy(outcome: &Outcome) -> EnergyReport {
    let work = outcome.tally.work;
    EnergyReport {
        supplied: work.supplied,
        dissipated: work.dissipated,
        stored: outcome.stored,
        defect: work.supplied - work.dissipated - outcome.stored,
    }
}

fn phases(outcome: &Outcome) -> Vec<PhaseReport> {
    let seen = outcome.tally.phases.iter();
    seen.map(|visit| PhaseReport {
        phase: visit.kind,
        visits: visit.visits,
        time: visit.time,
        share: visit.time / outcome.duration,
    })
    .collect()
}
