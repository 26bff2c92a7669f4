//! Establishing certainty of z = 1 along the hysteresis zone. The paper (section 3): it "increases from zero, on
//! stability boundary s_SN, to one on grazing boundary g0". It is a share of initial states, so it depends on
//! which states are asked: that dependence is shown beside it.

mod curve;
mod findings;

use anyhow::Context;
use softstop::Ratios;

use super::{Detail, Drawn, Figure};
use crate::chart::{CertaintyCurve, CertaintyPage, CertaintyPanel, CertaintyPoint};
use crate::failure::Failure;
use crate::progress::Progress;
use curve::{Curve, Place, Starts};

/// Establishing certainty along the hysteresis zone.
pub(super) const FIGURE: Figure = Figure {
    title: "Establishing certainty of z = 1 from g0 to s_SN, and its integrity",
    files: &["certainty.svg", "certainty.csv"],
    draw,
};

/// Clearances.
const CLEARANCES: [f64; 5] = [2.0, 6.0, 10.0, 14.0, 18.0];
/// The clearance of points A and B among them.
const MIDDLE: usize = 2;
/// Half of the region of starts, in units of the clearance, where nothing else is said.
const REGION: f64 = 2.0;
/// Smaller and larger regions.
const REGIONS: [Starts; 4] = [
    Starts::AtRest,
    Starts::Square(1.0),
    Starts::Square(REGION),
    Starts::Square(4.0),
];
/// Cells on each side of the region.
const CELLS: [usize; 2] = [64, 24];
/// Places of the zone between its ends; at the ends themselves one of the motions is not stable.
const STEPS: [usize; 2] = [20, 8];
const ENDS: [f64; 3] = [0.001, 0.01, 0.025];

/// Places from near g0 to near s_SN, closer at the ends.
fn places(steps: usize) -> Vec<f64> {
    let inner = (1..steps).map(|k| k as f64 / steps as f64);
    let near = ENDS.iter().copied();
    let far = ENDS.iter().rev().map(|end| 1.0 - end);
    near.chain(inner).chain(far).collect()
}

fn draw(detail: Detail) -> Result<Drawn, Failure> {
    let places = places(detail.pick(STEPS[0], STEPS[1]));
    let cells = detail.pick(CELLS[0], CELLS[1]);
    let square = Starts::Square(REGION);
    let mut curves: Vec<Curve> = Vec::new();
    for machine in [Ratios::unloaded(), Ratios::loaded()] {
        for clearance in CLEARANCES {
            curves.push(Curve::new(machine, clearance, square)?);
        }
    }
    for starts in REGIONS.into_iter().filter(|starts| *starts != square) {
        curves.push(Curve::new(Ratios::unloaded(), CLEARANCES[MIDDLE], starts)?);
    }
    let work = curves.len() * places.len() * cells * cells;
    let progress = Progress::new(work as u64, "cells");
    curve::fill(&mut curves, &places, cells, &progress)?;
    drop(progress);
    let svg = CertaintyPage {
        panels: panels(&curves),
    }
    .svg();
    Ok(Drawn {
        files: vec![svg.into_bytes(), table(&curves)?],
        findings: findings::of(&curves),
    })
}

/// What is shown of a place.
type Show = fn(&Place) -> CertaintyPoint;

fn certainty(place: &Place) -> CertaintyPoint {
    CertaintyPoint {
        place: place.place,
        value: place.certainty,
        interval: Some(place.interval),
    }
}

fn integrity(place: &Place) -> CertaintyPoint {
    CertaintyPoint {
        place: place.place,
        value: place.integrity,
        interval: None,
    }
}

fn line(curve: &Curve, label: String, color: usize, show: Show) -> CertaintyCurve {
    CertaintyCurve {
        label,
        color,
        is_dashed: false,
        points: curve.places.iter().map(show).collect(),
    }
}

fn panels(curves: &[Curve]) -> Vec<CertaintyPanel> {
    let (unloaded, rest) = curves.split_at(CLEARANCES.len());
    let (loaded, others) = rest.split_at(CLEARANCES.len());
    let clearances = |curves: &[Curve], show: Show| -> Vec<CertaintyCurve> {
        let line = |(color, curve): (usize, &Curve)| {
            line(curve, format!("ρ = {}", curve.clearance()), color, show)
        };
        curves.iter().enumerate().map(line).collect()
    };
    let mut regions: Vec<&Curve> = others.iter().collect();
    regions.insert(2, &unloaded[MIDDLE]);
    let regions = regions.into_iter().enumerate();
    let regions = regions.map(|(color, curve)| line(curve, curve.starts.label(), color, certainty));
    let regions = regions.collect();
    let mut integrities = clearances(unloaded, integrity);
    let mut extra = line(
        &loaded[MIDDLE],
        "ρ = 10, loaded".to_owned(),
        MIDDLE,
        integrity,
    );
    extra.is_dashed = true;
    integrities.push(extra);
    let panel = |title: &str, up, curves, has_claim| CertaintyPanel {
        title: title.to_owned(),
        up,
        curves,
        has_claim,
    };
    let (share, ball) = ("certainty of z = 1", "radius of the largest ball in z = 1");
    vec![
        panel(
            "(a) unloaded, |X|, |X′| < 2ρ",
            share,
            clearances(unloaded, certainty),
            true,
        ),
        panel(
            "(b) loaded, |X|, |X′| < 2ρ",
            share,
            clearances(loaded, certainty),
            true,
        ),
        panel("(c) unloaded, ρ = 10: other starts", share, regions, true),
        panel("(d) integrity, |X|, |X′| < 2ρ", ball, integrities, false),
    ]
}

/// A row for each place of each curve.
fn table(curves: &[Curve]) -> Result<Vec<u8>, Failure> {
    let mut table = csv::Writer::from_writer(Vec::new());
    let header = [
        "machine",
        "rho",
        "starts",
        "place",
        "eta",
        "certainty",
        "certainty_low",
        "certainty_high",
        "integrity",
        "motions",
    ];
    let failed = "cannot write certainty.csv";
    table.write_record(header).context(failed)?;
    for curve in curves {
        for place in &curve.places {
            let row = (
                curve.machine(),
                curve.clearance(),
                curve.starts.label(),
                place.place,
                place.frequency,
                place.certainty,
                place.interval[0],
                place.interval[1],
                place.integrity,
                &place.motions,
            );
            table.serialize(row).context(failed)?;
        }
    }
    let content = table.into_inner().map_err(csv::IntoInnerError::into_error);
    Ok(content.context(failed)?)
}
