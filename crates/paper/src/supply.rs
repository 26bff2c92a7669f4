//! Does an interrupted supply of strips end the z = 1 motion?
//!
//! At the end of each drive period, while the mass is short of the strip, the supply breaks off or sets in again
//! by chance, so that strips come and fail in runs of a mean length. The motion begins as z = 1; in the end the
//! supply is steady once more, and it is counted whether each period has its impact still. What is there without a
//! strip can be read in two ways ([`StopWithoutStrip`]).

use std::f64::consts::TAU;

use anyhow::Result;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};
use serde::{Deserialize, Serialize};
use softstop::{Ratios, Start};
use softstop_draw::{Align, Chart, Layer, Sign, Stroke, style};
use softstop_dynamics::Orbit;
use softstop_dynamics::basin::wilson_interval;
use softstop_dynamics::missing_strips::{StopWithoutStrip, StrokeCount};
use softstop_dynamics::orbit::find;
use softstop_dynamics::zone::hysteresis;
use softstop_lanes::{BatchObserver, Job, LoweredMachine};

use crate::figure::{Drawn, Figure, Findings, Studio, evenly_spread, findings};
use softstop_console::output::csv;
use softstop_console::progress::Progress;

/// Mean lengths of runs with and without strips, in drive periods.
const RUNS: [f64; 3] = [2.0, 5.0, 25.0];
/// Drive periods for which a motion settles in the end, and in which its impacts are counted then.
const CLOSE: (u64, u64) = (250, 64);
/// Shares of the range from g0 to the loaded machine's fold, that fold being 1; the unloaded one's lies beyond.
const SHARES: (f64, f64) = (0.02, 1.1);

const READINGS: [(StopWithoutStrip, &str); 2] = [
    (StopWithoutStrip::Near, "stop at rho without a strip"),
    (StopWithoutStrip::Fixed, "stop fixed at rho + 0.9"),
];

/// What became of many motions at one frequency: a row of the table.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Outcome {
    stop_without_strip: StopWithoutStrip,
    eta: f64,
    mean_run: f64,
    motions: usize,
    /// Motions that miss at least one stroke: an impact comes later than a drive period and a half after the last one.
    missed: usize,
    /// Motions that are no longer z = 1 in the end.
    ended: usize,
}

/// One machine without and with strips, and the z = 1 motion from which it starts.
struct Press {
    machines: [LoweredMachine; 2],
    orbit: Orbit,
    /// Whether it starts and ends with strips.
    is_supplied: bool,
}

pub(super) fn draw(studio: &Studio, figure: &Figure) -> Result<Drawn> {
    let detail = studio.detail;
    let machine = Ratios::loaded();
    let zones = zones(machine.clearance)?;
    let [grazing, loaded, unloaded] = zones;
    let mut etas = etas(zones, detail.pick(55, 12));
    // Point B among them.
    etas.push(machine.frequency);
    etas.sort_by(f64::total_cmp);
    let runs = READINGS.map(|(reading, _)| RUNS.map(|mean| (reading, mean)));
    let cases = runs.iter().flatten();
    let cases = cases.flat_map(|(reading, mean)| etas.iter().map(move |eta| (reading, eta, mean)));
    let cases: Vec<(&StopWithoutStrip, &f64, &f64)> = cases.collect();
    let progress = Progress::new(cases.len() as u64, "frequencies");
    let (motions, periods) = detail.pick((64, 400), (16, 200));
    let outcomes = studio.each("supply", &cases, |&(reading, &eta, &mean)| {
        let press = Press::new(*reading, eta, eta < loaded)?;
        let ends = press.run(mean, periods, motions)?;
        progress.step()?;
        Ok(Outcome {
            stop_without_strip: *reading,
            eta,
            mean_run: mean,
            motions,
            missed: ends.iter().filter(|it| it.0).count(),
            ended: ends.iter().filter(|it| it.1).count(),
        })
    })?;
    drop(progress);
    let mut findings = Findings::default();
    findings.add("eta_SN loaded", loaded);
    findings.add("eta_SN unloaded", unloaded);
    for (reading, name) in READINGS {
        for mean in RUNS {
            let own = || of_run(&outcomes, reading, mean);
            let ended = own().find(|it| it.ended > 0);
            let missed = own().filter(|it| it.missed > 0 && it.ended == 0);
            let at_b = own().find(|it| it.eta == machine.frequency);
            findings! { findings, |what| format!("{name}, runs of {mean}: {what}");
                "first eta at which a motion ends" => ended.map(|it| it.eta);
                "last eta at which strokes are missed and no motion ends" => missed.map(|it| it.eta).max_by(f64::total_cmp);
                "motions with a missed stroke at B" => at_b.map(|it| it.missed as f64);
            }
        }
    }
    let chart = chart(figure, &outcomes, grazing, loaded)?;
    let files = [chart.svg().into_bytes(), csv(&outcomes)?];
    Ok(Drawn::new(files, findings))
}

