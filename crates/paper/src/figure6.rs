//! Figure 6: bifurcation diagrams over six clearances, up and down, and the boundaries across them.

use anyhow::{Error, Result};
use softstop::Parameter;
use softstop_console::columns;
use softstop_console::export::csv;
use softstop_console::machine::PaperMachine;
use softstop_draw::{Align, Chart, Layer, Mark, Sign, Stroke, style};
use softstop_dynamics::sweep::Jump;
use softstop_dynamics::zone::free_amplitude;
use softstop_dynamics::{Chain, MotionKind, Plan, SweepStep, orbit};

use crate::boundaries::{self, Ends, Figures};
use crate::diagram::{self, is_one};
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
    let mut chart = chart(figure, &chains, &response, &across, point);
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
    Ok(Drawn::new(files, findings_of(&ends, &chains, optimum)))
}

fn findings_of(ends: &[Ends], chains: &[Chain], optimum: Option<(f64, f64)>) -> Findings {
    let mut findings = Findings::default();
    for (end, ways) in ends.iter().zip(chains.chunks_exact(2)) {
        let rho = end.clearance;
        let ones = || diagram::steps(ways).filter(|step| is_one(step));
        let hardest = ones().max_by(|a, b| a.hardest_impact().total_cmp(&b.hardest_impact()));
        let highest = ones().max_by(|a, b| a.max_position.total_cmp(&b.max_position));
        let farthest = diagram::steps(ways).map(|step| step.max_position);
        findings! { findings, |what| format!("{what} at rho = {rho}");
            "eta_g0" => end.grazing[0];
            "eta_SN" => end.fold.map(|it| it[0]);
            "eta_PD" => end.flip.map(|it| it[0]);
            "X_m at the fold" => end.fold.map(|it| it[1]);
            "velocity at the fold" => end.fold.map(|it| it[2]);
            "hardest impact of z = 1" => hardest.map(SweepStep::hardest_impact);
            "eta of the hardest impact" => hardest.map(|it| it.value);
            "largest X_m of any motion" => farthest.max_by(f64::total_cmp);
            "largest X_m of z = 1" => highest.map(|it| it.max_position);
            "eta of the largest X_m of z = 1" => highest.map(|it| it.value);
            "hysteresis width" => end.fold.map(|it| it[0] - end.grazing[0]);
        }
        for chain in ways {
            let (ranges, way) = (ranges(chain), chain.direction.name());
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

/// Radius of the dots.
const DOT: f64 = 0.65;
/// Height of a jump that has an arrow, as a share of the panel.
const SEEN: f64 = 0.03;

/// Lines of the boundaries.
const RESPONSE: Stroke = Stroke::solid(style::INK, 1.5);
const FOLD: Stroke = Stroke::dashed(style::INK, 1.7, (8.0, 4.0));
const FLIP: Stroke = Stroke::dashed(style::INK, 1.7, (2.0, 3.0));

/// Which value of eta, X_m and X'- a panel shows over the first.
type Which = usize;

/// The sweeps up and down of each clearance, in its rising order, the amplitude of the free mass over eta, the curves across
/// the clearances, and the paper's point by its name.
fn chart(
    figure: &Figure,
    chains: &[Chain],
    response: &[(f64, f64)],
    boundaries: &[(&'static str, Vec<Figures>)],
    (name, point): (&'static str, Figures),
) -> Chart {
    let mut chart = figure.chart.clone();
    let lowest = chart.panels.len() - 1;
    for (index, panel) in chart.panels.iter_mut().enumerate() {
        if index != 0 && index != lowest {
            panel.layers = pierced_ranges(chains);
            continue;
        }
        let which: Which = if index == 0 { 1 } else { 2 };
        let seen = SEEN * panel.y.ends[1].unwrap_or(0.0);
        let diagrams = rows(chains).flat_map(|(ways, color)| diagram(ways, color, which));
        let mut layers: Vec<Layer> = diagrams.collect();
        if which == 1 {
            layers.push(Layer::line(response.iter().copied(), RESPONSE));
        }
        for (name, curve) in boundaries {
            let stroke = match *name {
                "s_SN" => FOLD,
                "s_PD" => FLIP,
                _ if which == 1 => continue,
                _ => RESPONSE,
            };
            let points = curve.iter().map(|at| (at[0], at[which]));
            layers.push(Layer::line(points, stroke));
        }
        layers.extend(chains.iter().flat_map(|chain| jumps(chain, which, seen)));
        layers.extend(rows(chains).filter_map(|(ways, color)| label(ways, color, which)));
        let at = (point[0], point[which]);
        let spot = Layer::marks([at], Mark::Hollow, style::INK).sized(5.0);
        let text = Layer::text(at, Align::Left, name).moved(9.0, 18.0);
        layers.extend([spot, text.plated()]);
        if which == 1 {
            layers.extend(legend());
        }
        panel.layers = layers;
    }
    chart
}

/// The sweeps of each clearance, and its colour.
fn rows(chains: &[Chain]) -> impl Iterator<Item = (&[Chain], &'static str)> {
    let rows = chains.chunks_exact(2).enumerate();
    rows.map(|(index, ways)| (ways, style::ordered(index, chains.len() / 2)))
}

/// Dots of all motions, and lines where z = 1 is stable.
fn diagram(ways: &[Chain], color: &'static str, which: Which) -> Vec<Layer> {
    let show = |step: &SweepStep| -> Vec<(f64, f64)> {
        let heights = match which {
            1 if step.hardest_impact() == 0.0 => &[],
            1 => std::slice::from_ref(&step.max_position),
            _ => &step.velocities[..],
        };
        heights.iter().map(|height| (step.value, *height)).collect()
    };
    // What has not settled is on its way from one motion to another.
    let settled = diagram::steps(ways).filter(|step| step.is_settled());
    let mut layers = vec![Layer::dots(settled.flat_map(show), DOT, color)];
    for chain in ways {
        let rising = chain.rising_steps();
        let runs = rising.chunk_by(|a, b| is_one(a) && is_one(b));
        layers.extend(runs.filter(|run| is_one(run[0])).map(|run| {
            let line = run.iter().flat_map(|step| show(step));
            Layer::line(line, Stroke::solid(color, 2.6))
        }));
    }
    layers
}

/// Arrows at jumps between rest from impacts and z = 1 that are so high.
fn jumps(chain: &Chain, which: Which, seen: f64) -> Vec<Layer> {
    let impacts = |motion: &MotionKind| {
        let regime = motion.regime().filter(|it| it.periods == 1)?;
        Some(regime.impacts)
    };
    let position = |value: f64| {
        let step = chain.steps.iter().find(|step| step.value == value);
        step.map_or(f64::NAN, |step| step.max_position)
    };
    let arrow = |jump: &Jump| {
        let (from, to) = match which {
            1 => (position(jump.from), position(jump.to)),
            _ => jump.velocities,
        };
        let motions = (impacts(&jump.before), impacts(&jump.after));
        let is_shown = matches!(motions, (Some(0), Some(1)) | (Some(1), Some(0)));
        let stroke = Stroke::solid(style::ASIDE, 1.2);
        (is_shown && (from - to).abs() > seen)
            .then(|| Layer::arrow((jump.from, from), (jump.to, to), stroke))
    };
    chain.find_jumps().iter().filter_map(arrow).collect()
}

/// The clearance of a diagram, beside the end of its z = 1 or above its hardest impact.
fn label(ways: &[Chain], color: &'static str, which: Which) -> Option<Layer> {
    let ones = diagram::steps(ways).filter(|step| is_one(step));
    let name = format!("ρ = {}", ways[0].machine.scene.clearance);
    Some(match which {
        1 => {
            let step = ones.max_by(|a, b| a.value.total_cmp(&b.value))?;
            let text = Layer::text((step.value, step.max_position), Align::Left, name);
            text.moved(12.0, -4.0).colored(color).plated()
        }
        _ => {
            let step = ones.max_by(|a, b| a.hardest_impact().total_cmp(&b.hardest_impact()))?;
            let text = Layer::text((step.value, step.hardest_impact()), Align::Right, name);
            text.moved(-7.0, -6.0).colored(color)
        }
    })
}

fn legend() -> [Layer; 5] {
    let key = |stroke, name: &str| Layer::key(Sign::Line(stroke), name);
    let free = "g₀  amplitude of the free mass: impacts begin where it is ρ";
    [
        key(RESPONSE, free),
        key(
            RESPONSE,
            "(lower panel: X′₋ of z = 1 there, above resonance)",
        ),
        key(FOLD, "s_SN  fold: z = 1 ends"),
        key(FLIP, "s_PD  flip: the period of z = 1 doubles"),
        key(
            Stroke::solid(style::ASIDE, 2.6),
            "z = 1, stable (in the colour of its ρ)",
        ),
    ]
}

/// Ranges of eta in which the largest position of a sweep lies behind the strip, if there is one.
fn ranges(chain: &Chain) -> Vec<(f64, f64)> {
    let scene = &chain.machine.scene;
    let strip = scene.piercing.map_or(f64::INFINITY, |it| it.thickness);
    let through = scene.clearance + strip;
    let rising = chain.rising_steps();
    let runs = rising.chunk_by(|a, b| (a.max_position > through) == (b.max_position > through));
    let pierced = runs.filter(|run| run[0].max_position > through && run.len() > 1);
    let ends = pierced.map(|run| (run[0].value, run[run.len() - 1].value));
    ends.collect()
}

/// Where the strip is pierced: a couple of arrows in its colour for each clearance, up and down.
fn pierced_ranges(chains: &[Chain]) -> Vec<Layer> {
    let mut layers = Vec::new();
    for (index, (ways, color)) in rows(chains).enumerate() {
        for (chain, shift, is_up) in [(&ways[0], 0.2, true), (&ways[1], -0.2, false)] {
            let row = shift - index as f64;
            layers.extend(ranges(chain).into_iter().map(|(low, high)| {
                let (tail, head) = if is_up { (low, high) } else { (high, low) };
                Layer::arrow((tail, row), (head, row), Stroke::solid(color, 1.8))
            }));
        }
    }
    let text = "the strip is pierced: Xₘ > ρ + σ";
    let last = 1.0 - chains.len() as f64 / 2.0;
    layers.push(Layer::text((RANGE.1, last), Align::Right, text).moved(-8.0, 4.0));
    layers
}
