//! The trajectory of a motion over some drive periods, kept: what is asked of it follows without running it again.

pub mod turn;

use std::ops::ControlFlow;

use nalgebra::Vector2;

use crate::monitor::stop_if;
use softstop::internals::Motion;
use softstop::{
    Arc, CheckedScene, Clock, Crossing, CrossingKind, Instant, KeptArc, MotionError, Observer,
    Tangent, Touch,
};
use turn::turning_points;

/// Arcs of a trajectory for which there is room at first: as many as most drive periods have.
const FIRST_ARC_ROOM: usize = 8;

/// Most arcs that are kept of a trajectory: some 150 MB, and up to three times that of Taylor steps.
const MAX_KEPT_ARCS: usize = 1 << 18;

/// The kept trajectory of a motion: its arcs and crossings from time 0 on, in order of time.
#[derive(Debug, Clone)]
pub struct PeriodTrajectory {
    /// The scene that the motion is of.
    pub scene: CheckedScene,
    /// The clock that its instants refer to.
    pub clock: Clock,
    /// The arcs of the trajectory, each with the crossing at its end.
    pub arcs: Vec<KeptArc>,
    /// Position and velocity at the end of the trajectory.
    pub end: Vector2<f64>,
}

impl PeriodTrajectory {
    /// An empty trajectory of a motion of a scene.
    pub fn empty(scene: &CheckedScene) -> Self {
        Self {
            scene: scene.clone(),
            clock: scene.clock(),
            arcs: Vec::with_capacity(FIRST_ARC_ROOM),
            end: Vector2::zeros(),
        }
    }

    /// Records the trajectory of the motion of a scene from a state at time 0, as far as it is advanced.
    ///
    /// # Errors
    /// [`MotionError`] if the state is not finite or beyond a rigid stop, and that of advancing;
    /// [`MotionError::Endless`] if it has more arcs than are kept.
    pub fn record(
        scene: &CheckedScene,
        state: Vector2<f64>,
        advance: impl FnOnce(&mut Motion, &mut Self) -> Result<(), MotionError>,
    ) -> Result<Self, MotionError> {
        let mut motion = scene.motion(state.into())?;
        let mut kept = Self::empty(scene);
        advance(&mut motion, &mut kept)?;
        if kept.arcs.len() > MAX_KEPT_ARCS {
            return Err(MotionError::Endless {
                time: kept.clock.time(motion.now()),
                position: motion.state().position,
            });
        }
        motion.tell_arc(&mut kept);
        kept.end = motion.state().into();
        Ok(kept)
    }

    /// Replays all arcs and crossings of the trajectory to an observer.
    pub fn replay(&self, observer: &mut dyn Observer) {
        for kept in &self.arcs {
            observer.arc(&self.observed_arc(kept), kept.duration);
            if let Some(crossing) = &kept.crossing {
                observer.crossing(crossing);
            }
        }
    }

    /// A new observer to which all arcs and crossings of the trajectory have been replayed.
    pub fn replayed<O: Observer + Default>(&self) -> O {
        let mut observer = O::default();
        self.replay(&mut observer);
        observer
    }

    /// One arc of the trajectory as observers see it.
    pub fn observed_arc<'a>(&'a self, kept: &'a KeptArc) -> Arc<'a> {
        kept.seen(&self.clock, self.scene.phases())
    }

    /// The arcs of the trajectory as observers see them, and how long each lasts, in s.
    pub fn arcs(&self) -> impl Iterator<Item = (Arc<'_>, f64)> {
        self.arcs
            .iter()
            .map(|kept| (self.observed_arc(kept), kept.duration))
    }

    /// The crossings of the trajectory, in order of time.
    pub fn crossings(&self) -> impl Iterator<Item = &Crossing> + Clone {
        self.arcs.iter().filter_map(|arc| arc.crossing.as_ref())
    }

    /// The trajectory up to an instant within it.
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
            end: self.state_at(end),
        }
    }

    /// The state of the trajectory when so many drive periods are complete.
    pub fn at_cycle(&self, periods: u64) -> Vector2<f64> {
        self.state_at(Clock::at_cycle(periods))
    }

    /// The state of the trajectory at an instant.
    fn state_at(&self, at: Instant) -> Vector2<f64> {
        let next = self.arcs.partition_point(|arc| arc.start <= at);
        let state = |kept: &KeptArc| {
            let elapsed = self.clock.elapsed(kept.start, at);
            let (position, velocity) = kept.course.state_at(elapsed, self.clock.drive(at));
            let phase = kept.phase.map(|phase| &self.scene.phases()[phase]);
            let inside = phase.map_or(position, |phase| phase.confine_position(position));
            Vector2::new(inside, velocity)
        };
        let last = next.checked_sub(1).and_then(|last| self.arcs.get(last));
        last.map_or(self.end, state)
    }

    /// The tangent of the whole trajectory, its exact Jacobian.
    pub fn tangent(&self) -> Tangent {
        self.replayed()
    }

    /// The impacts of the trajectory, in order of time.
    pub fn impacts(&self) -> impl Iterator<Item = Touch> {
        self.crossings().filter_map(|crossing| {
            Some(Touch {
                instant: crossing.instant,
                before_impact_velocity: crossing.impact_velocity()?,
            })
        })
    }

    /// Times in s and before-impact velocities in m/s of the trajectory's impacts.
    pub fn timed_impacts(&self) -> impl Iterator<Item = (f64, f64)> {
        let timed = |touch: Touch| (self.clock.time(touch.instant), touch.before_impact_velocity);
        self.impacts().map(timed)
    }

    /// Instants at which complete chatter of the trajectory ends in rest.
    pub fn rests(&self) -> impl Iterator<Item = Instant> {
        let rests = self.crossings().filter(|it| it.kind == CrossingKind::Rest);
        rests.map(|crossing| crossing.instant)
    }

    /// The largest position of the trajectory in m.
    pub fn max_position(&self) -> f64 {
        self.farthest_position(true, f64::max)
    }

    /// The lowest position of the trajectory in m.
    pub fn min_position(&self) -> f64 {
        self.farthest_position(false, f64::min)
    }

    /// The farthest position of the trajectory in m, of turning points, crossings and ends.
    fn farthest_position(&self, back: bool, farther: impl Fn(f64, f64) -> f64) -> f64 {
        let begin = self.arcs.first();
        let begin = begin.map_or(self.end.x, |arc| arc.course.departure.position);
        let arcs = self.arcs.iter();
        let turns = arcs.flat_map(|arc| turning_points(&arc.course, arc.duration, back));
        let positions = turns.map(|turn| turn.position);
        let positions = positions.chain(self.crossings().map(|crossing| crossing.position));
        positions.fold(farther(begin, self.end.x), farther)
    }
}

impl Observer for PeriodTrajectory {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.arcs.push(KeptArc::new(arc, elapsed));
    }

    fn crossing(&mut self, crossing: &Crossing) {
        if let Some(last) = self.arcs.last_mut() {
            last.crossing = Some(*crossing);
        }
    }

    fn progress(&mut self, _: u64) -> ControlFlow<()> {
        stop_if(self.arcs.len() > MAX_KEPT_ARCS)
    }
}
