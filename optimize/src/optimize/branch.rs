//! The stable z = 1 motions of a zone as curves to draw.

use nalgebra::Vector2;
use softstop::{Dimension, Machine, Scene};
use softstop_dynamics::{BranchPoint, Orbit, Zone};

/// Points put in between two of the continuation, for a curve without visible corners.
const BETWEEN: u32 = 6;

/// The stable z = 1 motions of a zone.
#[derive(Debug, Clone)]
pub(super) struct Branch {
    pub(super) label: String,
    pub(super) frequency_g0: f64,
    pub(super) frequency_sn: f64,
    /// Frequency and before-impact velocity along each stable piece; folds inside the zone leave gaps.
    pub(super) pieces: Vec<Vec<(f64, f64)>>,
}

impl Branch {
    /// The motions of a machine's zone, in its own units.
    pub(super) fn new(machine: &Machine, zone: &Zone, label: String) -> Self {
        let own = |frequency| machine.to_own(Dimension::Frequency, frequency);
        let stable = zone.branch.chunk_by(|a, b| drawn(a) && drawn(b));
        Self {
            label,
            frequency_g0: own(zone.frequency_g0),
            frequency_sn: own(zone.frequency_sn),
            pieces: stable
                .filter(|piece| piece.len() > 1)
                .map(|piece| smooth(&zone.scene, piece))
                .map(|curve| curve.into_iter().map(|(w, v)| (own(w), v)).collect())
                .collect(),
        }
    }
}

/// Stable, or a fold, where a stable piece ends.
fn drawn(point: &BranchPoint) -> bool {
    point.is_stable() || point.fold_test().abs() < 1e-6
}

fn smooth(scene: &Scene, piece: &[BranchPoint]) -> Vec<(f64, f64)> {
    let mut curve = Vec::new();
    for pair in piece.windows(2) {
        let (from, to) = (&pair[0], &pair[1]);
        curve.push((from.parameter, from.before_impact_velocity()));
        let shares = (1..=BETWEEN).map(|step| f64::from(step) / f64::from(BETWEEN + 1));
        curve.extend(shares.filter_map(|share| between(scene, from, to, share)));
    }
    curve.extend(
        piece
            .last()
            .map(|point| (point.parameter, point.before_impact_velocity())),
    );
    curve
}

/// The motion at a frequency between two neighbours, if Newton's method stays between them.
fn between(scene: &Scene, from: &BranchPoint, to: &BranchPoint, share: f64) -> Option<(f64, f64)> {
    let mix = |from: f64, to: f64| from + share * (to - from);
    let frequency = mix(from.parameter, to.parameter);
    let state = Vector2::new(
        mix(from.position, to.position),
        mix(from.velocity, to.velocity),
    );
    let orbit = Orbit::near(&scene.at_frequency(frequency), state).ok()?;
    let inside = |value: f64, a: f64, b: f64| value >= a.min(b) && value <= a.max(b);
    inside(orbit.position, from.position, to.position)
        .then_some((frequency, orbit.before_impact_velocity()))
}
