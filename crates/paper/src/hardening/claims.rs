//! The five points of the paper's introduction in numbers.

use super::SUBHARMONIC;
use super::stops::{CLEARANCE, Law, grazing};
use super::subharmonics::{self, Subharmonic};
use super::swept::Swept;
use crate::hardening::chart::StopFolds;

/// All points but the last.
pub(super) fn of_stops(drawn: &[Swept], folds: &[StopFolds]) -> Vec<(String, f64)> {
    let mut findings = Vec::new();
    let mut add = |name: String, value: f64| findings.push((name, value));
    for swept in drawn {
        let name = swept.law.name().replace('₂', "2").replace('₁', "1");
        add(
            format!("(1) {name}: share of eta that is reversible"),
            swept.reversible(),
        );
        add(
            format!("(2) {name}: share of eta beyond z = 0 and z = 1"),
            swept.complex(),
        );
        if let Some(eta) = swept.lowest_with_impacts() {
            add(format!("(3) {name}: lowest eta with impacts, falling"), eta);
        }
    }
    let (_, upper) = grazing(CLEARANCE);
    let widths: Vec<(f64, f64, f64)> = folds
        .iter()
        .filter_map(|fold| {
            let (weak, strong) = (fold.weak?, fold.strong?);
            Some((fold.stiffness, upper - weak.0, strong.0 - weak.0))
        })
        .collect();
    let whole = |stiffness: f64| (stiffness.log10() - stiffness.log10().round()).abs() < 1e-9;
    for &(stiffness, weak, hysteresis) in widths.iter().filter(|width| whole(width.0)) {
        add(
            format!("(3) k2/k1 = {stiffness:.0}: width of weak z = 1"),
            weak,
        );
        add(
            format!("(3) k2/k1 = {stiffness:.0}: width of hysteresis"),
            hysteresis,
        );
    }
    let (lower, _) = grazing(CLEARANCE);
    add("(3) lower eta of g0".to_owned(), lower);
    add("(3) upper eta of g0".to_owned(), upper);
    for fold in folds.iter().filter(|fold| whole(fold.stiffness)) {
        if let Some(flip) = fold.first_flip {
            add(
                format!(
                    "(3) k2/k1 = {:.0}: width of weak z = 1 below resonance, to its flip",
                    fold.stiffness
                ),
                flip - lower,
            );
        }
    }
    let hard: Vec<_> = widths.iter().filter(|width| width.0 >= 10.0).collect();
    if let (Some(first), Some(last)) = (hard.first(), hard.last()) {
        let power = (last.1 / first.1).ln() / (last.0 / first.0).ln();
        add(
            "(3) width of weak z = 1 goes with k2 to the power".to_owned(),
            power,
        );
    }
    let of = |law: Law| drawn.iter().find(|swept| swept.law == law);
    if let Some(kelvin) = of(Law::KelvinVoigt(10.0)) {
        for law in [Law::TwoSlopes(10.0), Law::Hertz(10.0)] {
            if let Some(other) = of(law) {
                let name = law.name().replace('₂', "2").replace('₁', "1");
                add(
                    format!("(4) {name}: share of eta with the same motion"),
                    kelvin.likeness(other),
                );
            }
        }
    }
    findings
}

/// The fifth point.
pub(super) fn of_orders(found: &[Subharmonic]) -> Vec<(String, f64)> {
    let of = |stiffness: f64| {
        let own: Vec<Subharmonic> = found
            .iter()
            .filter(|motion| motion.stiffness == stiffness)
            .copied()
            .collect();
        let (beside, inside) = subharmonics::longest(&own);
        [
            (
                format!("(5) k2/k1 = {stiffness}: highest n of z = 1/n beside z = 0"),
                beside as f64,
            ),
            (
                format!("(5) k2/k1 = {stiffness}: highest n of z = 1/n within g0"),
                inside as f64,
            ),
        ]
    };
    SUBHARMONIC.into_iter().flat_map(of).collect()
}
