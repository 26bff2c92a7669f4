//! Running up: ways to bring a machine into its motion with impacts, each tried: in the hysteresis zone the machine may
//! as well stay without impacts, and which of the two it does depends on how it came there.

mod try_way;
mod way;

use std::fmt::{self, Display, Formatter};

use serde::{Deserialize, Serialize};

use crate::basin::BasinTest;
use crate::cycle_metrics::peak_stop_force;
use crate::monitor::Monitor;
use crate::motion_kind::MotionKind;
use crate::orbit::{Orbit, OrbitError, StroboscopicMap};
use crate::parallel;
use softstop::{CheckedScene, MotionError, Parameter, Start};

use try_way::try_way;
pub use way::Way;

/// Number of steps in which a slow way to run up changes its parameter.
const RUN_UP_STEPS: usize = 256;
/// Drive periods of each step of a slow way to run up.
const STEP_PERIODS: u64 = 64;

/// Settings of running up: which ways are tried, how fast a ramp is, and which force is allowed.
#[derive(Debug, Clone, PartialEq)]
pub struct RunUpSettings {
    /// The ways that are tried.
    pub ways: Vec<Way>,
    /// Change of the drive's frequency in rad/s from each drive period to the next, in steps of several periods where these are
    /// more than 16,384; none, or one that is not positive, for a slow way.
    pub ramp: Option<f64>,
    /// Largest force in N at the stop that is allowed on the way.
    pub most_force: Option<f64>,
    /// Whether forces and positions on the way are computed even if none is bounded.
    pub with_peaks: bool,
}

impl Default for RunUpSettings {
    /// Settings for running up slowly by all ways with the drive's own amplitude, with any force.
    fn default() -> Self {
        Self {
            ways: Way::BY_OWN_DRIVE.to_vec(),
            ramp: None,
            most_force: None,
            with_peaks: false,
        }
    }
}

impl RunUpSettings {
    /// True if forces and positions on the ways are computed.
    fn computes_peaks(&self) -> bool {
        self.with_peaks || self.most_force.is_some()
    }

    /// Number of steps in which a way to run up changes a parameter from `low` to `high`, and drive periods of each.
    fn sweep_steps(&self, parameter: Parameter, (low, high): (f64, f64)) -> (usize, u64) {
        let ramp = self.ramp.filter(|rate| *rate > 0.0);
        match ramp.filter(|_| parameter == Parameter::Frequency) {
            Some(rate) => {
                let changes = (high - low) / rate;
                let most_steps = (RUN_UP_STEPS as u64 * STEP_PERIODS) as f64;
                let each = (changes / most_steps).ceil().max(1.0);
                ((changes / each).ceil() as usize + 1, each as u64)
            }
            None => (RUN_UP_STEPS, STEP_PERIODS),
        }
    }
}

/// An attempt to run up by one way, with the motion in which it ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Attempt {
    /// The way that was tried.
    pub way: Way,
    /// Share of the runs that end on the motion, of angles at which the drive is switched on; of a slow way 0 or 1.
    pub share: f64,
    /// Drive angle in rad in the middle of the widest range of those at which the drive may be switched on.
    pub angle: Option<f64>,
    /// Value at which a slow way begins, in SI units of what changes on it.
    pub from: Option<f64>,
    /// The motion in which a slow way ends, if it comes to its end.
    pub ends: Option<MotionKind>,
    /// Value at which a slow way that does not lead there showed z = 1 last, in SI units; none if it never did.
    pub lost: Option<f64>,
    /// Drive periods that the way takes; none where the drive is switched on at once.
    pub periods: Option<u64>,
    /// The largest values of all runs on the way and in 64 drive periods after it, if they were computed.
    pub peaks: Option<RunUpPeaks>,
}

/// The largest values on a way to run up.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct RunUpPeaks {
    /// Largest contact force in N while the stop is touched; infinite if a rigid one is struck.
    pub stop_force: f64,
    /// Largest position in m.
    pub highest: f64,
}

