//! Does an interrupted supply of strips end the z = 1 motion?
//!
//! At the end of each drive period, while the mass is short of the strip, the supply breaks off or sets in again
//! by chance, so that strips come and fail in runs of a mean length. The motion begins as z = 1; in the end the
//! supply is steady once more, and it is counted whether each period has its impact still. What is there without a
//! strip can be read in two ways ([`Reading`]).

mod chart;

use std::f64::consts::TAU;

use anyhow::Result;
use nalgebra::Vector2;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};
use serde::{Deserialize, Serialize};
use softstop::Ratios;
use softstop_dynamics::StroboscopicMap;
use softstop_dynamics::orbit::find;
use softstop_dynamics::supply::{Reading, Strokes};
use softstop_dynamics::zone::hysteresis;

use crate::figure::{Drawn, Figure, Findings, Studio};
use softstop_console::output;
use softstop_console::progress::Progress;

/// The figure.
pub(crate) const FIGURE: Figure = Figure {
    title: "z = 1 under an interrupted supply of strips",
    files: &["supply.svg", "supply.csv"],
    draw,
};

/// Mean lengths of runs with and without strips, in drive periods.
const RUNS: [f64; 3] = [2.0, 5.0, 25.0];
/// Drive periods for which a motion settles in the end, and in which its impacts are counted then.
const CLOSE: (usize, usize) = (250, 64);
/// Shares of the range from g0 to the loaded machine's fold, that fold being 1; the unloaded one's lies beyond.
const SHARES: (f64, f64) = (0.02, 1.1);

const READINGS: [(Reading, &str); 2] = [
    (Reading::Near, "stop at rho without a strip"),
    (Reading::Fixed, "stop fixed at rho + 0.9"),
];

/// What became of many motions at one frequency.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Outcome {
    stop_without_strip: Reading,
    eta: f64,
    mean_run: f64,
    motions: usize,
    /// Motions that miss at least one stroke: an impact comes later than a drive period and a half after the last one.
    missed: usize,
    /// Motions that are no longer z = 1 in the end.
    ended: usize,
}

/// One machine with and without strips.
struct Press {
    clearance: f64,
    /// Without, and with.
    maps: [StroboscopicMap; 2],
    start: Vector2<f64>,
    /// When its impact is, in drive periods.
    impact: f64,
    /// Whether it starts and ends with strips.
    is_supplied: bool,
}

fn draw(studio: &Studio) -> Result<Drawn> {
    let detail = studio.detail;
    let machine = Ratios::loaded();
    let zones = zones(machine.clearance)?;
    let mut etas = etas(zones, detail.pick(55, 12));
    // Point B among them.
    etas.push(machine.frequency);
    etas.sort_by(f64::total_cmp);
    let progress = Progress::new((2 * etas.len() * RUNS.len()) as u64, "frequencies");
    let mut outcomes = Vec::new();
    let mut findings = Findings::default();
    let [grazing, loaded, unloaded] = zones;
    findings.add("eta_SN loaded", loaded);
    findings.add("eta_SN unloaded", unloaded);
    for (reading, name) in READINGS {
        let found = survey(reading, &etas, loaded, studio, &progress)?;
        for mean in RUNS {
            let mut add = |what: &str, value: Option<f64>| {
                findings.add(format!("{name}, runs of {mean}: {what}"), value);
            };
            let ended = of_run(&found, mean).find(|it| it.ended > 0);
            add("first eta at which a motion ends", ended.map(|it| it.eta));
            let missed = of_run(&found, mean).filter(|it| it.missed > 0 && it.ended == 0);
            let missed = missed.map(|it| it.eta).max_by(f64::total_cmp);
            add(
                "last eta at which strokes are missed and no motion ends",
                missed,
            );
            let at_b = of_run(&found, mean).find(|it| it.eta == machine.frequency);
            let at_b = at_b.map(|it| it.missed as f64);
            add("motions with a missed stroke at B", at_b);
        }
        outcomes.extend(found);
    }
    let svg = chart::svg(&outcomes, grazing, loaded, machine.clearance);
    Ok(Drawn {
        files: vec![svg.into_bytes(), output::csv(&outcomes)?],
        findings,
    })
}

