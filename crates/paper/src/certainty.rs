//! Establishing certainty of z = 1 along the hysteresis zone. The paper (section 3): it "increases from zero, on
//! stability boundary s_SN, to one on grazing boundary g0". It is a share of initial states, so it depends on
//! which states are asked: that dependence is shown beside it.

use std::f64::consts::TAU;

use anyhow::{Context, Result};
use rayon::prelude::*;

use crate::figure::{Drawn, Figure, Findings, Studio};
use softstop_console::column::Column;
use softstop_console::columns;
use softstop_console::export::csv;
use softstop_console::machine::PaperMachine;
use softstop_console::progress::Progress;
use softstop_draw::{Chart, Layer, Mark, Stroke, style};
use softstop_dynamics::basin::{BasinOptions, CertaintyAtPlace, establishing_certainties};
use softstop_dynamics::{self as dynamics, Grid, zone};
use softstop_explore::basin::certainty::layers;

/// Clearances.
const CLEARANCES: [f64; 5] = [2.0, 6.0, 10.0, 14.0, 18.0];
/// The clearance of points A and B among them.
const MIDDLE: usize = 2;
/// The usual region of starts, and others.
const REGION: Starts = Starts::Square(2.0);
const OTHERS: [Starts; 3] = [Starts::AtRest, Starts::Square(1.0), Starts::Square(4.0)];
/// Cells on each side of the region, and places of the zone between its ends; at the ends themselves one of the motions
/// is not stable.
const CELLS: [usize; 2] = [52, 24];
const STEPS: [usize; 2] = [20, 8];
const ENDS: [f64; 3] = [0.001, 0.01, 0.025];

/// Which states are asked.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Starts {
    /// Anywhere within the clearance on both sides, without velocity, at any drive angle.
    AtRest,
    /// At drive angle 0: positions and velocities up to so many clearances.
    Square(f64),
}

impl Starts {
    /// In the paper's symbols.
    fn label(self) -> String {
        match self {
            Self::AtRest => "|X| < ρ, X′ = 0, any φ".to_owned(),
            Self::Square(1.0) => "|X|, |X′| < ρ".to_owned(),
            Self::Square(half) => format!("|X|, |X′| < {half}ρ"),
        }
    }

    fn grid(self, clearance: f64, cells: usize) -> Grid {
        let position = |far: f64| dynamics::Axis::position(-far, far, cells);
        let (across, up) = match self {
            Self::AtRest => (dynamics::Axis::angle(0.0, TAU, cells), position(clearance)),
            Self::Square(half) => {
                let far = half * clearance;
                (position(far), dynamics::Axis::velocity(-far, far, cells))
            }
        };
        Grid::of_states(across, up, 0.0)
    }
}

/// The certainty along the zone of a machine.
struct Curve {
    machine: PaperMachine,
    clearance: f64,
    starts: Starts,
    places: Vec<CertaintyAtPlace>,
}

/// Places from near g0 to near s_SN, closer at the ends.
fn places(steps: usize) -> Vec<f64> {
    let inner = (1..steps).map(|k| k as f64 / steps as f64);
    let near = ENDS.iter().copied();
    let far = ENDS.iter().rev().map(|end| 1.0 - end);
    near.chain(inner).chain(far).collect()
}

pub(super) fn draw(studio: &Studio, figure: &Figure) -> Result<Drawn> {
    let places = places(studio.detail.pick(STEPS[0], STEPS[1]));
    let cells = studio.detail.pick(CELLS[0], CELLS[1]);
    let usual = |machine| CLEARANCES.map(|clearance| (machine, clearance, REGION));
    let others = OTHERS.map(|starts| (PaperMachine::Unloaded, CLEARANCES[MIDDLE], starts));
    let all = [
        &usual(PaperMachine::Unloaded)[..],
        &usual(PaperMachine::Loaded),
        &others,
    ]
    .concat();
    let progress = Progress::new((all.len() * places.len() * cells * cells) as u64, "cells");
    let curves = all.par_iter().map(|&(machine, clearance, starts)| {
        let scene = machine.ratios().at_clearance(clearance).scene()?;
        let zone = zone::hysteresis(&scene);
        let zone = zone.with_context(|| format!("no hysteresis zone at rho = {clearance}"))?;
        let (grid, watcher) = (starts.grid(clearance, cells), progress.watcher());
        let options = BasinOptions::default();
        Ok(Curve {
            machine,
            clearance,
            starts,
            places: establishing_certainties(
                &zone,
                &places,
                &grid,
                &options,
                &watcher,
                studio.kept,
            )?,
        })
    });
    let curves = curves.collect::<Result<Vec<Curve>>>()?;
    drop(progress);
    let rows = curves.iter();
    let rows = rows.flat_map(|curve| curve.places.iter().map(move |at| (curve, at)));
    Ok(Drawn {
        files: vec![
            chart(figure, &curves)?.svg().into_bytes(),
            csv(&columns(), rows)?,
        ],
        findings: findings(&curves),
    })
}

