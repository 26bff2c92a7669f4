//! What several commands report: plain data whose field names are the keys of the JSON.

use serde::Serialize;
use softstop::Ratios;
use softstop_dynamics::orbit::Orbit;

use crate::machine::Regime;
use crate::table::{Row, number, row};

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

/// The machine as rows of a table.
#[must_use]
pub fn machine(report: &MachineReport) -> Vec<Row> {
    let strip = [
        ("strip stiffness k2/k1", report.piercing_stiffness),
        ("strip friction k3/k1", report.piercing_friction),
        ("strip thickness sigma", report.thickness),
        ("travel to the stop nu", report.travel),
    ];
    let mut rows = vec![
        row("regime", [report.regime.name().to_owned()]),
        row("clearance rho", [number(report.clearance)]),
        row("stiffness k4/k1", [number(report.stiffness)]),
        row("preload Fp/F0", [number(report.preload)]),
        row("damping beta1", [number(report.damping)]),
        row("contact damping beta", [number(report.contact_damping)]),
    ];
    rows.extend(
        strip
            .into_iter()
            .filter_map(|(label, value)| Some(row(label, [number(value?)]))),
    );
    rows
}

/// The motion as rows of a table.
#[must_use]
pub fn motion(report: &MotionReport) -> Vec<Row> {
    let multipliers = report.multipliers.map(|multiplier| {
        if multiplier.im == 0.0 {
            number(multiplier.re)
        } else {
            format!("{} {:+.6}i", number(multiplier.re), multiplier.im)
        }
    });
    let [first, second] = multipliers;
    vec![
        row(
            "before-impact velocity X'-",
            [number(report.before_impact_velocity)],
        ),
        row("greatest position X_m", [number(report.max_position)]),
        row("position X at drive angle 0", [number(report.position)]),
        row("velocity X' at drive angle 0", [number(report.velocity)]),
        row("trace of the monodromy", [number(report.trace)]),
        row("its determinant", [number(report.determinant)]),
        row("Floquet multipliers", [first]),
        row("", [second]),
    ]
}