/// The frequencies between which z = 1 is: g0, s_SN with strips, s_SN without.
fn zones(clearance: f64) -> Result<[f64; 3]> {
    let scene = |ratios: Ratios| ratios.at_clearance(clearance).scene();
    let unloaded = hysteresis(&scene(Ratios::unloaded())?)?;
    let loaded = hysteresis(&scene(Ratios::loaded())?)?.high.frequency;
    Ok([unloaded.frequency_g0, loaded, unloaded.high.frequency])
}

fn etas([grazing, loaded, unloaded]: [f64; 3], count: usize) -> Vec<f64> {
    let at = |share: f64| grazing + share * (loaded - grazing);
    evenly_spread(at(SHARES.0), at(SHARES.1).min(unloaded), count)
}

impl Press {
    fn new(reading: StopWithoutStrip, frequency: f64, is_supplied: bool) -> Result<Self> {
        let scene = Ratios::loaded().at_frequency(frequency).scene()?;
        let scenes = [reading.scene_without_strip(&scene).check()?, scene.check()?];
        Ok(Self {
            machines: scenes.each_ref().map(LoweredMachine::new),
            orbit: find(&scenes[usize::from(is_supplied)])?,
            is_supplied,
        })
    }

    /// Whether a stroke was missed, and whether z = 1 has ended, of as many motions as there are seeds.
    fn run(&self, mean: f64, periods: u64, seeds: usize) -> Result<Vec<(bool, bool)>> {
        let impact = self.orbit.impact_angles().next().unwrap_or(0.0) / TAU;
        let clearance = self.orbit.scene.clearance;
        let motion = |seed: usize| Motion {
            state: self.orbit.state().into(),
            is_supplied: self.is_supplied,
            chance: Xoshiro256PlusPlus::seed_from_u64(seed as u64),
            strokes: StrokeCount::after_impact(impact - 1.0),
            impacts: 0,
        };
        let mut motions: Vec<Motion> = (0..seeds).map(motion).collect();
        for period in 0..periods {
            for motion in &mut motions {
                // Once in a mean run.
                let chance = motion.chance.next_u64() as f64 / u64::MAX as f64;
                let changes = chance * mean < 1.0 && motion.state.position < clearance;
                motion.is_supplied ^= changes;
            }
            self.follow(&mut motions, period, 1)?;
        }
        let strokes = motions.iter().map(|motion| motion.strokes);
        let missed = strokes.map(|strokes| strokes.missed_strokes(periods as f64) > 0);
        let missed: Vec<bool> = missed.collect();
        for length in [CLOSE.0, CLOSE.1] {
            for motion in &mut motions {
                (motion.is_supplied, motion.impacts) = (self.is_supplied, 0);
            }
            self.follow(&mut motions, periods, length)?;
        }
        let ended = motions.iter().map(|motion| motion.impacts != CLOSE.1);
        Ok(missed.into_iter().zip(ended).collect())
    }

    /// Follows motions with or without strips from a drive period on, for so many.
    fn follow(&self, motions: &mut [Motion], from: u64, periods: u64) -> Result<()> {
        let job = |motion: &Motion| Job {
            machine: usize::from(motion.is_supplied),
            start: motion.state,
            periods,
        };
        let jobs: Vec<Job> = motions.iter().map(job).collect();
        let mut counter = Counter {
            period: self.orbit.scene.period(),
            from,
            motions,
        };
        let outcomes = softstop_lanes::run(&self.machines, &jobs, &mut counter);
        for (motion, outcome) in motions.iter_mut().zip(outcomes) {
            outcome.error.map_or(Ok(()), Err)?;
            motion.state = outcome.end;
        }
        Ok(())
    }
}

