//! Figure 7, (a) and (b): the z = 1 motion at the points A and B.

mod chart;
mod stroke;

use anyhow::Result;
use softstop::{PhaseKind, Ratios};
use softstop_dynamics::orbit::{Exponents, Orbit, find};

use crate::figure::{self, Detail, Drawn, Figure};
use crate::figure7::chart::{StrokeChart, StrokePoint};
use stroke::Stroke;

/// Point A: the unloaded machine.
pub(super) const POINT_A: Figure = Figure {
    title: "Point A: the z = 1 motion of the unloaded machine",
    files: &["figure-7a.svg", "figure-7a.csv"],
    draw: |studio| {
        draw(
            &Ratios::unloaded(),
            "Fig. 7(a), point A: unloaded",
            studio.detail,
        )
    },
};

/// Point B: the loaded machine.
pub(super) const POINT_B: Figure = Figure {
    title: "Point B: the z = 1 motion of the loaded machine",
    files: &["figure-7b.svg", "figure-7b.csv"],
    draw: |studio| {
        draw(
            &Ratios::loaded(),
            "Fig. 7(b), point B: loaded",
            studio.detail,
        )
    },
};

fn draw(ratios: &Ratios, name: &str, detail: Detail) -> Result<Drawn> {
    let scene = ratios.scene()?;
    let orbit = find(&scene)?;
    let stroke = Stroke::of(&orbit, detail.pick(2000, 400))?;
    let chart = StrokeChart {
        title: format!(
            "{name}, η = {}, ρ = {}, z = 1",
            ratios.frequency, ratios.clearance
        ),
        subtitle: format!(
            "X_m = {:.5},  X′₋ = {:.6},  Floquet multipliers of modulus {:.4}",
            orbit.max_position,
            orbit.before_impact_velocity(),
            orbit.multipliers()[0].norm(),
        ),
        points: stroke.points.clone(),
        period: scene.period(),
        clearance: scene.clearance,
        strip: ratios.piercing.map(|strip| (strip.thickness, strip.travel)),
        before_impact_velocity: orbit.before_impact_velocity(),
        max_position: orbit.max_position,
    };
    Ok(Drawn {
        files: vec![chart.svg().into_bytes(), table(&stroke.points)?],
        findings: findings(&orbit, &stroke),
    })
}

fn findings(orbit: &Orbit, stroke: &Stroke) -> Vec<(String, f64)> {
    let period = orbit.scene.period();
    let mut findings = vec![
        ("X_m".to_owned(), orbit.max_position),
        ("X'_-".to_owned(), orbit.before_impact_velocity()),
        ("period T".to_owned(), period),
        (
            "contact, share of T".to_owned(),
            stroke.contact_time() / period,
        ),
        (
            "largest multiplier, modulus".to_owned(),
            orbit.multipliers()[0].norm(),
        ),
        (
            "Lyapunov exponent per period".to_owned(),
            Exponents::of(orbit).per_period[0],
        ),
        ("energy dissipated per period".to_owned(), stroke.dissipated),
        (
            "of it in contact, share".to_owned(),
            stroke.dissipated_in_contact / stroke.dissipated,
        ),
    ];
    let passages = [("C", PhaseKind::Cut), ("D", PhaseKind::Stop)];
    for (letter, kind) in passages {
        if let Some(velocity) = stroke.velocity_into(kind) {
            findings.push((format!("X'_{letter}"), velocity));
        }
    }
    if let Some(velocity) = stroke.velocity_out_of(PhaseKind::Stop) {
        findings.push(("X'_E".to_owned(), velocity));
    }
    findings
}

fn table(points: &[StrokePoint]) -> Result<Vec<u8>> {
    let columns = "tau,position,velocity,contact_force,phase";
    let rows = points.iter().map(|point| {
        let phase = softstop_explore::simulate::name(point.phase);
        (
            point.time,
            point.position,
            point.velocity,
            point.force,
            phase,
        )
    });
    figure::table(columns, rows)
}
