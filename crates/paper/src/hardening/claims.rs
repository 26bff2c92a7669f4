//! The five points of the paper's introduction in numbers.

use super::SUBHARMONIC;
use super::folds::Folds;
use super::stops::{CLEARANCE, Law, grazing};
use super::subharmonics::{Subharmonic, longest};
use super::swept::Swept;
use crate::figure::Findings;

/// All points but the last.
pub(super) fn of_stops(findings: &mut Findings, drawn: &[Swept], folds: &[Folds]) {
    let plain = |law: Law| law.name().replace('₂', "2").replace('₁', "1");
    for swept in drawn {
        let name = plain(swept.law);
        let mut add = |point: u32, what: &str, value: Option<f64>| {
            findings.add(format!("({point}) {name}: {what}"), value);
        };
        let (reversible, complex) = (swept.reversible(), swept.complex());
        add(1, "share of eta that is reversible", Some(reversible));
        add(2, "share of eta beyond z = 0 and z = 1", Some(complex));
        let lowest = swept.lowest_with_impacts();
        add(3, "lowest eta with impacts, falling", lowest);
    }
    let (lower, upper) = grazing(CLEARANCE);
    findings.add("(3) lower eta of g0", lower);
    findings.add("(3) upper eta of g0", upper);
    for fold in folds {
        let decade = fold.stiffness.log10();
        if (decade - decade.round()).abs() < 1e-9 {
            let mut add = |what: &str, value: Option<f64>| {
                findings.add(
                    format!("(3) k2/k1 = {:.0}: width of {what}", fold.stiffness),
                    value,
                );
            };
            let widths = fold.widths();
            add("weak z = 1", widths.map(|it| it[1]));
            add("hysteresis", widths.map(|it| it[2]));
            let flip = fold.first_flip.map(|flip| flip - lower);
            add("weak z = 1 below resonance, to its flip", flip);
        }
    }
    let hard = folds.iter().filter_map(Folds::widths);
    let hard: Vec<[f64; 3]> = hard.filter(|it| it[0] >= 10.0).collect();
    let power = hard
        .first()
        .zip(hard.last())
        .map(|(first, last)| (last[1] / first[1]).ln() / (last[0] / first[0]).ln());
    findings.add("(3) width of weak z = 1 goes with k2 to the power", power);
    let of = |law: Law| drawn.iter().find(|swept| swept.law == law);
    for law in [Law::TwoSlopes(10.0), Law::Hertz(10.0)] {
        let both = of(Law::KelvinVoigt(10.0)).zip(of(law));
        let likeness = both.map(|(kelvin, other)| kelvin.likeness(other));
        let mut add = |what: &str, value: Option<f64>| {
            let name = format!(
                "(4) {}: share of eta with the same motion{what}",
                plain(law)
            );
            findings.add(name, value);
        };
        add("", likeness.map(|it| it[0]));
        let others = ", where either is neither z = 0 nor z = 1";
        add(others, likeness.map(|it| it[1]));
    }
}

/// The fifth point.
pub(super) fn of_orders(findings: &mut Findings, found: &[Subharmonic]) {
    for stiffness in SUBHARMONIC {
        for (is_beside, place) in [(true, "beside z = 0"), (false, "within g0")] {
            let name = format!("(5) k2/k1 = {stiffness}: highest n of z = 1/n {place}");
            findings.add(name, longest(found, stiffness, is_beside) as f64);
        }
    }
}
