//! All motions with one impact per drive period, stable or not: every impact that such a motion may have is looked at.
//!
//! A motion of z = 1 is known from the time t and the before-impact velocity v of its impact. What the next impact is
//! off by ([`MultiSegmentShooting`]) is smooth in both, so a lattice over one drive period and all velocities that the drive can keep
//! up shows the cells in which it may vanish, and Newton's method from there finds where it does. How small the basin
//! of a motion is plays no part.

use super::beside::beside_frequency;
use super::multi_segment_shooting::{MultiSegmentShooting, Nearest};
use super::{Orbit, OrbitError};
use crate::extremes::extremes;
use crate::monitor::{Monitor, unmonitored};
use softstop::Scene;

/// Times in a drive period, and velocities, each so many times the one before.
pub(super) const TIMES: usize = 20;
pub(super) const RATIO: f64 = 1.25;
/// Every so many of both are looked at first; and how near to zero, in units of its change there, the residual must come
/// in a cell of them for the others to be, and in one of these for Newton's method to begin there.
const COARSE: usize = 2;
const SLACK: f64 = 1.0;
const NARROW: f64 = 0.5;
/// The slowest impact that is looked for, in units of the motion's speed.
const SLOWEST_IMPACT: f64 = 0.005;
/// Below that, in the same units, an impact is no more than rounding about grazing.
pub(crate) const FAINTEST: f64 = 1e-6;
/// The fastest, in units of the speed at which free damping takes all that the drive gives to a harmonic motion.
const FASTEST: f64 = 1.5;
/// The fastest in units of the motion's speed, for machines with little damping or none.
const UTMOST: f64 = 2000.0;
/// Difference of times, in units of the period, and of velocities, in units of themselves, within which impacts are
/// the same, and within which Newton's method leads from one to the other.
const SAME_IMPACT: f64 = 1e-6;
pub(super) const NEAR_IMPACT: f64 = 1e-3;

/// Residual in units of the velocity, or of the motion's speed if that is higher, up to which a miss is a near one; and
/// difference from another one, as above, within which it is none of its own.
const MISSED: f64 = 1.0;
const TOLD: f64 = 0.05;

/// Most motions at one frequency: where friction holds the mass at any of many places, there is no end to them.
const MAX_ORBITS: usize = 100;

/// All z = 1 motions, those with the hardest impacts last.
///
/// # Errors
/// [`OrbitError::Motion`] if the scene is none; [`OrbitError::Stopped`].
pub(crate) fn all_single(scene: &Scene, monitor: Monitor<'_>) -> Result<Vec<Orbit>, OrbitError> {
    Ok(scan(scene, monitor)?.map_or(Vec::new(), |singles| singles.found))
}

/// All z = 1 motions, and before them those at frequencies within a share of the scene's that near misses lead to.
///
/// # Errors
/// As [`all_single`].
pub(crate) fn all_about(
    scene: &Scene,
    share: f64,
    monitor: Monitor<'_>,
) -> Result<Vec<Orbit>, OrbitError> {
    let Some(singles) = scan(scene, monitor)? else {
        return Ok(Vec::new());
    };
    let beside = |impact| beside_frequency(scene, impact, share);
    let beside = singles.missed.iter().copied().filter_map(beside);
    let mut all: Vec<Orbit> = beside.filter(|orbit| singles.is_real(orbit)).collect();
    all.extend(singles.found);
    Ok(all)
}

/// The z = 1 motions that Newton's method leads to from the time in s and the before-impact velocity in m/s of an impact,
/// first to one and then, kept away from it, to others.
pub(crate) fn singles_near(scene: &Scene, impact: (f64, f64)) -> Vec<Orbit> {
    Singles::new(scene).map_or(Vec::new(), |mut singles| {
        singles.look(impact, &unmonitored).unwrap_or_default();
        singles.found
    })
}

fn scan<'a>(scene: &'a Scene, monitor: Monitor<'_>) -> Result<Option<Singles<'a>>, OrbitError> {
    scene.validate()?;
    OrbitError::ask(monitor)?;
    let Some(mut singles) = Singles::new(scene) else {
        return Ok(None);
    };
    let lattice = (singles.period, &speeds(scene)[..]);
    for guess in guesses(&singles.shooting, lattice, monitor)? {
        singles.look(guess, monitor)?;
    }
    singles.found.sort_by(Orbit::compare_velocity);
    Ok(Some(singles))
}

/// What guesses led to.
pub(super) struct Singles<'a> {
    pub(super) shooting: MultiSegmentShooting<'a>,
    pub(super) period: f64,
    /// The motion's speed.
    unit: f64,
    /// Motions.
    pub(super) found: Vec<Orbit>,
    /// Impacts that Newton's method came near to fitting at, and settled nowhere.
    missed: Vec<(f64, f64)>,
}

impl<'a> Singles<'a> {
    /// None if the scene has no stop.
    pub(super) fn new(scene: &'a Scene) -> Option<Self> {
        Some(Self {
            shooting: MultiSegmentShooting::new(scene, 1)?,
            period: scene.clock().period(),
            unit: scene.motion_scales().speed(),
            found: Vec::new(),
            missed: Vec::new(),
        })
    }

