//! Figure 6: bifurcation diagrams over six clearances, up and down, and the boundaries across them.

mod chart;

use anyhow::{Error, Result};
use softstop::Parameter;
use softstop_console::columns;
use softstop_console::export::csv;
use softstop_console::machine::PaperMachine;
use softstop_dynamics::zone::free_amplitude;
use softstop_dynamics::{Chain, Plan, Step, orbit};

use crate::boundaries::{self, Ends};
use crate::diagram;
use crate::figure::{Drawn, Figure, Findings, Studio, findings};

/// The paper's clearances and frequencies.
const CLEARANCES: [f64; 6] = [2.0, 6.0, 10.0, 14.0, 18.0, 22.0];
const RANGE: (f64, f64) = (0.8, 1.8);

pub(super) fn draw(studio: &Studio, figure: &Figure) -> Result<Drawn> {
    let regime: PaperMachine = figure.get("machine")?;
    let machine = regime.ratios();
    let (steps, periods) = studio.detail.pick((1000, 200), (120, 100));
    let plan = Plan::new(Parameter::Frequency, RANGE, steps, periods)?;
    let mut chains = Vec::new();
    for clearance in CLEARANCES {
        let scene = machine.at_clearance(clearance).scene()?;
        chains.extend(diagram::ways(&scene));
    }
    let chains = diagram::sweep(vec![(plan, chains)], "steps of the sweeps", studio.kept)?;
    let ends = boundaries::ends(&machine, &CLEARANCES)?;
    let across = boundaries::across(&machine)?;
    let optimum = boundaries::optimum(&machine, &ends);
    let scene = machine.scene()?;
    let etas = (0..=2400).map(|k| RANGE.0 + (RANGE.1 - RANGE.0) * f64::from(k) / 2400.0);
    let response = etas.map(|eta| (eta, free_amplitude(&scene, eta)));
    let response: Vec<(f64, f64)> = response.collect();
    let point = (regime.point(), boundaries::figures(&orbit::find(&scene)?));
    let mut chart = chart::chart(figure, &chains, &response, &across, point);
    chart.subtitle = format!(
        "Peterka 2003, Fig. 6({}). Sweeps up and down, {periods} drive periods at each of {steps} frequencies; \
         grey arrows: jumps between z = 0 and z = 1",
        &figure.name[1..]
    );
    let sweeps = chains.iter();
    let rho = |it: &Chain| it.machine.scene.clearance.to_string();
    let sweeps = sweeps.map(|it| (rho(it), it.direction.name(), &it.steps[..]));
    let points = across.iter();
    let points = points.flat_map(|(name, curve)| curve.iter().map(move |at| (*name, *at)));
    let columns = columns! { (&str, [f64; 3]), it;
        "boundary" [None], "which one" => it.0;
        "eta" [None], "drive frequency" => it.1[0];
        "max_position" [None], "X_m" => it.1[1];
        "before_impact_velocity" [None], "X'_-" => it.1[2];
    };
    let files = [
        chart.png().map_err(Error::msg)?,
        diagram::table("rho", sweeps)?,
        csv(&columns, points)?,
    ];
    Drawn::new(files, findings_of(&ends, &chains, optimum))
}

fn findings_of(ends: &[Ends], chains: &[Chain], optimum: Option<(f64, f64)>) -> Findings {
    let mut findings = Findings::default();
    for (end, ways) in ends.iter().zip(chains.chunks_exact(2)) {
        let rho = end.clearance;
        let ones = || diagram::steps(ways).filter(|step| diagram::is_one(step));
        let hardest = ones().max_by(|a, b| a.hardest_impact().total_cmp(&b.hardest_impact()));
        let highest = ones().max_by(|a, b| a.max_position.total_cmp(&b.max_position));
        let farthest = diagram::steps(ways).map(|step| step.max_position);
        findings! { findings, |what| format!("{what} at rho = {rho}");
            "eta_g0" => end.grazing[0];
            "eta_SN" => end.fold.map(|it| it[0]);
            "eta_PD" => end.flip.map(|it| it[0]);
            "X_m at the fold" => end.fold.map(|it| it[1]);
            "velocity at the fold" => end.fold.map(|it| it[2]);
            "hardest impact of z = 1" => hardest.map(Step::hardest_impact);
            "eta of the hardest impact" => hardest.map(|it| it.value);
            "largest X_m of any motion" => farthest.max_by(f64::total_cmp);
            "largest X_m of z = 1" => highest.map(|it| it.max_position);
            "eta of the largest X_m of z = 1" => highest.map(|it| it.value);
            "hysteresis width" => end.fold.map(|it| it[0] - end.grazing[0]);
        }
        for chain in ways {
            let (ranges, way) = (chart::ranges(chain), chain.direction.name());
            findings! { findings, |what| format!("eta where piercing {what} on the way {way} at rho = {rho}");
                "begins" => ranges.first().map(|range| range.0);
                "ends" => ranges.last().map(|range| range.1);
            }
        }
    }
    let (clearance, velocity) = optimum.unzip();
    findings.add("rho of the hardest impact at a fold", clearance);
    findings.add("hardest impact at a fold", velocity);
    findings
}
