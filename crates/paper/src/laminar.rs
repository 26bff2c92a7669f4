//! How long the old motion lasts between bursts beside an ISN of Table 1 (Pomeau and Manneville 1980): stretches of
//! drive periods with its order of impacts, over the distance from where it loses its stability.

use std::collections::VecDeque;

use anyhow::Result;
use nalgebra::Vector2;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use softstop::Ratios;
use softstop_dynamics::StroboscopicMap;
use softstop_dynamics::transitions::Transition;
use softstop_dynamics::watch::piece;

use crate::figure::{self, Drawn, Figure, Findings, Studio};
use crate::table1::{matching, paper};
use softstop_console::progress::Progress;

/// Laminar lengths.
pub(crate) const FIGURE: Figure = Figure {
    title: "Laminar lengths beside the ISN of Table 1",
    files: &["laminar.csv"],
    draw,
};

/// Rows with an ISN.
const ROWS: [usize; 3] = [3, 16, 17];
/// log10 of the least and the largest distance in eta, and distances in a decade.
const DECADES: (i32, i32, i32) = (-7, -4, 3);
/// Drive periods for which a motion is followed, at most.
const ENDURANCE: u64 = 1_000_000;
/// Stretches after which it is known well enough, and fewest from which a mean is told.
const STRETCHES: (usize, usize) = (400, 100);
/// Shortest stretch, in periods of the motion, that is not chance.
const CALM: u64 = 5;
/// How far from the old motion it starts, as a share of the clearance.
const APART: f64 = 1e-3;

/// Stretches beside the end of a motion.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Beside {
    row: usize,
    eta: f64,
    distance: f64,
    stretches: usize,
    mean_drive_periods: f64,
    longest_drive_periods: u64,
}

fn draw(studio: &Studio) -> Result<Drawn> {
    let transitions = studio.transitions()?;
    let rows = paper::ROWS.iter().filter(|row| ROWS.contains(&row.number));
    let found = rows.filter_map(|row| {
        let transition = matching::find(row, transitions)?.transition;
        Some((row.number, transition))
    });
    let (low, high, each) = DECADES;
    let powers = (low * each..=high * each).map(|index| f64::from(index) / f64::from(each));
    let cases = found.flat_map(|case| powers.clone().map(move |power| (case, 10f64.powf(power))));
    let cases: Vec<((usize, &Transition), f64)> = cases.collect();
    let progress = Progress::new(cases.len() as u64, "distances");
    let kept = studio.kept;
    let beside = cases.par_iter().map(|((row, transition), distance)| {
        progress.step()?;
        let of = ("laminar", row, distance);
        piece(kept, &of, || beside(*row, transition, *distance))
    });
    let beside: Vec<Beside> = beside.flat_map(Result::transpose).collect::<Result<_>>()?;
    let mut findings = Findings::default();
    for row in ROWS {
        let own = beside.iter().filter(|it| it.row == row);
        let own: Vec<&Beside> = own.collect();
        let power = |length: fn(&Beside) -> f64| {
            let logarithms = own.iter().map(|it| [it.distance.ln(), length(it).ln()]);
            slope(&logarithms.collect::<Vec<_>>())
        };
        let mut add = |what: &str, value: Option<f64>| {
            findings.add(format!("row {row:02}: {what}"), value);
        };
        add("distances", Some(own.len() as f64));
        let mean = power(|it| it.mean_drive_periods);
        add("mean length goes with the distance to the power", mean);
        let longest = power(|it| it.longest_drive_periods as f64);
        add(
            "longest length goes with the distance to the power",
            longest,
        );
    }
    let columns = "row,eta,distance,stretches,mean_drive_periods,longest_drive_periods";
    Ok(Drawn {
        files: vec![figure::table(columns, beside)?],
        findings,
    })
}

/// The stretches at a distance, if there are enough of them.
fn beside(row: usize, transition: &Transition, distance: f64) -> Result<Option<Beside>> {
    let (Some(state), Some(regime)) = (transition.state, transition.from.regime()) else {
        return Ok(None);
    };
    let machine = Ratios::unloaded();
    let map = |eta: f64| -> Result<StroboscopicMap> {
        Ok(StroboscopicMap::new(
            &machine.at_frequency(eta).scene()?,
            1,
        )?)
    };
    let mut state: Vector2<f64> = state.into();
    let at_end = map(transition.value)?;
    let (mut old, mut order) = (state, Vec::new());
    for _ in 0..regime.periods {
        let passage = at_end.apply(old)?;
        old = passage.end;
        order.push(passage.impacts.len());
    }
    let mut counter = Counter::new(order);
    let direction = if transition.rising { 1.0 } else { -1.0 };
    let eta = transition.value + direction * distance;
    let map = map(eta)?;
    state.x -= APART * machine.clearance;
    let mut lengths: Vec<u64> = Vec::new();
    for _ in 0..ENDURANCE {
        let passage = map.apply(state)?;
        state = passage.end;
        let ended = counter.enter(passage.impacts.len());
        lengths.extend(ended.filter(|length| *length >= CALM * regime.periods));
        if lengths.len() > STRETCHES.0 {
            break;
        }
    }
    // The first one began where the motion was started, not where chaos throws it.
    let lengths = lengths.get(1..).unwrap_or_default();
    Ok((lengths.len() >= STRETCHES.1).then(|| Beside {
        row,
        eta,
        distance,
        stretches: lengths.len(),
        mean_drive_periods: lengths.iter().sum::<u64>() as f64 / lengths.len() as f64,
        longest_drive_periods: lengths.iter().copied().max().unwrap_or(0),
    }))
}

/// Counts drive periods in a row with an order of impacts, from wherever it begins.
struct Counter {
    order: Vec<usize>,
    last: VecDeque<usize>,
    length: u64,
}

impl Counter {
    fn new(order: Vec<usize>) -> Self {
        Self {
            order,
            last: VecDeque::new(),
            length: 0,
        }
    }

    /// The length of the stretch that this drive period ends, if it does.
    fn enter(&mut self, impacts: usize) -> Option<u64> {
        self.last.push_back(impacts);
        if self.last.len() > self.order.len() {
            self.last.pop_front();
        }
        let twice = self.order.repeat(2);
        let mut orders = twice.windows(self.order.len());
        if orders.any(|order| self.last.iter().eq(order)) {
            self.length += 1;
            return None;
        }
        Some(std::mem::take(&mut self.length)).filter(|length| *length > 0)
    }
}

/// The slope of the straight line through points by least squares.
fn slope(points: &[[f64; 2]]) -> Option<f64> {
    let count = points.len() as f64;
    let mean = |index: usize| points.iter().map(|point| point[index]).sum::<f64>() / count;
    let (x, y) = (mean(0), mean(1));
    let across: f64 = points.iter().map(|point| (point[0] - x).powi(2)).sum();
    let both: f64 = points
        .iter()
        .map(|point| (point[0] - x) * (point[1] - y))
        .sum();
    (points.len() > 2).then(|| both / across)
}