    /// Follows Newton's method from a guess, and from there to others that may lie beside the motion that it leads to.
    fn look(&mut self, guess: (f64, f64), monitor: Monitor<'_>) -> Result<(), OrbitError> {
        OrbitError::ask(monitor)?;
        let (period, impacts) = (self.period, self.impacts());
        let known = |at: &[f64]| {
            let near = |other| apart(other, (at[0], at[1]), period) < NEAR_IMPACT;
            impacts.iter().copied().any(near)
        };
        let settled = self.shooting.settle_new(&[guess], known);
        let mut next = settled.map_err(|failed| self.miss(failed.nearest));
        while let Ok(orbit) = next {
            OrbitError::ask(monitor)?;
            if orbit.is_some_and(|orbit| !self.keep(orbit)) {
                break;
            }
            let apart = self.shooting.settle_apart(guess, &self.impacts());
            next = apart.map(Some).map_err(drop);
        }
        Ok(())
    }

    /// Keeps a motion that does more than graze and is not known; false if it does not, or there are too many.
    pub(super) fn keep(&mut self, orbit: Orbit) -> bool {
        let is_known = self
            .found
            .iter()
            .any(|known| same(known, &orbit, self.period));
        let is_kept = self.is_real(&orbit) && !is_known && self.found.len() < MAX_ORBITS;
        if is_kept {
            self.found.push(orbit);
        }
        is_kept
    }

    /// True if an orbit does more than graze.
    fn is_real(&self, orbit: &Orbit) -> bool {
        orbit.before_impact_velocity() > FAINTEST * self.unit
    }

    pub(super) fn impacts(&self) -> Vec<(f64, f64)> {
        self.found.iter().map(impact).collect()
    }

    fn miss(&mut self, Nearest { impact, residual }: Nearest) {
        let told = |other: &(f64, f64)| apart(*other, impact, self.period) < TOLD;
        if residual < MISSED * (impact.1 / self.unit).max(1.0) && !self.missed.iter().any(told) {
            self.missed.push(impact);
        }
    }
}

/// True if two orbits have the same impact.
fn same(a: &Orbit, b: &Orbit, period: f64) -> bool {
    apart(impact(a), impact(b), period) < SAME_IMPACT
}

fn impact(orbit: &Orbit) -> (f64, f64) {
    orbit.timed_impacts()[0]
}

/// How far apart two impacts are, each a time and a velocity.
pub(super) fn apart((t, v): (f64, f64), (u, w): (f64, f64), period: f64) -> f64 {
    between(t, u, period).max((v - w).abs() / v.max(w))
}

/// How far apart two times are, as a share of the period.
pub(super) fn between(one: f64, other: f64, period: f64) -> f64 {
    let between = (one - other).rem_euclid(period);
    between.min(period - between) / period
}

/// The middles of the cells in which the residual may vanish. Coarse cells are looked at first, and those divided that it
/// comes near to zero in.
pub(super) fn guesses(
    shooting: &MultiSegmentShooting<'_>,
    (period, speeds): (f64, &[f64]),
    monitor: Monitor<'_>,
) -> Result<Vec<(f64, f64)>, OrbitError> {
    let width = period / TIMES as f64;
    let mut lattice = Lattice {
        shooting,
        width,
        known: vec![None; TIMES * speeds.len()],
        speeds,
        monitor,
    };
    let last = speeds.len().saturating_sub(1);
    let mut guesses = Vec::new();
    for column in (0..TIMES).step_by(COARSE) {
        for row in (0..last).step_by(COARSE) {
            let top = last.min(row + COARSE);
            let coarse = lattice.corners([column, column + COARSE], [row, top])?;
            if !may_vanish(&coarse, SLACK) {
                continue;
            }
            for (column, row) in
                (column..column + COARSE).flat_map(|c| (row..top).map(move |r| (c, r)))
            {
                let fine = lattice.corners([column, column + 1], [row, row + 1])?;
                if may_vanish(&fine, NARROW) {
                    let middle = (column as f64 + 0.5) * width;
                    guesses.push((middle, speeds[row] * RATIO.sqrt()));
                }
            }
        }
    }
    Ok(guesses)
}

/// What impacts at times and velocities are off by, computed where it is asked for.
struct Lattice<'a> {
    shooting: &'a MultiSegmentShooting<'a>,
    /// Between two times, in s.
    width: f64,
    speeds: &'a [f64],
    known: Vec<Option<Option<[f64; 2]>>>,
    monitor: Monitor<'a>,
}

impl Lattice<'_> {
    /// The four corners of a cell.
    fn corners(
        &mut self,
        columns: [usize; 2],
        rows: [usize; 2],
    ) -> Result<[Option<[f64; 2]>; 4], OrbitError> {
        let mut corners = [None; 4];
        let places = columns
            .into_iter()
            .flat_map(|column| rows.map(|row| (column % TIMES, row)));
        for (corner, (column, row)) in corners.iter_mut().zip(places) {
            let place = column * self.speeds.len() + row;
            *corner = match self.known[place] {
                Some(known) => known,
                None => {
                    OrbitError::ask(self.monitor)?;
                    let time = column as f64 * self.width;
                    *self.known[place].insert(self.shooting.gap(time, self.speeds[row]))
                }
            };
        }
        Ok(corners)
    }
}

/// True if both parts change their sign between corners, or come as near to it as a share of what they change by, or may
/// do so beyond those where there is no such motion.
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

/// Before-impact velocities in m/s, in rising order.
pub(super) fn speeds(scene: &Scene) -> Vec<f64> {
    let scales = scene.motion_scales();
    let unit = scales.speed();
    let damping = scene.damping.min(scene.contact_damping);
    let most = FASTEST * scene.excitation.amplitude / damping;
    let highest = most.clamp(4.0 * unit, UTMOST * unit);
    let count = (highest / (SLOWEST_IMPACT * unit)).ln() / RATIO.ln();
    let speed = |index: usize| SLOWEST_IMPACT * unit * RATIO.powi(index as i32);
    (0..=count.ceil() as usize).map(speed).collect()
}
