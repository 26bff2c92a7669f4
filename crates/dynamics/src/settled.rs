//! What motions have come to, each of a machine of its own: many are followed together in the lanes, first unwatched,
//! then watched, and looked at after that.
//!
//! ```
//! use softstop::{Ratios, Start};
//! use softstop_dynamics::settled::Settling;
//! use softstop_dynamics::watch::unwatched;
//!
//! let scene = Ratios::unloaded().scene()?;
//! let starts = [Start::REST, Start::new(0.0, 14.0)];
//! let seen = Settling::default().follow(&starts.map(|start| (&scene, start)), &unwatched);
//! let seen = seen.unwrap_or_default();
//! let regimes = seen.iter().map(|seen| Some(seen.as_ref().ok()?.regime()?.to_string()));
//! assert_eq!(regimes.collect::<Vec<_>>(), [Some("0".to_owned()), Some("1".to_owned())]);
//! # Ok::<(), softstop::SceneError>(())
//! ```

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use crate::attractors::Region;
use crate::batch::follow;
use crate::motion::MotionKind;
use crate::orbit::recurrence::settles_on;
use crate::orbit::{ImpactPattern, Regime, StroboscopicMap};
use crate::watch::Watcher;
use softstop::{Instant, MotionError, Scene, Start};
use softstop_lanes::{Job, Machine, Watch};

/// ln of a hundredfold growth.
const MUCH: f64 = 4.605_170_185_988_092;
/// Distance within which a state has returned unless it is said otherwise.
pub(crate) const RETURN: f64 = 1e-4;

/// How motions are followed, and looked at.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Settling {
    /// Drive periods, all together.
    pub periods: u64,
    /// The last of them, in which they are looked at: a period of up to half as many is told.
    pub watched: u64,
    /// Distance within which a state has returned, in units of the motion's size.
    pub tolerance: f64,
}

impl Default for Settling {
    fn default() -> Self {
        Self {
            periods: 500,
            watched: 64,
            tolerance: RETURN,
        }
    }
}

impl Settling {
    /// Follows a motion of each scene from its start; an error where the scene or the start cannot be, or the motion
    /// cannot be computed. Nothing if the watcher, which is not told how much is done, wants to stop.
    pub fn follow(
        &self,
        motions: &[(&Scene, Start)],
        watcher: Watcher<'_>,
    ) -> Option<Vec<Result<Seen, MotionError>>> {
        let (mut machines, mut starts) = (Vec::new(), Vec::new());
        let lowered: Vec<Result<(), MotionError>> = motions
            .iter()
            .map(|(scene, start)| {
                start.validate()?;
                let machine = Machine::new(scene)?;
                starts.push((machines.len(), *start));
                machines.push(machine);
                Ok(())
            })
            .collect();
        let settling = self.periods - self.watched;
        let records = watched(&machines, &starts, settling, self.watched, || watcher(0, 0))?;
        let mut records = records.into_iter();
        let seen = lowered.into_iter().zip(motions).map(|(lowered, motion)| {
            lowered?;
            let record = records.next().unwrap_or(Ok(Record::new(Start::REST)))?;
            let frequency = motion.0.excitation.frequency;
            Ok(Seen::of(frequency, record, self.tolerance))
        });
        Some(seen.collect())
    }

    /// The share of so many starts, spread evenly over a region, that lead to z = 1; what cannot be computed does not.
    /// Without a region it is the box of the scene's own size that commands take starts from. Nothing if the scene is
    /// invalid, or the watcher wants to stop.
    pub fn certainty(
        &self,
        scene: &Scene,
        starts: usize,
        region: Option<Region>,
        watcher: Watcher<'_>,
    ) -> Option<f64> {
        let machine = [Machine::new(scene).ok()?];
        let region = region.unwrap_or_else(|| Region::box_with(scene, []));
        let starts = region.starts(starts, 0).into_iter();
        let starts: Vec<(usize, Start)> = starts.map(|start| (0, start)).collect();
        let settling = self.periods - self.watched;
        let records = watched(&machine, &starts, settling, self.watched, || watcher(0, 0))?;
        let frequency = scene.excitation.frequency;
        let regime = |record| Seen::of(frequency, record, self.tolerance).regime();
        let regimes = records.into_iter().flatten().map(regime);
        let come = regimes.filter(|regime| *regime == Some(Regime::ONE));
        Some(come.count() as f64 / starts.len() as f64)
    }
}

/// What a motion has come to.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Seen {
    /// Drive periods after which it returns, if it does.
    pub periods: Option<u64>,
    /// Before-impact velocities in m/s, ascending: of one period of what returns, else of all watched drive
    /// periods.
    pub velocities: Vec<f64>,
    /// State at drive angle phi, a period of what returns before the end, else where it was first watched.
    pub from: Start,
    /// State at the end, at drive angle phi.
    pub end: Start,
    /// When the impacts of these velocities were, counted from there.
    instants: Vec<Instant>,
    /// Drive periods from there to the end.
    length: u64,
}

