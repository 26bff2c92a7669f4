//! The periodic orbit to which segments from impact to impact close, with its monodromy matrix as a product over them.

use nalgebra::{Matrix2, Vector2};

use super::contact_passage::ContactPassage;
use super::multi_segment_shooting::{MultiSegmentShooting, ShootingEvaluation, Unknowns};
use super::{Monodromy, Orbit, OrbitError, StroboscopicMap};
use crate::tolerance::ROUNDING;
use softstop::internals::{LinearLaw, Motion, NextEvent, PhaseId, first_crossing};
use softstop::{CheckedScene, Clock, ImpactEvent, Instant, Tangent};

/// Share of the drive period by which an impact found by its crossing may precede the one that segments were shot to: by the
/// square root of what Newton's method leaves, where the impact is weak.
const IMPACT_TIME_TOLERANCE: f64 = 1e-4;

impl MultiSegmentShooting {
    /// The periodic orbit through impacts between which the segments of the shooting fit.
    pub(super) fn close_orbit(
        &self,
        at: &Unknowns,
        evaluation: &ShootingEvaluation,
    ) -> Result<Orbit, OrbitError> {
        self.check_flights(at, evaluation)?;
        let clock = self.face.clock;
        let mut impacts: Vec<(f64, f64, &ContactPassage)> = evaluation
            .passages
            .iter()
            .enumerate()
            .map(|(segment, passing)| {
                let time = at[2 * segment].rem_euclid(self.span());
                (time, at[2 * segment + 1], passing)
            })
            .collect();
        impacts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (time, _, last) = impacts[impacts.len() - 1];
        let free = self.span() - time - last.lasting;
        let (state, tail) = self.tail_after_last_impact(time, last)?;
        let mut factors = vec![self.head_to_first_impact(impacts[0].0, free, state)?];
        // The factor by the saltation at the impact of a contact.
        let entry = |&(time, velocity, passing): &(f64, f64, &ContactPassage)| {
            let matrix = self
                .face
                .entry_saltation(clock.instant(time), velocity, passing);
            (matrix, matrix.determinant())
        };
        for pair in impacts.windows(2) {
            let (time, _, passing) = pair[0];
            let flight = pair[1].0 - time - passing.lasting;
            let free = flight_factor(&passing.course.flow, flight);
            factors.extend([entry(&pair[0]), factor(&passing.tangent), free]);
        }
        factors.extend(impacts.last().map(entry));
        if free >= 0.0 {
            factors.extend([
                factor(&last.tangent),
                flight_factor(&last.course.flow, free),
            ]);
        } else {
            factors.push(tail);
        }
        let contacts = impacts.iter().map(|(_, _, passing)| passing);
        let touched: f64 = contacts.clone().map(|passing| passing.lasting).sum();
        let lost: f64 = contacts
            .map(|passing| passing.tangent.damping_integral)
            .sum();
        let touch = |&(time, velocity, _): &(f64, f64, &ContactPassage)| ImpactEvent {
            instant: clock.instant(time),
            before_impact_velocity: velocity,
        };
        let map = StroboscopicMap::new(&self.face.scene, self.periods);
        Ok(Orbit {
            scene: self.face.scene.clone(),
            periods: self.periods,
            position: state.x,
            velocity: state.y,
            impacts: impacts.iter().map(touch).collect(),
            rests: Vec::new(),
            max_position: map.max_position(state)?.max(self.face.surface_position()),
            monodromy: Monodromy::from_factors(&factors),
            damping_integral: lost + last.course.flow.damping() * (self.span() - touched),
        })
    }

    /// Refuses impacts between which the free flight hits the stop.
    fn check_flights(
        &self,
        at: &Unknowns,
        evaluation: &ShootingEvaluation,
    ) -> Result<(), OrbitError> {
        let count = evaluation.passages.len();
        for (segment, passing) in evaluation.passages.iter().enumerate() {
            let next = (segment + 1) % count;
            let around = if next <= segment { self.span() } else { 0.0 };
            let flight = at[2 * next] + around - at[2 * segment] - passing.lasting;
            let (course, guards) = (&passing.course, &self.face.phases[PhaseId::FREE].guards);
            let early = flight - IMPACT_TIME_TOLERANCE * self.face.clock.period();
            if let NextEvent::Crossing(found) =
                first_crossing(course, guards, course.start_node(), flight)
                && found.elapsed < early
            {
                return Err(OrbitError::OtherRegime { impacts: count + 1 });
            }
        }
        Ok(())
    }

