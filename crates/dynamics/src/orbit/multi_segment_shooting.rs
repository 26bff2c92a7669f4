//! Newton's method from impact to impact, regular at grazing.
//!
//! Where a periodic motion grazes the stop, its stroboscopic map has a square root: the time of an impact, as
//! a function of the state before, and with it the saltation matrix, grows without bound as the
//! before-impact velocity goes to zero. Newton's method on the map then leaps out of the domain of the
//! square root (Ghosh and Simpson, arXiv 2510.16218). From impact to impact there is none: the unknowns are
//! the time t and the before-impact velocity v of each impact, and what has to vanish is how far the free motion
//! after each contact, followed to the time of the next impact as if there were no stop, is then from
//! the clearance, and its velocity from the next v. All of it is smooth in t and v down to v = 0: contact
//! lasts about 2 v / |a|, and its own tangent takes the factor 1/v of the saltation away again. Nothing is
//! linearised about the clearance, so no saltation is wrong for a weak impact (Chawla et al., arXiv 2506.18379).

use nalgebra::{DMatrix, DVector, Vector2};

use super::contact_passage::{ClearanceSurface, ContactPassage};
use super::deflation::deflation_factor;
use super::{Orbit, OrbitError, TimedImpact};
use crate::solve_linear::solve_linear;
use crate::tolerance::ROUNDING_SHARE;
use softstop::internals::Scales;
use softstop::{CheckedScene, Clock};

/// Newton steps of the shooting before giving up.
const MAX_SHOOTING_STEPS: usize = 60;
/// Newton steps in a row that may fail to halve the least residual so far.
const MAX_IDLE_STEPS: usize = 16;
/// Halvings of a Newton step that leads to no motion.
const MAX_HALVINGS: u32 = 8;

/// Share of the drive period by which a Newton step may move an impact, and of its velocity that it must leave.
const MAX_STEP_SHARE: f64 = 0.1;

/// Unknowns of the shooting: times in s from drive period 0 on and before-impact velocities in m/s, by turns.
pub(super) type ImpactUnknowns = DVector<f64>;

/// Shooting from impact to impact for a periodic orbit of a scene over a number of drive periods.
pub(super) struct MultiSegmentShooting {
    scales: Scales,
    pub(super) clearance: ClearanceSurface,
    pub(super) periods: u64,
}

/// The segments from impact to impact at some unknowns, with residual and Jacobian.
#[derive(Clone)]
pub(super) struct ShootingEvaluation {
    pub passages: Vec<ContactPassage>,
    residual: DVector<f64>,
    jacobian: DMatrix<f64>,
}

/// A guess of the shooting's unknowns, evaluated.
pub(super) type EvaluatedGuess = (ImpactUnknowns, ShootingEvaluation);

/// Why the shooting settled on no orbit, with its nearest miss: the first impact, time in s and velocity in m/s, where the
/// residual was least.
pub(super) struct ShootingFailure {
    error: OrbitError,
    pub impact: TimedImpact,
    pub residual: f64,
}

impl From<OrbitError> for ShootingFailure {
    fn from(error: OrbitError) -> Self {
        Self {
            error,
            impact: (0.0, 0.0),
            residual: f64::INFINITY,
        }
    }
}

impl From<ShootingFailure> for OrbitError {
    fn from(failed: ShootingFailure) -> Self {
        failed.error
    }
}

impl MultiSegmentShooting {
    /// The shooting for orbits of a scene; none if the scene has no stop.
    pub(super) fn new(scene: &CheckedScene, periods: u64) -> Option<Self> {
        let clearance = ClearanceSurface::new(scene)?;
        Some(Self {
            scales: scene.scales(),
            clearance,
            periods,
        })
    }

    /// The drive periods of the orbit of the shooting, in s.
    pub(super) fn span(&self) -> f64 {
        self.clearance.clock.time(Clock::at_cycle(self.periods))
    }

