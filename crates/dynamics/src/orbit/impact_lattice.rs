//! The lattice of times and velocities of one impact per drive period, which guesses of z = 1 orbits are drawn from.

use super::multi_segment_shooting::MultiSegmentShooting;
use super::{OrbitError, TimedImpact};
use crate::extremes::extremes;
use crate::monitor::Monitor;
use softstop::Scene;

/// Times of the impact lattice in a drive period.
pub(super) const LATTICE_TIMES: usize = 20;
/// Ratio of neighbouring velocities of the impact lattice.
pub(super) const LATTICE_SPEED_RATIO: f64 = 1.25;
/// Every so many times and velocities of the lattice are coarse ones, looked at first.
const COARSE_STRIDE: usize = 2;
/// How near to zero, in units of its change in a fine cell, the residual must come for Newton's method to begin there.
const FINE_SLACK: f64 = 0.5;
/// The slowest impact of the lattice, in units of the motion's speed.
const MIN_LATTICE_SPEED: f64 = 0.005;
/// The fastest impact of the lattice, in units of the speed at which damping takes all that the drive gives.
const MAX_DAMPED_SPEED: f64 = 1.5;
/// The fastest impact of the lattice in units of the motion's speed, for machines with little damping or none.
const MAX_UNDAMPED_SPEED: f64 = 2000.0;

/// Guesses of impacts: middles of fine lattice cells in which the residual may vanish, within coarse ones.
pub(super) fn guess_impacts_from_lattice(
    shooting: &MultiSegmentShooting,
    (period, speeds): (f64, &[f64]),
    monitor: Monitor<'_>,
) -> Result<Vec<TimedImpact>, OrbitError> {
    let width = period / LATTICE_TIMES as f64;
    let mut lattice = ImpactLattice {
        shooting,
        width,
        known: vec![None; LATTICE_TIMES * speeds.len()],
        speeds,
        monitor,
    };
    let last = speeds.len().saturating_sub(1);
    let mut guesses = Vec::new();
    for column in (0..LATTICE_TIMES).step_by(COARSE_STRIDE) {
        for row in (0..last).step_by(COARSE_STRIDE) {
            let top = last.min(row + COARSE_STRIDE);
            let coarse = lattice.cell_corners([column, column + COARSE_STRIDE], [row, top])?;
            if !residual_may_vanish(&coarse, 1.0) {
                continue;
            }
            for (column, row) in
                (column..column + COARSE_STRIDE).flat_map(|c| (row..top).map(move |r| (c, r)))
            {
                let fine = lattice.cell_corners([column, column + 1], [row, row + 1])?;
                if residual_may_vanish(&fine, FINE_SLACK) {
                    let middle = (column as f64 + 0.5) * width;
                    guesses.push((middle, speeds[row] * LATTICE_SPEED_RATIO.sqrt()));
                }
            }
        }
    }
    Ok(guesses)
}

/// The lattice of impacts at times and velocities, with the residual of each, computed where it is asked for.
struct ImpactLattice<'a> {
    shooting: &'a MultiSegmentShooting,
    /// Between two times of the lattice, in s.
    width: f64,
    speeds: &'a [f64],
    known: Vec<Option<Option<[f64; 2]>>>,
    monitor: Monitor<'a>,
}

impl ImpactLattice<'_> {
    /// The residuals at the four corners of a lattice cell.
    fn cell_corners(
        &mut self,
        columns: [usize; 2],
        rows: [usize; 2],
    ) -> Result<[Option<[f64; 2]>; 4], OrbitError> {
        let mut corners = [None; 4];
        let places = columns
            .into_iter()
            .flat_map(|column| rows.map(|row| (column % LATTICE_TIMES, row)));
        for (corner, (column, row)) in corners.iter_mut().zip(places) {
            let place = column * self.speeds.len() + row;
            *corner = match self.known[place] {
                Some(known) => known,
                None => {
                    OrbitError::ask_monitor(self.monitor)?;
                    let time = column as f64 * self.width;
                    *self.known[place].insert(self.shooting.return_gap(time, self.speeds[row]))
                }
            };
        }
        Ok(corners)
    }
}

/// True if both parts nearly change their sign between corners, or may do so where there is no such motion.
fn residual_may_vanish(corners: &[Option<[f64; 2]>; 4], slack: f64) -> bool {
    let known = corners.iter().flatten();
    let changes = |part: usize| {
        let values = known.clone().map(|gap| gap[part]);
        let [low, high] = extremes(values)?;
        let near = slack * (high - low);
        Some(low <= near && high >= -near)
    };
    let count = [0, 1]
        .into_iter()
        .filter(|part| changes(*part) == Some(true))
        .count();
    count > usize::from(known.count() == corners.len())
}

/// Before-impact velocities in m/s of the impact lattice, in rising order.
pub(super) fn lattice_speeds(scene: &Scene) -> Vec<f64> {
    let scales = scene.motion_scales();
    let unit = scales.speed();
    let damping = scene.damping.min(scene.contact_damping);
    let most = MAX_DAMPED_SPEED * scene.excitation.amplitude / damping;
    let highest = most.clamp(4.0 * unit, MAX_UNDAMPED_SPEED * unit);
    let count = (highest / (MIN_LATTICE_SPEED * unit)).ln() / LATTICE_SPEED_RATIO.ln();
    let speed = |index: usize| MIN_LATTICE_SPEED * unit * LATTICE_SPEED_RATIO.powi(index as i32);
    (0..=count.ceil() as usize).map(speed).collect()
}
