//! All motions with one impact per drive period, stable or not, from a lattice of times and velocities of that impact.
//!
//! A motion of z = 1 is known from the time t and the before-impact velocity v of its impact. What the next impact is
//! off by ([`MultiSegmentShooting`]) is smooth in both, so a lattice over one drive period and all velocities that the drive can keep
//! up shows the cells in which it may vanish, and Newton's method from there finds where it does. How small the basin
//! of a motion is plays no part.

use super::deflation::DEFLATION_WIDTH;
use super::free_frequency::find_beside_frequency;
use super::multi_segment_shooting::{MultiSegmentShooting, ShootingFailure};
use super::{Orbit, OrbitError};
use crate::extremes::extremes;
use crate::monitor::{Monitor, unmonitored};
use crate::tolerance::{NEAR, SAME};
use softstop::{CheckedScene, Scene};

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

/// Most z = 1 orbits at one frequency: where friction holds the mass at any of many places, there is no end to them.
const MAX_SINGLE_IMPACT_ORBITS: usize = 100;

/// All z = 1 orbits of a scene, those with the hardest impacts last.
///
/// # Errors
/// [`OrbitError::Motion`] if the scene is none; [`OrbitError::Stopped`].
pub(crate) fn single_impact_orbits(
    scene: &Scene,
    monitor: Monitor<'_>,
) -> Result<Vec<Orbit>, OrbitError> {
    Ok(scan_lattice(&scene.check()?, monitor)?.map_or(Vec::new(), |singles| singles.found))
}

/// All z = 1 orbits of a scene, after those that near misses lead to within a share of its frequency.
///
/// # Errors
/// As [`single_impact_orbits`].
pub(crate) fn single_impact_orbits_about_frequency(
    scene: &CheckedScene,
    share: f64,
    monitor: Monitor<'_>,
) -> Result<Vec<Orbit>, OrbitError> {
    let Some(singles) = scan_lattice(scene, monitor)? else {
        return Ok(Vec::new());
    };
    let beside = |impact| find_beside_frequency(scene, impact, share);
    let beside = singles.missed.iter().copied().filter_map(beside);
    let mut all: Vec<Orbit> = beside.filter(|orbit| singles.has_impact(orbit)).collect();
    all.extend(singles.found);
    Ok(all)
}

/// The z = 1 orbits that Newton's method leads to from an impact (s, m/s), first to one, then, deflated, to others.
pub(crate) fn single_impact_orbits_near_impact(
    scene: &CheckedScene,
    impact: (f64, f64),
) -> Vec<Orbit> {
    SingleImpactSearch::new(scene).map_or(Vec::new(), |mut singles| {
        singles
            .search_from(impact, &unmonitored)
            .unwrap_or_default();
        singles.found
    })
}

/// Scans the impact lattice of a scene for z = 1 orbits; none if the scene has no stop.
fn scan_lattice(
    scene: &CheckedScene,
    monitor: Monitor<'_>,
) -> Result<Option<SingleImpactSearch>, OrbitError> {
    OrbitError::ask_monitor(monitor)?;
    let Some(mut singles) = SingleImpactSearch::new(scene) else {
        return Ok(None);
    };
    let lattice = (singles.period, &lattice_speeds(scene)[..]);
    for guess in guess_from_lattice(&singles.shooting, lattice, monitor)? {
        singles.search_from(guess, monitor)?;
    }
    singles.found.sort_by(Orbit::compare_velocity);
    Ok(Some(singles))
}

/// A search for z = 1 orbits, and what its guesses led to.
pub(super) struct SingleImpactSearch {
    pub(super) shooting: MultiSegmentShooting,
    pub(super) period: f64,
    /// The motion's speed in m/s.
    unit: f64,
    /// The orbits that were found.
    pub(super) found: Vec<Orbit>,
    /// Impacts, time in s and velocity in m/s, of near misses.
    missed: Vec<(f64, f64)>,
}

impl SingleImpactSearch {
    /// A search for z = 1 orbits of a scene; none if the scene has no stop.
    pub(super) fn new(scene: &CheckedScene) -> Option<Self> {
        Some(Self {
            shooting: MultiSegmentShooting::new(scene, 1)?,
            period: scene.clock().period(),
            unit: scene.motion_scales().speed(),
            found: Vec::new(),
            missed: Vec::new(),
        })
    }

