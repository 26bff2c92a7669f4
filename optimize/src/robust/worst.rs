//! The worst machine between the bounds.

use crate::order::sort_rising;
use crate::spread::{in_coordinates, varied};
use softstop_dynamics::derivatives;
use softstop_dynamics::figure::{Figure, Sense};
use softstop_dynamics::monitor::Monitor;
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::parallel;
use softstop_dynamics::{CycleMetrics, Orbit};

use super::Tolerances;
use super::corners::corners;
use super::neighbours::Neighbours;
use super::rates::rates;
use crate::design::requirement::sign;

/// Steps towards the worst machine, and halvings of one.
const STEPS: usize = 60;
const HALVINGS: usize = 40;
/// Share of a value that is nothing to gain.
const GAIN: f64 = 1e-10;
/// Change of a coordinate over which a figure without exact derivatives is differenced.
const DIFFERENCE: f64 = 1e-3;
/// Corners that are looked at, at most, and from how many of the worst of them steps are taken.
const CORNERS: usize = 16;
const STARTS: usize = 3;

/// The machine with the worst value of a figure.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Worst {
    /// Its coordinates.
    pub at: Vec<f64>,
    /// Its motion.
    pub orbit: Orbit,
    /// Its value of the figure, in SI units.
    pub value: f64,
    /// d(value)/d(coordinate) there; zeros at a fold, where it has none.
    pub slopes: Vec<f64>,
}

/// The worst value between the bounds of each figure that a motion tells by itself, the least of one whose good side is
/// [`Sense::Least`], else the largest: by steps along the figure's gradient that end at the bounds, from the nominal machine
/// and from the worst corners, until no coordinate at its other bound is worse. Where machines between the bounds lose the
/// motion, it is that of the machines on this side of the loss.
///
/// # Errors
/// [`OrbitError::Stopped`]; [`OrbitError`] if the nominal motion is not one to start from.
pub fn worst(
    spread: &Tolerances,
    nominal: &Orbit,
    figures: &[(Figure, Sense)],
    watcher: Monitor<'_>,
) -> Result<Vec<Worst>, OrbitError> {
    let neighbours = Neighbours::new(spread, nominal);
    let corners = corners(spread.dimensions(), CORNERS);
    let corners = parallel::filter_map(&corners, |at| Some((neighbours.motion(at)?, at.clone())));
    parallel::try_map(figures, |(figure, sense)| {
        let search = WorstSearch {
            neighbours: &neighbours,
            figure: *figure,
            // What is worst is least.
            sign: sign(*sense),
            watcher,
        };
        search.run(&corners)
    })
}

/// The search for the machine with the least value of a figure, times a sign.
struct WorstSearch<'a> {
    neighbours: &'a Neighbours<'a>,
    figure: Figure,
    sign: f64,
    watcher: Monitor<'a>,
}

