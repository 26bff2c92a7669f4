//! Findings on the certainty of z = 1: the paper's claim, tested.

use super::curve::{Curve, Place};
use crate::figure::Findings;

/// Places of which the certainty is told.
const TOLD: [f64; 3] = [0.25, 0.5, 0.75];

/// Certainties at the ends and in between, and how far the claim is off.
pub(super) fn of(curves: &[Curve]) -> Findings {
    let mut findings = Findings::default();
    for curve in curves {
        let name = curve.name();
        let mut tell = |what: &str, value: Option<f64>| {
            findings.add(format!("{name}: {what}"), value);
        };
        let (first, last) = (curve.places.first(), curve.places.last());
        let [certainty, integrity] = [|at: &Place| at.certainty, |at: &Place| at.integrity];
        tell("certainty near g0", first.map(certainty));
        tell("certainty near s_SN", last.map(certainty));
        for place in TOLD {
            let found = nearest(&curve.places, place).map(certainty);
            tell(&format!("certainty at s = {place}"), found);
        }
        let rise = rise(&curve.places);
        tell("largest rise of the certainty away from g0", Some(rise));
        tell("integrity near g0", first.map(integrity));
        tell("integrity near s_SN", last.map(integrity));
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
