//! Figure 9: the motions (A) to (L), each found from scratch among all on which the machine settles.

mod asked;
mod chart;
mod found;
mod path;
mod section;

use anyhow::{Result, anyhow};
use softstop::Ratios;
use softstop_dynamics::attractors::{Options, Survey, attractors_watched};

use crate::figure::{self, Detail, Drawn, Figure, Studio};
use crate::figure9::chart::{MotionPage, MotionRow};
pub(super) use asked::letters;
use asked::{Asked, MOTIONS};
use found::Found;
use softstop_console::interrupt;
use softstop_console::progress::Progress;

/// Motions (A) to (L).
pub(crate) const FIGURE: Figure = Figure {
    title: "Motions (A) to (L)",
    files: &[
        "figure-9-a-f.svg",
        "figure-9-g-l.svg",
        "figure-9.csv",
        "figure-9-series.csv",
        "figure-9-section.csv",
    ],
    draw,
};

/// Drive periods of the time series, on the first page and on the second.
const SHOWN: [u64; 2] = [24, 12];
/// Motions on a page.
const ON_A_PAGE: usize = 6;
/// Points for each drive period, of all of a motion and of what is near the stop.
const FINENESS: (u32, u32) = (72, 1440);

fn draw(studio: &Studio) -> Result<Drawn> {
    let detail = studio.detail;
    let found = found(detail)?;
    let mut files = Vec::new();
    let (mut series, mut sections) = (Vec::new(), Vec::new());
    for (page, shown) in SHOWN.into_iter().enumerate() {
        let mut rows = Vec::new();
        let first = page * ON_A_PAGE;
        for motion in found.iter().skip(first).take(ON_A_PAGE) {
            let path = motion.path(shown, FINENESS.0)?;
            let path_of = |fineness| motion.path(motion.repeats(), fineness);
            let plane = path_of(FINENESS.0)?;
            let near = path_of(FINENESS.1)?;
            let coexist = |other: &&Found| {
                other.asked.letter != motion.asked.letter
                    && other.asked.frequency == motion.asked.frequency
            };
            let others = found.iter().filter(coexist);
            let letter = motion.asked.letter;
            let points = path.points.iter();
            series.extend(points.map(|it| (letter, it.periods, it.position, it.velocity)));
            sections.extend(motion.section.iter().map(|state| (letter, *state)));
            rows.push(MotionRow {
                letter: motion.asked.letter,
                title: motion.title(),
                remark: motion.remark(),
                is_chaotic: motion.is_chaotic(),
                clearance: Ratios::unloaded().clearance,
                repeats: motion.period(),
                series: path.positions(),
                impacts: path.impacts,
                trajectory: plane.states(),
                near: near.near(Ratios::unloaded().clearance),
                section: motion.section.clone(),
                others: others.map(|other| other.section.clone()).collect(),
            });
        }
        files.push(page_of(rows, shown).svg().into_bytes());
    }
    files.push(figure::table(
        found::COLUMNS,
        found.iter().map(Found::line),
    )?);
    files.push(figure::table(
        "motion,drive_periods,position,velocity",
        series,
    )?);
    files.push(figure::table("motion,position,velocity", sections)?);
    Ok(Drawn {
        files,
        findings: found.iter().flat_map(Found::findings).collect(),
    })
}

fn page_of(rows: Vec<MotionRow>, shown: u64) -> MotionPage {
    let letter = |row: Option<&MotionRow>| row.map_or(' ', |row| row.letter);
    MotionPage {
        title: format!(
            "Fig. 9({})–({}): motions of the unloaded machine, ρ = 10",
            letter(rows.first()),
            letter(rows.last())
        ),
        explanation:
            "▼ impacts · right: states at drive angle 0, in grey those of the motions above or \
                      below that coexist at the same η"
                .to_owned(),
        shown: shown as f64,
        rows,
    }
}

/// All motions that are asked for.
fn found(detail: Detail) -> Result<Vec<Found>> {
    let progress = Progress::new(MOTIONS.len() as u64, "motions");
    let mut surveys: Vec<(f64, Survey)> = Vec::new();
    let mut found = Vec::new();
    for asked in MOTIONS {
        if surveys
            .last()
            .is_none_or(|(frequency, _)| *frequency != asked.frequency)
        {
            surveys.push((asked.frequency, survey(&asked, detail, &progress)?));
        }
        if let Some((_, survey)) = surveys.last() {
            let motion = Found::among(asked, survey, detail.pick(4000, 600))?;
            found.push(motion.ok_or_else(|| anyhow!("motion ({}) not found", asked.letter))?);
        }
        progress.step()?;
    }
    Ok(found)
}

/// All motions at a frequency.
fn survey(asked: &Asked, detail: Detail, progress: &Progress) -> Result<Survey> {
    let scene = asked.scene()?;
    let options = Options {
        starts: detail.pick(256, 96),
        patience: detail.pick(4_000_000, 200_000),
        ..Options::default()
    };
    let watcher = |_, _| {
        progress.beat();
        interrupt::go_on()
    };
    Ok(attractors_watched(&scene, &options, &watcher)?)
}
