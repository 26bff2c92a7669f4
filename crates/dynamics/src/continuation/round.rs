//! One round of an orbit: everything that its followers look at.

use nalgebra::{Matrix2, Vector2};

use super::face::{Face, Touch};
use softstop::internals::Motion;
use softstop::{
    Arc, Clock, Crossing, CrossingKind, Effort, Instant, MotionError, Observer, Scene, Start, Stop,
    Tangent,
};

/// How often an orbit crosses what; it changes only where the orbit grazes something.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Sequence {
    /// Impacts; each row of bounces that ends in rest counts as one.
    pub impacts: usize,
    /// Crossings of surfaces, impacts on a rigid stop among them.
    pub surfaces: usize,
    /// Turns under dry friction.
    pub reversals: usize,
    /// Rows of bounces that end in rest.
    pub rests: usize,
}

/// What happens from time 0 over a number of drive periods.
#[derive(Debug, Clone)]
pub(crate) struct Round {
    /// States after each drive period.
    pub ends: Vec<Vector2<f64>>,
    /// Exact Jacobian of the last one.
    pub monodromy: Matrix2<f64>,
    /// Before-impact velocities in m/s, in order of time.
    pub impacts: Vec<f64>,
    /// How often it crosses what.
    pub sequence: Sequence,
    /// The slowest crossing of a surface.
    pub slowest: Option<Touch>,
    /// Drive periods between time 0 and the nearest crossing before or after it; 0 if the mass is held at time 0.
    pub margin: f64,
}

impl Round {
    /// The round from a state.
    pub fn of(scene: &Scene, periods: u64, state: Vector2<f64>) -> Result<Self, MotionError> {
        let mut motion = scene.motion(state.into())?;
        let mut watch = Watch {
            scene,
            clock: *motion.clock(),
            tangent: Tangent::default(),
            impacts: Vec::new(),
            sequence: Sequence::default(),
            slowest: None,
            margin: f64::INFINITY,
            periods: periods as f64,
        };
        let mut ends = Vec::with_capacity(periods as usize);
        for period in 1..=periods {
            carry_on(&mut motion, Clock::at_cycle(period), &mut watch)?;
            let Start { position, velocity } = motion.state();
            ends.push(Vector2::new(position, velocity));
        }
        motion.tell_arc(&mut watch);
        watch.sequence.impacts = watch.impacts.len();
        Ok(Self {
            ends,
            monodromy: watch.tangent.matrix,
            impacts: watch.impacts,
            sequence: watch.sequence,
            slowest: watch.slowest,
            margin: watch.margin,
        })
    }

    /// The state in the end.
    pub fn end(&self) -> Vector2<f64> {
        self.ends[self.ends.len() - 1]
    }
}

/// Work that an orbit may cost per drive period, in scan windows: 260,000 crossings. A mass that bounces more
/// often is on its way to rest, and its motion is no orbit that could be followed.
const MOST_WORK: u64 = 1 << 22;

/// Carries a motion on by a drive period at most.
pub(crate) fn carry_on(
    motion: &mut Motion,
    until: Instant,
    observer: &mut impl Observer,
) -> Result<(), MotionError> {
    let mut effort = Effort::windows(MOST_WORK);
    if motion
        .watch(until, &mut (observer, &mut effort))?
        .is_continue()
    {
        return Ok(());
    }
    Err(MotionError::Stalled {
        time: motion.clock().time(motion.now()),
        position: motion.state().position,
    })
}

struct Watch<'a> {
    scene: &'a Scene,
    clock: Clock,
    tangent: Tangent,
    impacts: Vec<f64>,
    sequence: Sequence,
    slowest: Option<Touch>,
    margin: f64,
    periods: f64,
}

impl Observer for Watch<'_> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.tangent.arc(arc, elapsed);
        if arc.course.is_held() && arc.start == Clock::at_cycle(0) {
            self.margin = 0.0;
        }
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.tangent.crossing(crossing);
        let Instant { cycles, offset } = crossing.instant;
        let time = cycles + offset / self.clock.period();
        self.margin = self.margin.min(time).min(self.periods - time);
        self.impacts.extend(crossing.impact_velocity());
        match crossing.kind {
            CrossingKind::Surface { .. } | CrossingKind::Rebound { .. } => self.passes(crossing),
            CrossingKind::Reversal => self.sequence.reversals += 1,
            CrossingKind::Rest => self.rests(),
            CrossingKind::Switch | CrossingKind::Release => {}
        }
    }
}

impl Watch<'_> {
    fn passes(&mut self, crossing: &Crossing) {
        self.sequence.surfaces += 1;
        let amount = crossing.velocity.abs();
        if self.slowest.is_none_or(|known| amount < known.amount)
            && let Some(face) = Face::at(self.scene, crossing.position)
        {
            self.slowest = Some(Touch {
                time: self.clock.time(crossing.instant),
                amount,
                face,
                reverses: false,
            });
        }
    }

    /// A row of ever weaker bounces counts as its first: how many of them are told one by one is the
    /// simulation's choice.
    fn rests(&mut self) {
        self.sequence.rests += 1;
        while let [.., before, last] = self.impacts[..]
            && last < before
        {
            self.impacts.pop();
            self.sequence.surfaces -= 1;
        }
        self.slowest = None;
    }
}

/// True if an orbit can graze the scene's stop without losing its derivative: the force does not jump
/// there.
pub(crate) fn grazes_gently(scene: &Scene) -> bool {
    let continuous = match &scene.stop {
        Stop::None
        | Stop::KelvinVoigt { .. }
        | Stop::PiecewiseLinear { .. }
        | Stop::Hertz { .. } => true,
        Stop::Preloaded { preload, .. } => *preload == 0.0,
        Stop::Rigid { .. } => false,
    };
    continuous && scene.piercing.is_none() && scene.rigid.is_none()
}
