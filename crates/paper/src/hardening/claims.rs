//! The five points of the paper's introduction in numbers.

use super::SUBHARMONIC;
use super::folds::Folds;
use super::stops::{CLEARANCE, Law, grazing};
use super::subharmonics::{Subharmonic, longest};
use super::swept::SweptStop;
use crate::figure::Findings;

/// All points but the last.
pub(super) fn of_stops(findings: &mut Findings, drawn: &[SweptStop], folds: &[Folds]) {
    let plain = |law: Law| law.name().replace('₂', "2").replace('₁', "1");
    for swept in drawn {
        let name = plain(swept.law);
        let (reversible, complex) = (swept.reversible(), swept.complex());
        let lowest = swept.lowest_with_impacts();
        for (point, what, value) in [
            (1, "share of eta that is reversible", Some(reversible)),
            (2, "share of eta beyond z = 0 and z = 1", Some(complex)),
            (3, "lowest eta with impacts, falling", lowest),
        ] {
            findings.add(format!("({point}) {name}: {what}"), value);
        }
    }
    let (lower, upper) = grazing(CLEARANCE);
    findings.add("(3) lower eta of g0", lower);
    findings.add("(3) upper eta of g0", upper);
    for fold in folds {
        let decade = fold.stiffness.log10();
        if (decade - decade.round()).abs() < 1e-9 {
            let (widths, flip) = (fold.widths(), fold.first_flip);
            let values = [
                ("weak z = 1", widths.map(|it| it[1])),
                ("hysteresis", widths.map(|it| it[2])),
                (
                    "weak z = 1 below resonance, to its flip",
                    flip.map(|eta| eta - lower),
                ),
            ];
            let name = format!("(3) k2/k1 = {:.0}: width of ", fold.stiffness);
            findings.group(&name, values);
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
        let others = ", where either is neither z = 0 nor z = 1";
        let values = [
            ("", likeness.map(|it| it[0])),
            (others, likeness.map(|it| it[1])),
        ];
        let name = format!("(4) {}: share of eta with the same motion", plain(law));
        findings.group(&name, values);
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
