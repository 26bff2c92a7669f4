//! Figure 6: bifurcation diagrams over six clearances, up and down, and the boundaries across them.

mod boundaries;
mod chart;

use anyhow::{Error, Result};
use softstop::{Parameter, Ratios};
use softstop_dynamics::{Chain, Plan, Step, orbit};

use crate::diagram;
use crate::figure::{self, Drawn, Figure, Findings, Studio};
use boundaries::Ends;
use chart::Chart;
use softstop_console::progress::Progress;

/// Fig. 6(a).
pub(super) const UNLOADED: Figure = Figure {
    title: "Bifurcation diagrams of the unloaded machine over six clearances",
    files: &["figure-6a.png", "figure-6a.csv", "figure-6a-boundaries.csv"],
    draw: |studio| draw(studio, Ratios::unloaded(), "A"),
};

/// Fig. 6(b).
pub(super) const LOADED: Figure = Figure {
    title: "Bifurcation diagrams of the loaded machine over six clearances",
    files: &["figure-6b.png", "figure-6b.csv", "figure-6b-boundaries.csv"],
    draw: |studio| draw(studio, Ratios::loaded(), "B"),
};

/// The paper's clearances and frequencies.
const CLEARANCES: [f64; 6] = [2.0, 6.0, 10.0, 14.0, 18.0, 22.0];
const RANGE: (f64, f64) = (0.8, 1.8);

fn draw(studio: &Studio, machine: Ratios, name: &'static str) -> Result<Drawn> {
    let detail = studio.detail;
    let (steps, periods) = detail.pick((1000, 200), (120, 100));
    let plan = Plan::new(Parameter::Frequency, RANGE, steps, periods)?;
    let mut chains = Vec::new();
    for clearance in CLEARANCES {
        let scene = machine.at_clearance(clearance).scene()?;
        chains.extend(diagram::ways(&scene));
    }
    let chains = diagram::sweep(vec![(plan, chains)], "steps of the sweeps", studio.kept)?;
    let progress = Progress::new(3 * CLEARANCES.len() as u64, "boundaries");
    let ends = boundaries::ends(&machine, &CLEARANCES, &progress)?;
    let across = boundaries::across(&machine, &ends, detail.pick(0.02, 0.05), &progress)?;
    let optimum = boundaries::optimum(&machine, &ends);
    let point = orbit::find(&machine.scene()?)?;
    let is_loaded = machine.piercing.is_some();
    let chart = Chart {
        chains: &chains,
        boundaries: &across,
        point: (name, boundaries::figures(&point)),
        is_loaded,
        explanation: format!(
            "Peterka 2003, Fig. 6({}). Sweeps up and down, {periods} drive periods at each of {steps} frequencies; \
             grey arrows: jumps between z = 0 and z = 1",
            if is_loaded { 'b' } else { 'a' }
        ),
    };
    Ok(Drawn {
        files: vec![
            chart.png().map_err(Error::msg)?,
            table(&chains)?,
            boundaries::table(&across)?,
        ],
        findings: findings(&ends, &chains, optimum),
    })
}

fn table(chains: &[Chain]) -> Result<Vec<u8>> {
    let columns = format!("rho,direction,eta,{}", diagram::FIELDS);
    let steps = chains
        .iter()
        .flat_map(|chain| chain.steps.iter().map(move |step| (chain, step)));
    let rows = steps.map(|(chain, step)| {
        let (rho, way) = (chain.machine.scene.clearance, chain.direction.name());
        let eta = format!("{:.9}", step.value);
        (rho, way, eta, diagram::fields(step))
    });
    figure::table(&columns, rows)
}

fn findings(ends: &[Ends], chains: &[Chain], optimum: Option<(f64, f64)>) -> Findings {
    let mut findings = Findings::default();
    for (end, ways) in ends.iter().zip(chains.chunks_exact(2)) {
        let rho = end.clearance;
        let mut add = |name: &str, value: Option<f64>| {
            findings.add(format!("{name} at rho = {rho}"), value);
        };
        let fold = end.fold.as_ref().map(|it| it.1);
        add("eta_g0", Some(end.grazing[0]));
        add("eta_SN", fold.map(|it| it[0]));
        add("eta_PD", end.flip.as_ref().map(|it| it.1[0]));
        add("X_m at the fold", fold.map(|it| it[1]));
        add("velocity at the fold", fold.map(|it| it[2]));
        let ones = diagram::steps(ways).filter(|step| diagram::is_one(step));
        let hardest = ones.max_by(|a, b| a.hardest().total_cmp(&b.hardest()));
        add("hardest impact of z = 1", hardest.map(Step::hardest));
        add("eta of the hardest impact", hardest.map(|it| it.value));
        let highest = diagram::steps(ways).map(|step| step.max_position);
        add("largest X_m of any motion", highest.max_by(f64::total_cmp));
        let ones = diagram::steps(ways).filter(|step| diagram::is_one(step));
        let highest = ones.max_by(|a, b| a.max_position.total_cmp(&b.max_position));
        add("largest X_m of z = 1", highest.map(|it| it.max_position));
        add(
            "eta of the largest X_m of z = 1",
            highest.map(|it| it.value),
        );
        add("hysteresis width", fold.map(|it| it[0] - end.grazing[0]));
        for chain in ways {
            let ranges = chart::ranges(chain);
            let way = chain.direction.name();
            let begins = format!("eta where piercing begins on the way {way}");
            add(&begins, ranges.first().map(|range| range.0));
            let ends = format!("eta where piercing ends on the way {way}");
            add(&ends, ranges.last().map(|range| range.1));
        }
    }
    let (clearance, velocity) = optimum.unzip();
    findings.add("rho of the hardest impact at a fold", clearance);
    findings.add("hardest impact at a fold", velocity);
    findings
}
