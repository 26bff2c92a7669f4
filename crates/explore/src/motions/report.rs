//! What `softstop motions` reports.

use serde::Serialize;
use softstop::Machine;
use softstop_dynamics::attractors::{Attractor, Certainty, Chaos, Options, Survey};
use softstop_dynamics::motion::MotionKind;
use softstop_dynamics::orbit::{Exponents, Orbit};

use softstop_console::arguments::title;
use softstop_console::report::{MachineReport, MotionName, Multiplier};

/// All motions of a machine.
#[derive(Debug, Clone, Serialize)]
pub struct MotionsReport {
    /// The machine.
    pub machine: MachineReport,
    /// What it is called.
    #[serde(skip)]
    pub title: String,
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
    pub name: MotionName,
    /// If it repeats.
    #[serde(flatten)]
    pub periodic: Option<PeriodicReport>,
    /// If it is chaotic.
    #[serde(flatten)]
    pub chaos: Option<ChaosReport>,
    /// Least and largest position at which motions ended, if it rests.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub positions: Option<[f64; 2]>,
    /// If it has not settled.
    #[serde(flatten)]
    pub unsettled: Option<UnsettledReport>,
}

/// What did not settle while it was watched.
#[derive(Debug, Clone, Serialize)]
pub struct UnsettledReport {
    /// Position at drive angle phi.
    pub position: f64,
    /// Velocity there.
    pub velocity: f64,
    /// Its exponents.
    pub exponents: ExponentReport,
}

/// A periodic motion.
#[derive(Debug, Clone, Serialize)]
pub struct PeriodicReport {
    /// Impacts p; of complete chatter those before the summed ones.
    pub impacts: u64,
    /// Drive periods n.
    pub periods: u64,
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
    /// Mean number of drive periods that it lasts, if it ends.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lifetime: Option<f64>,
    /// Starts that came to it, if it ends.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub entered: Option<usize>,
    /// Position in m at drive angle phi of a state on it.
    pub position: f64,
    /// Velocity in m/s there.
    pub velocity: f64,
    /// Mean impacts per drive period.
    pub impacts_per_period: f64,
    /// Least before-impact velocity; null without impacts.
    pub least_before_impact_velocity: Option<f64>,
    /// The largest one.
    pub before_impact_velocity: Option<f64>,
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
            machine: MachineReport::of(machine),
            title: title(machine),
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
        let orbit = attractor.orbit.as_ref().zip(attractor.certainty);
        let is_unsettled = attractor.motion == MotionKind::Unsettled;
        let exponents = attractor.exponents.filter(|_| is_unsettled);
        Self {
            share: attractor.share,
            starts: attractor.starts,
            name: MotionName::of(&attractor.motion),
            periodic: orbit.map(|(orbit, certainty)| PeriodicReport::new(orbit, &certainty)),
            chaos: attractor.chaos.as_ref().map(ChaosReport::new),
            positions: attractor.positions,
            unsettled: exponents.map(|exponents| UnsettledReport {
                position: attractor.state.position,
                velocity: attractor.state.velocity,
                exponents: ExponentReport::new(&exponents),
            }),
        }
    }
}

impl PeriodicReport {
    fn new(orbit: &Orbit, certainty: &Certainty) -> Self {
        let regime = orbit.regime();
        Self {
            impacts: regime.impacts,
            periods: regime.periods,
            chatter: orbit.chatters(),
            position: orbit.position,
            velocity: orbit.velocity,
            before_impact_velocities: orbit.before_impact_velocities().collect(),
            impact_angles: orbit.impact_angles().collect(),
            max_position: orbit.max_position,
            multipliers: orbit.multipliers().map(Multiplier::new),
            exponents: ExponentReport::new(&Exponents::of(orbit)),
            returned: certainty.returned,
            residual: certainty.residual,
        }
    }
}

impl ChaosReport {
    fn new(chaos: &Chaos) -> Self {
        Self {
            lifetime: chaos.lifetime,
            entered: chaos.lifetime.map(|_| chaos.entered),
            position: chaos.state.position,
            velocity: chaos.state.velocity,
            impacts_per_period: chaos.impacts_per_period,
            least_before_impact_velocity: chaos.velocities.map(|[least, _]| least),
            before_impact_velocity: chaos.velocities.map(|[_, largest]| largest),
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