    /// The state at the end of the period, and the monodromy factor from right after the last impact to it.
    fn tail_after_last_impact(
        &self,
        time: f64,
        last: &ContactPassage,
    ) -> Result<(Vector2<f64>, MonodromyFactor), OrbitError> {
        let from = self.face.clock.instant(time);
        let mut motion = self.face.release(from, last.velocity_after)?;
        let tangent = advance_with_tangent(&mut motion, Clock::at_cycle(self.periods))?;
        Ok((motion.state().into(), factor(&tangent)))
    }

    /// The monodromy factor from the period's beginning, `-free` s of it in contact, to the first impact.
    fn head_to_first_impact(
        &self,
        time: f64,
        free: f64,
        state: Vector2<f64>,
    ) -> Result<MonodromyFactor, OrbitError> {
        let flow = self.face.phases[PhaseId::FREE].flow;
        if free >= 0.0 {
            return Ok(flight_factor(&flow, time));
        }
        let mut motion = self.face.scene.motion(state.into())?;
        // The mass may leave a little later than it did by the contact that began before.
        let between = 0.5 * (time - free);
        let tangent = advance_with_tangent(&mut motion, self.face.clock.instant(between))?;
        let (transition, kept) = flight_factor(&flow, time - between);
        Ok((transition * tangent.matrix, kept * tangent.determinant))
    }
}

/// A factor of a monodromy matrix, with its determinant.
type MonodromyFactor = (Matrix2<f64>, f64);

/// The factor of a monodromy matrix that a tangent stands for.
fn factor(tangent: &Tangent) -> MonodromyFactor {
    (tangent.matrix, tangent.determinant)
}

/// The factor of a monodromy matrix by a free flight over a time in s.
fn flight_factor(flow: &LinearLaw, elapsed: f64) -> MonodromyFactor {
    (flow.transition(elapsed), (-flow.damping() * elapsed).exp())
}

/// Advances a motion to an instant, and returns the tangent of its way.
fn advance_with_tangent(motion: &mut Motion, until: Instant) -> Result<Tangent, OrbitError> {
    let mut tangent = Tangent::default();
    motion.advance(until, &mut tangent)?;
    motion.tell_arc(&mut tangent);
    Ok(tangent)
}

impl Orbit {
    /// The periodic orbit, stable or not, that Newton's method from impact to impact reaches from times in s
    /// and before-impact velocities in m/s of all impacts near its own. It is regular down to grazing,
    /// where the map is not. No impact may come to rest.
    ///
    /// # Errors
    /// [`OrbitError`] if it does not settle, or on impacts between which there are others.
    pub fn find_by_impacts(
        scene: &CheckedScene,
        periods: u64,
        impacts: &[(f64, f64)],
    ) -> Result<Self, OrbitError> {
        let none = OrbitError::OtherRegime { impacts: 0 };
        if impacts.is_empty() {
            return Err(none);
        }
        let shooting = MultiSegmentShooting::new(scene, periods.max(1)).ok_or(none)?;
        let guess = shooting.evaluate_guess(impacts).ok_or(OrbitError::LOST)?;
        let orbit = shooting.solve(guess, &[])?;
        let all = orbit.timed_impacts();
        for part in (1..periods).filter(|part| periods.is_multiple_of(*part)) {
            let share = all.len() as u64 * part;
            if share.is_multiple_of(periods) && orbit.repeats_after(&all, part) {
                let first = &all[..(share / periods) as usize];
                return Self::find_by_impacts(scene, part, first);
            }
        }
        Ok(orbit)
    }

    /// True if the impacts of an orbit are the same after `part` of its drive periods.
    fn repeats_after(&self, impacts: &[(f64, f64)], part: u64) -> bool {
        let period = self.scene.clock().period();
        let shift = impacts.len() * part as usize / self.periods as usize;
        let span = period * part as f64;
        let speed = self.scene.scales().speed();
        let pairs = impacts.iter().zip(&impacts[shift..]);
        let mut pairs = pairs.map(|(a, b)| ((b.0 - a.0 - span) / period, (b.1 - a.1) / speed));
        let most = ROUNDING * (1.0 + self.velocity.abs() / speed);
        pairs.all(|(time, velocity)| time.hypot(velocity) <= most)
    }
}