/// A row for each place of each curve.
fn columns<'a>() -> [Column<(&'a Curve, &'a CertaintyAtPlace)>; 10] {
    columns! { (&'a Curve, &'a CertaintyAtPlace), it;
        "machine" [None], "unloaded or loaded" => it.0.machine.name();
        "rho" [None], "its clearance" => it.0.clearance;
        "starts" [None], "which states are asked" => it.0.starts.label();
        "place" [None], "0 at g0, 1 at s_SN" => it.1.place;
        "eta" [None], "drive frequency" => it.1.frequency;
        "certainty" [None], "share of starts that lead to z = 1" => it.1.certainty;
        "certainty_low" [None], "lower end of its 95 % interval" => it.1.interval[0];
        "certainty_high" [None], "upper end of it" => it.1.interval[1];
        "integrity" [None], "radius of the largest ball in z = 1" => integrity(it.1);
        "motions" [None], "all motions and their shares" => motions(it.1);
    }
}

/// Integrity factor: radius of the largest ball inside the basin of z = 1, in units of half of the region; 0 if there is none.
fn integrity(at: &CertaintyAtPlace) -> f64 {
    let ball = at.basins.largest_ball_of(dynamics::Regime::ONE);
    ball.map_or(0.0, |ball| ball.radius)
}

fn motions(at: &CertaintyAtPlace) -> String {
    let classes = at.basins.classes.iter();
    let motions = classes.map(|class| format!("{}: {:.6}", class.motion, class.share));
    motions.collect::<Vec<_>>().join(", ")
}

/// Certainties at the ends and in between, and how far the claim is off.
fn findings(curves: &[Curve]) -> Findings {
    let mut findings = Findings::default();
    for Curve {
        machine,
        clearance,
        starts,
        places,
    } in curves
    {
        let near = |place: f64| {
            let gap = |at: &&CertaintyAtPlace| (at.place - place).abs();
            places.iter().min_by(|a, b| gap(a).total_cmp(&gap(b)))
        };
        let certainty = |place| near(place).map(|at| at.certainty);
        let values = [
            ("certainty near g0", certainty(0.0)),
            ("integrity near g0", near(0.0).map(integrity)),
            ("certainty near s_SN", certainty(1.0)),
            ("integrity near s_SN", near(1.0).map(integrity)),
            ("certainty at s = 0.25", certainty(0.25)),
            ("certainty at s = 0.5", certainty(0.5)),
            ("certainty at s = 0.75", certainty(0.75)),
            (
                "largest rise of the certainty away from g0",
                Some(rise(places)),
            ),
        ];
        let (name, starts) = (machine.name(), starts.label());
        let name = format!("{name}, rho = {clearance}, starts {starts}: ");
        findings.group(&name, values);
    }
    findings
}

/// How much larger the certainty is somewhere than at a place nearer to g0, beyond both 95 % intervals: 0 if it
/// falls all the way, as the paper has it.
fn rise(places: &[CertaintyAtPlace]) -> f64 {
    let later = |(index, place): (usize, &CertaintyAtPlace)| {
        let rest = places[index + 1..].iter();
        let rises = rest.filter(|other| other.interval[0] > place.interval[1]);
        let rises = rises.map(|other| other.certainty - place.certainty);
        rises.fold(0.0, f64::max)
    };
    places.iter().enumerate().map(later).fold(0.0, f64::max)
}

fn chart(figure: &Figure, curves: &[Curve]) -> Result<Chart> {
    let count = CLEARANCES.len();
    let color = |index| style::ordered(index, count);
    let by_clearance = |index: usize| {
        let name = format!("ρ = {}", curves[index].clearance);
        let stroke = Stroke::solid(color(index % count), 2.2);
        (&curves[index], stroke, name)
    };
    let by_starts = |(index, color): (usize, _)| {
        let name = curves[index].starts.label();
        (&curves[index], Stroke::solid(color, 2.2), name)
    };
    let regions = [
        (2 * count, style::REFERENCE),
        (2 * count + 1, "#8C8C8C"),
        (MIDDLE, color(MIDDLE)),
        (2 * count + 2, style::POINT),
    ];
    let certainties = |curves: Vec<Named<'_>>| {
        let claim = Layer::marks([(0.0, 1.0), (1.0, 0.0)], Mark::Circle, style::ASIDE);
        let claim = claim.named("the paper: one at g₀, zero at s_SN");
        curves.iter().flat_map(certainty).chain([claim]).collect()
    };
    let dashed = Stroke::dashed(color(MIDDLE), 2.2, (8.0, 5.0));
    let loaded = (&curves[count + MIDDLE], dashed, String::new());
    let integrities = (0..count).map(by_clearance).chain([loaded]);
    figure.picture([
        certainties((0..count).map(by_clearance).collect()),
        certainties((count..2 * count).map(by_clearance).collect()),
        certainties(regions.map(by_starts).into()),
        integrities.map(|it| largest_ball(&it)).collect(),
    ])
}

/// A curve, how it is drawn, and its name.
type Named<'a> = (&'a Curve, Stroke, String);

fn certainty((curve, stroke, name): &Named) -> [Layer; 2] {
    let [band, line] = layers(&curve.places, |at| at.place, *stroke);
    [band, line.named(name)]
}

fn largest_ball((curve, stroke, name): &Named) -> Layer {
    let line = curve.places.iter().map(|at| (at.place, integrity(at)));
    Layer::line(line, *stroke).named(name)
}
