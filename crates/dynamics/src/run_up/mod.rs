//! Ways to bring a machine into its motion with impacts, each tried: in the hysteresis zone the machine may as well
//! stay without impacts, and which of the two it does depends on how it came there.

mod way;

use std::f64::consts::TAU;
use std::fmt::{self, Display, Formatter};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::basin::{BasinTest, at_section};
use crate::cycle_metrics::{AT_STOP, largest_force};
use crate::monitor::{Monitor, stop_if};
use crate::motion::MotionKind;
use crate::orbit::{Orbit, OrbitError, Regime, StroboscopicMap};
use crate::sweep::{Chain, Plan};
use softstop::{Machine, MotionError, Parameter, Scene, Start};

pub use way::Way;

/// Steps of a slow way, drive periods of each, and the distance within which a state has returned in them, in units of
/// the motion's size.
const SLOW_STEPS: usize = 256;
const STEP_PERIODS: u64 = 64;
const SLOW_RETURN: f64 = 1e-2;

/// Which ways are tried, and what is asked of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Those that are tried.
    pub ways: Vec<Way>,
    /// Change of the drive's frequency in rad/s from each drive period to the next; none for a slow one, which is what a
    /// still slower rate is taken for.
    pub ramp: Option<f64>,
    /// Largest force in N at the stop that is allowed on the way.
    pub most_force: Option<f64>,
    /// Whether forces and positions on the way are computed even if none is bounded.
    pub with_peaks: bool,
}

impl Default for Settings {
    /// Slow ways by the drive's own amplitude, with any force.
    fn default() -> Self {
        Self {
            ways: Way::BY_OWN_DRIVE.to_vec(),
            ramp: None,
            most_force: None,
            with_peaks: false,
        }
    }
}

impl Settings {
    fn has_peaks(&self) -> bool {
        self.with_peaks || self.most_force.is_some()
    }

    /// Values of a parameter on the way, and drive periods of each.
    fn steps(&self, parameter: Parameter, (low, high): (f64, f64)) -> (usize, u64) {
        let slow = (SLOW_STEPS, STEP_PERIODS);
        let periods = self.ramp.map(|rate| ((high - low) / rate).ceil() + 1.0);
        match periods.filter(|_| parameter == Parameter::Frequency) {
            Some(periods) if periods < (SLOW_STEPS as u64 * STEP_PERIODS) as f64 => {
                (periods as usize, 1)
            }
            _ => slow,
        }
    }
}

/// What came of a way.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Attempt {
    /// Which way.
    pub way: Way,
    /// Share of the runs that end on the motion: of the drive angles at which the drive is switched on; of a slow way 0
    /// or 1.
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
    pub peaks: Option<Peaks>,
}

/// The largest values on a way.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Peaks {
    /// Force of contact in N while the stop is touched.
    pub stop_force: f64,
    /// Position in m.
    pub highest: f64,
}

impl Peaks {
    /// Goes on with some periods; the state after them.
    fn take(&mut self, scene: &Scene, start: Start, periods: u64) -> Result<Start, MotionError> {
        let motion = StroboscopicMap::new(scene, periods)?.trajectory(start.into())?;
        let force = largest_force(scene, &motion, AT_STOP);
        self.stop_force = self.stop_force.max(force);
        self.highest = self.highest.max(motion.max_position());
        Ok(motion.end.into())
    }
}

/// All ways that were tried.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct RunUp {
    /// They, in the order in which they were asked for; those that a machine does not have are left out.
    pub ways: Vec<Attempt>,
    /// Largest force in N at the stop that is allowed on the way.
    pub most_force: Option<f64>,
}

impl RunUp {
    /// Tries ways into a stable motion; the drive is switched on at so many drive angles.
    ///
    /// # Errors
    /// [`OrbitError::Motion`] if the motion cannot be computed; [`OrbitError::Stopped`].
    pub fn of(
        orbit: &Orbit,
        settings: &Settings,
        angles: usize,
        monitor: Monitor<'_>,
    ) -> Result<Self, OrbitError> {
        let basin_test = BasinTest::of(orbit)?;
        let tried = settings.ways.par_iter().map(|way| match way {
            Way::SwitchedOn => {
                switched_on(orbit, &basin_test, (settings, angles), monitor).map(Some)
            }
            _ => changed(orbit, &basin_test, (settings, *way), monitor),
        });
        let tried = tried.collect::<Result<Vec<Option<Attempt>>, OrbitError>>()?;
        Ok(Self {
            ways: tried.into_iter().flatten().collect(),
            most_force: settings.most_force,
        })
    }

    /// The ways that lead to the motion for sure, with no more force than is allowed.
    pub fn works(&self) -> impl Iterator<Item = &Attempt> {
        let all = self.ways.iter().filter(|attempt| attempt.share == 1.0);
        all.filter(|attempt| self.is_gentle(attempt))
    }

    /// True if the stop is pressed no harder on a way than is allowed.
    pub fn is_gentle(&self, attempt: &Attempt) -> bool {
        let within = |most: f64| attempt.peaks.is_some_and(|it| it.stop_force <= most);
        self.most_force.is_none_or(within)
    }