/// One motion under way.
struct Motion {
    state: Start,
    is_supplied: bool,
    /// When the supply changes.
    chance: Xoshiro256PlusPlus,
    strokes: StrokeCount,
    /// Impacts since the supply is steady.
    impacts: u64,
}

/// Counts the strokes of motions that are followed together.
struct Counter<'a> {
    /// A drive period in s.
    period: f64,
    /// The drive period from which they are followed.
    from: u64,
    motions: &'a mut [Motion],
}

impl BatchObserver for Counter<'_> {
    fn observed(&self) -> (bool, bool) {
        (true, false)
    }

    fn impact(&mut self, job: usize, cycle: u64, offset: f64, _: f64) {
        let motion = &mut self.motions[job];
        motion.impacts += 1;
        motion
            .strokes
            .record_impact((self.from + cycle) as f64 + offset / self.period);
    }
}

fn of_run(
    outcomes: &[Outcome],
    reading: StopWithoutStrip,
    mean: f64,
) -> impl Iterator<Item = &Outcome> {
    let own = outcomes.iter();
    own.filter(move |it| it.stop_without_strip == reading && it.mean_run == mean)
}

/// The line of the share without a missed stroke.
const DOTS: (f64, f64) = (2.0, 4.0);
const MARK: Stroke = Stroke::dashed(style::INK, 1.2, (5.0, 4.0));

/// The chart; `fold` is where z = 1 ends with strips.
fn chart(figure: &Figure, outcomes: &[Outcome], grazing: f64, fold: f64) -> Result<Chart> {
    let right = outcomes.iter().map(|it| it.eta).fold(fold, f64::max);
    let room = 0.03 * (right - grazing);
    let layers = READINGS.into_iter().map(|(reading, _)| {
        let runs = RUNS.into_iter().enumerate();
        let curves = runs.flat_map(|(index, mean)| {
            let color = style::ordered(index, RUNS.len());
            curves(of_run(outcomes, reading, mean).collect(), color, mean)
        });
        let marks = [
            Layer::vertical(grazing, MARK, ""),
            Layer::text((grazing, 0.5), Align::Left, "g₀").moved(6.0, 0.0),
            Layer::vertical(fold, MARK, "s_SN with strips"),
        ];
        let keys = [
            (Stroke::solid(style::INK, 2.2), "z = 1 in the end"),
            (Stroke::dashed(style::INK, 1.6, DOTS), "no stroke missed"),
        ];
        let keys = keys.map(|(stroke, name)| Layer::key(Sign::Line(stroke), name));
        curves.chain(marks).chain(keys).collect()
    });
    let mut chart = figure.picture(layers)?;
    for panel in &mut chart.panels {
        panel.x.ends = [grazing - room, right + room].map(Some);
    }
    Ok(chart)
}

/// How many are z = 1 in the end, and how many have missed no stroke.
fn curves(outcomes: Vec<&Outcome>, color: &'static str, mean: f64) -> Vec<Layer> {
    let share =
        |it: &Outcome, lost: usize| (it.eta, (it.motions - lost) as f64 / it.motions as f64);
    let interval = |it: &&Outcome| (it.eta, wilson_interval(it.motions - it.ended, it.motions));
    let open = outcomes.split(|it| it.ended == 0 || it.ended == it.motions);
    let bands = open.map(|it| Layer::band(it.iter().map(interval), color, 0.2));
    let stay = outcomes.iter().map(|it| share(it, it.ended));
    let struck = outcomes.iter().map(|it| share(it, it.missed));
    let lines = [
        Layer::line(stay, Stroke::solid(color, 2.2)).named(format!("runs of {mean} periods")),
        Layer::line(struck, Stroke::dashed(color, 1.6, DOTS)),
    ];
    bands.chain(lines).collect()
}