impl WorstSearch<'_> {
    fn run(&self, corners: &[(Orbit, Vec<f64>)]) -> Result<Worst, OrbitError> {
        let Neighbours {
            spread, nominal, ..
        } = self.neighbours;
        let dimensions = spread.dimensions();
        let nominal = self.point(vec![0.0; dimensions], (*nominal).clone());
        let mut best = self.descend(nominal.ok_or(OrbitError::NotIsolated)?)?;
        let tried = corners
            .iter()
            .filter_map(|(orbit, at)| Some((self.signed(orbit)?, orbit, at)));
        let mut starts: Vec<(f64, &Orbit, &Vec<f64>)> = tried.collect();
        sort_rising(&mut starts, |it| it.0);
        for (_, orbit, at) in starts.into_iter().take(STARTS) {
            let Some(start) = self.point(at.clone(), orbit.clone()) else {
                continue;
            };
            let other = self.descend(start)?;
            if self.sign * other.value < self.sign * best.value {
                best = other;
            }
        }
        let flipped = |best: &Worst| {
            (0..2 * dimensions).find_map(|index| {
                let mut at = best.at.clone();
                at[index / 2] = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
                let orbit = self.neighbours.motion(&at)?;
                let gain = self.sign * best.value - self.signed(&orbit)?;
                let is_worse = gain > GAIN * best.value.abs();
                is_worse.then(|| self.point(at, orbit)).flatten()
            })
        };
        while let Some(start) = flipped(&best) {
            best = self.descend(start)?;
        }
        Ok(best)
    }

    /// What is least where a motion is worst.
    fn signed(&self, orbit: &Orbit) -> Option<f64> {
        let value = self.neighbours.spread.value(self.figure, orbit);
        value.map(|value| self.sign * value)
    }

    /// The derivatives of a motion's figure: exact, or by differences where it has no exact ones.
    fn slopes(&self, at: &[f64], orbit: &Orbit) -> Option<Vec<f64>> {
        let value = |index: usize, change: f64| {
            let mut at = at.to_vec();
            at[index] += change;
            self.neighbours.value(&at, self.figure)
        };
        let slope = |index| {
            let (below, above) = (value(index, -DIFFERENCE)?, value(index, DIFFERENCE)?);
            Some((above - below) / (2.0 * DIFFERENCE))
        };
        let exact = || {
            let spread = self.neighbours.spread;
            let slopes = derivatives::differentiate_orbit(orbit, &varied(spread, at)).ok()?;
            let stroke = CycleMetrics::of(orbit).ok()?;
            let by = rates((self.figure, spread.cost()), &slopes, (orbit, &stroke))?;
            Some(in_coordinates(spread, at, &slopes.parameters, &by))
        };
        exact().or_else(|| (0..at.len()).map(slope).collect())
    }

    /// A machine and its motion, which may have no value; without derivatives at a fold, where no step leads on.
    fn point(&self, at: Vec<f64>, orbit: Orbit) -> Option<Worst> {
        let slopes = self.slopes(&at, &orbit);
        Some(Worst {
            slopes: slopes.unwrap_or_else(|| vec![0.0; at.len()]),
            value: self.neighbours.spread.value(self.figure, &orbit)?,
            at,
            orbit,
        })
    }

    /// Steps down from a machine.
    fn descend(&self, start: Worst) -> Result<Worst, OrbitError> {
        let mut here = start;
        for _ in 0..STEPS {
            let Some(next) = self.step(&here)? else {
                break;
            };
            here = next;
        }
        Ok(here)
    }

    /// A worse machine down the gradient, if there is one.
    fn step(&self, here: &Worst) -> Result<Option<Worst>, OrbitError> {
        let slopes: Vec<f64> = here.slopes.iter().map(|slope| self.sign * slope).collect();
        let sizes = slopes.iter().map(|slope| slope.abs());
        let flattest = sizes.filter(|slope| *slope > 0.0).min_by(f64::total_cmp);
        let Some(flattest) = flattest else {
            return Ok(None);
        };
        // Far enough for all coordinates to come to their bounds.
        let mut length = 2.0 / flattest;
        for _ in 0..HALVINGS {
            if (self.watcher)(0, 0).is_break() {
                return Err(OrbitError::Stopped);
            }
            let down = here.at.iter().zip(&slopes);
            let at: Vec<f64> = down
                .map(|(at, slope)| (at - length * slope).clamp(-1.0, 1.0))
                .collect();
            let ways = at.iter().zip(&here.at).zip(&slopes);
            let gain: f64 = ways.map(|((to, from), slope)| slope * (from - to)).sum();
            if gain <= GAIN * here.value.abs() {
                break;
            }
            let tried = self.neighbours.motion(&at);
            let is_worse = |orbit: &Orbit| {
                let value = self.signed(orbit);
                value.is_some_and(|value| value < self.sign * here.value)
            };
            if let Some(orbit) = tried.filter(is_worse) {
                return Ok(self.point(at, orbit));
            }
            length *= 0.5;
        }
        Ok(None)
    }
}

/// d(before-impact velocity)/d(coordinate) in m/s of the nominal motion.
pub(super) fn nominal_slopes(
    spread: &Tolerances,
    nominal: &Orbit,
    watcher: Monitor<'_>,
) -> Result<Vec<f64>, OrbitError> {
    let search = WorstSearch {
        neighbours: &Neighbours::new(spread, nominal),
        figure: Figure::Velocity,
        sign: 1.0,
        watcher,
    };
    let slopes = search.slopes(&vec![0.0; spread.dimensions()], nominal);
    slopes.ok_or(OrbitError::NotIsolated)
}
