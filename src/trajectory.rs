//! A motion kept: its arcs and crossings, and what follows from them without running it again.

mod from_scene;
mod kept_arc;
mod turning_points;

pub use from_scene::AppliedForce;
pub use kept_arc::KeptArc;
pub use turning_points::turning_points;

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use crate::checked_scene::CheckedScene;
use crate::integrator::{
    Arc, Clock, Counts, Crossing, CrossingKind, Instant, Observer, Start, Work, mechanical_energy,
};
use crate::phases::PhaseId;
use crate::tangent::Tangent;

/// Arcs of a trajectory for which there is room at first: as many as most drive periods have.
const FIRST_ARC_ROOM: usize = 8;

/// A mass that touches: when, and how fast.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ImpactEvent {
    /// When it happens.
    pub instant: Instant,
    /// Before-impact velocity in m/s.
    pub before_impact_velocity: f64,
}

/// An exact motion over a span of time: an observer that keeps the motion's arcs and crossings.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Trajectory {
    /// The scene that the motion is of.
    pub scene: CheckedScene,
    /// The clock of its instants.
    pub clock: Clock,
    /// Arcs in order of time, without gaps, each with the crossing at its end.
    pub arcs: Vec<KeptArc>,
    /// State at the end.
    pub end: Start,
}

impl Trajectory {
    /// A trajectory without arcs, which keeps a motion of a scene as its observer.
    #[doc(hidden)]
    pub fn empty(scene: &CheckedScene) -> Self {
        Self {
            scene: scene.clone(),
            clock: scene.clock(),
            arcs: Vec::with_capacity(FIRST_ARC_ROOM),
            end: Start::REST,
        }
    }

    /// Crossings in order of time.
    pub fn crossings(&self) -> impl Iterator<Item = &Crossing> + Clone {
        self.arcs.iter().filter_map(|arc| arc.crossing.as_ref())
    }

    /// The impacts in order of time.
    pub fn impacts(&self) -> impl Iterator<Item = ImpactEvent> {
        self.crossings().filter_map(|crossing| {
            Some(ImpactEvent {
                instant: crossing.instant,
                before_impact_velocity: crossing.impact_velocity()?,
            })
        })
    }

    /// Times in s and before-impact velocities in m/s of the impacts, in order of time.
    pub fn timed_impacts(&self) -> impl Iterator<Item = (f64, f64)> {
        let timed =
            |touch: ImpactEvent| (self.clock.time(touch.instant), touch.before_impact_velocity);
        self.impacts().map(timed)
    }

    /// Instants at which complete chatter ends in rest, in order of time.
    pub fn rests(&self) -> impl Iterator<Item = Instant> {
        let rests = self.crossings().filter(|it| it.kind == CrossingKind::Rest);
        rests.map(|crossing| crossing.instant)
    }

    /// Position in m and velocity in m/s at any instant within the trajectory.
    pub fn at(&self, instant: Instant) -> Option<Start> {
        let next = self.arcs.partition_point(|arc| arc.start <= instant);
        let arc = self.arcs.get(next.checked_sub(1)?)?;
        let elapsed = self.clock.elapsed(arc.start, instant);
        if next == self.arcs.len() && elapsed > arc.duration {
            return None;
        }
        let (position, velocity) = arc.course.state_at(elapsed, self.clock.drive(instant));
        let phase = arc.phase.map(|phase| &self.scene.phases()[phase]);
        let inside = phase.map_or(position, |phase| phase.confine_position(position));
        Some(Start::new(inside, velocity))
    }

    /// The state after so many whole drive periods; that at the end if there are fewer.
    #[doc(hidden)]
    pub fn at_cycle(&self, periods: u64) -> Vector2<f64> {
        let state = self.at(Clock::at_cycle(periods));
        state.unwrap_or(self.end).into()
    }

    /// The trajectory up to an instant; the whole of it if it ends before.
    #[doc(hidden)]
    pub fn up_to(&self, end: Instant) -> Self {
        let begun = self.arcs.partition_point(|arc| arc.start < end);
        let mut arcs = self.arcs[..begun].to_vec();
        if let Some(last) = arcs.last_mut() {
            let elapsed = self.clock.elapsed(last.start, end);
            if elapsed < last.duration {
                (last.duration, last.crossing) = (elapsed, None);
            }
        }
        Self {
            scene: self.scene.clone(),
            clock: self.clock,
            arcs,
            end: self.at(end).unwrap_or(self.end),
        }
    }

