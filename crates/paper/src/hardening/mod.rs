//! The transition of the stop's stiffness k2 from 0 to infinity (Peterka 2003, figure 1 and the five points of
//! its introduction).

mod chart;
mod folds;
mod stops;
mod subharmonics;
mod swept;

use anyhow::Result;

use crate::diagram;
use crate::figure::{Drawn, Figure, Findings, Studio, findings};
use chart::chart;
use folds::Folds;
use softstop_console::columns;
use softstop_console::export::csv;
use softstop_console::failure::check_interrupt;
use stops::{CLEARANCE, Law, grazing};
use subharmonics::{Subharmonic, longest};
use swept::{SweptStop, sweep};

/// The stops whose diagrams are drawn.
const DRAWN: [Law; 8] = [
    Law::KelvinVoigt(0.0),
    Law::KelvinVoigt(1.0),
    Law::KelvinVoigt(3.0),
    Law::KelvinVoigt(10.0),
    Law::KelvinVoigt(100.0),
    Law::Rigid,
    Law::TwoSlopes(10.0),
    Law::Hertz(10.0),
];
/// log10 of k2/k1 in the map.
const DECADES: (f64, f64) = (-1.0, 4.0);
/// Stiffnesses k2/k1 whose subharmonic motions are looked for.
const SUBHARMONIC: [f64; 3] = [1.0, 10.0, 100.0];

pub(super) fn draw(studio: &Studio, figure: &Figure) -> Result<Drawn> {
    let detail = studio.detail;
    let drawn = sweep(&DRAWN, detail.pick((420, 200), (120, 80)), studio.kept)?;
    let rows = stiffnesses(detail.pick(51, 11));
    let laws: Vec<Law> = rows.iter().copied().map(Law::KelvinVoigt).collect();
    let map = sweep(&laws, detail.pick((240, 120), (60, 60)), studio.kept)?;
    let folds = folds::folds(&stiffnesses(detail.pick(21, 6)))?;
    let subharmonics = subharmonics::subharmonics(&SUBHARMONIC, studio)?;
    let mut findings = Findings::default();
    folds::onsets(&mut findings, &folds)?;
    // A branch that was cut short would go unnoticed.
    check_interrupt()?;
    claims_of_stops(&mut findings, &drawn, &folds);
    claims_of_orders(&mut findings, &subharmonics);
    let branches = columns! { Folds, it;
        "stiffness" [None], "k2/k1" => it.stiffness;
        "eta_grazing" [None], "upper g0" => grazing(CLEARANCE).1;
        "eta_strong_fold" [None], "where strong impacts end" => it.strong.map(|at| at.0);
        "velocity_strong_fold" [None], "X'_- there" => it.strong.map(|at| at.1);
        "eta_weak_fold" [None], "where weak impacts end" => it.weak.map(|at| at.0);
        "velocity_weak_fold" [None], "X'_- there" => it.weak.map(|at| at.1);
        "eta_first_flip" [None], "right beyond grazing, below the resonance" => it.first_flip;
        "eta_flip" [None], "from which on z = 1 is stable" => it.flip;
    };
    let motions = columns! { Subharmonic, it;
        "stiffness" [None], "k2/k1" => it.stiffness;
        "eta" [None], "drive frequency" => it.eta;
        "impacts" [None], "p of z = p/n" => it.impacts;
        "periods" [None], "n of it" => it.periods;
        "beside_impactless_motion" [None], "whether that exists there, too" => it.is_beside_rest;
    };
    let files = [
        chart(figure, (&drawn, &map), &folds, &subharmonics)?
            .svg()
            .into_bytes(),
        steps(&drawn)?,
        steps(&map)?,
        csv(&branches, &folds)?,
        csv(&motions, &subharmonics)?,
    ];
    Ok(Drawn::new(files, findings))
}

/// So many stiffnesses with equal ratios.
fn stiffnesses(count: usize) -> Vec<f64> {
    let share = |index: usize| index as f64 / (count - 1) as f64;
    let power = |index| DECADES.0 + share(index) * (DECADES.1 - DECADES.0);
    (0..count).map(|index| 10f64.powf(power(index))).collect()
}

/// A row for each step of each way.
fn steps(swept: &[SweptStop]) -> Result<Vec<u8>> {
    let sweeps = swept.iter().flat_map(|swept| {
        let stop = match swept.law {
            Law::KelvinVoigt(stiffness) => stiffness.to_string(),
            law => law.name(),
        };
        let ways = [("up", &swept.up), ("down", &swept.down)];
        ways.map(|(way, steps)| (stop.clone(), way, &steps[..]))
    });
    diagram::table("stop", sweeps)
}

/// The points of the paper's introduction in numbers, all but the last.
fn claims_of_stops(findings: &mut Findings, drawn: &[SweptStop], folds: &[Folds]) {
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
fn claims_of_orders(findings: &mut Findings, found: &[Subharmonic]) {
    for stiffness in SUBHARMONIC {
        for (is_beside, place) in [(true, "beside z = 0"), (false, "within g0")] {
            let name = format!("(5) k2/k1 = {stiffness}: highest n of z = 1/n {place}");
            findings.add(name, longest(found, stiffness, is_beside) as f64);
        }
    }
}
