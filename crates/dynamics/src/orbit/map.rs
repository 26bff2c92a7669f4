//! The stroboscopic map: from drive angle to the same drive angle, whole periods later.

use std::sync::Arc as Shared;

use nalgebra::Vector2;

use super::Monodromy;
use super::turn::turns;
use softstop::internals::{Motion, Phases, Scales};
use softstop::{
    Arc, Clock, Crossing, CrossingKind, Instant, MotionError, Observer, Scene, Start, Tangent,
    Touch,
};

/// Times what rounding leaves of a residual by which it may be off.
const ROUNDINGS: f64 = 100.0;

/// The map of one scene over a number of drive periods, from time 0.
#[derive(Debug, Clone)]
pub struct StroboscopicMap {
    phases: Shared<Phases>,
    clock: Clock,
    periods: u64,
    scales: Scales,
}

/// One application of the map.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Passage {
    /// Position and velocity after the periods.
    pub end: Vector2<f64>,
    /// Exact Jacobian of the map.
    pub monodromy: Monodromy,
    /// Integral of damping over mass along the way.
    pub damping_integral: f64,
    /// Its impacts, in order of time.
    pub impacts: Vec<Touch>,
    /// Ends of complete chatter: infinitely many ever weaker impacts that end in rest, of which `impacts`
    /// holds only those before the summed ones.
    pub rests: Vec<Instant>,
}

impl StroboscopicMap {
    /// The map of `scene` over `periods` drive periods.
    ///
    /// # Errors
    /// [`MotionError::Scene`] if the scene is invalid.
    pub fn new(scene: &Scene, periods: u64) -> Result<Self, MotionError> {
        scene.validate()?;
        Ok(Self {
            phases: scene.phases().into(),
            clock: scene.clock(),
            periods,
            scales: scene.scales(),
        })
    }

    /// The drive periods of one application.
    pub fn periods(&self) -> u64 {
        self.periods
    }

    /// The measure of its states.
    pub(crate) fn scales(&self) -> &Scales {
        &self.scales
    }

    /// The clock of the drive.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// The image of a state, with the Jacobian.
    ///
    /// # Errors
    /// [`MotionError`] if the state is not finite or the motion unbounded.
    pub fn apply(&self, state: Vector2<f64>) -> Result<Passage, MotionError> {
        let mut seen = PassageRecorder::default();
        let end = self.observe(state, &mut seen)?;
        Ok(Passage {
            end,
            monodromy: Monodromy::from(&seen.tangent),
            damping_integral: seen.tangent.damping_integral,
            impacts: seen.impacts,
            rests: seen.rests,
        })
    }

    /// How far a fixed point, as Newton's method finds it with this passage, may lie off by rounding, in the map's
    /// scales.
    pub(super) fn doubt(&self, state: Vector2<f64>, passage: &Passage) -> f64 {
        let response = passage.monodromy.resolvent();
        let response = response.map_or(f64::INFINITY, |it| self.scales.jacobian(&it).norm());
        ROUNDINGS * self.scales.rounding(&state, &passage.monodromy) * response
    }

    /// The image of a state alone.
    ///
    /// # Errors
    /// As [`StroboscopicMap::apply`].
    pub fn image(&self, state: Vector2<f64>) -> Result<Vector2<f64>, MotionError> {
        self.observe(state, &mut ())
    }

    /// The largest position in m on the way from a state.
    ///
    /// # Errors
    /// As [`StroboscopicMap::apply`].
    pub fn max_position(&self, state: Vector2<f64>) -> Result<f64, MotionError> {
        let mut highest = Highest(state.x);
        let end = self.observe(state, &mut highest)?;
        Ok(highest.0.max(end.x))
    }

    /// The image of a state, with all arcs and crossings on the way told to an observer.
    pub(crate) fn observe(
        &self,
        state: Vector2<f64>,
        observer: &mut impl Observer,
    ) -> Result<Vector2<f64>, MotionError> {
        let start = Start::from(state);
        start.validate()?;
        let mut motion = Motion::new(self.phases.clone(), self.clock, Clock::at_cycle(0), start)?;
        motion.advance(Clock::at_cycle(self.periods), observer)?;
        motion.tell_arc(observer);
        Ok(motion.state().into())
    }
}

/// Records the tangent, the impacts and the ends of chatter of a motion.
#[derive(Default)]
pub(crate) struct PassageRecorder {
    pub tangent: Tangent,
    pub impacts: Vec<Touch>,
    rests: Vec<Instant>,
}

impl Observer for PassageRecorder {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.tangent.arc(arc, elapsed);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.tangent.crossing(crossing);
        if let Some(velocity) = crossing.impact_velocity() {
            self.impacts.push(Touch {
                instant: crossing.instant,
                before_impact_velocity: velocity,
            });
        }
        if crossing.kind == CrossingKind::Rest {
            self.rests.push(crossing.instant);
        }
    }
}

/// Keeps the largest position.
struct Highest(f64);

impl Observer for Highest {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let turns = turns(arc.course, elapsed, true).map(|turn| turn.position);
        self.0 = turns.fold(self.0, f64::max);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.0 = self.0.max(crossing.position);
    }
}
