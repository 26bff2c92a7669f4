//! The periodic orbit to which segments from impact to impact close, with its monodromy matrix as a product over them.

use nalgebra::Vector2;

use super::contact_passage::ContactPassage;
use super::multi_segment_shooting::{ImpactUnknowns, MultiSegmentShooting, ShootingEvaluation};
use super::{Monodromy, Orbit, OrbitError, StroboscopicMap};
use softstop::internals::{LinearLaw, Motion, NextEvent, PhaseId, first_crossing};
use softstop::{Clock, ImpactEvent, Instant, Tangent};

/// Share of the drive period by which an impact found by its crossing may precede the one that segments were shot to: by the
/// square root of what Newton's method leaves, where the impact is weak.
const IMPACT_TIME_TOLERANCE: f64 = 1e-4;

impl MultiSegmentShooting {
    /// The periodic orbit through impacts between which the segments of the shooting fit.
    pub(super) fn orbit_of_segments(
        &self,
        at: &ImpactUnknowns,
        evaluation: &ShootingEvaluation,
    ) -> Result<Orbit, OrbitError> {
        self.refuse_flights_through_stop(at, evaluation)?;
        let clock = self.clearance.clock;
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
                .clearance
                .entry_saltation(clock.instant(time), velocity, passing);
            Monodromy::with_determinant(matrix, matrix.determinant())
        };
        for pair in impacts.windows(2) {
            let (time, _, passing) = pair[0];
            let flight = pair[1].0 - time - passing.lasting;
            let free = flight_factor(&passing.course.flow, flight);
            factors.extend([entry(&pair[0]), Monodromy::from(&passing.tangent), free]);
        }
        factors.extend(impacts.last().map(entry));
        if free >= 0.0 {
            factors.extend([
                Monodromy::from(&last.tangent),
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
        let map = StroboscopicMap::new(&self.clearance.scene, self.periods);
        Ok(Orbit {
            scene: self.clearance.scene.clone(),
            periods: self.periods,
            position: state.x,
            velocity: state.y,
            impacts: impacts.iter().map(touch).collect(),
            rests: Vec::new(),
            max_position: map
                .max_position(state)?
                .max(self.clearance.surface_position()),
            monodromy: Monodromy::product(&factors),
            damping_integral: lost + last.course.flow.damping() * (self.span() - touched),
        })
    }

    /// Refuses impacts between which the free flight hits the stop.
    fn refuse_flights_through_stop(
        &self,
        at: &ImpactUnknowns,
        evaluation: &ShootingEvaluation,
    ) -> Result<(), OrbitError> {
        let count = evaluation.passages.len();
        for (segment, passing) in evaluation.passages.iter().enumerate() {
            let next = (segment + 1) % count;
            let around = if next <= segment { self.span() } else { 0.0 };
            let flight = at[2 * next] + around - at[2 * segment] - passing.lasting;
            let (course, guards) = (
                &passing.course,
                &self.clearance.phases[PhaseId::FREE].guards,
            );
            let early = flight - IMPACT_TIME_TOLERANCE * self.clearance.clock.period();
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
    ) -> Result<(Vector2<f64>, Monodromy), OrbitError> {
        let from = self.clearance.clock.instant(time);
        let mut motion = self.clearance.release(from, last.velocity_after)?;
        let tangent = advance_with_tangent(&mut motion, Clock::at_cycle(self.periods))?;
        Ok((motion.state().into(), Monodromy::from(&tangent)))
    }

    /// The monodromy factor from the period's beginning, `-free` s of it in contact, to the first impact.
    fn head_to_first_impact(
        &self,
        time: f64,
        free: f64,
        state: Vector2<f64>,
    ) -> Result<Monodromy, OrbitError> {
        let flow = self.clearance.phases[PhaseId::FREE].flow;
        if free >= 0.0 {
            return Ok(flight_factor(&flow, time));
        }
        let mut motion = self.clearance.scene.motion(state.into())?;
        // The mass may leave a little later than it did by the contact that began before.
        let between = 0.5 * (time - free);
        let tangent = advance_with_tangent(&mut motion, self.clearance.clock.instant(between))?;
        let flight = flight_factor(&flow, time - between);
        Ok(Monodromy::product(&[Monodromy::from(&tangent), flight]))
    }
}

/// The factor of a monodromy matrix by a free flight over a time in s.
pub(super) fn flight_factor(flow: &LinearLaw, elapsed: f64) -> Monodromy {
    let determinant = (-flow.damping() * elapsed).exp();
    Monodromy::with_determinant(flow.modes.transition(elapsed), determinant)
}

/// Advances a motion to an instant, and returns the tangent of its way.
fn advance_with_tangent(motion: &mut Motion, until: Instant) -> Result<Tangent, OrbitError> {
    let mut tangent = Tangent::default();
    motion.advance(until, &mut tangent)?;
    motion.tell_arc(&mut tangent);
    Ok(tangent)
}
