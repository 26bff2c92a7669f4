//! One round of an orbit: everything that its followers look at.

use nalgebra::{Matrix2, Vector2};

use softstop::internals::{Course, Guard, Motion, Outlook, first_crossing};
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

/// A surface at which a scene's law of force changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Face {
    /// The clearance: an impact.
    Clearance,
    /// The end of phase I, where the strip is pierced.
    Pierced,
    /// The stop behind the strip.
    Stop,
    /// The rigid stop behind that.
    Wall,
}

impl Face {
    /// All.
    pub const ALL: [Self; 4] = [Self::Clearance, Self::Pierced, Self::Stop, Self::Wall];

    /// Its position in m, if the scene has it.
    pub fn position(self, scene: &Scene) -> Option<f64> {
        match self {
            Self::Clearance => Some(scene.clearance),
            Self::Pierced => scene
                .piercing
                .map(|strip| scene.clearance + strip.thickness),
            Self::Stop => scene.piercing.map(|_| scene.stop_position()),
            Self::Wall => scene.wall().map(|(position, _)| position),
        }
    }

    /// The face at a position, to rounding.
    fn at(scene: &Scene, position: f64) -> Option<Self> {
        let near = 1e-9 * (scene.scales().length + position.abs());
        let stands = |face: &Self| {
            face.position(scene)
                .is_some_and(|level| (level - position).abs() < near)
        };
        Self::ALL.into_iter().find(stands)
    }
}

/// Where an orbit comes near to grazing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Touch {
    /// Time in s.
    pub time: f64,
    /// Velocity in m/s of a crossing, or distance in m of a turning point from the surface ahead.
    pub amount: f64,
    /// The surface.
    pub face: Face,
    /// Dry friction turns its sign there.
    pub reverses: bool,
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
}

impl Round {
    /// The round from a state.
    pub fn of(scene: &Scene, periods: u64, state: Vector2<f64>) -> Result<Self, MotionError> {
        let mut motion = begin(scene, state)?;
        let mut watch = Watch {
            scene,
            clock: *motion.clock(),
            tangent: Tangent::default(),
            impacts: Vec::new(),
            sequence: Sequence::default(),
            slowest: None,
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
        })
    }

    /// The state in the end.
    pub fn end(&self) -> Vector2<f64> {
        self.ends[self.ends.len() - 1]
    }
}

/// The motion of a scene from a state at time 0.
pub(crate) fn begin(scene: &Scene, state: Vector2<f64>) -> Result<Motion, MotionError> {
    scene.validate()?;
    let start = Start::new(state.x, state.y);
    start.validate()?;
    Motion::new(scene.phases(), scene.clock(), Clock::at_cycle(0), start)
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
}

impl Observer for Watch<'_> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.tangent.arc(arc, elapsed);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.tangent.crossing(crossing);
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
        Stop::None | Stop::KelvinVoigt { .. } | Stop::Hertz { .. } => true,
        Stop::PiecewiseLinear { unloading, .. } => unloading.is_empty(),
        Stop::Preloaded { preload, .. } => *preload == 0.0,
        Stop::Rigid { .. } => false,
    };
    continuous && scene.piercing.is_none() && scene.rigid.is_none()
}

/// The turning point that comes nearest to the surface ahead of it, if any turns before one.
pub(crate) fn nearest_turn(
    scene: &Scene,
    periods: u64,
    state: Vector2<f64>,
) -> Result<Option<Touch>, MotionError> {
    let mut motion = begin(scene, state)?;
    let mut turns = Turns {
        clock: *motion.clock(),
        faces: Face::ALL
            .into_iter()
            .filter_map(|face| Some((face, face.position(scene)?)))
            .collect(),
        nearest: None,
    };
    for period in 1..=periods {
        carry_on(&mut motion, Clock::at_cycle(period), &mut turns)?;
    }
    motion.tell_arc(&mut turns);
    Ok(turns.nearest)
}

struct Turns {
    clock: Clock,
    faces: Vec<(Face, f64)>,
    nearest: Option<Touch>,
}

impl Observer for Turns {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let start = self.clock.time(arc.start);
        for (back, at, position) in turning_points(arc.course, elapsed) {
            self.turn(back, start + at, position, false);
        }
    }

    fn crossing(&mut self, crossing: &Crossing) {
        if crossing.kind == CrossingKind::Reversal {
            let back = crossing.acceleration_before < 0.0;
            let time = self.clock.time(crossing.instant);
            self.turn(back, time, crossing.position, true);
        }
    }
}

impl Turns {
    fn turn(&mut self, back: bool, time: f64, position: f64, reverses: bool) {
        for &(face, level) in &self.faces {
            let amount = if back {
                level - position
            } else {
                position - level
            };
            let nearer = self
                .nearest
                .is_none_or(|known| amount < known.amount || (reverses && amount == known.amount));
            if amount > 0.0 && nearer {
                self.nearest = Some(Touch {
                    time,
                    amount,
                    face,
                    reverses,
                });
            }
        }
    }
}

/// Turning points of a course within `duration` seconds: whether it turns back, elapsed time, position.
fn turning_points(course: &Course, duration: f64) -> Vec<(bool, f64, f64)> {
    let mut found = Vec::new();
    if course.is_held() || course.is_chattering() {
        return found;
    }
    let mut node = course.start();
    let mut back = course.departure.velocity > 0.0;
    loop {
        let guard = if back {
            Guard::turning_back()
        } else {
            Guard::turning_forward()
        };
        match first_crossing(course, &[guard], node, duration) {
            Outlook::Crossing(turn) if turn.elapsed > node.elapsed && turn.elapsed <= duration => {
                found.push((back, turn.elapsed, turn.position));
                node = course.node(turn.elapsed);
                back = !back;
            }
            _ => return found,
        }
    }
}
