//! The orbit to which segments from impact to impact close.

use nalgebra::{Matrix2, Vector2};

use super::contact::ContactPassage;
use super::multi_segment_shooting::{MultiSegmentShooting, ShootingEvaluation, Unknowns};
use super::{Monodromy, Orbit, OrbitError, StroboscopicMap};
use softstop::internals::{LinearLaw, Motion, NextEvent, PhaseId, first_crossing};
use softstop::{Clock, Instant, Tangent, Touch};

/// Share of the drive period by which an impact found by its crossing may differ from the one looked for.
const EARLY: f64 = 1e-4;

impl MultiSegmentShooting<'_> {
    /// The orbit through impacts that fit.
    pub(super) fn orbit(
        &self,
        at: &Unknowns,
        evaluation: &ShootingEvaluation,
    ) -> Result<Orbit, OrbitError> {
        self.check(at, evaluation)?;
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
        let (state, tail) = self.tail(time, last)?;
        let mut factors = vec![self.head(impacts[0].0, free, state)?];
        for pair in impacts.windows(2) {
            let (time, _, passing) = pair[0];
            let flight = pair[1].0 - time - passing.lasting;
            let free = along(&passing.course.flow, flight);
            factors.extend([entry(passing), factor(&passing.tangent), free]);
        }
        factors.push(entry(last));
        if free >= 0.0 {
            factors.extend([factor(&last.tangent), along(&last.course.flow, free)]);
        } else {
            factors.push(tail);
        }
        let contacts = impacts.iter().map(|(_, _, passing)| passing);
        let touched: f64 = contacts.clone().map(|passing| passing.lasting).sum();
        let lost: f64 = contacts
            .map(|passing| passing.tangent.damping_integral)
            .sum();
        let touch = |&(time, velocity, _): &(f64, f64, &ContactPassage)| Touch {
            instant: clock.instant(time),
            before_impact_velocity: velocity,
        };
        let map = StroboscopicMap::new(self.scene, self.periods)?;
        Ok(Orbit {
            scene: self.scene.clone(),
            periods: self.periods,
            position: state.x,
            velocity: state.y,
            impacts: impacts.iter().map(touch).collect(),
            rests: Vec::new(),
            max_position: map.max_position(state)?.max(self.face.position()),
            monodromy: Monodromy::product(&factors),
            damping_integral: lost + last.course.flow.damping() * (self.span() - touched),
        })
    }

    /// Refuses impacts between which the free motion hits the stop.
    fn check(&self, at: &Unknowns, evaluation: &ShootingEvaluation) -> Result<(), OrbitError> {
        let count = evaluation.passages.len();
        for (segment, passing) in evaluation.passages.iter().enumerate() {
            let next = (segment + 1) % count;
            let around = if next <= segment { self.span() } else { 0.0 };
            let flight = at[2 * next] + around - at[2 * segment] - passing.lasting;
            let (course, guards) = (&passing.course, &self.face.phases[PhaseId::FREE].guards);
            let early = flight - EARLY * self.face.clock.period();
            if let NextEvent::Crossing(found) =
                first_crossing(course, guards, course.start_node(), flight)
                && found.elapsed < early
            {
                return Err(OrbitError::OtherRegime { impacts: count + 1 });
            }
        }
        Ok(())
    }

    /// From right after the last impact to the end of the period: the state there, and the tangent.
    fn tail(&self, time: f64, last: &ContactPassage) -> Result<(Vector2<f64>, Factor), OrbitError> {
        let from = self.face.clock.instant(time);
        let mut motion = self.face.motion(from, last.velocity_after)?;
        let tangent = advanced(&mut motion, Clock::at_cycle(self.periods))?;
        Ok((motion.state().into(), factor(&tangent)))
    }

    /// From the beginning of the period to the first impact. If `free` is negative, contact lasts on for so
    /// many seconds.
    fn head(&self, time: f64, free: f64, state: Vector2<f64>) -> Result<Factor, OrbitError> {
        let flow = self.face.phases[PhaseId::FREE].flow;
        if free >= 0.0 {
            return Ok(along(&flow, time));
        }
        let (phases, clock) = (self.face.phases.clone(), self.face.clock);
        let mut motion = Motion::new(phases, clock, Clock::at_cycle(0), state.into())?;
        // The mass may leave a little later than it did by the contact that began before.
        let between = 0.5 * (time - free);
        let tangent = advanced(&mut motion, clock.instant(between))?;
        let (transition, kept) = along(&flow, time - between);
        Ok((transition * tangent.matrix, kept * tangent.determinant))
    }
}

/// A factor of a monodromy matrix, with its determinant.
type Factor = (Matrix2<f64>, f64);

fn factor(tangent: &Tangent) -> Factor {
    (tangent.matrix, tangent.determinant)
}

fn entry(passing: &ContactPassage) -> Factor {
    (passing.entry, passing.entry.determinant())
}

/// Free motion over a time in s.
fn along(flow: &LinearLaw, elapsed: f64) -> Factor {
    (flow.transition(elapsed), (-flow.damping() * elapsed).exp())
}

/// Advances a motion: the tangent of the way.
fn advanced(motion: &mut Motion, until: Instant) -> Result<Tangent, OrbitError> {
    let mut tangent = Tangent::default();
    motion.advance(until, &mut tangent)?;
    motion.tell_arc(&mut tangent);
    Ok(tangent)
}
