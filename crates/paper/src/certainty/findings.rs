//! Findings on the certainty of z = 1: the paper's claim, tested.

use super::curve::{Curve, Place};

/// Places of which the certainty is told.
const TOLD: [f64; 3] = [0.25, 0.5, 0.75];

/// Certainties at the ends and in between, and how far the claim is off.
pub(super) fn of(curves: &[Curve]) -> Vec<(String, f64)> {
    let mut findings = Vec::new();
    for curve in curves {
        let name = format!(
            "{}, rho = {}, starts {}",
            curve.machine(),
            curve.clearance(),
            curve.starts.label()
        );
        let mut tell = |what: &str, value: f64| findings.push((format!("{name}: {what}"), value));
        let Some((first, last)) = curve.places.first().zip(curve.places.last()) else {
            continue;
        };
        tell("certainty near g0", first.certainty);
        tell("certainty near s_SN", last.certainty);
        for place in TOLD {
            if let Some(found) = nearest(&curve.places, place) {
                tell(&format!("certainty at s = {place}"), found.certainty);
            }
        }
        tell(
            "largest rise of the certainty away from g0",
            rise(&curve.places),
        );
        tell("integrity near g0", first.integrity);
        tell("integrity near s_SN", last.integrity);
    }
    findings
}

fn nearest(places: &[Place], place: f64) -> Option<&Place> {
    let gap = |found: &&Place| (found.place - place).abs();
    places.iter().min_by(|a, b| gap(a).total_cmp(&gap(b)))
}

/// How much larger the certainty is somewhere than at a place nearer to g0, beyond both 95 % intervals: 0 if it
/// falls all the way, as the paper has it.
fn rise(places: &[Place]) -> f64 {
    let later = |(index, place): (usize, &Place)| {
        let rest = places[index + 1..].iter();
        let rises = rest.filter(|other| other.interval[0] > place.interval[1]);
        let rises = rises.map(|other| other.certainty - place.certainty);
        rises.fold(0.0, f64::max)
    };
    places.iter().enumerate().map(later).fold(0.0, f64::max)
}
