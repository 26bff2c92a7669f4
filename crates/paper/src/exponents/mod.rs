//! The largest Lyapunov exponent under the diagram of rho = 10: is the harder motion the more stable one?

mod chart;

use anyhow::{Error, Result, anyhow};
use rayon::prelude::*;
use softstop::{MotionError, Ratios, Scene};
use softstop_dynamics::continuation::Parameter;
use softstop_dynamics::orbit::{Exponents, Orbit, find};
use softstop_dynamics::sweep::{Chain, Plan, Step};
use softstop_dynamics::zone::hysteresis;

use crate::diagram::{self, Job};
use crate::exponents::chart::{StabilityChart, StabilityPart, StabilityPoint};
use crate::figure::{self, Drawn, Figure, Studio};
use softstop_console::progress::Progress;

/// Lyapunov exponent under the diagram.
pub(crate) const FIGURE: Figure = Figure {
    title: "Lyapunov exponent under the diagram",
    files: &["exponents.png", "exponents.csv"],
    draw,
};

/// Both ranges of eta, and the exponents that their panels show.
const PARTS: [((f64, f64), (f64, f64)); 2] =
    [((0.8, 1.8), (-0.03, 0.008)), ((0.95, 1.0), (-0.03, 0.09))];

fn draw(studio: &Studio) -> Result<Drawn> {
    let detail = studio.detail;
    let plans = PARTS
        .iter()
        .zip(detail.pick([(1401, 200), (900, 200)], [(101, 100), (41, 100)]));
    let plans = plans.map(|((range, _), (steps, periods))| {
        Ok(Plan::new(Parameter::Frequency, *range, steps, periods)?)
    });
    let plans = plans.collect::<Result<Vec<Plan>>>()?;
    let scene = Ratios::unloaded().scene()?;
    let mut whole = [(plans[0], diagram::ways(&scene).to_vec())];
    diagram::sweep(&mut whole, "steps of the sweeps")?;
    let [(_, whole)] = whole;
    let zoom = whole.iter().map(|sweep| diagram::part_of(sweep, &plans[1]));
    let mut zoom: Vec<Job> = zoom.collect();
    diagram::sweep(&mut zoom, "steps of the zoom")?;
    let sweeps = [whole, zoom.into_iter().flat_map(|job| job.1).collect()];
    let steps: usize = plans.iter().map(|plan| 2 * plan.steps).sum();
    let progress = Progress::new(steps as u64, "exponents");
    let batch = detail.pick(40, 4);
    let mut parts = Vec::new();
    for (chains, (range, exponents)) in sweeps.iter().zip(PARTS) {
        let ways = [
            points(&chains[0], batch, &progress)?,
            points(&chains[1], batch, &progress)?,
        ];
        parts.push(StabilityPart {
            range,
            exponents,
            ways,
        });
    }
    let branch = branch(detail.pick(400, 80))?;
    let summary = Summary::new(&parts, &branch)?;
    let chart = StabilityChart {
        parts: &parts,
        branch: &branch,
        marks: &summary.marks(),
        explanation: explanation(&plans, batch),
    };
    Ok(Drawn {
        files: vec![chart.png().map_err(Error::msg)?, table(&parts)?],
        findings: summary.findings(),
    })
}

fn explanation(plans: &[Plan], batch: u64) -> String {
    let sweeps: Vec<String> = plans
        .iter()
        .map(|plan| {
            format!(
                "{} frequencies × {} drive periods",
                plan.steps, plan.periods
            )
        })
        .collect();
    format!(
        "Left {}, right {}. Periodic motion: λ = ln|μ|/(nT); else the mean over {} drive periods",
        sweeps[0],
        sweeps[1],
        32 * batch
    )
}

/// The steps of a sweep with their exponents, in rising order.
fn points(chain: &Chain, batch: u64, progress: &Progress) -> Result<Vec<StabilityPoint>> {
    chain
        .rising()
        .into_par_iter()
        .map(|step| {
            progress.step()?;
            Ok(StabilityPoint {
                exponent: exponent(&chain.machine.scene, step, batch)?,
                step: step.clone(),
            })
        })
        .collect()
}

/// The largest exponent per unit of tau, and the half-width of its 95 % interval.
fn exponent(scene: &Scene, step: &Step, batch: u64) -> Result<(f64, f64), MotionError> {
    let mut scene = scene.clone();
    scene.excitation.frequency = step.value;
    if let Some(periods) = step.motion.periods()
        && let Ok(orbit) = Orbit::periodic(&scene, step.end.into(), periods)
        && orbit.is_stable()
    {
        return Ok((Exponents::of(&orbit).per_second()[0], 0.0));
    }
    let (found, _) = Exponents::along(&scene, step.end.into(), batch)?;
    Ok((found.per_second()[0], found.error / found.period))
}

