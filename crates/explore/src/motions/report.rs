//! What `softstop motions` reports.

use std::collections::BTreeMap;

use serde::Serialize;
use softstop::{Machine, Scene};
use softstop_dynamics::attractors::{Attractor, Chaos, Kind, Options, Survey};
use softstop_dynamics::orbit::{Exponents, Orbit};

use softstop_console::arguments::title;
use softstop_console::report::{Multiplier, units};

/// All motions of a machine.
#[derive(Debug, Clone, Serialize)]
pub struct MotionsReport {
    /// The machine's name.
    pub machine: String,
    /// Its units.
    pub units: BTreeMap<&'static str, &'static str>,
    /// The machine, SI units.
    pub scene: Scene,
    /// The motions, that with the largest share of starts first.
    pub motions: Vec<SettledReport>,
    /// Starts that the shares count.
    pub starts: usize,
    /// Starts whose motion could not be carried on.
    pub lost: usize,
    /// Why not the first of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Least and largest position in m of the starts.
    pub region_position: [f64; 2],
    /// Least and largest velocity in m/s of the starts.
    pub region_velocity: [f64; 2],
    /// Seed of the starts.
    pub seed: u64,
    /// Drive periods computed.
    pub periods_computed: u64,
}

/// One motion.
#[derive(Debug, Clone, Serialize)]
pub struct SettledReport {
    /// Share of the starts that were on it in the end.
    pub share: f64,
    /// How many that were.
    pub starts: usize,
    /// What it is.
    #[serde(flatten)]
    pub what: What,
}

/// What a motion is.
#[derive(Debug, Clone, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum What {
    /// It repeats.
    Periodic(Box<PeriodicReport>),
    /// It comes to rest for good.
    Rest {
        /// Least and largest position in m at which motions ended.
        positions: [f64; 2],
    },
    /// It never repeats.
    Chaos(ChaosReport),
    /// It is chaotic for long, but not for ever.
    TransientChaos {
        /// Mean number of drive periods that it lasts.
        lifetime: f64,
        /// Starts that came to it.
        entered: usize,
        /// What it is like before.
        #[serde(flatten)]
        chaos: ChaosReport,
    },
    /// It did not settle while it was watched.
    Unsettled {
        /// Position in m at drive angle phi.
        position: f64,
        /// Velocity in m/s there.
        velocity: f64,
        /// Its exponents.
        exponents: ExponentReport,
    },
}

/// A periodic motion.
#[derive(Debug, Clone, Serialize)]
pub struct PeriodicReport {
    /// p/n, or the infinity sign for complete chatter.
    pub z: String,
    /// Impacts p; of complete chatter those before the summed ones.
    pub impacts: u64,
    /// Drive periods n.
    pub periods: u64,
    /// Impacts in each drive period, in order.
    pub order: String,
    /// True for complete chatter.
    pub chatter: bool,
    /// Position in m at drive angle phi.
    pub position: f64,
    /// Velocity in m/s there.
    pub velocity: f64,
    /// Before-impact velocities in m/s, in order of time.
    pub before_impact_velocities: Vec<f64>,
    /// Drive angles of the impacts in rad.
    pub impact_angles: Vec<f64>,
    /// Largest position in m.
    pub max_position: f64,
    /// Floquet multipliers over its period.
    pub multipliers: [Multiplier; 2],
    /// Lyapunov exponents.
    pub exponents: ExponentReport,
    /// Distance of states one period apart when it was met, in units of its size.
    pub returned: f64,
    /// |P(s) - s| after Newton's method, in m and m/s.
    pub residual: f64,
}

/// A chaotic motion.
#[derive(Debug, Clone, Serialize)]
pub struct ChaosReport {
    /// Position in m at drive angle phi of a state on it.
    pub position: f64,
    /// Velocity in m/s there.
    pub velocity: f64,
    /// Mean impacts per drive period.
    pub impacts_per_period: f64,
    /// Least and largest before-impact velocity in m/s; null without impacts.
    pub velocities: Option<[f64; 2]>,
    /// Its exponents.
    pub exponents: ExponentReport,
    /// Drive periods for which motions on it were watched, all together.
    pub watched: u64,
}

/// Lyapunov exponents; null stands for minus infinity.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct ExponentReport {
    /// Per drive period, the larger first.
    pub per_period: [f64; 2],
    /// Per second.
    pub per_second: [f64; 2],
    /// Half-width of the 95 % interval of the larger one per drive period.
    pub error: f64,
}

impl MotionsReport {
    /// The report of a survey.
    #[must_use]
    pub fn new(machine: &Machine, options: &Options, survey: &Survey) -> Self {
        let lost = survey.lost.as_ref();
        Self {
            machine: title(machine),
            units: units(machine),
            scene: machine.scene.clone(),
            motions: survey.attractors.iter().map(SettledReport::new).collect(),
            starts: survey.starts,
            lost: lost.map_or(0, |(count, _)| *count),
            reason: lost.map(|(_, error)| error.to_string()),
            region_position: survey.region.position,
            region_velocity: survey.region.velocity,
            seed: options.seed,
            periods_computed: survey.periods,
        }
    }
}

impl SettledReport {
    fn new(attractor: &Attractor) -> Self {
        let what = match &attractor.kind {
            Kind::Periodic { orbit, certainty } => What::Periodic(Box::new(PeriodicReport {
                returned: certainty.returned,
                residual: certainty.residual,
                ..PeriodicReport::new(orbit)
            })),
            Kind::AtRest { positions } => What::Rest {
                positions: *positions,
            },
            Kind::Chaotic(chaos) => What::Chaos(ChaosReport::new(chaos)),
            Kind::TransientChaos {
                chaos,
                lifetime,
                entered,
            } => What::TransientChaos {
                lifetime: *lifetime,
                entered: *entered,
                chaos: ChaosReport::new(chaos),
            },
            Kind::Unsettled { state, exponents } => What::Unsettled {
                position: state.position,
                velocity: state.velocity,
                exponents: ExponentReport::new(exponents),
            },
        };
        Self {
            share: attractor.share,
            starts: attractor.starts,
            what,
        }
    }
}

impl PeriodicReport {
    fn new(orbit: &Orbit) -> Self {
        let regime = orbit.regime();
        let z = if orbit.chatters() {
            "∞".to_owned()
        } else {
            regime.to_string()
        };
        Self {
            z,
            impacts: regime.impacts,
            periods: regime.periods,
            order: orbit.pattern().to_string(),
            chatter: orbit.chatters(),
            position: orbit.position,
            velocity: orbit.velocity,
            before_impact_velocities: orbit.before_impact_velocities().collect(),
            impact_angles: orbit.impact_angles().collect(),
            max_position: orbit.max_position,
            multipliers: orbit.multipliers().map(Multiplier::new),
            exponents: ExponentReport::new(&Exponents::of(orbit)),
            returned: 0.0,
            residual: 0.0,
        }
    }
}

impl ChaosReport {
    fn new(chaos: &Chaos) -> Self {
        Self {
            position: chaos.state.position,
            velocity: chaos.state.velocity,
            impacts_per_period: chaos.impacts_per_period,
            velocities: chaos.velocities,
            exponents: ExponentReport::new(&chaos.exponents),
            watched: chaos.watched,
        }
    }
}

impl ExponentReport {
    fn new(exponents: &Exponents) -> Self {
        Self {
            per_period: exponents.per_period,
            per_second: exponents.per_second(),
            error: exponents.error,
        }
    }
}
