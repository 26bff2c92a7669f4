//! The largest Lyapunov exponent under the diagram of rho = 10: is the harder motion the more stable one?

mod chart;

use anyhow::{Context, Error, Result};
use rayon::prelude::*;
use serde::Deserialize;
use softstop::{MotionError, Ratios, Scene};
use softstop_dynamics::orbit::find;
use softstop_dynamics::zone::hysteresis;
use softstop_dynamics::{Chain, Exponents, Orbit, Step};

use crate::diagram::{self, Part};
use crate::figure::{Drawn, Figure, Findings, Studio};
use softstop_console::column::Column;
use softstop_console::columns;
use softstop_console::export::csv;
use softstop_console::progress::Progress;

/// A step of a sweep, its largest exponent per unit of tau, and the half-width of the 95 % interval of that.
struct Point {
    step: Step,
    exponent: (f64, f64),
}

/// eta, X'- and the exponent.
type Place = [f64; 3];

/// The whole range and a part of it.
#[derive(Deserialize)]
struct What {
    parts: [Part; 2],
}

pub(super) fn draw(studio: &Studio, figure: &Figure) -> Result<Drawn> {
    let (detail, [whole, zoom]) = (studio.detail, figure.what::<What>()?.parts);
    let plans = [whole.plan(detail)?, zoom.plan(detail)?];
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
    let points = |way: usize| points(&chains[way], batch, &progress);
    let parts = [[points(0)?, points(1)?], [points(2)?, points(3)?]];
    let branch = branch(detail.pick(400, 80))?;
    let none = "z = 1 was not met";
    let machine = Ratios::unloaded();
    let point = of(&find(&machine.scene()?)?);
    let hardest = branch.iter().max_by(|a, b| a[1].total_cmp(&b[1]));
    let stable = branch.iter().min_by(|a, b| a[2].total_cmp(&b[2]));
    let (hardest, stable) = (*hardest.context(none)?, *stable.context(none)?);
    let points = parts.iter().flatten().flatten();
    let places = points.map(|at| [at.step.value, at.step.hardest_impact(), at.exponent.0]);
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
    let mut chart = chart::chart(figure, &parts, &branch, &marks);
    chart.subtitle = format!(
        "Left {left}, right {right}. Periodic motion: λ = ln|μ|/(nT); else the mean over {} drive periods",
        32 * batch
    );
    let ways = parts
        .iter()
        .flat_map(|ways| ways.iter().zip(["up", "down"]));
    let rows = ways.flat_map(|(points, way)| points.iter().map(move |point| (way, point)));
    Ok(Drawn {
        files: vec![chart.png().map_err(Error::msg)?, csv(&columns(), rows)?],
        findings,
    })
}

/// The steps of a sweep with their exponents, in rising order.
fn points(chain: &Chain, batch: u64, progress: &Progress) -> Result<Vec<Point>> {
    let points = chain.rising_steps().into_par_iter().map(|step| {
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
        && let Ok(orbit) = Orbit::find_periodic(&scene, step.end.into(), periods)
        && orbit.is_stable()
    {
        return Ok((of(&orbit)[2], 0.0));
    }
    let (found, _) = Exponents::along_motion(&scene, step.end.into(), batch)?;
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

/// A row for each step of each way.
fn columns<'a>() -> [Column<(&'a str, &'a Point)>; 7] {
    columns! { (&'a str, &'a Point), it;
        "direction" [None], "of the frequency" => it.0;
        "eta" [None], "drive frequency" => format!("{:.9}", it.1.step.value);
        "impacts" [None], "p of z = p/n" => it.1.step.motion.regime().map(|z| z.impacts);
        "periods" [None], "n of it" => it.1.step.motion.regime().map(|z| z.periods);
        "lambda" [None], "largest exponent per unit of tau" => it.1.exponent.0;
        "lambda_half_width" [None], "of its 95 % interval" => it.1.exponent.1;
        "largest_before_impact_velocity" [None], "of the motion" => it.1.step.hardest_impact();
    }
}
