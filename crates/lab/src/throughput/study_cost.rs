//! What a study costs beside the lanes alone: the same motions, with all that makes a table of them and without.

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::Context;
use rayon::prelude::*;
use serde::Serialize;
use softstop::{MotionError, SceneError};
use softstop_console::failure::Failure;
use softstop_console::median::median;
use softstop_console::progress::Progress;
use softstop_explore::study::Study;
use softstop_lanes::{Job, LoweredMachine, run_parallel};

/// Points whose machines are in memory at once.
const TOGETHER: u64 = 1 << 13;

/// A study beside the lanes alone, on all cores.
#[derive(Debug, Clone, Serialize)]
pub struct StudyCost {
    /// Its file.
    pub study: PathBuf,
    /// Its points.
    pub points: u64,
    /// Drive periods of each.
    pub periods: u64,
    /// Medians of the seconds of lanes and study.
    pub seconds: [f64; 2],
    /// How many times as long the study takes in each round, sorted.
    pub times: Vec<f64>,
}

impl StudyCost {
    /// Measures the study of a file so many rounds.
    ///
    /// # Errors
    /// [`Failure::Run`] if a motion cannot be computed, or a file not be
    /// written; [`Failure::Interrupted`].
    pub fn measure(path: &Path, study: &Study, repeats: usize) -> Result<Self, Failure> {
        let progress = Progress::new(2 * repeats as u64, "runs of the study");
        let (mut alone, mut whole) = (Vec::new(), Vec::new());
        for _ in 0..repeats {
            alone.push(lanes(study).context("a motion of the study")?);
            progress.step()?;
            let begin = Instant::now();
            study.compute()?;
            whole.push(begin.elapsed().as_secs_f64());
            progress.step()?;
        }
        let times = whole.iter().zip(&alone).map(|(whole, alone)| whole / alone);
        let mut times: Vec<f64> = times.collect();
        times.sort_by(f64::total_cmp);
        Ok(Self {
            study: path.to_owned(),
            points: study.points(),
            periods: study.periods(),
            seconds: [median(alone), median(whole)],
            times,
        })
    }

    /// For people.
    pub fn told(&self) -> String {
        let ([alone, whole], times) = (self.seconds, &self.times);
        format!(
            "{}, {} points of {} periods: lanes alone {alone:.2} s, the study {whole:.2} s, {:.3} times as long ({:.3} \
             to {:.3})\n",
            self.study.display(),
            self.points,
            self.periods,
            median(times.clone()),
            times[0],
            times[times.len() - 1]
        )
    }
}

/// Seconds that the lanes take for the motions of a study, unwatched; lowering is part of it, making the machines is not.
fn lanes(study: &Study) -> Result<f64, MotionError> {
    let mut seconds = 0.0;
    for first in (0..study.points()).step_by(TOGETHER as usize) {
        let points = first..(first + TOGETHER).min(study.points());
        let machines: Vec<_> = points.map(|point| study.machine_at(point)).collect();
        let begin = Instant::now();
        let jobs = machines.iter().enumerate().map(|(machine, it)| Job {
            machine,
            start: it.start,
            periods: study.periods(),
        });
        let jobs: Vec<Job> = jobs.collect();
        let lowered = machines
            .par_iter()
            .map(|it| Ok(LoweredMachine::new(&it.check(None)?)));
        let lowered: Vec<LoweredMachine> = lowered.collect::<Result<_, SceneError>>()?;
        run_parallel(&lowered, &jobs, |_| ());
        seconds += begin.elapsed().as_secs_f64();
    }
    Ok(seconds)
}