/// z = 1 from the grazing g0 to its fold, ever denser towards the fold: eta, X'-, exponent.
fn branch(count: u32) -> Result<Vec<[f64; 3]>> {
    let zone = hysteresis(&Ratios::unloaded().scene()?)?;
    let shares = (0..=count).map(|index| 1.0 - (1.0 - f64::from(index) / f64::from(count)).powi(3));
    let at = |share: f64| -> Result<[f64; 3]> {
        let orbit = zone.orbit_at(share)?;
        let exponent = Exponents::of(&orbit).per_second()[0];
        Ok([
            zone.frequency_at(share),
            orbit.before_impact_velocity(),
            exponent,
        ])
    };
    shares
        .collect::<Vec<f64>>()
        .into_par_iter()
        .map(at)
        .collect()
}

/// What the figure says about z = 1: eta, X'-, exponent.
struct Summary {
    point: [f64; 3],
    hardest: [f64; 3],
    most_stable: [f64; 3],
    most_chaotic: Option<[f64; 3]>,
    /// z = 1 at its fold.
    fold: [f64; 3],
    /// Exponent of the impact-less motion.
    rest: f64,
}

impl Summary {
    fn new(parts: &[StabilityPart], branch: &[[f64; 3]]) -> Result<Self> {
        let machine = Ratios::unloaded();
        let scene = machine.scene()?;
        let orbit = find(&scene)?;
        let ways = parts.iter().flat_map(|part| &part.ways);
        let hardest = branch.iter().max_by(|a, b| a[1].total_cmp(&b[1]));
        let stable = branch.iter().min_by(|a, b| a[2].total_cmp(&b[2]));
        let none = || anyhow!("z = 1 was not met");
        let triple = |at: &StabilityPoint| [at.step.value, at.step.hardest(), at.exponent.0];
        let chaotic = ways.flatten().map(triple).filter(|it| it[2] > 0.0);
        Ok(Self {
            point: [
                machine.frequency,
                orbit.before_impact_velocity(),
                Exponents::of(&orbit).per_second()[0],
            ],
            hardest: *hardest.ok_or_else(none)?,
            most_stable: *stable.ok_or_else(none)?,
            most_chaotic: chaotic.max_by(|a, b| a[2].total_cmp(&b[2])),
            fold: *branch.last().ok_or_else(none)?,
            rest: -machine.damping,
        })
    }

    fn marks(&self) -> Vec<(String, [f64; 3])> {
        let named =
            |name: &str, at: [f64; 3]| (format!("{name}: λ = {:.4}", at[2]).replace('-', "−"), at);
        vec![
            named("A", self.point),
            named("lowest", self.most_stable),
            ("λ → 0 at the fold s_SN".to_owned(), self.fold),
        ]
    }

    fn findings(&self) -> Vec<(String, f64)> {
        let mut findings = vec![
            ("lambda at A".to_owned(), self.point[2]),
            ("lambda without impacts".to_owned(), self.rest),
        ];
        let mut add = |what: &str, at: [f64; 3]| {
            findings.push((format!("{what}: eta"), at[0]));
            findings.push((format!("{what}: velocity"), at[1]));
            findings.push((format!("{what}: lambda"), at[2]));
        };
        add("least lambda on z = 1", self.most_stable);
        add("hardest impact on z = 1", self.hardest);
        if let Some(at) = self.most_chaotic {
            add("largest lambda", at);
        }
        findings
    }
}

fn table(parts: &[StabilityPart]) -> Result<Vec<u8>> {
    let columns =
        "direction,eta,impacts,periods,lambda,lambda_half_width,largest_before_impact_velocity";
    let ways = parts
        .iter()
        .flat_map(|part| part.ways.iter().zip(["up", "down"]));
    let points = ways.flat_map(|(points, way)| points.iter().map(move |point| (way, point)));
    let rows = points.map(|(way, StabilityPoint { step, exponent })| {
        let regime = step.motion.regime();
        let regime = regime.map(|it| (it.impacts, it.periods)).unzip();
        let eta = format!("{:.9}", step.value);
        (way, eta, regime, *exponent, step.hardest())
    });
    figure::table(columns, rows)
}
