//! One round of an orbit: everything that its followers look at.

use nalgebra::{Matrix2, Vector2};

use super::face::{Face, Touch};
use super::way::Border;
use softstop::internals::{Detuning, Motion};
use softstop::{
    Arc, Clock, Crossing, CrossingKind, Effort, Instant, MotionError, Observer, Scene, Start,
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
    /// Crossings of other kinds: ends of rest, contacts that cease or begin to press.
    pub others: usize,
    /// How often the mass is held, by dry friction or at a face.
    pub holds: usize,
    /// Crossings of surfaces and turns at which the force does not jump: an orbit gains and loses them smoothly.
    pub gentle: [usize; 2],
}

impl Sequence {
    /// True if no crossing with a jump of the force makes the difference.
    pub fn agrees(&self, other: &Self) -> bool {
        self.hard() == other.hard() && self.rests == other.rests
    }

    /// The same, with as many impacts.
    pub fn goes_on(&self, other: &Self) -> bool {
        self.impacts == other.impacts && self.agrees(other)
    }

    /// What comes in between two orbits.
    pub fn border(&self, other: &Self) -> Option<Border> {
        let ([surfaces, turns], [others, other_turns]) = (self.hard(), other.hard());
        if (self.holds, self.rests) != (other.holds, other.rests) {
            Some(Border::Rest)
        } else if surfaces != others {
            Some(Border::Surface)
        } else {
            (turns != other_turns).then_some(Border::Turn)
        }
    }

    fn hard(&self) -> [usize; 2] {
        [
            self.surfaces - self.gentle[0],
            self.reversals - self.gentle[1],
        ]
    }

    /// What happens how often, whether the force jumps there or not: at the end of a range a jump may vanish.
    pub fn events(&self) -> [usize; 4] {
        [self.impacts, self.surfaces, self.reversals, self.rests]
    }

    /// Crossings of all kinds.
    pub fn crossings(&self) -> usize {
        self.surfaces + self.reversals + self.others
    }
}

/// What happens from time 0 over a number of drive periods.
#[derive(Debug, Clone)]
pub(crate) struct Round {
    /// States after each drive period.
    pub ends: Vec<Vector2<f64>>,
    /// Exact Jacobian of the last one.
    pub monodromy: Matrix2<f64>,
    /// Its exact derivative by the drive's frequency in m s/rad and m/rad, where all laws have one in closed form.
    pub by_frequency: Option<Vector2<f64>>,
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
            detuning: Detuning::default(),
            impacts: Vec::new(),
            sequence: Sequence::default(),
            slowest: None,
            margin: f64::INFINITY,
            periods: periods as f64,
            is_held: false,
            touched: None,
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
            monodromy: watch.detuning.tangent.matrix,
            by_frequency: watch.detuning.at_drive_angle(&motion),
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

/// Work that an orbit may cost per drive period, in scan windows: 32,000 crossings. A mass that bounces more
/// often is on its way to rest, and its motion is no orbit that could be followed.
const MOST_WORK: u64 = 1 << 19;

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
    detuning: Detuning,
    impacts: Vec<f64>,
    sequence: Sequence,
    slowest: Option<Touch>,
    margin: f64,
    periods: f64,
    is_held: bool,
    /// The position at which a surface without a jump of the force was passed forward last, and whether the mass has
    /// turned since.
    touched: Option<(f64, bool)>,
}

impl Observer for Watch<'_> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.detuning.arc(arc, elapsed);
        let was_held = std::mem::replace(&mut self.is_held, arc.course.is_held());
        if self.is_held && arc.start == Clock::at_cycle(0) {
            self.margin = 0.0;
        }
        self.sequence.holds += usize::from(self.is_held && !was_held);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.detuning.crossing(crossing);
        let Instant { cycles, offset } = crossing.instant;
        let time = cycles + offset / self.clock.period();
        self.margin = self.margin.min(time).min(self.periods - time);
        self.impacts.extend(crossing.impact_velocity());
        match crossing.kind {
            CrossingKind::Surface { .. } | CrossingKind::Rebound { .. } => self.passes(crossing),
            CrossingKind::Reversal => self.turns(),
            CrossingKind::Rest => self.rests(),
            CrossingKind::Switch | CrossingKind::Release => self.sequence.others += 1,
        }
    }
}

impl Watch<'_> {
    fn turns(&mut self) {
        self.sequence.reversals += 1;
        if let Some((_, turned)) = &mut self.touched {
            *turned = true;
        }
    }

    fn passes(&mut self, crossing: &Crossing) {
        self.sequence.surfaces += 1;
        let amount = crossing.velocity.abs();
        let face = Face::at(self.scene, crossing.position);
        let gentle = face.is_none_or(|face| face.is_gentle(self.scene));
        let touched = self.touched.take();
        if gentle {
            self.sequence.gentle[0] += 1;
            // Turning back in between comes and goes with the touch.
            match touched {
                Some((position, true)) if position == crossing.position => {
                    self.sequence.gentle[1] += 1;
                }
                _ if crossing.velocity > 0.0 => self.touched = Some((crossing.position, false)),
                _ => {}
            }
        }
        if self.slowest.is_none_or(|known| amount < known.amount)
            && let Some(face) = face
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
