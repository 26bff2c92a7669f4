//! Figure 7, (a) and (b): the z = 1 motion at the points A and B, and both over each other.

mod both;
mod chart;

use anyhow::Result;
use softstop::{PhaseKind, Ratios, Scene};
use softstop_dynamics::orbit::find;
use softstop_dynamics::{Exponents, Orbit};

use crate::figure::{self, Drawn, Figure, Findings, Studio};
use crate::path::{Path, Point};

/// Point A: the unloaded machine.
pub(super) const POINT_A: Figure = Figure {
    title: "Point A: the z = 1 motion of the unloaded machine",
    files: &["figure-7a.svg", "figure-7a.csv"],
    draw: |studio| draw(studio, &Ratios::unloaded(), "(a), point A: unloaded"),
};

/// Point B: the loaded machine.
pub(super) const POINT_B: Figure = Figure {
    title: "Point B: the z = 1 motion of the loaded machine",
    files: &["figure-7b.svg", "figure-7b.csv"],
    draw: |studio| draw(studio, &Ratios::loaded(), "(b), point B: loaded"),
};

/// Both.
pub(super) const BOTH: Figure = Figure {
    title: "Point A over point B",
    files: &["figure-7.svg"],
    draw: |studio| {
        let a = Cycle::of(studio, &Ratios::unloaded())?;
        let b = Cycle::of(studio, &Ratios::loaded())?;
        let mut findings = Findings::default();
        let positions = [&a, &b].map(|cycle| cycle.orbit.max_position);
        findings.add("X_m of B less that of A", positions[1] - positions[0]);
        let velocity = b.orbit.before_impact_velocity() / a.orbit.before_impact_velocity();
        findings.add("X'_- of B over that of A", velocity);
        Ok(Drawn {
            files: vec![both::chart(&[a, b]).svg().into_bytes()],
            findings,
        })
    },
};

/// One period of a z = 1 motion.
struct Cycle {
    orbit: Orbit,
    path: Path,
}

impl Cycle {
    fn of(studio: &Studio, machine: &Ratios) -> Result<Self> {
        let orbit = find(&machine.scene()?)?;
        let fineness = (studio.detail.pick(2000, 400), 24);
        let path = Path::new(&orbit.scene, orbit.state().into(), orbit.periods, fineness)?;
        Ok(Self { orbit, path })
    }
}

/// The positions at which laws change and their names.
fn faces(scene: &Scene) -> Vec<(f64, &'static str)> {
    let face = scene.clearance;
    let Some(strip) = scene.piercing else {
        return vec![(face, "ρ = X_III")];
    };
    let cut = face + strip.thickness;
    vec![(face, "ρ"), (cut, "ρ + σ"), (cut + strip.travel, "X_III")]
}

fn draw(studio: &Studio, machine: &Ratios, name: &str) -> Result<Drawn> {
    let cycle = Cycle::of(studio, machine)?;
    let rows = cycle.path.points.iter().map(|at| {
        let phase = softstop_explore::simulate::name(at.phase);
        (at.time, at.position, at.velocity, at.force, phase)
    });
    let table = figure::table("tau,position,velocity,contact_force,phase", rows)?;
    Ok(Drawn {
        files: vec![cycle.chart(name).svg().into_bytes(), table],
        findings: findings(&cycle),
    })
}

fn findings(Cycle { orbit, path }: &Cycle) -> Findings {
    let period = orbit.scene.period();
    let velocity = |point: Option<&Point>| point.map(|point| point.velocity);
    let mut findings = Findings::default();
    for (name, value) in [
        ("X_m", Some(orbit.max_position)),
        ("X'_-", Some(orbit.before_impact_velocity())),
        ("period T", Some(period)),
        ("contact, share of T", Some(path.contact_time() / period)),
        (
            "largest multiplier, modulus",
            Some(orbit.multipliers()[0].norm()),
        ),
        (
            "Lyapunov exponent per period",
            Some(Exponents::of(orbit).per_period[0]),
        ),
        ("energy dissipated per period", Some(path.dissipated)),
        (
            "of it in contact, share",
            Some(path.dissipated_in_contact / path.dissipated),
        ),
        ("X'_C", velocity(path.first(PhaseKind::Cut))),
        ("X'_D", velocity(path.first(PhaseKind::Stop))),
        ("X'_E", velocity(path.last(PhaseKind::Stop))),
    ] {
        findings.add(name, value);
    }
    findings
}
