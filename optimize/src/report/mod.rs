//! What the subcommands report: plain data whose field names are the keys of the JSON.

pub mod text;

use std::collections::BTreeMap;

use serde::Serialize;
use softstop::Ratios;
use softstop::orbit::Orbit;
use softstop::zone::Zone;

use crate::arguments::{Machine, Regime};
use crate::design::{Design, Problem};

/// A Floquet multiplier.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Multiplier {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
    /// Absolute value; below 1 for both if the motion is stable.
    pub modulus: f64,
}

impl Multiplier {
    /// This complex number.
    #[must_use]
    pub fn new(multiplier: nalgebra::Complex<f64>) -> Self {
        Self {
            re: multiplier.re,
            im: multiplier.im,
            modulus: multiplier.norm(),
        }
    }
}

/// The machine: the paper's dimensionless ratios by the names of the command line.
#[derive(Debug, Clone, Serialize)]
pub struct MachineReport {
    /// With or without a strip.
    pub regime: Regime,
    /// rho.
    pub clearance: f64,
    /// k4/k1.
    pub stiffness: f64,
    /// Preload force in units of F0.
    pub preload: f64,
    /// beta1.
    pub damping: f64,
    /// beta.
    pub contact_damping: f64,
    /// k2/k1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub piercing_stiffness: Option<f64>,
    /// k3/k1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub piercing_friction: Option<f64>,
    /// sigma.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness: Option<f64>,
    /// nu.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub travel: Option<f64>,
}

impl MachineReport {
    /// The machine with these ratios.
    #[must_use]
    pub fn new(regime: Regime, ratios: &Ratios) -> Self {
        let strip = ratios.piercing;
        Self {
            regime,
            clearance: ratios.clearance,
            stiffness: ratios.stiffness,
            preload: ratios.preload,
            damping: ratios.damping,
            contact_damping: ratios.contact_damping,
            piercing_stiffness: strip.map(|strip| strip.stiffness),
            piercing_friction: strip.map(|strip| strip.friction),
            thickness: strip.map(|strip| strip.thickness),
            travel: strip.map(|strip| strip.travel),
        }
    }
}

/// A motion, in units of F0/k1 and sqrt(m/k1).
#[derive(Debug, Clone, Serialize)]
pub struct MotionReport {
    /// eta.
    pub frequency: f64,
    /// X at drive angle 0.
    pub position: f64,
    /// X' at drive angle 0.
    pub velocity: f64,
    /// X' when the mass reaches the clearance.
    pub before_impact_velocity: f64,
    /// X_m.
    pub max_position: f64,
    /// Trace of the monodromy matrix.
    pub trace: f64,
    /// Its determinant.
    pub determinant: f64,
    /// Its eigenvalues.
    pub multipliers: [Multiplier; 2],
}

impl MotionReport {
    /// The motion of this orbit at this drive frequency.
    #[must_use]
    pub fn new(frequency: f64, orbit: &Orbit) -> Self {
        Self {
            frequency,
            position: orbit.position,
            velocity: orbit.velocity,
            before_impact_velocity: orbit.before_impact_velocity(),
            max_position: orbit.max_position,
            trace: orbit.trace(),
            determinant: orbit.determinant(),
            multipliers: orbit.multipliers().map(Multiplier::new),
        }
    }
}

/// What `softstop orbit` reports.
#[derive(Debug, Clone, Serialize)]
pub struct OrbitReport {
    /// The motion.
    #[serde(flatten)]
    pub motion: MotionReport,
    /// Where it was found.
    #[serde(flatten)]
    pub machine: MachineReport,
}

impl OrbitReport {
    /// The orbit of this machine.
    #[must_use]
    pub fn new(machine: &Machine, orbit: &Orbit) -> Self {
        Self {
            motion: MotionReport::new(machine.ratios.frequency, orbit),
            machine: MachineReport::new(machine.regime, &machine.ratios),
        }
    }
}

/// What `softstop zone` reports.
#[derive(Debug, Clone, Serialize)]
pub struct ZoneReport {
    /// Grazing of the motion without impacts, above resonance.
    pub frequency_g0: f64,
    /// The fold of the z = 1 motion.
    pub frequency_sn: f64,
    /// Before-impact velocity at the fold.
    pub velocity_sn: f64,
    /// The machine.
    #[serde(flatten)]
    pub machine: MachineReport,
}

