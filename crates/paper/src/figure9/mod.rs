//! Figure 9: the motions (A) to (L), each found from scratch among all on which the machine settles.

mod chart;
mod found;
pub(crate) mod section;

use anyhow::{Result, anyhow};
use serde::Deserialize;
use softstop::Ratios;
use softstop_dynamics::attractors::{SearchOptions, find_attractors};

use crate::figure::{Detail, Drawn, Figure, Findings, Studio};
use found::FoundMotion;
use softstop_console::columns;
use softstop_console::export::csv;
use softstop_console::interrupt;
use softstop_console::progress::Progress;

/// The clearance ρ.
const CLEARANCE: f64 = Ratios::unloaded().clearance;
/// Least depth beyond the stop that is shown, in units of the clearance.
const SHALLOW: f64 = 0.002;
/// Drive periods of the time series, on the first page and on the second.
const SHOWN: [u64; 2] = [24, 12];
/// Motions on a page.
const ON_A_PAGE: usize = 6;

/// A motion that the figure shows.
#[derive(Debug, Clone, Deserialize)]
struct WantedMotion {
    letter: char,
    /// Its frequency.
    eta: f64,
    /// Whether the paper's text gives that frequency.
    is_given: bool,
    /// The order of its impacts; none of what does not repeat.
    impacts: Option<String>,
    /// What else there is to say.
    remark: String,
}

/// The letters at each frequency, as "A, B".
pub(crate) fn letters() -> Result<Vec<(String, f64)>> {
    let names = |group: &[WantedMotion]| {
        let letters: Vec<String> = group.iter().map(|it| it.letter.to_string()).collect();
        (letters.join(", "), group[0].eta)
    };
    let motions: Vec<WantedMotion> = Figure::called("9")?.get("motions")?;
    let groups = motions.chunk_by(|a, b| a.eta == b.eta);
    Ok(groups.map(names).collect())
}

pub(super) fn draw(studio: &Studio, figure: &Figure) -> Result<Drawn> {
    let found = found(&figure.get::<Vec<WantedMotion>>("motions")?, studio.detail)?;
    let (mut files, mut series, mut sections) = (Vec::new(), Vec::new(), Vec::new());
    let mut findings = Findings::default();
    for (motions, shown) in found.chunks(ON_A_PAGE).zip(SHOWN) {
        let (chart, points) = chart::page(figure, motions, &found, shown)?;
        files.push(chart.svg().into_bytes());
        series.extend(points);
    }
    for motion in &found {
        motion.tell(&mut findings)?;
        let states = motion.section.states.iter();
        sections.extend(states.map(|state| (motion.asked.letter, *state)));
    }
    let points = columns! { (char, [f64; 3]), it;
        "motion" [None], "its letter" => it.0.to_string();
        "drive_periods" [None], "time" => it.1[0];
        "position" [None], "X" => it.1[1];
        "velocity" [None], "X'" => it.1[2];
    };
    let states = columns! { (char, (f64, f64)), it;
        "motion" [None], "its letter" => it.0.to_string();
        "position" [None], "X at drive angle 0" => it.1.0;
        "velocity" [None], "X' there" => it.1.1;
    };
    files.push(csv(&found::columns(), &found)?);
    files.extend([csv(&points, series)?, csv(&states, sections)?]);
    Ok(Drawn::new(files, findings))
}

/// All motions that are asked for, each among those at its frequency.
fn found(asked: &[WantedMotion], detail: Detail) -> Result<Vec<FoundMotion>> {
    let progress = Progress::new(asked.len() as u64, "motions");
    let options = SearchOptions {
        starts: detail.pick(256, 96),
        patience: detail.pick(4_000_000, 200_000),
        ..SearchOptions::default()
    };
    let watcher = |_, _| {
        progress.beat();
        interrupt::go_on()
    };
    let mut found = Vec::new();
    for group in asked.chunk_by(|a, b| a.eta == b.eta) {
        let scene = Ratios::unloaded().at_frequency(group[0].eta).scene()?;
        let survey = find_attractors(&scene, &options, &watcher)?;
        for asked in group {
            let motion = FoundMotion::among(asked, &survey, detail.pick(4000, 600))?;
            found.push(motion.ok_or_else(|| anyhow!("motion ({}) not found", asked.letter))?);
            progress.step()?;
        }
    }
    Ok(found)
}