    /// Follows Newton's method from a guessed impact, and to others beside the orbit that it leads to.
    fn search_from(&mut self, guess: (f64, f64), monitor: Monitor<'_>) -> Result<(), OrbitError> {
        OrbitError::ask_monitor(monitor)?;
        let (period, impacts) = (self.period, self.found_impacts());
        let known = |at: &[f64]| {
            let near = |other| impact_distance(other, (at[0], at[1]), period) < NEAR;
            impacts.iter().copied().any(near)
        };
        let Some(guess) = self.shooting.evaluate_guess(&[guess]) else {
            return Ok(());
        };
        let settled = self.shooting.solve_unless_known(guess.clone(), known, &[]);
        let mut next = settled.map_err(|failed| self.keep_miss(failed));
        while let Ok(orbit) = next {
            OrbitError::ask_monitor(monitor)?;
            if orbit.is_some_and(|orbit| !self.keep_new(orbit)) {
                break;
            }
            let apart = self.shooting.solve(guess.clone(), &self.found_impacts());
            next = apart.map(Some).map_err(drop);
        }
        Ok(())
    }

    /// Keeps an orbit that does more than graze and is not known; false if it does not, or there are too many.
    pub(super) fn keep_new(&mut self, orbit: Orbit) -> bool {
        let distance = |known| impact_distance(impact_of(known), impact_of(&orbit), self.period);
        let is_known = self.found.iter().any(|known| distance(known) < SAME);
        let is_kept =
            self.has_impact(&orbit) && !is_known && self.found.len() < MAX_SINGLE_IMPACT_ORBITS;
        if is_kept {
            self.found.push(orbit);
        }
        is_kept
    }

    /// True if the impact of an orbit is more than grazing to rounding.
    fn has_impact(&self, orbit: &Orbit) -> bool {
        orbit.before_impact_velocity() > SAME * self.unit
    }

    /// The impacts, times in s and velocities in m/s, of the orbits found so far.
    pub(super) fn found_impacts(&self) -> Vec<(f64, f64)> {
        self.found.iter().map(impact_of).collect()
    }

    /// Keeps the impact of a search that settled nowhere, if it is a near miss, by less than the velocity and the motion's
    /// speed, and a new one.
    fn keep_miss(&mut self, failed: ShootingFailure) {
        let ShootingFailure {
            impact, residual, ..
        } = failed;
        let told =
            |other: &(f64, f64)| impact_distance(*other, impact, self.period) < DEFLATION_WIDTH;
        if residual < (impact.1 / self.unit).max(1.0) && !self.missed.iter().any(told) {
            self.missed.push(impact);
        }
    }
}

/// Time in s and before-impact velocity in m/s of the impact of a z = 1 orbit.
fn impact_of(orbit: &Orbit) -> (f64, f64) {
    orbit.timed_impacts()[0]
}

/// Distance of two impacts, each a time in s and a velocity in m/s: a share of the period, or of the velocity.
pub(super) fn impact_distance((t, v): (f64, f64), (u, w): (f64, f64), period: f64) -> f64 {
    time_distance(t, u, period).max((v - w).abs() / v.max(w))
}

/// Distance of two times around the period, as a share of it.
pub(super) fn time_distance(one: f64, other: f64, period: f64) -> f64 {
    let between = (one - other).rem_euclid(period);
    between.min(period - between) / period
}

/// Guesses of impacts: middles of fine lattice cells in which the residual may vanish, within coarse ones.
pub(super) fn guess_from_lattice(
    shooting: &MultiSegmentShooting,
    (period, speeds): (f64, &[f64]),
    monitor: Monitor<'_>,
) -> Result<Vec<(f64, f64)>, OrbitError> {
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
            if !may_vanish(&coarse, 1.0) {
                continue;
            }
            for (column, row) in
                (column..column + COARSE_STRIDE).flat_map(|c| (row..top).map(move |r| (c, r)))
            {
                let fine = lattice.cell_corners([column, column + 1], [row, row + 1])?;
                if may_vanish(&fine, FINE_SLACK) {
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
fn may_vanish(corners: &[Option<[f64; 2]>; 4], slack: f64) -> bool {
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
