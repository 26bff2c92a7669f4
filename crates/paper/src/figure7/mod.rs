//! Figure 7, (a) and (b): the z = 1 motion at the points A and B, and both over each other.

mod chart;

use anyhow::Result;
use softstop::{PhaseKind, Scene};
use softstop_console::columns;
use softstop_console::export::csv;
use softstop_console::machine::PaperMachine;
use softstop_draw::{Chart, Layer, Stroke, style};
use softstop_dynamics::orbit::find;
use softstop_dynamics::{LyapunovExponents, Orbit};

use crate::figure::{Drawn, Figure, Findings, Studio, findings};
use crate::path::{Path, PathPoint};
use chart::{FACE, STATE};

/// One period of a z = 1 motion.
struct Cycle {
    orbit: Orbit,
    path: Path,
}

impl Cycle {
    fn of(studio: &Studio, machine: PaperMachine) -> Result<Self> {
        let orbit = find(&machine.ratios().scene()?)?;
        let fineness = (studio.detail.pick(2000, 400), 24);
        let path = Path::new(&orbit.scene, orbit.state().into(), orbit.periods, fineness)?;
        Ok(Self { orbit, path })
    }
}

/// The positions at which laws change, their names, and the phases beyond.
fn faces(scene: &Scene) -> Vec<(f64, &'static str, PhaseKind)> {
    let face = scene.clearance;
    let Some(strip) = scene.piercing else {
        return vec![(face, "ρ = X_III", PhaseKind::Stop)];
    };
    let cut = face + strip.thickness;
    let stop = (cut + strip.travel, "X_III", PhaseKind::Stop);
    let pierce = (face, "ρ", PhaseKind::Pierce);
    vec![pierce, (cut, "ρ + σ", PhaseKind::Cut), stop]
}

pub(super) fn draw(studio: &Studio, figure: &Figure) -> Result<Drawn> {
    let cycle = Cycle::of(studio, figure.get("machine")?)?;
    let columns = columns! { PathPoint, it;
        "tau" [None], "time" => it.time;
        "position" [None], "X" => it.position;
        "velocity" [None], "X'" => it.velocity;
        "contact_force" [None], "F/F0" => it.force;
        "phase" [None], "whose law holds" => softstop_explore::simulate::name(it.phase);
    };
    let table = csv(&columns, &cycle.path.points)?;
    let Cycle { orbit, path } = &cycle;
    let period = orbit.scene.period();
    let contact = path.phases().filter(|it| it[0].phase != PhaseKind::Free);
    let contact = contact.map(|it| it[it.len() - 1].time - it[0].time);
    let velocity = |point: Option<&PathPoint>| point.map(|point| point.velocity);
    let mut findings = Findings::default();
    findings! { findings, str::to_owned;
        "X_m" => orbit.max_position;
        "X'_-" => orbit.before_impact_velocity();
        "period T" => period;
        "contact, share of T" => contact.sum::<f64>() / period;
        "largest multiplier, modulus" => orbit.monodromy.multipliers()[0].norm();
        "Lyapunov exponent per period" => LyapunovExponents::of(orbit).per_period[0];
        "energy dissipated per period" => path.dissipated;
        "of it in contact, share" => path.dissipated_in_contact / path.dissipated;
        "X'_C" => velocity(path.first(PhaseKind::Cut));
        "X'_D" => velocity(path.first(PhaseKind::Stop));
        "X'_E" => velocity(path.last(PhaseKind::Stop));
    }
    let files = [cycle.chart(figure)?.svg().into_bytes(), table];
    Ok(Drawn::new(files, findings))
}

/// Point A over point B.
pub(super) fn both(studio: &Studio, figure: &Figure) -> Result<Drawn> {
    let a = Cycle::of(studio, PaperMachine::Unloaded)?;
    let b = Cycle::of(studio, PaperMachine::Loaded)?;
    let mut findings = Findings::default();
    let farther = b.orbit.max_position - a.orbit.max_position;
    findings.add("X_m of B less that of A", farther);
    let faster = b.orbit.before_impact_velocity() / a.orbit.before_impact_velocity();
    findings.add("X'_- of B over that of A", faster);
    let svg = picture_of_both(figure, &[a, b])?.svg();
    Ok(Drawn::new([svg.into_bytes()], findings))
}

/// The curves of points A and B.
const CURVES: [(&str, Stroke); 2] = [
    ("A, unloaded", Stroke::solid(style::DESIGN, 2.0)),
    ("B, loaded", Stroke::dashed(style::OPTIMUM, 2.0, (7.0, 3.0))),
];
/// How far before the clearance the near part begins, in units of the larger depth.
const BEFORE: f64 = 0.6;

/// Points A and B over each other, "small difference between working and unloaded regime" (Peterka 2003, section 3): time
/// series, phase plane, and the part of it near the stop; both have the same clearance and period.
fn picture_of_both(figure: &Figure, cycles: &[Cycle; 2]) -> Result<Chart> {
    let scene = &cycles[1].orbit.scene;
    let (rho, period) = (scene.clearance, scene.period());
    let highest = cycles.iter().map(|it| it.orbit.max_position);
    let highest = highest.fold(f64::NEG_INFINITY, f64::max);
    let depth = highest - rho;
    let layers = |show: &dyn Fn(&PathPoint) -> (f64, f64), face: fn(f64, &str) -> Layer| {
        let curves = cycles.iter().zip(CURVES);
        let curves = curves.map(|(cycle, (name, stroke))| {
            Layer::line(cycle.path.points.iter().map(show), stroke).named(name)
        });
        let faces = faces(scene).into_iter();
        let faces = faces.map(|(at, name, _)| face(at, name));
        faces.chain(curves).collect()
    };
    let series = |at: &PathPoint| (at.time / period, at.position);
    let mut chart = figure.picture([
        layers(&series, |at, _| Layer::horizontal(at, FACE, "")),
        layers(&STATE, |at, _| Layer::vertical(at, FACE, "")),
        layers(&STATE, |at, name| Layer::vertical(at, FACE, name)),
    ])?;
    chart.panels[2].x.ends = [rho - BEFORE * depth, highest + 0.2 * depth].map(Some);
    Ok(chart)
}
