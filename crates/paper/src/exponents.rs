//! The largest Lyapunov exponent under the diagram of rho = 10: is the harder motion the more stable one?

use anyhow::{Context, Error, Result};
use rayon::prelude::*;
use softstop::{MotionError, Ratios, Scene};
use softstop_dynamics::orbit::find;
use softstop_dynamics::zone::hysteresis;
use softstop_dynamics::{Chain, LyapunovExponents, Orbit, SweepStep};

use crate::diagram::{self, Part, WAYS, by_way, dots};
use crate::figure::{Drawn, Figure, Findings, Studio};
use softstop_console::columns;
use softstop_console::export::csv;
use softstop_console::progress::Progress;
use softstop_draw::{Align, Chart, Layer, Mark, Stroke, style};

/// Radius of a dot.
const DOT: f64 = 0.7;

/// A step of a sweep, its largest exponent per unit of tau, and the half-width of the 95 % interval of that.
struct ExponentStep {
    step: SweepStep,
    exponent: (f64, f64),
}

/// eta, X'- and the exponent.
type Place = [f64; 3];

pub(super) fn draw(studio: &Studio, figure: &Figure) -> Result<Drawn> {
    let (detail, [whole, zoom]): (_, [Part; 2]) = (studio.detail, figure.get("parts")?);
    let plans = [whole.plan(detail)?, zoom.plan(detail)?];
    let ways = diagram::ways(&Ratios::unloaded().scene()?).to_vec();
    let mut chains = diagram::sweep(vec![(plans[0], ways)], "steps of the sweeps", studio.kept)?;
    let zoom = chains.iter();
    let zoom = zoom
        .map(|sweep| diagram::part_of(sweep, &plans[1]))
        .collect();
    chains.extend(diagram::sweep(zoom, "steps of the zoom", studio.kept)?);
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
    let mut chart = chart(figure, &parts, &branch, &marks);
    chart.subtitle = format!(
        "Left {left}, right {right}. Periodic motion: λ = ln|μ|/(nT); else the mean over {} drive periods",
        32 * batch
    );
    let ways = parts.iter();
    let ways = ways.flat_map(|ways| ways.iter().zip(["up", "down"]));
    let rows = ways.flat_map(|(points, way)| points.iter().map(move |point| (way, point)));
    let columns = columns! { (&str, &ExponentStep), it;
        "direction" [None], "of the frequency" => it.0;
        "eta" [None], "drive frequency" => format!("{:.9}", it.1.step.value);
        "impacts" [None], "p of z = p/n" => it.1.step.motion.regime().map(|z| z.impacts);
        "periods" [None], "n of it" => it.1.step.motion.regime().map(|z| z.periods);
        "lambda" [None], "largest exponent per unit of tau" => it.1.exponent.0;
        "lambda_half_width" [None], "of its 95 % interval" => it.1.exponent.1;
        "largest_before_impact_velocity" [None], "of the motion" => it.1.step.hardest_impact();
    };
    let png = chart.png().map_err(Error::msg)?;
    Ok(Drawn::new([png, csv(&columns, rows)?], findings))
}

/// The steps of a sweep with their exponents, in rising order.
fn points(chain: &Chain, batch: u64, progress: &Progress) -> Result<Vec<ExponentStep>> {
    let points = chain.rising_steps().into_par_iter().map(|step| {
        progress.step()?;
        let exponent = exponent(&chain.machine.scene, step, batch)?;
        let step = step.clone();
        Ok(ExponentStep { step, exponent })
    });
    points.collect()
}

fn exponent(scene: &Scene, step: &SweepStep, batch: u64) -> Result<(f64, f64), MotionError> {
    let scene = scene.at_frequency(step.value);
    if let Some(periods) = step.motion.periods()
        && let Ok(orbit) = Orbit::find_periodic(&scene, step.end.into(), periods)
        && orbit.is_stable()
    {
        return Ok((of(&orbit)[2], 0.0));
    }
    let (found, _) = LyapunovExponents::along_motion(&scene, step.end.into(), batch)?;
    Ok((found.per_second()[0], found.error / found.period))
}

fn of(orbit: &Orbit) -> Place {
    let [exponent, _] = LyapunovExponents::of(orbit).per_second();
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

/// The whole range and a part of it, each up and down, in the whole z = 1 up to its fold and points to mark on it with
/// their names.
fn chart(
    figure: &Figure,
    parts: &[[Vec<ExponentStep>; 2]],
    branch: &[Place],
    marks: &[(String, Place)],
) -> Chart {
    let mut chart = figure.chart.clone();
    for (index, panel) in chart.panels.iter_mut().enumerate() {
        let (ways, row) = (&parts[index / 2], index % 2);
        panel.layers = layers(ways, row);
        if row == 0 {
            let steps = ways.iter().flatten().map(|point| &point.step);
            let top = steps.map(SweepStep::hardest_impact).fold(1.0, f64::max);
            panel.y.ends = [-0.04 * top, 1.08 * top].map(Some);
        } else {
            let zero = Layer::horizontal(0.0, Stroke::solid(style::INK, 1.0), "");
            panel.layers.push(zero);
        }
        if index < 2 {
            let curve = branch.iter().map(|at| (at[0], at[1 + row]));
            let curve = Layer::line(curve, Stroke::solid(style::DESIGN, 1.8));
            panel.layers.push(curve);
            panel.layers.extend(marks.iter().flat_map(|(_, at)| {
                let spot = Layer::marks([(at[0], at[1 + row])], Mark::Hollow, style::INK);
                let line = Stroke::dashed(style::ASIDE, 0.9, (3.0, 3.0));
                [Layer::vertical(at[0], line, ""), spot.sized(4.5)]
            }));
        }
        if index == 1 {
            let beyond = Layer::text((0.965, 0.0), Align::Left, "chaos: λ > 0, at the right");
            panel.layers.push(beyond.moved(0.0, -8.0).plated());
            panel.layers.extend(marks.iter().map(|(name, at)| {
                let (shift, align) = match at[0] < 1.2 {
                    true => (-9.0, Align::Right),
                    false => (9.0, Align::Left),
                };
                Layer::text((at[0], at[2]), align, name).moved(shift, 20.0)
            }));
        }
    }
    chart
}

/// The diagram or the exponents of a part.
fn layers([up, down]: &[Vec<ExponentStep>; 2], row: usize) -> Vec<Layer> {
    let ways = by_way(up, down, |point| &point.step);
    let layers = ways.into_iter().zip(WAYS).map(|(points, (name, color))| {
        let settled = points.into_iter().filter(|it| it.step.is_settled());
        let dots = settled.flat_map(|point| match row {
            0 => dots(&point.step),
            _ => vec![(point.step.value, point.exponent.0)],
        });
        let radius = [DOT, 1.4 * DOT][row];
        Layer::dots(dots, radius, color).named(name)
    });
    layers.collect()
}
