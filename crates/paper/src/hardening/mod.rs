//! The transition of the stop's stiffness k2 from 0 to infinity (Peterka 2003, figure 1 and the five points of
//! its introduction).

mod chart;
mod claims;
mod folds;
mod stops;
mod subharmonics;
mod swept;

use anyhow::Result;
use softstop_dynamics::sweep::Step;

use crate::figure::{self, Drawn, Figure, Studio};
use crate::hardening::chart::{HardeningChart, StopFolds, StopOrders};
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::output;
use stops::{CLEARANCE, Law, RESTITUTION, grazing};
use subharmonics::Subharmonic;
use swept::{RANGE, Swept, regime, sweep};

/// From a soft to a rigid stop.
pub(crate) const FIGURE: Figure = Figure {
    title: "From a soft to a rigid stop",
    files: &[
        "hardening.svg",
        "hardening.csv",
        "hardening-map.csv",
        "hardening-folds.csv",
        "hardening-subharmonics.csv",
    ],
    draw,
};

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

fn draw(studio: &Studio) -> Result<Drawn> {
    let detail = studio.detail;
    let drawn = sweep(&DRAWN, detail.pick(420, 120), detail.pick(200, 80))?;
    let rows = stiffnesses(detail.pick(51, 11));
    let laws: Vec<Law> = rows.iter().copied().map(Law::KelvinVoigt).collect();
    let map = sweep(&laws, detail.pick(240, 60), detail.pick(120, 60))?;
    let folds = folds::folds(&stiffnesses(detail.pick(21, 6)))?;
    let (frequencies, starts) = detail.pick((72, 64), (18, 32));
    let subharmonics = subharmonics::subharmonics(&SUBHARMONIC, frequencies, starts)?;
    let mut findings = folds::onsets(&folds)?;
    // A branch that was cut short would go unnoticed.
    if interrupt::requested() {
        return Err(Failure::Interrupted.into());
    }
    let chart = chart(&drawn, &map, &folds, &subharmonics);
    findings.extend(claims::of_stops(&drawn, &folds));
    findings.extend(claims::of_orders(&subharmonics));
    Ok(Drawn {
        files: vec![
            chart.svg().into_bytes(),
            steps(&drawn)?,
            steps(&map)?,
            branches(&folds)?,
            output::csv(&subharmonics)?,
        ],
        findings,
    })
}

/// So many stiffnesses with equal ratios.
fn stiffnesses(count: usize) -> Vec<f64> {
    let share = |index: usize| index as f64 / (count - 1) as f64;
    let power = |index| DECADES.0 + share(index) * (DECADES.1 - DECADES.0);
    (0..count).map(|index| 10f64.powf(power(index))).collect()
}

fn chart(
    drawn: &[Swept],
    map: &[Swept],
    folds: &[StopFolds],
    subharmonics: &[Subharmonic],
) -> HardeningChart {
    let of = |step: &Step| -> Vec<(f64, f64)> {
        let velocities = step.velocities.iter();
        velocities.map(|velocity| (step.value, *velocity)).collect()
    };
    let diagram = |swept: &Swept| {
        let ways = [&swept.up, &swept.down];
        let ways = ways.map(|steps| steps.iter().flat_map(of).collect());
        (swept.law.name(), ways)
    };
    let row = |swept: &Swept| {
        let pairs = swept.up.iter().zip(&swept.down);
        pairs.map(|(up, down)| (regime(up), regime(down))).collect()
    };
    HardeningChart {
        explanation: format!(
            "clearance ρ = {CLEARANCE}, β₁ = 0.02, contact damping for a restitution of {RESTITUTION}; dashed: \
             grazing of the impact-less motion, g₀"
        ),
        grazing: grazing(CLEARANCE),
        frequencies: RANGE,
        diagrams: drawn.iter().map(diagram).collect(),
        decades: DECADES,
        map: map.iter().map(row).collect(),
        folds: folds.to_vec(),
        orders: orders(subharmonics),
    }
}

/// Motions z = 1/n over the frequency.
fn orders(found: &[Subharmonic]) -> StopOrders {
    let of = |stiffness: f64| {
        let own = found
            .iter()
            .filter(|motion| motion.stiffness == stiffness && motion.impacts == 1);
        let points = own.map(|motion| (motion.frequency, motion.periods as f64));
        (format!("k₂/k₁ = {stiffness}"), points.collect())
    };
    StopOrders {
        title: format!(
            "Motions z = 1/n found at clearance ρ = {}",
            subharmonics::NARROW
        ),
        frequencies: subharmonics::RANGE,
        grazing: grazing(subharmonics::NARROW).1,
        found: SUBHARMONIC.into_iter().map(of).collect(),
    }
}

/// A row for each step of each way.
fn steps(swept: &[Swept]) -> Result<Vec<u8>> {
    let columns = "stop,direction,eta,motion,impacts_per_period,max_position,\
                   largest_before_impact_velocity";
    let rows = swept.iter().flat_map(|swept| {
        let stop = match swept.law {
            Law::KelvinVoigt(stiffness) => format!("{stiffness}"),
            law => law.name(),
        };
        let row = move |step: &Step, direction| {
            (
                stop.clone(),
                direction,
                step.value,
                regime(step).name(),
                step.impacts_per_period,
                step.max_position,
                step.hardest(),
            )
        };
        let up = swept.up.iter().map(|step| (step, "up"));
        let all = up.chain(swept.down.iter().map(|step| (step, "down")));
        all.map(move |(step, direction)| row(step, direction))
    });
    figure::table(columns, rows)
}

/// A row for each branch of z = 1.
fn branches(folds: &[StopFolds]) -> Result<Vec<u8>> {
    let columns = "stiffness,eta_grazing,eta_strong_fold,velocity_strong_fold,eta_weak_fold,\
                   velocity_weak_fold,eta_first_flip,eta_flip";
    let rows = folds.iter().map(|fold| {
        (
            fold.stiffness,
            grazing(CLEARANCE).1,
            fold.strong.unzip(),
            fold.weak.unzip(),
            fold.first_flip,
            fold.flip,
        )
    });
    figure::table(columns, rows)
}
