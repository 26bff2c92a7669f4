//! The largest Lyapunov exponent under the diagram of rho = 10: is the harder motion the more stable one?

mod chart;

use anyhow::{Context, Error, Result};
use rayon::prelude::*;
use softstop::{MotionError, Parameter, Ratios, Scene};
use softstop_dynamics::orbit::find;
use softstop_dynamics::zone::hysteresis;
use softstop_dynamics::{Chain, Exponents, Orbit, Plan, Step};

use crate::diagram;
use crate::figure::{self, Drawn, Figure, Findings, Studio};
use softstop_console::progress::Progress;

/// Both ranges of eta, and the exponents that their panels show.
const PARTS: [((f64, f64), (f64, f64)); 2] =
    [((0.8, 1.8), (-0.03, 0.008)), ((0.95, 1.0), (-0.03, 0.09))];

/// A step of a sweep, its largest exponent per unit of tau, and the half-width of the 95 % interval of that.
struct Point {
    step: Step,
    exponent: (f64, f64),
}

/// Sweeps over a range of eta.
struct Part {
    range: (f64, f64),
    /// Least and largest exponent to be seen.
    exponents: (f64, f64),
    /// Up and down, in rising order of eta.
    ways: [Vec<Point>; 2],
}

/// eta, X'- and the exponent.
type Place = [f64; 3];

pub(super) fn draw(studio: &Studio, _: &Figure) -> Result<Drawn> {
    let detail = studio.detail;
    let sizes = detail.pick([(1401, 200), (900, 200)], [(101, 100), (41, 100)]);
    let plan = |part: usize| {
        let (steps, periods) = sizes[part];
        Plan::new(Parameter::Frequency, PARTS[part].0, steps, periods)
    };
    let plans = [plan(0)?, plan(1)?];
    let ways = diagram::ways(&Ratios::unloaded().scene()?).to_vec();
    let mut chains = diagram::sweep(vec![(plans[0], ways)], "steps of the sweeps", studio.kept)?;
    let zoom = chains.iter();
    let zoom = zoom.map(|sweep| diagram::part_of(sweep, &plans[1]));
    chains.extend(diagram::sweep(
        zoom.collect(),
        "steps of the zoom",
        studio.kept,
    )?);
    let steps: usize = chains.iter().map(|chain| chain.steps.len()).sum();
    let progress = Progress::new(steps as u64, "exponents");
    let batch = detail.pick(40, 4);
    let mut parts = Vec::new();
    for (ways, (range, exponents)) in chains.chunks_exact(2).zip(PARTS) {
        let points = |way: usize| points(&ways[way], batch, &progress);
        parts.push(Part {
            range,
            exponents,
            ways: [points(0)?, points(1)?],
        });
    }
    let branch = branch(detail.pick(400, 80))?;
    let none = "z = 1 was not met";
    let machine = Ratios::unloaded();
    let point = of(&find(&machine.scene()?)?);
    let hardest = branch.iter().max_by(|a, b| a[1].total_cmp(&b[1]));
    let stable = branch.iter().min_by(|a, b| a[2].total_cmp(&b[2]));
    let (hardest, stable) = (*hardest.context(none)?, *stable.context(none)?);
    let points = parts.iter().flat_map(|part| &part.ways).flatten();
    let places = points.map(|at| [at.step.value, at.step.hardest(), at.exponent.0]);
    let chaotic = places.filter(|it| it[2] > 0.0);
    let chaotic = chaotic.max_by(|a, b| a[2].total_cmp(&b[2]));
    let named = |name: &str, at: Place| {
        let text = format!("{name}: λ = {:.4}", at[2]);
        (text.replace('-', "−"), at)
    };
    let fold = *branch.last().context(none)?;
    let marks = [
        named("A", point),
        named("lowest", stable),
        ("s_SN, the fold: λ → 0".to_owned(), fold),
    ];
    let mut findings = Findings::default();
    findings.add("lambda at A", point[2]);
    findings.add("lambda without impacts", -machine.damping);
    for (what, at) in [
        ("least lambda on z = 1", Some(stable)),
        ("hardest impact on z = 1", Some(hardest)),
        ("largest lambda", chaotic),
    ] {
        for (index, name) in ["eta", "velocity", "lambda"].iter().enumerate() {
            findings.add(format!("{what}: {name}"), at.map(|at| at[index]));
        }
    }
    let [left, right] =
        plans.map(|it| format!("{} frequencies × {} drive periods", it.steps, it.periods));
    let explanation = format!(
        "Left {left}, right {right}. Periodic motion: λ = ln|μ|/(nT); else the mean over {} drive periods",
        32 * batch
    );
    let chart = chart::chart(&parts, &branch, &marks, explanation);
    Ok(Drawn {
        files: vec![chart.png().map_err(Error::msg)?, table(&parts)?],
        findings,
    })
}

/// The steps of a sweep with their exponents, in rising order.
fn points(chain: &Chain, batch: u64, progress: &Progress) -> Result<Vec<Point>> {
    let points = chain.rising().into_par_iter().map(|step| {
        progress.step()?;
        let exponent = exponent(&chain.machine.scene, step, batch)?;
        let step = step.clone();
        Ok(Point { step, exponent })
    });
    points.collect()
}

fn exponent(scene: &Scene, step: &Step, batch: u64) -> Result<(f64, f64), MotionError> {
    let scene = scene.at_frequency(step.value);
    if let Some(periods) = step.motion.periods()
        && let Ok(orbit) = Orbit::periodic(&scene, step.end.into(), periods)
        && orbit.is_stable()
    {
        return Ok((of(&orbit)[2], 0.0));
    }
    let (found, _) = Exponents::along(&scene, step.end.into(), batch)?;
    Ok((found.per_second()[0], found.error / found.period))
}

fn of(orbit: &Orbit) -> Place {
    let [exponent, _] = Exponents::of(orbit).per_second();
    let eta = orbit.scene.excitation.frequency;
    [eta, orbit.before_impact_velocity(), exponent]
}

/// z = 1 from the grazing g0 to its fold, ever denser towards the fold.
fn branch(count: u32) -> Result<Vec<Place>> {
    let zone = hysteresis(&Ratios::unloaded().scene()?)?;
    let places = (0..=count).into_par_iter().map(|index| {
        let share = 1.0 - (1.0 - f64::from(index) / f64::from(count)).powi(3);
        let [_, velocity, exponent] = of(&zone.orbit_at(share)?);
        Ok([zone.frequency_at(share), velocity, exponent])
    });
    places.collect()
}

fn table(parts: &[Part]) -> Result<Vec<u8>> {
    let ways = parts
        .iter()
        .flat_map(|part| part.ways.iter().zip(["up", "down"]));
    let points = ways.flat_map(|(points, way)| points.iter().map(move |point| (way, point)));
    let rows = points.map(|(way, Point { step, exponent })| {
        let regime = step.motion.regime();
        let regime = regime.map(|it| (it.impacts, it.periods)).unzip();
        let eta = format!("{:.9}", step.value);
        (way, eta, regime, *exponent, step.hardest())
    });
    let columns =
        "direction,eta,impacts,periods,lambda,lambda_half_width,largest_before_impact_velocity";
    figure::table(columns, rows)
}
