//! What a sweep came to, as a table and as JSON.

use std::path::PathBuf;

use serde::Serialize;
use softstop_dynamics::continuation::{Adjustable, Parameter};
use softstop_dynamics::orbit::ImpactPattern;
use softstop_dynamics::sweep::{
    Chain, Coexistence, Direction, Jump, Plan, Settled, Step, hysteresis,
};

use softstop_console::failure::Failure;
use softstop_console::model::Model;
use softstop_console::output::Staged;

/// The result.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct SweepReport {
    /// What was swept.
    pub parameter: &'static str,
    /// Its least and largest value.
    pub range: [f64; 2],
    /// Number of values.
    pub steps: usize,
    /// Drive periods at each.
    pub periods: u64,
    /// Mean change of the parameter per drive period.
    pub rate_per_period: f64,
    /// A sweep each.
    pub sweeps: Vec<ChainReport>,
    /// Where up and down differ.
    pub hysteresis: Vec<ZoneReport>,
    /// The files.
    pub files: Vec<String>,
}

/// One sweep.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ChainReport {
    /// Clearance of the machine; none if that is swept.
    pub clearance: Option<f64>,
    /// Which way.
    pub direction: &'static str,
    /// Steps done.
    pub steps: usize,
    /// Steps of chaos, and unsettled ones.
    pub chaotic: usize,
    /// Steps that have not settled.
    pub unsettled: usize,
    /// Why it ended early.
    pub error: Option<String>,
    /// Where it jumps.
    pub jumps: Vec<JumpReport>,
}

/// One jump: between these two values.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct JumpReport {
    /// Value before.
    pub from: f64,
    /// Value after.
    pub to: f64,
    /// Motion before.
    pub before: String,
    /// Motion after.
    pub after: String,
    /// Largest before-impact velocity before.
    pub velocity_before: f64,
    /// Largest before-impact velocity after.
    pub velocity_after: f64,
}

/// One range in which up and down differ.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ZoneReport {
    /// Clearance of the machine; none if that is swept.
    pub clearance: Option<f64>,
    /// Least value.
    pub from: f64,
    /// Largest value.
    pub to: f64,
    /// Motion on the way up.
    pub up: String,
    /// Motion on the way down.
    pub down: String,
}

impl SweepReport {
    pub(super) fn new(plan: &Plan, chains: &[Chain<Model>], files: &[PathBuf]) -> Self {
        let of_machine = |pair: &[Chain<Model>]| match pair {
            [up, down] if up.direction != down.direction => {
                let zones = hysteresis(up, down);
                let clearance = clearance(plan, up);
                let report = |zone: &Coexistence| ZoneReport::new(clearance, zone);
                zones.iter().map(report).collect()
            }
            _ => Vec::new(),
        };
        let both = chains.iter().any(|chain| chain.direction == Direction::Up)
            && chains
                .iter()
                .any(|chain| chain.direction == Direction::Down);
        let together = if both { 2 } else { 1 };
        Self {
            parameter: plan.parameter.name(),
            range: plan.range.into(),
            steps: plan.steps,
            periods: plan.periods,
            rate_per_period: plan.rate(),
            sweeps: chains
                .iter()
                .map(|chain| ChainReport::new(plan, chain))
                .collect(),
            hysteresis: chains.chunks(together).flat_map(of_machine).collect(),
            files: files
                .iter()
                .map(|file| file.display().to_string())
                .collect(),
        }
    }
}

impl ChainReport {
    fn new(plan: &Plan, chain: &Chain<Model>) -> Self {
        let count = |which: fn(&Settled) -> bool| {
            chain
                .steps
                .iter()
                .filter(|step| which(&step.settled))
                .count()
        };
        Self {
            clearance: clearance(plan, chain),
            direction: chain.direction.name(),
            steps: chain.steps.len(),
            chaotic: count(|settled| matches!(settled, Settled::Chaotic { .. })),
            unsettled: count(Settled::is_unsettled),
            error: chain.error.as_ref().map(ToString::to_string),
            jumps: chain.jumps().iter().map(JumpReport::new).collect(),
        }
    }
}

impl JumpReport {
    fn new(jump: &Jump) -> Self {
        Self {
            from: jump.from,
            to: jump.to,
            before: name(&jump.before, jump.orders[0].as_ref()),
            after: name(&jump.after, jump.orders[1].as_ref()),
            velocity_before: jump.velocities.0,
            velocity_after: jump.velocities.1,
        }
    }
}

impl ZoneReport {
    fn new(clearance: Option<f64>, zone: &Coexistence) -> Self {
        Self {
            clearance,
            from: zone.from,
            to: zone.to,
            up: name(&zone.up, zone.orders[0].as_ref()),
            down: name(&zone.down, zone.orders[1].as_ref()),
        }
    }
}

/// The clearance of a chain, unless it is swept.
fn clearance(plan: &Plan, chain: &Chain<Model>) -> Option<f64> {
    let swept = plan.parameter == Parameter::Clearance;
    chain.machine.value(Parameter::Clearance).filter(|_| !swept)
}

/// A motion in a word, with the order of its impacts.
pub(super) fn name(settled: &Settled, order: Option<&ImpactPattern>) -> String {
    match (settled, order) {
        (Settled::Periodic(regime), Some(order)) if regime.impacts > 1 => {
            format!("z = {regime} ({order})")
        }
        _ => kind(settled),
    }
}

fn kind(settled: &Settled) -> String {
    match settled {
        Settled::Periodic(regime) => format!("z = {regime}"),
        Settled::Chaotic { .. } => "chaos".to_owned(),
        Settled::Unsettled { .. } => "unsettled".to_owned(),
    }
}

/// Columns of the table.
const COLUMNS: [&str; 13] = [
    "clearance",
    "direction",
    "value",
    "motion",
    "order",
    "impacts_per_period",
    "growth_per_period",
    "least_velocity",
    "largest_velocity",
    "max_position",
    "end_position",
    "end_velocity",
    "velocities",
];

/// Writes a row for each step.
pub(super) fn table(
    plan: &Plan,
    chains: &[Chain<Model>],
    mut table: Staged,
) -> Result<(), Failure> {
    table.header(&COLUMNS)?;
    for chain in chains {
        let clearance = clearance(plan, chain);
        for step in &chain.steps {
            table.row(&row(clearance, chain.direction, step))?;
        }
    }
    table.close()
}

fn row(clearance: Option<f64>, direction: Direction, step: &Step) -> impl Serialize {
    let growth = match step.settled {
        Settled::Periodic(_) => None,
        Settled::Chaotic { growth } | Settled::Unsettled { growth } => Some(growth),
    };
    let velocities: Vec<String> = step
        .velocities
        .iter()
        .map(|velocity| format!("{velocity:.9}"))
        .collect();
    (
        clearance,
        direction.name(),
        step.value,
        kind(&step.settled).trim_start_matches("z = ").to_owned(),
        step.order.as_ref().map(ToString::to_string),
        step.impacts_per_period,
        growth,
        step.velocities.first().copied(),
        step.velocities.last().copied(),
        step.max_position,
        step.end.position,
        step.end.velocity,
        velocities.join(" "),
    )
}