/// The frequencies between which z = 1 is: g0, s_SN with strips, s_SN without.
fn zones(clearance: f64) -> Result<[f64; 3]> {
    let scene = |ratios: Ratios| ratios.at_clearance(clearance).scene();
    let unloaded = hysteresis(&scene(Ratios::unloaded())?)?;
    let loaded = hysteresis(&scene(Ratios::loaded())?)?.frequency_sn;
    Ok([unloaded.frequency_g0, loaded, unloaded.frequency_sn])
}

fn etas([grazing, loaded, unloaded]: [f64; 3], count: usize) -> Vec<f64> {
    let at = |share: f64| grazing + share * (loaded - grazing);
    let (low, high) = (at(SHARES.0), at(SHARES.1).min(unloaded));
    let step = (high - low) / (count - 1) as f64;
    (0..count).map(|index| low + step * index as f64).collect()
}

fn survey(
    reading: Reading,
    etas: &[f64],
    loaded: f64,
    studio: &Studio,
    progress: &Progress,
) -> Result<Vec<Outcome>> {
    let cases = RUNS
        .iter()
        .flat_map(|mean| etas.iter().map(move |eta| (reading, *eta, *mean)));
    let cases: Vec<(Reading, f64, f64)> = cases.collect();
    let (motions, periods) = studio.detail.pick((64, 400), (16, 200));
    let outcome = |&(reading, eta, mean): &(Reading, f64, f64)| {
        let press = Press::new(reading, eta, eta < loaded)?;
        let mut outcome = Outcome {
            stop_without_strip: reading,
            eta,
            mean_run: mean,
            motions,
            missed: 0,
            ended: 0,
        };
        for motion in 0..motions {
            let (missed, ended) = press.run(mean, periods, motion as u64)?;
            outcome.missed += usize::from(missed);
            outcome.ended += usize::from(ended);
        }
        progress.step()?;
        Ok(outcome)
    };
    studio.each("supply", &cases, outcome)
}

impl Press {
    fn new(reading: Reading, frequency: f64, is_supplied: bool) -> Result<Self> {
        let machine = Ratios::loaded().at_frequency(frequency);
        let scene = machine.scene()?;
        let scenes = [reading.without(&scene), scene];
        let map = |scene| StroboscopicMap::new(scene, 1);
        let orbit = find(&scenes[usize::from(is_supplied)])?;
        Ok(Self {
            clearance: machine.clearance,
            maps: [map(&scenes[0])?, map(&scenes[1])?],
            start: orbit.state(),
            impact: orbit.impact_angles().next().unwrap_or(0.0) / TAU,
            is_supplied,
        })
    }

    /// Whether a stroke was missed, and whether z = 1 has ended.
    fn run(&self, mean: f64, periods: usize, seed: u64) -> Result<(bool, bool)> {
        let mut chance = Xoshiro256PlusPlus::seed_from_u64(seed);
        let (mut state, mut is_supplied) = (self.start, self.is_supplied);
        let mut strokes = Strokes::after(self.impact - 1.0);
        for period in 0..periods {
            let drawn = chance.next_u64() as f64 / u64::MAX as f64;
            if drawn * mean < 1.0 && state.x < self.clearance {
                is_supplied = !is_supplied;
            }
            let passage = self.maps[usize::from(is_supplied)].apply(state)?;
            state = passage.end;
            for impact in &passage.instants {
                strokes.strike(period as f64 + impact.offset / self.maps[0].clock().period());
            }
        }
        let mut impacts = 0;
        for period in 0..CLOSE.0 + CLOSE.1 {
            let passage = self.maps[usize::from(self.is_supplied)].apply(state)?;
            state = passage.end;
            impacts += if period < CLOSE.0 {
                0
            } else {
                passage.impacts.len()
            };
        }
        Ok((strokes.missed(periods as f64) > 0, impacts != CLOSE.1))
    }
}

fn of_run(outcomes: &[Outcome], mean: f64) -> impl Iterator<Item = &Outcome> {
    outcomes.iter().filter(move |it| it.mean_run == mean)
}