    /// Each kept arc as the [`Arc`] that an observer is handed, and how long it lasts, in s; none is clipped or joined.
    #[doc(hidden)]
    pub fn arc_views(&self) -> impl Iterator<Item = (Arc<'_>, f64)> {
        let seen = |kept| (self.observed_arc(kept), kept.duration);
        self.arcs.iter().map(seen)
    }

    /// One arc of the trajectory as observers see it.
    #[doc(hidden)]
    pub fn observed_arc<'a>(&'a self, kept: &'a KeptArc) -> Arc<'a> {
        Arc {
            start: kept.start,
            clock: &self.clock,
            course: &kept.course,
            phase: kept.phase.map(|phase| &self.scene.phases()[phase]),
            kind: kept.kind,
            side: kept.side,
            end: kept.end,
        }
    }

    /// Tells an observer of all arcs and crossings, as the motion did.
    pub fn replay(&self, observer: &mut dyn Observer) {
        for kept in &self.arcs {
            observer.arc(&self.observed_arc(kept), kept.duration);
            if let Some(crossing) = &kept.crossing {
                observer.crossing(crossing);
            }
        }
    }

    /// The tangent of the whole trajectory: its exact Jacobian.
    pub fn tangent(&self) -> Tangent {
        let mut tangent = Tangent::default();
        self.replay(&mut tangent);
        tangent
    }

    /// Largest position in m.
    pub fn max_position(&self) -> f64 {
        self.farthest_position(true, f64::max)
    }

    /// Lowest position in m.
    pub fn min_position(&self) -> f64 {
        self.farthest_position(false, f64::min)
    }

    /// The farthest position in m, of turning points, crossings and ends.
    fn farthest_position(&self, back: bool, farther: impl Fn(f64, f64) -> f64) -> f64 {
        let end = self.end.position;
        let begin = self.arcs.first();
        let begin = begin.map_or(end, |arc| arc.course.departure.position);
        let arcs = self.arcs.iter();
        let turns = arcs.flat_map(|arc| turning_points(&arc.course, arc.duration, back));
        let positions = turns.map(|turn| turn.position);
        let positions = positions.chain(self.crossings().map(|crossing| crossing.position));
        positions.fold(farther(begin, end), farther)
    }

    /// Energies supplied and dissipated, in J.
    pub fn work(&self) -> Work {
        let mut counts = Counts::default();
        self.replay(&mut counts.observer(self.scene.mass));
        counts.work
    }

    /// Mechanical energy at the end less that at the start, in J.
    pub fn stored(&self) -> f64 {
        let Some(first) = self.arcs.first() else {
            return 0.0;
        };
        let phases = self.scene.phases();
        // A mass that is held stays where it is: the store at its position is that of the moving arc beside.
        let mut stores = self.arcs.iter().filter_map(|arc| arc.phase);
        let first_store = stores.next();
        let energy = |state: Start, phase: Option<PhaseId>| {
            mechanical_energy(&self.scene, state, phase.map(|it| &phases[it].store))
        };
        let departure = first.course.departure;
        let start = Start::new(departure.position, departure.velocity);
        energy(self.end, stores.next_back().or(first_store)) - energy(start, first_store)
    }

    /// supplied - dissipated - stored, in J: zero but for rounding.
    pub fn energy_defect(&self) -> f64 {
        let work = self.work();
        work.supplied - work.dissipated - self.stored()
    }
}

impl Observer for Trajectory {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.arcs.push(KeptArc {
            start: arc.start,
            duration: elapsed,
            course: arc.course.clone(),
            kind: arc.kind,
            phase: arc.phase.map(|phase| phase.id),
            crossing: None,
            side: arc.side,
            end: arc.end,
        });
    }

    fn crossing(&mut self, crossing: &Crossing) {
        if let Some(last) = self.arcs.last_mut() {
            last.crossing = Some(*crossing);
        }
    }
}
