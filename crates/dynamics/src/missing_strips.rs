//! Missing strips: what becomes of the z = 1 motion of a loaded machine while strips fail to come, and after.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::basin::{BasinTest, TestedMotion};
use crate::ensemble::Member;
pub use crate::missed_strokes::StrokeCount;
use crate::missed_strokes::StrokeObserver;
use crate::monitor::Monitor;
use crate::orbit::{Orbit, OrbitError};
use crate::parallel;
use softstop::internals::Motion;
use softstop::{CheckedScene, Instant, MotionError, Scene, Strip};
use softstop_lanes::LoweredMachine;

/// Position of the stop while there is no strip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum StopWithoutStrip {
    /// At the clearance, as in the paper's unloaded machine.
    #[serde(rename = "rho")]
    Near,
    /// Where it stands behind a strip: it is fixed, as on a press.
    #[serde(rename = "rho + sigma + nu")]
    Fixed,
}

impl StopWithoutStrip {
    /// The scene of the machine while its strip is missing.
    pub fn scene_without_strip(self, scene: &Scene) -> Scene {
        let mut without = scene.clone();
        without.piercing = match self {
            Self::Near => None,
            Self::Fixed => scene.piercing.map(|strip| Strip {
                stiffness: 0.0,
                friction: 0.0,
                ..strip
            }),
        };
        without
    }
}

/// A run of strips missing in a row, from one drive angle on, and whether the motion came back after it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct StripGap {
    /// Drive angle in rad at which the strip is missing first and is there again some drive periods later; where a strip or stop
    /// is touched just then, it is so from the next stroke on.
    pub angle: f64,
    /// Whether the motion came back after the gap.
    pub comes_back: bool,
    /// Strokes missed until the motion has come back or is given up, as a [`StrokeCount`] has them.
    pub missed: u64,
}

/// What became of a motion after gaps of missing strips, one gap for each of several drive angles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct StripSurvival {
    /// Strips missing in a row, one for each drive period.
    pub missing: u32,
    /// The gaps, by the drive angle at which they begin.
    pub gaps: Vec<StripGap>,
}

impl StripSurvival {
    /// Share of the drive angles at which the supply of strips may pause such that the motion comes back after the pause.
    pub fn return_share(&self) -> f64 {
        let back = self.gaps.iter().filter(|gap| gap.comes_back).count();
        back as f64 / self.gaps.len() as f64
    }
}

/// Number of gaps of missing strips whose motions are followed together; it does not depend on how many threads there are.
const GAPS_TOGETHER: usize = 256;

/// Follows a stable motion of a loaded machine from which `missing` strips are taken in a row, beginning at each of so many drive
/// angles, evenly spread over its period: whether it comes back after the gap, and how many strokes it misses. Without a strip in
/// the scene nothing is missing.
///
/// # Errors
/// [`OrbitError::Motion`] if the motion cannot be computed; [`OrbitError::Stopped`].
pub fn survives_missing_strips(
    orbit: &Orbit,
    missing: u32,
    reading: StopWithoutStrip,
    angles: usize,
    monitor: Monitor<'_>,
) -> Result<StripSurvival, OrbitError> {
    let basin_test = BasinTest::of(orbit)?;
    let without = reading.scene_without_strip(&orbit.scene).check()?;
    let (turn, angles) = (TAU * orbit.periods as f64, angles.max(1));
    let angles: Vec<f64> = (0..angles)
        .map(|index| turn * index as f64 / angles as f64)
        .collect();
    let gaps = parallel::try_map_chunks(&angles, GAPS_TOGETHER, |angles| {
        let (mut machines, mut motions) = (Vec::new(), Vec::new());
        for (machine, turned) in angles.iter().enumerate() {
            let run = run_through_gap(orbit, &without, *turned, missing)?;
            let angle = (orbit.scene.excitation.reduced_phase() + turned).rem_euclid(TAU);
            machines.push(LoweredMachine::new(&orbit.scene.clone().at_phase(angle)?));
            motions.push(TestedMotion {
                member: Member::new(machine, run.motion.state()),
                angle,
                time: turned / TAU + run.periods as f64,
                period: orbit.scene.period(),
                strokes: run.strokes,
            });
        }
        let tested = basin_test.follow_motions::<true>(&machines, motions, &|_| false, monitor)?;
        let gap = |tested: &TestedMotion| StripGap {
            angle: tested.angle,
            comes_back: tested.reaches_orbit(),
            missed: tested.strokes.missed_strokes(tested.time),
        };
        Ok::<_, OrbitError>(tested.iter().map(gap).collect::<Vec<_>>())
    });
    Ok(StripSurvival {
        missing,
        gaps: gaps?.concat(),
    })
}

/// Follows the motion of an orbit through a gap of missing strips, from where the drive has turned by `turned` rad since the
/// orbit's time 0 to the end of the drive period in which strips are there again.
fn run_through_gap(
    orbit: &Orbit,
    without: &CheckedScene,
    turned: f64,
    missing: u32,
) -> Result<InterruptedMotion, MotionError> {
    let scene = &orbit.scene;
    let clock = scene.clock();
    let before = orbit
        .timed_impacts()
        .last()
        .map_or(0.0, |last| last.0 / clock.period());
    let mut run = InterruptedMotion {
        motion: scene.motion(orbit.state().into())?,
        clearance: scene.clearance,
        begin: clock.instant(turned / scene.excitation.frequency),
        periods: 0,
        strokes: StrokeCount::after_impact(before - orbit.periods as f64),
    };
    run.count_strokes(run.begin, false)?;
    run.switch_strips(without)?;
    while run.periods < u64::from(missing) {
        run.advance_period(false)?;
    }
    run.switch_strips(scene)?;
    run.advance_period(false)?;
    Ok(run)
}

/// Most drive periods for which strips wait to change until the mass is before the clearance.
const MAX_PERIODS_BEYOND: u64 = 16;

/// A motion of an orbit through a gap of missing strips, with its strokes counted.
struct InterruptedMotion {
    motion: Motion,
    clearance: f64,
    /// The instant at which the gap begins.
    begin: Instant,
    /// Drive periods that are complete since then.
    periods: u64,
    /// Its strokes, by times since the orbit's time 0.
    strokes: StrokeCount,
}

impl InterruptedMotion {
    /// Goes on with a scene with or without strips from where the mass is clear of them.
    fn switch_strips(&mut self, to: &CheckedScene) -> Result<(), MotionError> {
        let last = self.periods + MAX_PERIODS_BEYOND;
        while self.motion.state().position >= self.clearance && self.periods < last {
            if self.advance_period(true)? {
                break;
            }
        }
        self.motion = Motion::new(to, self.motion.now(), self.motion.state())?;
        Ok(())
    }

    /// Advances by a drive period; if it `stops`, only to where the mass leaves strip or stop: true then.
    fn advance_period(&mut self, stops: bool) -> Result<bool, MotionError> {
        let cycles = self.begin.cycles + (self.periods + 1) as f64;
        let left = self.count_strokes(
            Instant {
                cycles,
                ..self.begin
            },
            stops,
        )?;
        self.periods += u64::from(!left);
        Ok(left)
    }

    /// Advances to an instant, counting missed strokes; if it `stops`, only to where the mass leaves strip or stop: true then.
    fn count_strokes(&mut self, until: Instant, stops: bool) -> Result<bool, MotionError> {
        let mut watch = StrokeObserver {
            clearance: self.clearance,
            period: self.motion.clock().period(),
            strokes: &mut self.strokes,
            stops,
            left: false,
        };
        Ok(self.motion.watch(until, &mut watch)?.is_break())
    }
}
