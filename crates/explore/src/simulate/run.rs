//! The run itself: from sample to sample, exactly.

use anyhow::anyhow;
use softstop::internals::Motion;
use softstop::{CheckedScene, Instant, Start};

use super::begin::RunPlan;
use super::name;
use super::record::{CrossingRow, MotionRecorder, contact_force};
use super::tally::MotionTally;
use crate::simulate::chart::DrawnMotion;
use softstop_console::column::Column;
use softstop_console::columns;
use softstop_console::failure::{Failure, check_interrupt};
use softstop_console::progress::Progress;

/// What came of it.
pub(crate) struct RunOutcome<'a> {
    pub plan: &'a RunPlan,
    pub tally: MotionTally,
    pub drawing: DrawnMotion,
    /// Energy in J stored at the end less that at the start.
    pub stored: f64,
    pub end: Start,
    /// In s.
    pub duration: f64,
}

/// Share of the largest energy beyond which their balance tells that digits are lost.
const MOST_DEFECT: f64 = 1e-9;

impl RunOutcome<'_> {
    /// Energy in J that the balance lacks.
    pub(super) fn defect(&self) -> f64 {
        let work = &self.tally.work;
        work.supplied - work.dissipated - self.stored
    }

    /// Refuses a motion that does not keep its energies; that at the start was `before`, and `typical` is that of motions
    /// of this scene, for a run may end with none.
    fn check(&self, before: f64, typical: f64) -> Result<(), Failure> {
        let work = &self.tally.work;
        let energies = [before, self.stored, work.supplied, work.dissipated, typical];
        let size = energies.map(f64::abs).into_iter().fold(0.0, f64::max);
        let defect = self.defect();
        if defect.abs() <= MOST_DEFECT * size {
            return Ok(());
        }
        Err(Failure::Run(anyhow!(
            "the motion lost its digits: its energies of up to {size:e} J are out of balance by {defect:e} J, more \
             than a share of {MOST_DEFECT:e}"
        )))
    }
}

impl RunPlan {
    /// Runs the motion; what tables have is handed on as it comes.
    pub(crate) fn run(
        &self,
        mut sampled: impl FnMut(&MotionRow) -> Result<(), Failure>,
        crossed: impl FnMut(&CrossingRow) -> Result<(), Failure>,
    ) -> Result<RunOutcome<'_>, Failure> {
        let scene = &self.machine.scene;
        let mut motion = self.motion()?;
        let period = motion.clock().period();
        let before = motion.mechanical_energy(scene);
        let mut recorder = MotionRecorder::new(scene, &motion, crossed, self.drawn_from());
        let progress = Progress::new(self.periods, "periods");
        for sample in 0..=self.periods * self.samples {
            let (cycle, part) = (sample / self.samples, sample % self.samples);
            if part == 0 {
                progress.at(cycle);
            }
            check_interrupt()?;
            let instant = Instant {
                cycles: cycle as f64,
                offset: period * (part as f64 / self.samples as f64),
            };
            let stopped = motion.watch(instant, &mut recorder)?.is_break();
            recorder.check()?;
            if stopped {
                return Err(Failure::Interrupted);
            }
            sampled(&self.sample(&motion))?;
            if part == 0 {
                motion.feed_strip(self.is_fed(cycle));
            }
        }
        drop(progress);
        let (tally, drawing) = recorder.finish(&motion);
        let outcome = RunOutcome {
            plan: self,
            tally,
            drawing,
            stored: motion.mechanical_energy(scene) - before,
            end: motion.state(),
            duration: motion.clock().time(motion.now()),
        };
        let speed = scene.motion_scales().speed();
        outcome.check(before, scene.mass * speed * speed)?;
        Ok(outcome)
    }

    fn sample(&self, motion: &Motion) -> MotionRow {
        let state = motion.state();
        let drive = motion.clock().drive(motion.now());
        MotionRow {
            time: motion.clock().time(motion.now()),
            state,
            force: contact_force(&self.machine.scene, motion.phase(), state, drive),
            phase: name(motion.kind()),
        }
    }
}

/// A row of motion.csv.
pub(crate) struct MotionRow {
    time: f64,
    state: Start,
    force: f64,
    phase: &'static str,
}

/// The columns of motion.csv.
pub(super) fn columns() -> [Column<MotionRow>; 5] {
    columns! { MotionRow, it;
        "time" [Time], "from the start" => it.time;
        "position" [Length], "of the mass" => it.state.position;
        "velocity" [Velocity], "of the mass" => it.state.velocity;
        "contact_force" [Force], "of stop and strip; on a held mass, of what holds it" => it.force;
        "phase" [None], "of the motion" => it.phase;
    }
}

/// The positions in m at which the law of force changes.
pub(crate) fn faces(scene: &CheckedScene) -> Vec<f64> {
    let surfaces = scene.phases().surfaces.iter();
    let mut faces: Vec<f64> = surfaces.map(|it| it.position).collect();
    faces.sort_by(f64::total_cmp);
    faces.dedup();
    faces
}