    /// What came of one way.
    pub fn by(&self, way: Way) -> Option<&Attempt> {
        self.ways.iter().find(|attempt| attempt.way == way)
    }
}

impl Display for RunUp {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let mut works = self.works().map(|attempt| attempt.way.name());
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

/// Where the mass is before the drive runs: at the suspension's rest, or at the face of a stop that stands before it.
fn at_rest(scene: &Scene) -> Start {
    let below = scene.below.as_ref();
    let lowest = below.map_or(f64::NEG_INFINITY, |below| -below.clearance);
    Start::new(scene.clearance.min(0.0).max(lowest), 0.0)
}

fn switched_on(
    orbit: &Orbit,
    basin_test: &BasinTest,
    (settings, angles): (&Settings, usize),
    monitor: Monitor<'_>,
) -> Result<Attempt, OrbitError> {
    let (scene, rest) = (&orbit.scene, at_rest(&orbit.scene));
    let (phases, angles) = (scene.phases().into(), angles.max(1));
    let angles: Vec<f64> = (0..angles)
        .map(|index| TAU * index as f64 / angles as f64)
        .collect();
    let states = angles.iter();
    let states = states.map(|angle| at_section(&phases, scene.excitation, rest, *angle));
    let states = states.collect::<Result<Vec<Start>, _>>()?;
    let reached = basin_test.reached(&states, monitor)?;
    let peaks = || {
        let mut peaks = Peaks::default();
        for state in states {
            peaks.take(scene, state, STEP_PERIODS)?;
        }
        Ok::<_, MotionError>(peaks)
    };
    let all = reached.iter().filter(|reached| **reached).count();
    Ok(Attempt {
        way: Way::SwitchedOn,
        share: all as f64 / angles.len() as f64,
        angle: middle(&reached).map(|place| (TAU * place / angles.len() as f64).rem_euclid(TAU)),
        from: None,
        ends: None,
        lost: None,
        periods: None,
        peaks: settings.has_peaks().then(peaks).transpose()?,
    })
}

/// The middle of the longest row of those that are true on a circle, the first one of equals.
fn middle(circle: &[bool]) -> Option<f64> {
    let count = circle.len();
    let row = |first: usize| {
        let row = (0..count).take_while(|further| circle[(first + further) % count]);
        (row.count(), first)
    };
    let longest = (0..count)
        .map(row)
        .max_by_key(|(length, first)| (*length, count - first))?;
    let (length, first) = longest;
    (length > 0).then_some(first as f64 + 0.5 * (length as f64 - 1.0))
}

fn changed(
    orbit: &Orbit,
    basin_test: &BasinTest,
    (settings, way): (&Settings, Way),
    monitor: Monitor<'_>,
) -> Result<Option<Attempt>, OrbitError> {
    let scene = &orbit.scene;
    let Some((parameter, from, direction)) = way.change(scene) else {
        return Ok(None);
    };
    let Some(at_work) = parameter.get(scene) else {
        return Ok(None);
    };
    let mut followers = scene.followers.parameters();
    if followers.any(|it| it == parameter) {
        return Ok(None);
    }
    let range = (from.min(at_work), from.max(at_work));
    let (steps, periods) = settings.steps(parameter, range);
    let Ok(plan) = Plan::new(parameter, range, steps, periods) else {
        return Ok(None);
    };
    let plan = Plan {
        tolerance: SLOW_RETURN,
        heights: false,
        start: at_rest(scene),
        ..plan
    };
    let mut chains = [Chain::new(scene.clone(), direction)];
    if !plan.run(&mut chains, &|_, _| stop_if(monitor(0, 0).is_break())) {
        return Err(OrbitError::Stopped);
    }
    let [chain] = chains;
    let last = chain.steps.last().filter(|_| chain.error.is_none());
    let reached = match last {
        Some(last) => basin_test.reached(&[last.end], monitor)?[0],
        None => false,
    };
    let peaks = || {
        let (mut peaks, mut state) = (Peaks::default(), plan.start);
        for step in 0..steps {
            let mut machine = Machine::from(scene.clone());
            machine.set(parameter, plan.value(step, direction));
            state = peaks.take(&machine.scene, state, periods)?;
            OrbitError::ask(monitor)?;
        }
        peaks.take(scene, state, STEP_PERIODS)?;
        Ok::<_, OrbitError>(peaks)
    };
    let is_one = |motion: &MotionKind| motion.regime() == Some(Regime::ONE);
    let mut ones = chain.steps.iter().rev().filter(|step| is_one(&step.motion));
    Ok(Some(Attempt {
        way,
        share: f64::from(u8::from(reached)),
        angle: None,
        from: Some(from),
        ends: last.map(|last| last.motion.clone()),
        lost: ones.next().map(|step| step.value).filter(|_| !reached),
        periods: Some(steps as u64 * periods),
        // A way that cannot be computed to its end has none.
        peaks: settings.has_peaks().then(peaks).and_then(Result::ok),
    }))
}