    /// The orbit with as many impacts as the guess has, to which the shooting leads from there, away from `deflated` ones.
    ///
    /// # Errors
    /// [`OrbitError`] if it does not settle, or settles on impacts between which there are others.
    pub(super) fn solve(
        &self,
        guess: EvaluatedGuess,
        deflated: &[TimedImpact],
    ) -> Result<Orbit, OrbitError> {
        let found = self.solve_unless_known(guess, |_| false, deflated)?;
        found.ok_or(OrbitError::LOST)
    }

    /// The shooting's unknowns for guessed impacts, evaluated; none where there is no such motion.
    pub(super) fn evaluate_guess(&self, guess: &[TimedImpact]) -> Option<EvaluatedGuess> {
        let flat = guess.iter().flat_map(|&(time, velocity)| [time, velocity]);
        let at = ImpactUnknowns::from_iterator(2 * guess.len(), flat);
        let evaluation = self.evaluate_segments(&at)?;
        Some((at, evaluation))
    }

    /// The orbit that the shooting settles on, by Newton's method for impacts from a guess, away from `deflated` ones; none as
    /// soon as a whole step leads to impacts that are known.
    pub(super) fn solve_unless_known(
        &self,
        (mut at, mut evaluation): EvaluatedGuess,
        known: impl Fn(&[f64]) -> bool,
        deflated: &[TimedImpact],
    ) -> Result<Option<Orbit>, ShootingFailure> {
        let (mut least, mut idle) = (f64::INFINITY, 0);
        let mut nearest = ShootingFailure::from(OrbitError::LOST);
        for _ in 0..MAX_SHOOTING_STEPS {
            let residual = evaluation.residual.norm();
            if residual < nearest.residual {
                (nearest.impact, nearest.residual) = ((at[0], at[1]), residual);
            }
            (least, idle) = match residual < 0.5 * least {
                true => (residual, 0),
                false => (least, idle + 1),
            };
            if idle > MAX_IDLE_STEPS {
                break;
            }
            let Some(mut step) = solve_linear(&evaluation.jacobian, &evaluation.residual) else {
                break;
            };
            step.neg_mut();
            let period = self.clearance.clock.period();
            step *= deflation_factor((at[0], at[1]), (step[0], step[1]), deflated, period);
            let Some((share, next, tried)) = self.take_step(&at, &step) else {
                break;
            };
            let whole = share == 1.0;
            let shrinks = tried.residual.norm() < evaluation.residual.norm();
            if whole && !shrinks && self.is_solved(&at, &evaluation, 1.0) {
                return Ok(Some(self.orbit_of_segments(&at, &evaluation)?));
            }
            (at, evaluation) = (next, tried);
            if whole && known(at.as_slice()) {
                return Ok(None);
            }
            if self.is_solved(&at, &evaluation, ROUNDING_SHARE) {
                return Ok(Some(self.orbit_of_segments(&at, &evaluation)?));
            }
        }
        nearest.error = OrbitError::Diverged {
            residual: evaluation.residual.norm(),
        };
        Err(nearest)
    }

    /// What a motion with this impact alone is off by at the next one: position and velocity, scaled.
    pub(super) fn return_gap(&self, time: f64, velocity: f64) -> Option<[f64; 2]> {
        let clock = &self.clearance.clock;
        let from = clock.instant(time);
        let passage: ContactPassage<()> =
            self.clearance.pass_contact(from, velocity, self.span())?;
        let to = clock.instant(time + self.span());
        let flight = clock.elapsed(passage.free_from, to);
        let gap = |(position, arriving)| self.scaled_impact_gap((position, arriving), velocity);
        (flight > 0.0).then(|| gap(passage.course.state_at(flight, clock.drive(to))).into())
    }

    /// What a state at the clearance is off by where an impact of a velocity should be: position and velocity, scaled.
    fn scaled_impact_gap(&self, (position, velocity): (f64, f64), expected: f64) -> Vector2<f64> {
        let gap = Vector2::new(
            position - self.clearance.surface_position(),
            velocity - expected,
        );
        self.scales.state(&gap)
    }

