//! How long the old motion lasts between bursts beside an ISN of Table 1 (Pomeau and Manneville 1980): stretches of
//! drive periods with its order of impacts, over the distance from where it loses its stability.

use anyhow::Result;
use serde::{Deserialize, Serialize};
use softstop::{Ratios, Start};
use softstop_dynamics::internals::{Ensemble, Member};
use softstop_dynamics::monitor::recall_or_compute;
use softstop_lanes::LoweredMachine;

use crate::figure::{Drawn, Figure, Findings, Studio, findings};
use crate::table1::{matching, paper};
use crate::transitions::{Stretches, Transition};
use softstop_console::columns;
use softstop_console::export::csv;
use softstop_console::interrupt;
use softstop_console::progress::Progress;

/// Rows with an ISN.
const ROWS: [usize; 3] = [3, 16, 17];
/// log10 of the least and the largest distance in eta, and distances in a decade.
const DECADES: (i32, i32, i32) = (-7, -4, 3);
/// Drive periods for which a motion is followed, at most.
const ENDURANCE: u64 = 1_000_000;
/// Drive periods between two looks at which of them are known.
const LOOK: u64 = 10_000;
/// Stretches after which it is known well enough, and fewest from which a mean is told.
const STRETCHES: (usize, usize) = (400, 100);
/// How far from the old motion it starts, as a share of the clearance.
const APART: f64 = 1e-3;

/// Lengths of the stretches beside the end of a motion.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct LaminarLengths {
    row: usize,
    eta: f64,
    distance: f64,
    stretches: usize,
    mean_drive_periods: f64,
    longest_drive_periods: u64,
}

pub(super) fn draw(studio: &Studio, _: &Figure) -> Result<Drawn> {
    let transitions = studio.transitions()?;
    let rows = paper::ROWS.iter().filter(|row| ROWS.contains(&row.number));
    let found = rows.filter_map(|row| {
        let found = matching::find(row, transitions)?;
        Some((row.number, found.transition))
    });
    let (low, high, each) = DECADES;
    let powers = (low * each..=high * each).map(|index| f64::from(index) / f64::from(each));
    let cases = found.flat_map(|case| powers.clone().map(move |power| (case, 10f64.powf(power))));
    let cases: Vec<((usize, &Transition), f64)> = cases.collect();
    let lengths = recall_or_compute(studio.kept, &"laminar", || all(&cases))?;
    let mut findings = Findings::default();
    for row in ROWS {
        let own = lengths.iter().filter(|it| it.row == row);
        let own: Vec<&LaminarLengths> = own.collect();
        let power = |length: fn(&LaminarLengths) -> f64| {
            let logarithms = own.iter().map(|it| [it.distance.ln(), length(it).ln()]);
            slope(&logarithms.collect::<Vec<_>>())
        };
        findings! { findings, |what| format!("row {row:02}: {what}");
            "distances" => own.len() as f64;
            "mean length goes with the distance to the power" => power(|it| it.mean_drive_periods);
            "longest length goes with the distance to the power" => power(|it| it.longest_drive_periods as f64);
        }
    }
    let columns = columns! { LaminarLengths, it;
        "row" [None], "of Table 1" => it.row;
        "eta" [None], "drive frequency" => it.eta;
        "distance" [None], "from where the old motion loses its stability" => it.distance;
        "stretches" [None], "with its order of impacts" => it.stretches;
        "mean_drive_periods" [None], "of a stretch" => it.mean_drive_periods;
        "longest_drive_periods" [None], "of a stretch" => it.longest_drive_periods;
    };
    Ok(Drawn::new([csv(&columns, &lengths)?], findings))
}

/// The stretches at all distances at which there are enough of them: the motions go together.
fn all(cases: &[((usize, &Transition), f64)]) -> Result<Vec<LaminarLengths>> {
    let progress = Progress::new(cases.len() as u64, "distances");
    let (mut motions, mut machines, mut places) = (Vec::new(), Vec::new(), Vec::new());
    for ((row, transition), distance) in cases {
        let (Some(start), Some(regime)) = (transition.state, transition.from.regime()) else {
            continue;
        };
        let machine = Ratios::unloaded();
        let direction = if transition.rising { 1.0 } else { -1.0 };
        let eta = transition.value + direction * distance;
        let [at_end, beside] = [transition.value, eta].map(|eta| machine.at_frequency(eta));
        let apart = Start::new(start.position - APART * machine.clearance, start.velocity);
        motions.push(Stretches::new(
            Member::new(machines.len(), apart),
            &at_end.scene()?.check()?,
            start,
            regime.periods,
            |it| it.lengths.len() > STRETCHES.0,
        )?);
        machines.push(LoweredMachine::new(&beside.scene()?.check()?));
        places.push((*row, eta, *distance));
    }
    let ensemble = Ensemble::new(machines, &interrupt::watch);
    let mut left: Vec<&mut Stretches> = motions.iter_mut().collect();
    for _ in 0..ENDURANCE / LOOK {
        let before = left.len();
        ensemble.advance_batch::<true, true, _>(&mut left, LOOK)?;
        if let Some(error) = left.iter_mut().find_map(|it| it.member.error.take()) {
            return Err(error.into());
        }
        left.retain(|motion| !(motion.is_known)(motion));
        progress.steps((before - left.len()) as u64)?;
        if left.is_empty() {
            break;
        }
    }
    let found = places.into_iter().zip(&motions);
    let found = found.filter_map(|((row, eta, distance), motion)| {
        let lengths = motion.lengths.get(1..).unwrap_or_default();
        (lengths.len() >= STRETCHES.1).then(|| LaminarLengths {
            row,
            eta,
            distance,
            stretches: lengths.len(),
            mean_drive_periods: lengths.iter().sum::<u64>() as f64 / lengths.len() as f64,
            longest_drive_periods: lengths.iter().copied().max().unwrap_or(0),
        })
    });
    Ok(found.collect())
}

/// The slope of the straight line through points by least squares.
fn slope(points: &[[f64; 2]]) -> Option<f64> {
    let sum = |term: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(term).sum::<f64>();
    let count = points.len() as f64;
    let (x, y) = (sum(&|at| at[0]) / count, sum(&|at| at[1]) / count);
    let across = sum(&|at| (at[0] - x).powi(2));
    let both = sum(&|at| (at[0] - x) * (at[1] - y));
    (points.len() > 2).then(|| both / across)
}