impl RunUpPeaks {
    /// Advances a motion on a way to run up by some drive periods, raises the peaks to its largest values, and returns its state.
    fn take_peaks(
        &mut self,
        scene: &CheckedScene,
        start: Start,
        periods: u64,
    ) -> Result<Start, MotionError> {
        let motion = StroboscopicMap::new(scene, periods).trajectory(start.into())?;
        let force = peak_stop_force(&motion);
        self.stop_force = self.stop_force.max(force);
        self.highest = self.highest.max(motion.max_position());
        Ok(motion.end)
    }
}

/// The attempts to run a machine up into a stable motion, by all ways that were tried.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct RunUp {
    /// The attempts, in the order in which they were asked for; without ways that a machine lacks or that cannot be computed.
    pub ways: Vec<Attempt>,
    /// Largest force in N at the stop that is allowed on the way.
    pub most_force: Option<f64>,
}

impl RunUp {
    /// Tries ways to run up into the stable motion of an orbit; where the drive is switched on at once, at so many drive angles.
    ///
    /// # Errors
    /// [`OrbitError::Motion`] if the motion cannot be computed; [`OrbitError::Stopped`].
    pub fn of(
        orbit: &Orbit,
        settings: &RunUpSettings,
        angles: usize,
        monitor: Monitor<'_>,
    ) -> Result<Self, OrbitError> {
        let basin_test = BasinTest::of(orbit)?;
        let tried = parallel::try_map(&settings.ways, |way| {
            match try_way(orbit, &basin_test, (settings, *way, angles), monitor) {
                Err(OrbitError::Motion(_)) => Ok(None),
                tried => tried,
            }
        })?;
        Ok(Self {
            ways: tried.into_iter().flatten().collect(),
            most_force: settings.most_force,
        })
    }

    /// True if some way works, as [`RunUp::working_ways`] says: once one does, no other is begun. False if none does, and if the
    /// monitor says stop.
    ///
    /// # Errors
    /// [`OrbitError::Motion`] if the motion of the orbit cannot be computed.
    pub fn is_possible(
        orbit: &Orbit,
        settings: &RunUpSettings,
        angles: usize,
        monitor: Monitor<'_>,
    ) -> Result<bool, OrbitError> {
        let basin_test = BasinTest::of(orbit)?;
        let works = |way: &Way| {
            let attempt = try_way(orbit, &basin_test, (settings, *way, angles), monitor);
            let of_one_way = Self {
                ways: attempt.ok().flatten().into_iter().collect(),
                most_force: settings.most_force,
            };
            match of_one_way.working_ways().next() {
                Some(_) => Err(()),
                None => Ok(()),
            }
        };
        Ok(parallel::try_map(&settings.ways, works).is_err())
    }

    /// The attempts by ways that lead to the motion for sure, with no more force than is allowed.
    pub fn working_ways(&self) -> impl Iterator<Item = &Attempt> {
        let all = self.ways.iter().filter(|attempt| attempt.share == 1.0);
        all.filter(|attempt| self.is_gentle(attempt))
    }

    /// True if the force at the stop in an attempt to run up is no larger than allowed.
    pub fn is_gentle(&self, attempt: &Attempt) -> bool {
        let within = |most: f64| attempt.peaks.is_some_and(|it| it.stop_force <= most);
        self.most_force.is_none_or(within)
    }
}

impl Display for RunUp {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let mut works = self.working_ways().map(|attempt| attempt.way.name());
        match works.next() {
            Some(first) => {
                write!(f, "the motion is reached by {first}")?;
                works.try_for_each(|way| write!(f, ", or by {way}"))?;
            }
            None => f.write_str("no way that was tried reaches the motion for sure as asked")?,
        }
        let mut some = self
            .ways
            .iter()
            .filter(|it| it.share > 0.0 && it.share < 1.0);
        some.try_for_each(|it| {
            let percent = 100.0 * it.share;
            write!(
                f,
                "; {} does so at {percent:.0} % of the drive angles",
                it.way.name()
            )
        })
    }
}
