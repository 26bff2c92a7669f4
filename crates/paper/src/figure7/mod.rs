//! Figure 7, (a) and (b): the z = 1 motion at the points A and B, and both over each other.

mod both;
mod chart;
mod cycle;

use anyhow::Result;
use softstop::{PhaseKind, Ratios};
use softstop_dynamics::Exponents;
use softstop_dynamics::orbit::find;

use crate::figure::{self, Drawn, Figure, Findings, Studio};
use cycle::{Cycle, Point};

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
        let cycles = [
            cycle(studio, &Ratios::unloaded())?,
            cycle(studio, &Ratios::loaded())?,
        ];
        let [a, b] = cycles.each_ref().map(|cycle| &cycle.orbit);
        let mut findings = Findings::default();
        findings.add("X_m of B less that of A", b.max_position - a.max_position);
        let velocity = b.before_impact_velocity() / a.before_impact_velocity();
        findings.add("X'_- of B over that of A", velocity);
        Ok(Drawn {
            files: vec![both::svg(&cycles).into_bytes()],
            findings,
        })
    },
};

fn cycle(studio: &Studio, machine: &Ratios) -> Result<Cycle> {
    let orbit = find(&machine.scene()?)?;
    Ok(Cycle::of(orbit, studio.detail.pick(2000, 400))?)
}

fn draw(studio: &Studio, machine: &Ratios, name: &str) -> Result<Drawn> {
    let cycle = cycle(studio, machine)?;
    Ok(Drawn {
        files: vec![cycle.svg(name).into_bytes(), table(&cycle.points)?],
        findings: findings(&cycle),
    })
}

fn findings(cycle: &Cycle) -> Findings {
    let orbit = &cycle.orbit;
    let period = orbit.scene.period();
    let mut findings = Findings::default();
    findings.add("X_m", orbit.max_position);
    findings.add("X'_-", orbit.before_impact_velocity());
    findings.add("period T", period);
    findings.add("contact, share of T", cycle.contact_time() / period);
    let modulus = orbit.multipliers()[0].norm();
    findings.add("largest multiplier, modulus", modulus);
    let exponent = Exponents::of(orbit).per_period[0];
    findings.add("Lyapunov exponent per period", exponent);
    findings.add("energy dissipated per period", cycle.dissipated);
    let share = cycle.dissipated_in_contact / cycle.dissipated;
    findings.add("of it in contact, share", share);
    let velocity = |point: Option<&Point>| point.map(|point| point.velocity);
    findings.add("X'_C", velocity(cycle.first(PhaseKind::Cut)));
    findings.add("X'_D", velocity(cycle.first(PhaseKind::Stop)));
    findings.add("X'_E", velocity(cycle.last(PhaseKind::Stop)));
    findings
}

fn table(points: &[Point]) -> Result<Vec<u8>> {
    let rows = points.iter().map(|at| {
        let phase = softstop_explore::simulate::name(at.phase);
        (at.time, at.position, at.velocity, at.force, phase)
    });
    figure::table("tau,position,velocity,contact_force,phase", rows)
}