impl Seen {
    pub(crate) fn of(frequency: f64, record: Record, tolerance: f64) -> Self {
        let Record { states, impacts } = record;
        let watched = states.len() - 1;
        let found = settles_on(frequency, &states, tolerance);
        let length = found.unwrap_or(watched);
        let first = (watched - length) as f64;
        let own = || {
            impacts
                .iter()
                .filter(|(instant, _)| instant.cycles >= first)
        };
        let mut velocities: Vec<f64> = own().map(|(_, velocity)| *velocity).collect();
        velocities.sort_by(f64::total_cmp);
        let since = |(instant, _): &(Instant, f64)| Instant {
            cycles: instant.cycles - first,
            ..*instant
        };
        Self {
            periods: found.map(|periods| periods as u64),
            velocities,
            from: states[watched - length],
            end: states[watched],
            instants: own().map(since).collect(),
            length: length as u64,
        }
    }

    /// The regime z = p/n of what returns; of complete chatter the impacts before the summed ones count.
    pub fn regime(&self) -> Option<Regime> {
        Some(Regime {
            impacts: self.instants.len() as u64,
            periods: self.periods?,
        })
    }

    /// Mean number of impacts per drive period: p/n of what returns, else over the watched periods.
    pub fn impacts_per_period(&self) -> f64 {
        self.instants.len() as f64 / self.length as f64
    }

    /// Largest before-impact velocity in m/s; 0 without impacts.
    pub fn hardest(&self) -> f64 {
        self.velocities.last().copied().unwrap_or(0.0)
    }

    /// The map over the drive periods that it was looked at, for what takes more than a look.
    ///
    /// # Errors
    /// [`MotionError::Scene`] if the scene is invalid.
    pub fn map(&self, scene: &Scene) -> Result<StroboscopicMap, MotionError> {
        StroboscopicMap::new(scene, self.length)
    }

    /// The motion that returns, with the order of its impacts; none if it does not.
    ///
    /// # Errors
    /// [`MotionError`] if it cannot be computed.
    pub fn returning(
        &self,
        scene: &Scene,
        map: &StroboscopicMap,
    ) -> Result<Option<MotionKind>, MotionError> {
        let Some(regime) = self.regime() else {
            return Ok(None);
        };
        // Nothing chatters where nothing rebounds from a face.
        let rests = match scene.wall() {
            Some(_) => map.apply(self.from.into())?.rests,
            None => Vec::new(),
        };
        let order = ImpactPattern::new(&self.instants, &rests, self.length, scene.period());
        Ok(Some(MotionKind::repeating(regime, order)))
    }

    /// What it is: chaos if it does not return and small differences have grown more than a hundredfold; and their
    /// growth then, ln of the tangent's norm per drive period.
    ///
    /// # Errors
    /// [`MotionError`] if it cannot be computed.
    pub fn motion(
        &self,
        scene: &Scene,
        map: &StroboscopicMap,
    ) -> Result<(MotionKind, Option<f64>), MotionError> {
        if let Some(motion) = self.returning(scene, map)? {
            return Ok((motion, None));
        }
        let growth = map.apply(self.from.into())?.monodromy.norm().ln();
        let motion = match growth > MUCH {
            true => MotionKind::Chaos,
            false => MotionKind::Unsettled,
        };
        Ok((motion, Some(growth / self.length as f64)))
    }

    /// Largest position in m meanwhile.
    ///
    /// # Errors
    /// [`MotionError`] if it cannot be computed.
    pub fn max_position(&self, map: &StroboscopicMap) -> Result<f64, MotionError> {
        map.max_position(self.from.into())
    }
}

/// Follows motions, each of the machine with this number from a state, first unwatched, then watched; none if they were
/// stopped on the way.
pub(crate) fn watched(
    machines: &[Machine],
    starts: &[(usize, Start)],
    settling: u64,
    watched: u64,
    ask: impl Fn() -> ControlFlow<()>,
) -> Option<Vec<Result<Record, MotionError>>> {
    let job = |(machine, start): &(usize, Start)| Job {
        machine: *machine,
        start: *start,
        periods: settling,
    };
    let mut jobs: Vec<Job> = starts.iter().map(job).collect();
    let settled = follow(machines, &jobs, &mut (), &ask)?;
    for (job, outcome) in jobs.iter_mut().zip(&settled) {
        job.start = outcome.end;
        job.periods = watched;
    }
    let mut log = Log {
        records: jobs.iter().map(|job| Record::new(job.start)).collect(),
    };
    let outcomes = follow(machines, &jobs, &mut log, &ask)?;
    let errors = settled.into_iter().zip(outcomes);
    let errors = errors.map(|(settled, outcome)| settled.error.or(outcome.error));
    let records = log.records.into_iter().zip(errors);
    let records = records.map(|(record, error)| error.map_or(Ok(record), Err));
    Some(records.collect())
}

/// What is seen of one motion.
#[derive(Debug, Clone)]
pub(crate) struct Record {
    /// States at drive angle phi: that at the beginning, and one after each drive period.
    pub states: Vec<Start>,
    /// When, from the beginning on, and before-impact velocity in m/s of each impact.
    pub impacts: Vec<(Instant, f64)>,
}

impl Record {
    fn new(start: Start) -> Self {
        Self {
            states: vec![start],
            impacts: Vec::new(),
        }
    }
}

/// Keeps records.
struct Log {
    records: Vec<Record>,
}

impl Watch for Log {
    const IMPACTS: bool = true;
    const PERIODS: bool = true;

    fn impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        let instant = Instant {
            cycles: cycle as f64,
            offset,
        };
        self.records[job].impacts.push((instant, velocity));
    }

    fn period(&mut self, job: usize, _: u64, state: Start) {
        self.records[job].states.push(state);
    }
}
