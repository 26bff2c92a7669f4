//! What a motion has come to at the end of a step.

use serde::{Deserialize, Serialize};

use crate::orbit::recurrence::settles_on;
use crate::orbit::{ImpactPattern, Regime, StroboscopicMap};
use softstop::error::MotionError;
use softstop::integrator::{Instant, Start};
use softstop::scene::Scene;
use softstop_lanes::Watch;

/// The kind of motion at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Settled {
    /// It returns: z = p/n.
    Periodic(Regime),
    /// It does not return, and small differences have grown more than a hundredfold.
    Chaotic {
        /// Mean growth of small differences: ln of the tangent's norm per drive period.
        growth: f64,
    },
    /// It does not return, for it settles too slowly, goes somewhere else just now, or is quasi-periodic.
    Unsettled {
        /// Mean growth of small differences: ln of the tangent's norm per drive period.
        growth: f64,
    },
}

/// ln of a hundredfold growth.
const MUCH: f64 = 4.605_170_185_988_092;

impl Settled {
    /// The regime, if it returns.
    pub fn regime(&self) -> Option<Regime> {
        match self {
            Self::Periodic(regime) => Some(*regime),
            _ => None,
        }
    }

    /// True if it neither returns nor is chaotic.
    pub fn is_unsettled(&self) -> bool {
        matches!(self, Self::Unsettled { .. })
    }

    /// True if both are of one kind: the same regime, or chaos.
    pub fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Periodic(a), Self::Periodic(b)) => a == b,
            (Self::Chaotic { .. }, Self::Chaotic { .. }) => true,
            (Self::Unsettled { .. }, Self::Unsettled { .. }) => true,
            _ => false,
        }
    }
}

/// One step of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Step {
    /// The parameter's value.
    pub value: f64,
    /// What the motion has come to.
    pub settled: Settled,
    /// The order of its impacts, if it returns after several drive periods.
    pub order: Option<ImpactPattern>,
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
        let frequency = scene.excitation.frequency;
        let found = settles_on(frequency, states, tolerance);
        let periods = found.unwrap_or(watched);
        let first = (watched - periods) as f64;
        let own = impacts
            .iter()
            .filter(|(instant, _)| instant.cycles >= first);
        let mut velocities: Vec<f64> = own.clone().map(|(_, velocity)| *velocity).collect();
        let order = found.filter(|periods| *periods > 1).map(|periods| {
            let since = |(instant, _): &(Instant, f64)| Instant {
                cycles: instant.cycles - first,
                ..*instant
            };
            let instants: Vec<Instant> = own.map(since).collect();
            ImpactPattern::new(&instants, &[], periods as u64, scene.period())
        });
        velocities.sort_by(f64::total_cmp);
        let regime = Regime {
            impacts: velocities.len() as u64,
            periods: periods as u64,
        };
        let map = StroboscopicMap::new(scene, periods as u64)?;
        let from = states[watched - periods];
        let settled = match found {
            Some(_) => Settled::Periodic(regime),
            None => restless(&map, from, watched)?,
        };
        Ok(Self {
            value,
            settled,
            order,
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
}

/// Chaotic or not: by how much small differences grow along the motion from a state.
fn restless(map: &StroboscopicMap, from: Start, watched: usize) -> Result<Settled, MotionError> {
    let tangent = map.apply(from.into())?.monodromy;
    let growth = tangent.norm().ln();
    let per_period = growth / watched as f64;
    Ok(if growth > MUCH {
        Settled::Chaotic { growth: per_period }
    } else {
        Settled::Unsettled { growth: per_period }
    })
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
