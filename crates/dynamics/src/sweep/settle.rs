//! What a motion has come to at the end of a step.

use serde::{Deserialize, Serialize};

use crate::motion::MotionKind;
use crate::orbit::recurrence::settles_on;
use crate::orbit::{ImpactPattern, Regime, StroboscopicMap};
use softstop::{Instant, MotionError, Scene, Start};
use softstop_lanes::Watch;

/// ln of a hundredfold growth.
const MUCH: f64 = 4.605_170_185_988_092;

/// One step of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Step {
    /// The parameter's value.
    pub value: f64,
    /// What the motion has come to: chaos if small differences have grown more than a hundredfold.
    pub motion: MotionKind,
    /// Mean growth of small differences, unless it returns: ln of the tangent's norm per drive period.
    pub growth: Option<f64>,
    /// Mean number of impacts per drive period: p/n of what returns, else over the watched periods.
    pub impacts_per_period: f64,
    /// Before-impact velocities in m/s, ascending: of one period of what returns, else of all watched drive
    /// periods.
    pub velocities: Vec<f64>,
    /// Largest position in m meanwhile.
    pub max_position: f64,
    /// State at its end, at drive angle phi: the start of the next step.
    pub end: Start,
}

impl Step {
    pub(super) fn new(
        value: f64,
        scene: &Scene,
        record: &Record,
        tolerance: f64,
    ) -> Result<Self, MotionError> {
        let Record { states, impacts } = record;
        let watched = states.len() - 1;
        let found = settles_on(scene.excitation.frequency, states, tolerance);
        let periods = found.unwrap_or(watched);
        let first = (watched - periods) as f64;
        let impacts = impacts.iter();
        let own = impacts.filter(|(instant, _)| instant.cycles >= first);
        let mut velocities: Vec<f64> = own.clone().map(|(_, velocity)| *velocity).collect();
        velocities.sort_by(f64::total_cmp);
        let regime = Regime {
            impacts: velocities.len() as u64,
            periods: periods as u64,
        };
        let map = StroboscopicMap::new(scene, periods as u64)?;
        let from = states[watched - periods];
        let (motion, growth) = match found {
            Some(_) => {
                let since = |(instant, _): &(Instant, f64)| Instant {
                    cycles: instant.cycles - first,
                    ..*instant
                };
                let instants: Vec<Instant> = own.map(since).collect();
                // Nothing chatters where nothing rebounds from a face.
                let rests = match scene.wall() {
                    Some(_) => map.apply(from.into())?.rests,
                    None => Vec::new(),
                };
                let order = ImpactPattern::new(&instants, &rests, regime.periods, scene.period());
                (MotionKind::repeating(regime, order), None)
            }
            None => {
                let growth = map.apply(from.into())?.monodromy.norm().ln();
                let motion = match growth > MUCH {
                    true => MotionKind::Chaos,
                    false => MotionKind::Unsettled,
                };
                (motion, Some(growth / watched as f64))
            }
        };
        Ok(Self {
            value,
            motion,
            growth,
            impacts_per_period: regime.impacts as f64 / periods as f64,
            velocities,
            max_position: map.max_position(from.into())?,
            end: states[watched],
        })
    }

    /// Largest before-impact velocity in m/s; 0 without impacts.
    pub fn hardest(&self) -> f64 {
        self.velocities.last().copied().unwrap_or(0.0)
    }

    /// True if it returns, or is chaotic.
    pub fn is_settled(&self) -> bool {
        self.motion != MotionKind::Unsettled
    }
}

/// What is seen of one motion.
pub(super) struct Record {
    /// States at drive angle phi: that at the beginning, and one after each drive period.
    pub states: Vec<Start>,
    /// When, from the beginning on, and before-impact velocity in m/s of each impact.
    pub impacts: Vec<(Instant, f64)>,
}

/// Keeps records.
pub(super) struct Log {
    pub records: Vec<Record>,
}

impl Log {
    pub fn new(starts: impl Iterator<Item = Start>) -> Self {
        let record = |start| Record {
            states: vec![start],
            impacts: Vec::new(),
        };
        Self {
            records: starts.map(record).collect(),
        }
    }
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
