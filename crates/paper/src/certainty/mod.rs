//! Establishing certainty of z = 1 along the hysteresis zone. The paper (section 3): it "increases from zero, on
//! stability boundary s_SN, to one on grazing boundary g0". It is a share of initial states, so it depends on
//! which states are asked: that dependence is shown beside it.

mod curve;

use anyhow::Result;
use softstop::Ratios;
use softstop_dynamics::basin::Establishing;

use crate::figure::{self, Drawn, Figure, Studio};
use curve::{Curve, Starts, integrity, motions};
use softstop_console::progress::Progress;
use softstop_draw::shade::ordered;
use softstop_draw::style;
use softstop_explore::basin::certainty::{
    CertaintyCurve, CertaintyPage, CertaintyPanel, CertaintyPoint,
};

/// Establishing certainty along the hysteresis zone.
pub(crate) const FIGURE: Figure = Figure {
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
/// Their colours but that of the usual one, which is that of its clearance.
const REGION_COLORS: [&str; 3] = [style::REFERENCE, "#8C8C8C", style::POINT];
/// Cells on each side of the region.
const CELLS: [usize; 2] = [52, 24];
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

fn draw(studio: &Studio) -> Result<Drawn> {
    let detail = studio.detail;
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
    curve::fill(&mut curves, (&places, cells), &progress, studio.kept)?;
    drop(progress);
    let svg = CertaintyPage {
        panels: panels(&curves),
    }
    .svg();
    Ok(Drawn {
        files: vec![svg.into_bytes(), table(&curves)?],
        findings: curve::findings(&curves),
    })
}

/// What is shown of a place, and what that is called.
type Show = (fn(&Establishing) -> (f64, Option<[f64; 2]>), &'static str);
const CERTAINTY: Show = (
    |place| (place.certainty, Some(place.interval)),
    "certainty of z = 1",
);
const INTEGRITY: Show = (
    |place| (integrity(place), None),
    "radius of the largest ball in z = 1",
);

fn line(curve: &Curve, label: String, color: &'static str, (show, _): Show) -> CertaintyCurve {
    let point = |at: &Establishing| {
        let (value, interval) = show(at);
        CertaintyPoint {
            place: at.place,
            value,
            interval,
        }
    };
    CertaintyCurve {
        label,
        color,
        is_dashed: false,
        points: curve.places.iter().map(point).collect(),
    }
}

/// The colour of a clearance.
fn color_of(index: usize) -> &'static str {
    ordered(index, CLEARANCES.len())
}

fn panels(curves: &[Curve]) -> Vec<CertaintyPanel> {
    let (unloaded, rest) = curves.split_at(CLEARANCES.len());
    let (loaded, others) = rest.split_at(CLEARANCES.len());
    let clearances = |curves: &[Curve], show: Show| -> Vec<CertaintyCurve> {
        let lines = curves.iter().enumerate();
        let lines = lines.map(|(index, curve)| {
            let name = format!("ρ = {}", curve.clearance());
            line(curve, name, color_of(index), show)
        });
        lines.collect()
    };
    let mut regions: Vec<&Curve> = others.iter().collect();
    let mut colors = REGION_COLORS.to_vec();
    regions.insert(2, &unloaded[MIDDLE]);
    colors.insert(2, color_of(MIDDLE));
    let regions = regions.into_iter().zip(colors);
    let regions = regions.map(|(curve, color)| line(curve, curve.starts.label(), color, CERTAINTY));
    let regions: Vec<CertaintyCurve> = regions.collect();
    let mut integrities = clearances(unloaded, INTEGRITY);
    let extra = line(&loaded[MIDDLE], String::new(), color_of(MIDDLE), INTEGRITY);
    integrities.push(CertaintyCurve {
        is_dashed: true,
        ..extra
    });
    let [free, pierced] = [unloaded, loaded].map(|curves| clearances(curves, CERTAINTY));
    let dashed = "(d) largest ball in the basins of (a); dashed: ρ = 10 of (b)";
    let panels = [
        ("(a) unloaded, starts |X|, |X′| < 2ρ", free, CERTAINTY),
        ("(b) loaded, starts |X|, |X′| < 2ρ", pierced, CERTAINTY),
        ("(c) unloaded, ρ = 10, other starts", regions, CERTAINTY),
        (dashed, integrities, INTEGRITY),
    ];
    let panel = |(index, (title, curves, (_, up))): (usize, (&str, _, Show))| CertaintyPanel {
        title: title.to_owned(),
        up,
        curves,
        has_claim: index < 3,
        has_legend: index == 2,
    };
    panels.into_iter().enumerate().map(panel).collect()
}

/// A row for each place of each curve.
fn table(curves: &[Curve]) -> Result<Vec<u8>> {
    let places = curves
        .iter()
        .flat_map(|curve| curve.places.iter().map(move |at| (curve, at)));
    let rows = places.map(|(curve, at)| {
        let (rho, starts) = (curve.clearance(), curve.starts.label());
        let shares = (at.certainty, at.interval, integrity(at));
        let place = (at.place, at.frequency);
        (curve.machine(), rho, starts, place, shares, motions(at))
    });
    let columns =
        "machine,rho,starts,place,eta,certainty,certainty_low,certainty_high,integrity,motions";
    figure::table(columns, rows)
}
