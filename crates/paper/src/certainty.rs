//! Establishing certainty of z = 1 along the hysteresis zone. The paper (section 3): it "increases from zero, on
//! stability boundary s_SN, to one on grazing boundary g0". It is a share of initial states, so it depends on
//! which states are asked: that dependence is shown beside it.

use anyhow::{Context, Result};
use rayon::prelude::*;

use crate::basins::grid;
use crate::figure::{Drawn, Figure, Findings, Studio, findings};
use softstop_console::columns;
use softstop_console::export::csv;
use softstop_console::machine::PaperMachine;
use softstop_console::progress::Progress;
use softstop_draw::{Chart, Layer, Mark, Stroke, style};
use softstop_dynamics::basin::{BasinOptions, CertaintyAtPlace, establishing_certainties};
use softstop_dynamics::{Grid, zone};
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
        let within = |far: f64| [-far, far];
        match self {
            Self::AtRest => grid(within(clearance), None, cells),
            Self::Square(half) => {
                let range = within(half * clearance);
                grid(range, Some(range), cells)
            }
        }
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
        let (options, kept) = (BasinOptions::default(), studio.kept);
        let found = establishing_certainties(&zone, &places, &grid, &options, &watcher, kept);
        Ok(Curve {
            machine,
            clearance,
            starts,
            places: found?,
        })
    });
    let curves = curves.collect::<Result<Vec<Curve>>>()?;
    drop(progress);
    let columns = columns! { (&Curve, &CertaintyAtPlace), it;
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
    };
    let rows = curves.iter();
    let rows = rows.flat_map(|curve| curve.places.iter().map(move |at| (curve, at)));
    let svg = chart(figure, &curves)?.svg().into_bytes();
    let findings = findings_of(&curves);
    Ok(Drawn::new([svg, csv(&columns, rows)?], findings))
}

/// Integrity factor: radius of the largest ball inside the basin of z = 1, in units of half of the region; 0 if there is none.
fn integrity(at: &CertaintyAtPlace) -> f64 {
    at.largest_ball().map_or(0.0, |ball| ball.radius)
}

fn motions(at: &CertaintyAtPlace) -> String {
    let classes = at.basins.classes.iter();
    let motions = classes.map(|class| format!("{}: {:.6}", class.motion, class.share));
    motions.collect::<Vec<_>>().join(", ")
}

/// Certainties at the ends and in between, and how far the claim is off.
fn findings_of(curves: &[Curve]) -> Findings {
    let mut findings = Findings::default();
    for curve in curves {
        let near = |place: f64| {
            let gap = |at: &&CertaintyAtPlace| (at.place - place).abs();
            let places = curve.places.iter();
            places.min_by(|a, b| gap(a).total_cmp(&gap(b)))
        };
        let certainty = |place| near(place).map(|at| at.certainty);
        let (machine, starts) = (curve.machine.name(), curve.starts.label());
        let name = format!("{machine}, rho = {}, starts {starts}: ", curve.clearance);
        findings! { findings, |what| format!("{name}{what}");
            "certainty near g0" => certainty(0.0);
            "integrity near g0" => near(0.0).map(integrity);
            "certainty near s_SN" => certainty(1.0);
            "integrity near s_SN" => near(1.0).map(integrity);
            "certainty at s = 0.25" => certainty(0.25);
            "certainty at s = 0.5" => certainty(0.5);
            "certainty at s = 0.75" => certainty(0.75);
            "largest rise of the certainty away from g0" => rise(&curve.places);
        }
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
    let solid = |curve: usize, color, name| (&curves[curve], Stroke::solid(color, 2.2), name);
    let by_clearance = |curve: usize| {
        let name = format!("ρ = {}", curves[curve].clearance);
        solid(curve, color(curve % count), name)
    };
    let by_starts = |(curve, color): (usize, _)| solid(curve, color, curves[curve].starts.label());
    let regions = [
        (2 * count, style::REFERENCE),
        (2 * count + 1, "#8C8C8C"),
        (MIDDLE, color(MIDDLE)),
        (2 * count + 2, style::POINT),
    ];
    let certainties = |curves: &mut dyn Iterator<Item = (&Curve, Stroke, String)>| {
        let claim = Layer::marks([(0.0, 1.0), (1.0, 0.0)], Mark::Circle, style::ASIDE);
        let claim = claim.named("the paper: one at g₀, zero at s_SN");
        let curves = curves.flat_map(|(curve, stroke, name)| {
            let [band, line] = layers(&curve.places, |at| at.place, stroke);
            [band, line.named(name)]
        });
        curves.chain([claim]).collect()
    };
    let dashed = Stroke::dashed(color(MIDDLE), 2.2, (8.0, 5.0));
    let loaded = (&curves[count + MIDDLE], dashed, String::new());
    let integrities = (0..count).map(by_clearance).chain([loaded]);
    let integrities = integrities.map(|(curve, stroke, name)| {
        let line = curve.places.iter().map(|at| (at.place, integrity(at)));
        Layer::line(line, stroke).named(name)
    });
    figure.picture([
        certainties(&mut (0..count).map(by_clearance)),
        certainties(&mut (count..2 * count).map(by_clearance)),
        certainties(&mut regions.into_iter().map(by_starts)),
        integrities.collect(),
    ])
}
