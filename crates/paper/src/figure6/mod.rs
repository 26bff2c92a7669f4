//! Figure 6: bifurcation diagrams over six clearances, up and down, and the boundaries across them.

mod boundaries;
mod chart;
mod piercing;

use anyhow::{Error, Result};
use softstop::Ratios;
use softstop_dynamics::continuation::Parameter;
use softstop_dynamics::orbit;
use softstop_dynamics::sweep::{Chain, Plan, Step};

use crate::diagram::{self, Job};
use crate::figure::{self, Detail, Drawn, Figure};
use crate::figure6::chart::{ClearanceChart, ClearanceRow};
use crate::figure6::piercing::Ranges;
use boundaries::Ends;
use softstop_console::progress::Progress;

/// Fig. 6(a).
pub(super) const UNLOADED: Figure = Figure {
    title: "Bifurcation diagrams of the unloaded machine over six clearances",
    files: &["figure-6a.png", "figure-6a.csv", "figure-6a-boundaries.csv"],
    draw: |studio| draw(studio.detail, Ratios::unloaded(), "A"),
};

/// Fig. 6(b).
pub(super) const LOADED: Figure = Figure {
    title: "Bifurcation diagrams of the loaded machine over six clearances",
    files: &["figure-6b.png", "figure-6b.csv", "figure-6b-boundaries.csv"],
    draw: |studio| draw(studio.detail, Ratios::loaded(), "B"),
};

/// The paper's clearances and frequencies.
const CLEARANCES: [f64; 6] = [2.0, 6.0, 10.0, 14.0, 18.0, 22.0];
const RANGE: (f64, f64) = (0.8, 1.8);

fn draw(detail: Detail, machine: Ratios, name: &'static str) -> Result<Drawn> {
    let (steps, periods) = detail.pick((1000, 200), (120, 100));
    let plan = Plan::new(Parameter::Frequency, RANGE, steps, periods)?;
    let mut chains = Vec::new();
    for clearance in CLEARANCES {
        let scene = machine.at_clearance(clearance).scene()?;
        chains.extend(diagram::ways(&scene));
    }
    let mut job: [Job; 1] = [(plan, chains)];
    diagram::sweep(&mut job, "steps of the sweeps")?;
    let [(_, chains)] = job;

    let progress = Progress::new(3 * CLEARANCES.len() as u64, "boundaries");
    let ends = boundaries::ends(&machine, &CLEARANCES, &progress)?;
    let across = boundaries::across(&machine, &ends, detail.pick(0.02, 0.05), &progress)?;
    let optimum = boundaries::optimum(&machine, &ends);
    let rows: Vec<ClearanceRow> = chains
        .chunks_exact(2)
        .zip(&ends)
        .map(|(ways, ends)| ClearanceRow {
            clearance: ends.clearance,
            ways: [ways[0].clone(), ways[1].clone()],
        })
        .collect();
    let scene = machine.scene()?;
    let point = orbit::find(&scene)?;
    let piercing = piercing(&machine, &rows);
    let chart = ClearanceChart {
        rows: &rows,
        boundaries: &across,
        range: RANGE,
        point: (
            name,
            [
                machine.frequency,
                point.max_position,
                point.before_impact_velocity(),
            ],
        ),
        piercing: piercing.clone(),
        title: title(&machine),
        explanation: format!(
            "Peterka 2003, Fig. 6({}). Sweeps up and down, {periods} drive periods at each of {steps} frequencies; \
             grey arrows: jumps between z = 0 and z = 1",
            if machine.piercing.is_some() { 'b' } else { 'a' }
        ),
    };
    Ok(Drawn {
        files: vec![
            chart.png().map_err(Error::msg)?,
            table(&rows)?,
            boundaries::table(&across)?,
        ],
        findings: findings(&ends, &rows, optimum, piercing.as_deref()),
    })
}

fn title(machine: &Ratios) -> String {
    match machine.piercing {
        None => "Impact motion without piercing (unloaded machine), ρ = 2, 6, …, 22".to_owned(),
        Some(_) => "Impact motion with piercing (loaded machine), ρ = 2, 6, …, 22".to_owned(),
    }
}

/// Ranges of eta, up and down, in which the largest position lies behind the strip.
fn piercing(machine: &Ratios, rows: &[ClearanceRow]) -> Option<Vec<[Ranges; 2]>> {
    let strip = machine.piercing?;
    let ranges = |chain: &Chain| {
        let through = chain.machine.scene.clearance + strip.thickness;
        let rising = chain.rising();
        let runs = rising.chunk_by(|a, b| (a.max_position > through) == (b.max_position > through));
        let pierced = runs.filter(|run| run[0].max_position > through && run.len() > 1);
        pierced
            .map(|run| (run[0].value, run[run.len() - 1].value))
            .collect::<Ranges>()
    };
    let of_row = |row: &ClearanceRow| [ranges(&row.ways[0]), ranges(&row.ways[1])];
    Some(rows.iter().map(of_row).collect())
}

fn table(rows: &[ClearanceRow]) -> Result<Vec<u8>> {
    let columns = "rho,direction,eta,z,max_position,before_impact_velocities";
    let chains = rows.iter().flat_map(|row| &row.ways);
    let lines = chains.flat_map(|chain| {
        chain.steps.iter().map(|step| {
            (
                chain.machine.scene.clearance,
                chain.direction.name(),
                format!("{:.9}", step.value),
                diagram::name(&step.motion),
                format!("{:.6}", step.max_position),
                diagram::velocities(step),
            )
        })
    });
    figure::table(columns, lines)
}

/// The step of z = 1 with the highest velocity.
fn hardest(row: &ClearanceRow) -> Option<&Step> {
    let steps = row.ways.iter().flat_map(|chain| &chain.steps);
    let ones = steps.filter(|step| diagram::is_one(step));
    ones.max_by(|a, b| a.hardest().total_cmp(&b.hardest()))
}

fn findings(
    ends: &[Ends],
    rows: &[ClearanceRow],
    optimum: Option<(f64, f64)>,
    piercing: Option<&[[Ranges; 2]]>,
) -> Vec<(String, f64)> {
    let mut findings = Vec::new();
    for (end, row) in ends.iter().zip(rows) {
        let mut add = |name: &str, value: Option<f64>| {
            if let Some(value) = value {
                findings.push((format!("{name} at rho = {}", end.clearance), value));
            }
        };
        let fold = end.fold.as_ref().map(|it| it.1);
        add("eta_g0", Some(end.grazing[0]));
        add("eta_SN", fold.map(|it| it[0]));
        add("eta_PD", end.flip.as_ref().map(|it| it.1[0]));
        add("velocity at the fold", fold.map(|it| it[2]));
        let hardest = hardest(row);
        add("hardest impact of z = 1", hardest.map(Step::hardest));
        add("eta of the hardest impact", hardest.map(|it| it.value));
        add("hysteresis width", fold.map(|it| it[0] - end.grazing[0]));
    }
    if let Some((clearance, velocity)) = optimum {
        findings.push(("rho of the hardest impact at a fold".to_owned(), clearance));
        findings.push(("hardest impact at a fold".to_owned(), velocity));
    }
    for (rows, end) in piercing.into_iter().flatten().zip(ends) {
        for (ranges, way) in rows.iter().zip(["up", "down"]) {
            let (Some(first), Some(last)) = (ranges.first(), ranges.last()) else {
                continue;
            };
            let at = format!("on the way {way} at rho = {}", end.clearance);
            findings.push((format!("eta where piercing begins {at}"), first.0));
            findings.push((format!("eta where piercing ends {at}"), last.1));
        }
    }
    findings
}