    /// True if the residual of the shooting is no more than a share of what rounding alone may leave.
    fn is_solved(&self, at: &ImpactUnknowns, evaluation: &ShootingEvaluation, share: f64) -> bool {
        let velocities = at.iter().skip(1).step_by(2);
        let fastest = velocities.fold(0.0, |fastest: f64, velocity| fastest.max(*velocity));
        let scales = &self.scales;
        let state =
            self.clearance.surface_position().abs() / scales.length + fastest / scales.speed();
        let units = [1.0 / scales.rate, scales.speed()].into_iter().cycle();
        let columns = evaluation.jacobian.column_iter().zip(units);
        let entries =
            columns.flat_map(|(column, unit)| column.into_iter().map(move |it| it * unit));
        let norm = entries.map(|entry| entry * entry).sum::<f64>().sqrt();
        let rounding = 1e-14 * (1.0 + state) * (1.0 + norm);
        evaluation.residual.norm() <= share * rounding
    }

    /// The unknowns after as much of a Newton step as can be taken, with that share and their evaluation.
    fn take_step(
        &self,
        at: &ImpactUnknowns,
        step: &ImpactUnknowns,
    ) -> Option<(f64, ImpactUnknowns, ShootingEvaluation)> {
        let mut share = 1.0f64;
        for (index, (value, change)) in at.iter().zip(step).enumerate() {
            let (most, taken) = if index % 2 == 0 {
                (MAX_STEP_SHARE * self.clearance.clock.period(), change.abs())
            } else {
                ((1.0 - MAX_STEP_SHARE) * value, -change)
            };
            if taken > most {
                share = share.min(most / taken);
            }
        }
        (0..MAX_HALVINGS).find_map(|halvings| {
            let share = share / f64::from(1 << halvings);
            let moved = at
                .iter()
                .zip(step)
                .map(|(value, change)| value + share * change);
            let next = ImpactUnknowns::from_iterator(at.len(), moved);
            let evaluation = self.evaluate_segments(&next)?;
            Some((share, next, evaluation))
        })
    }

    /// Evaluates all segments from impact to impact, with residual and Jacobian; none where there is no such motion.
    fn evaluate_segments(&self, at: &ImpactUnknowns) -> Option<ShootingEvaluation> {
        let count = at.len() / 2;
        let mut evaluation = ShootingEvaluation {
            passages: Vec::with_capacity(count),
            residual: DVector::zeros(2 * count),
            jacobian: DMatrix::zeros(2 * count, 2 * count),
        };
        for segment in 0..count {
            let next = (segment + 1) % count;
            let around = if next <= segment { self.span() } else { 0.0 };
            let clock = &self.clearance.clock;
            let (from, to) = (clock.instant(at[2 * segment]), at[2 * next] + around);
            let longest = to - at[2 * segment];
            let before = at[2 * segment + 1];
            let passing: ContactPassage = self.clearance.pass_contact(from, before, longest)?;
            let to = clock.instant(to);
            let flight = clock.elapsed(passing.free_from, to);
            if flight <= 0.0 {
                return None;
            }
            let drive = clock.drive(to);
            let (position, velocity) = passing.course.state_at(flight, drive);
            let course = &passing.course;
            let forcing = course.flow.amplitude * drive.cos;
            let acceleration = course.flow.acceleration(position, velocity, forcing);
            let through = course.flow.modes.transition(flight) * passing.tangent.matrix;
            let (rows, column, ahead) = (2 * segment, 2 * segment, 2 * next);
            let mut fit = evaluation.residual.fixed_rows_mut::<2>(rows);
            fit.copy_from(&self.scaled_impact_gap((position, velocity), at[ahead + 1]));
            let mut add = |column: usize, by: Vector2<f64>| {
                let by = self.scales.state(&by);
                evaluation.jacobian[(rows, column)] += by.x;
                evaluation.jacobian[(rows + 1, column)] += by.y;
            };
            let after = passing.velocity_after;
            add(
                column,
                through * -Vector2::new(after, self.clearance.acceleration_after(from, &passing)),
            );
            add(column + 1, through * Vector2::new(0.0, after / before));
            add(ahead, Vector2::new(velocity, acceleration));
            add(ahead + 1, Vector2::new(0.0, -1.0));
            evaluation.passages.push(passing);
        }
        Some(evaluation)
    }
}