impl ZoneReport {
    /// The zone of this machine.
    #[must_use]
    pub fn new(machine: &Machine, zone: &Zone) -> Self {
        Self {
            frequency_g0: zone.frequency_g0,
            frequency_sn: zone.frequency_sn,
            velocity_sn: zone.velocity_sn,
            machine: MachineReport::new(machine.regime, &machine.ratios),
        }
    }
}

/// The design that was found.
#[derive(Debug, Clone, Serialize)]
pub struct DesignReport {
    /// The machine.
    #[serde(flatten)]
    pub machine: MachineReport,
    /// The motion.
    #[serde(flatten)]
    pub motion: MotionReport,
    /// Lower end of the design's zone.
    pub frequency_g0: f64,
    /// Upper end of the design's zone.
    pub frequency_sn: f64,
    /// Least allowed distance M from both ends, as a share of the zone's width.
    pub margin: f64,
    /// Place in the zone, in [M, 1 - M].
    pub s: f64,
    /// The limits that hold the design back, in words.
    pub at_limits: Vec<String>,
}

impl DesignReport {
    /// The report on the solution of this problem.
    #[must_use]
    pub fn new(problem: &Problem, design: &Design) -> Self {
        Self {
            machine: MachineReport::new(problem.machine.regime, &design.ratios),
            motion: MotionReport::new(design.ratios.frequency, &design.orbit),
            frequency_g0: design.zone.frequency_g0,
            frequency_sn: design.zone.frequency_sn,
            margin: problem.margin,
            s: design.place,
            at_limits: at_limits(problem, design),
        }
    }
}

/// Distance in s within which a design stands at the end of the allowed window.
const AT_MARGIN: f64 = 1e-9;

fn at_limits(problem: &Problem, design: &Design) -> Vec<String> {
    let ends = [
        ("stiffness", problem.stiffness.end(design.ratios.stiffness)),
        ("clearance", problem.clearance.end(design.ratios.clearance)),
    ];
    let mut limits: Vec<String> = ends
        .into_iter()
        .filter_map(|(name, end)| Some(format!("{name}: {} bound", end?)))
        .collect();
    if design.place <= problem.margin + AT_MARGIN {
        limits.push("margin from g0".to_owned());
    }
    if design.place >= 1.0 - problem.margin - AT_MARGIN {
        limits.push("margin from s_SN".to_owned());
    } else if let Some(end) = near_end(problem, design.ratios.frequency) {
        limits.push(format!("frequency: {end} bound"));
    }
    limits
}

/// Frequencies pass through the place in the zone and back, so an end is met to rounding only.
fn near_end(problem: &Problem, frequency: f64) -> Option<&'static str> {
    let near = |end: f64| end.is_finite() && (frequency - end).abs() <= 1e-12 * end.abs();
    let Problem {
        frequency: range, ..
    } = problem;
    match (range.is_held(), near(range.low), near(range.high)) {
        (false, true, _) => Some("lower"),
        (false, _, true) => Some("upper"),
        _ => None,
    }
}

/// One of the paper's points.
#[derive(Debug, Clone, Serialize)]
pub struct ReferenceReport {
    /// The machine.
    #[serde(flatten)]
    pub machine: MachineReport,
    /// The motion.
    #[serde(flatten)]
    pub motion: MotionReport,
    /// Before-impact velocity of the design over that of this point.
    pub gain: f64,
}

impl ReferenceReport {
    /// The paper's point of this regime beside a design of this velocity.
    #[must_use]
    pub fn new(regime: Regime, orbit: &Orbit, design_velocity: f64) -> Self {
        let ratios = regime.ratios();
        Self {
            machine: MachineReport::new(regime, &ratios),
            motion: MotionReport::new(ratios.frequency, orbit),
            gain: design_velocity / orbit.before_impact_velocity(),
        }
    }
}

/// How the design was searched.
#[derive(Debug, Clone, Serialize)]
pub struct SearchReport {
    /// Values held and ranges searched, in words.
    pub bounds: BTreeMap<&'static str, String>,
    /// Seed.
    pub seed: u64,
    /// Zones computed at most.
    pub evaluations: u64,
}

/// What `softstop optimize` reports and writes.
#[derive(Debug, Clone, Serialize)]
pub struct OptimizeReport {
    /// The solution.
    pub design: DesignReport,
    /// The paper's points A and B.
    pub reference: BTreeMap<&'static str, ReferenceReport>,
    /// How it was searched.
    pub search: SearchReport,
    /// Paths of the files written, by kind.
    pub files: BTreeMap<&'static str, String>,
}
