//! Establishing certainty of z = 1 along the hysteresis zone. The paper (section 3): it "increases from zero, on
//! stability boundary s_SN, to one on grazing boundary g0". It is a share of initial states, so it depends on
//! which states are asked: that dependence is shown beside it.

mod curve;

use anyhow::Result;
use rayon::prelude::*;
use softstop::Ratios;

use crate::figure::{self, Drawn, Figure, Studio};
use curve::{Curve, Starts, integrity, motions};
use softstop_console::progress::Progress;
use softstop_draw::{Axis, Chart, Corner, Layer, Legend, Mark, Panel, Stroke, style};
use softstop_explore::basin::certainty::{SHARES, layers};

/// Clearances.
const CLEARANCES: [f64; 5] = [2.0, 6.0, 10.0, 14.0, 18.0];
/// The clearance of points A and B among them.
const MIDDLE: usize = 2;
/// The usual region of starts, and others with their colours.
const REGION: Starts = Starts::Square(2.0);
const OTHERS: [(Starts, &str); 3] = [
    (Starts::AtRest, style::REFERENCE),
    (Starts::Square(1.0), "#8C8C8C"),
    (Starts::Square(4.0), style::POINT),
];
/// Cells on each side of the region, and places of the zone between its ends; at the ends themselves one of the motions
/// is not stable.
const CELLS: [usize; 2] = [52, 24];
const STEPS: [usize; 2] = [20, 8];
const ENDS: [f64; 3] = [0.001, 0.01, 0.025];

/// Places from near g0 to near s_SN, closer at the ends.
fn places(steps: usize) -> Vec<f64> {
    let inner = (1..steps).map(|k| k as f64 / steps as f64);
    let near = ENDS.iter().copied();
    let far = ENDS.iter().rev().map(|end| 1.0 - end);
    near.chain(inner).chain(far).collect()
}

pub(super) fn draw(studio: &Studio, _: &Figure) -> Result<Drawn> {
    let places = places(studio.detail.pick(STEPS[0], STEPS[1]));
    let cells = studio.detail.pick(CELLS[0], CELLS[1]);
    let usual = [Ratios::unloaded(), Ratios::loaded()];
    let usual = usual.into_iter().flat_map(|machine| {
        let curves = CLEARANCES.into_iter();
        curves.map(move |clearance| (machine.at_clearance(clearance), REGION))
    });
    let others = OTHERS.map(|(starts, _)| (Ratios::unloaded(), starts));
    let of = usual.chain(others);
    let of: Vec<(Ratios, Starts)> = of.collect();
    let work = of.len() * places.len() * cells * cells;
    let progress = Progress::new(work as u64, "cells");
    let curves = of.par_iter().map(|(machine, starts)| {
        Curve::new(machine, *starts, (&places, cells), &progress, studio.kept)
    });
    let curves = curves.collect::<Result<Vec<Curve>>>()?;
    drop(progress);
    Ok(Drawn {
        files: vec![chart(&curves).svg().into_bytes(), table(&curves)?],
        findings: curve::findings(&curves),
    })
}

fn chart(curves: &[Curve]) -> Chart {
    let (unloaded, rest) = curves.split_at(CLEARANCES.len());
    let (loaded, others) = rest.split_at(CLEARANCES.len());
    let color = |index| style::ordered(index, CLEARANCES.len());
    let by_clearance = |curves: &[Curve], show: fn(&Curve, Stroke) -> Vec<Layer>| -> Vec<Layer> {
        let lines = curves.iter().enumerate();
        let lines = lines.flat_map(|(index, curve)| {
            let mut layers = show(curve, Stroke::solid(color(index), 2.2));
            let line = layers.pop();
            let name = format!("ρ = {}", curve.clearance());
            layers.into_iter().chain(line.map(|line| line.named(name)))
        });
        lines.collect()
    };
    let mut regions: Vec<(&Curve, &str)> = others.iter().zip(OTHERS.map(|it| it.1)).collect();
    regions.insert(2, (&unloaded[MIDDLE], color(MIDDLE)));
    let regions = regions.into_iter().flat_map(|(curve, color)| {
        let mut layers = certainty(curve, Stroke::solid(color, 2.2));
        let line = layers.pop();
        layers
            .into_iter()
            .chain(line.map(|line| line.named(curve.starts.label())))
    });
    let dashed = Stroke::dashed(color(MIDDLE), 2.2, (8.0, 5.0));
    let mut integrities = by_clearance(unloaded, largest_ball);
    integrities.extend(largest_ball(&loaded[MIDDLE], dashed));
    let of_one = "certainty of z = 1";
    let panels = [
        (
            "(a) unloaded, starts |X|, |X′| < 2ρ",
            of_one,
            by_clearance(unloaded, certainty),
        ),
        (
            "(b) loaded, starts |X|, |X′| < 2ρ",
            of_one,
            by_clearance(loaded, certainty),
        ),
        (
            "(c) unloaded, ρ = 10, other starts",
            of_one,
            regions.collect(),
        ),
        (
            "(d) largest ball in the basins of (a); dashed: ρ = 10 of (b)",
            "radius of the largest ball in z = 1",
            integrities,
        ),
    ];
    let claim = "the paper: one at g₀, zero at s_SN";
    let panels = panels.into_iter().map(|(title, name, mut layers)| {
        if name == of_one {
            let ends = [(0.0, 1.0), (1.0, 0.0)];
            layers.push(Layer::marks(ends, Mark::Circle, style::ASIDE).named(claim));
        }
        Panel {
            title: title.to_owned(),
            size: (540.0, 350.0),
            x: Axis::new("place in the hysteresis zone: 0 at g₀, 1 at s_SN").range((-0.02, 1.02)),
            y: Axis::new(name).range(SHARES),
            legend: title
                .starts_with("(c)")
                .then_some(Legend::Inside(Corner::TopRight)),
            layers,
            ..Panel::default()
        }
    });
    let title = "How certainly z = 1 establishes itself in its hysteresis zone";
    Chart {
        subtitle: "bands: 95 % intervals".to_owned(),
        ..Chart::new(title, panels).in_columns(2)
    }
}

fn certainty(curve: &Curve, stroke: Stroke) -> Vec<Layer> {
    layers(&curve.places, |at| at.place, stroke).into()
}

fn largest_ball(curve: &Curve, stroke: Stroke) -> Vec<Layer> {
    let line = curve.places.iter().map(|at| (at.place, integrity(at)));
    vec![Layer::line(line, stroke)]
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
