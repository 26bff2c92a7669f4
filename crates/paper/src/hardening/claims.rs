//! The five points of the paper's introduction in numbers.

use super::SUBHARMONIC;
use super::folds::Folds;
use super::stops::{CLEARANCE, Law, grazing};
use super::subharmonics::{Subharmonic, longest};
use super::swept::SweptStop;
use crate::figure::{Findings, findings};

/// All points but the last.
pub(super) fn of_stops(findings: &mut Findings, drawn: &[SweptStop], folds: &[Folds]) {
    let plain = |law: Law| law.name().replace('₂', "2").replace('₁', "1");
    for swept in drawn {
        let name = plain(swept.law);
        findings! { findings, |(point, what)| format!("({point}) {name}: {what}");
            (1, "share of eta that is reversible") => swept.reversible();
            (2, "share of eta beyond z = 0 and z = 1") => swept.complex();
            (3, "lowest eta with impacts, falling") => swept.lowest_with_impacts();
        }
    }
    let (lower, upper) = grazing(CLEARANCE);
    findings.add("(3) lower eta of g0", lower);
    findings.add("(3) upper eta of g0", upper);
    for fold in folds {
        let decade = fold.stiffness.log10();
        if (decade - decade.round()).abs() < 1e-9 {
            let (widths, stiffness) = (fold.widths(), fold.stiffness);
            findings! { findings, |what| format!("(3) k2/k1 = {stiffness:.0}: width of {what}");
                "weak z = 1" => widths.map(|it| it[1]);
                "hysteresis" => widths.map(|it| it[2]);
                "weak z = 1 below resonance, to its flip" => fold.first_flip.map(|eta| eta - lower);
            }
        }
    }
    let hard = folds.iter().filter_map(Folds::widths);
    let hard: Vec<[f64; 3]> = hard.filter(|it| it[0] >= 10.0).collect();
    let ends = hard.first().zip(hard.last());
    let power = ends.map(|(one, last)| (last[1] / one[1]).ln() / (last[0] / one[0]).ln());
    findings.add("(3) width of weak z = 1 goes with k2 to the power", power);
    let of = |law: Law| drawn.iter().find(|swept| swept.law == law);
    for law in [Law::TwoSlopes(10.0), Law::Hertz(10.0)] {
        let both = of(Law::KelvinVoigt(10.0)).zip(of(law));
        let likeness = both.map(|(kelvin, other)| kelvin.likeness(other));
        let name = plain(law);
        findings! { findings, |which| format!("(4) {name}: share of eta with the same motion{which}");
            "" => likeness.map(|it| it[0]);
            ", where either is neither z = 0 nor z = 1" => likeness.map(|it| it[1]);
        }
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
