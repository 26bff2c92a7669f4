//! The map over the drive periods of an orbit, with everything that a continuation looks at.

use std::sync::Arc as Shared;

use nalgebra::Vector2;

use super::face::{Face, Touch};
use super::sequence::Sequence;
use crate::orbit::Monodromy;
use softstop::internals::{FrequencySensitivity, Motion, Phases};
use softstop::{
    Arc, Clock, Crossing, CrossingKind, Effort, Instant, MotionError, Observer, Scene, Start,
};

/// The image of a state after a number of drive periods from time 0, its derivatives, and what happens on the way.
#[derive(Debug, Clone)]
pub(crate) struct PeriodMap {
    /// Where it begins: the state, or the face of a rigid stop for a state beyond it.
    pub start: Vector2<f64>,
    /// States after each drive period.
    pub ends: Vec<Vector2<f64>>,
    /// Exact Jacobian of the last one.
    pub monodromy: Monodromy,
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

impl PeriodMap {
    /// The map of a valid scene, with its phases, from a state; with its derivative by the drive's frequency if that is
    /// wanted.
    pub fn of(
        machine: (&Scene, Shared<Phases>),
        periods: u64,
        state: Vector2<f64>,
        by_frequency: bool,
    ) -> Result<Self, MotionError> {
        let mut detuning = FrequencySensitivity::default();
        let (followed, by_frequency) = if by_frequency {
            let (followed, motion) = follow(machine, periods, state, &mut detuning)?;
            (followed, detuning.at_drive_angle(&motion))
        } else {
            let (followed, _) = follow(machine, periods, state, &mut detuning.tangent)?;
            (followed, None)
        };
        let Followed {
            start,
            ends,
            recorder,
        } = followed;
        let (lowest, highest) = recorder.scene.reach();
        let at_wall = start.x == lowest || start.x == highest;
        Ok(Self {
            start,
            ends,
            // Whatever comes to rest at a rigid stop goes on alike.
            monodromy: match at_wall && recorder.margin == 0.0 {
                true => Monodromy::ZERO,
                false => Monodromy::from(&detuning.tangent),
            },
            by_frequency,
            impacts: recorder.impacts,
            sequence: recorder.sequence,
            slowest: recorder.slowest,
            margin: recorder.margin,
        })
    }

    /// The state in the end.
    pub fn end(&self) -> Vector2<f64> {
        self.ends[self.ends.len() - 1]
    }
}

/// The image alone of a state, and how often the motion crosses what, without any derivative.
pub(crate) fn image(
    machine: (&Scene, Shared<Phases>),
    periods: u64,
    state: Vector2<f64>,
) -> Result<(Vector2<f64>, Sequence), MotionError> {
    let (Followed { ends, recorder, .. }, _) = follow(machine, periods, state, &mut ())?;
    Ok((ends[ends.len() - 1], recorder.sequence))
}

/// A motion from a state over the periods.
pub(super) struct Followed<'a> {
    start: Vector2<f64>,
    ends: Vec<Vector2<f64>>,
    recorder: MapRecorder<'a>,
}

/// Follows a motion over the periods, which another observer watches, too.
pub(super) fn follow<'a>(
    (scene, phases): (&'a Scene, Shared<Phases>),
    periods: u64,
    state: Vector2<f64>,
    other: &mut impl Observer,
) -> Result<(Followed<'a>, Motion), MotionError> {
    let start = before_wall(scene, state);
    let begin = Start::from(start);
    begin.validate()?;
    let mut motion = Motion::new(phases, scene.clock(), Clock::at_cycle(0), begin)?;
    let mut recorder = MapRecorder {
        scene,
        clock: *motion.clock(),
        impacts: Vec::new(),
        sequence: Sequence::default(),
        slowest: None,
        margin: f64::INFINITY,
        periods: periods as f64,
        is_held: false,
        touched: None,
        row: None,
    };
    let mut ends = Vec::with_capacity(periods as usize);
    for period in 1..=periods {
        carry_on(
            &mut motion,
            Clock::at_cycle(period),
            &mut (&mut recorder, &mut *other),
        )?;
        ends.push(motion.state().into());
    }
    motion.tell_arc(&mut (&mut recorder, other));
    recorder.sequence.impacts = recorder.impacts.len();
    Ok((
        Followed {
            start,
            ends,
            recorder,
        },
        motion,
    ))
}

/// Distance and speed, in the scene's scales, within which a mass rests at a rigid stop.
const AT_REST: f64 = 1e-9;

/// A state, or one at the face of a rigid stop for one beyond it, or at rest there to rounding: so the map goes on
/// continuously past the face, and has no other fixed points.
pub(crate) fn before_wall(scene: &Scene, state: Vector2<f64>) -> Vector2<f64> {
    let (lowest, highest) = scene.reach();
    let scales = scene.scales();
    let is_near = |wall: &f64| (wall - state.x).abs() < AT_REST * scales.length;
    if let Some(wall) = [highest, lowest].into_iter().find(is_near)
        && state.y.abs() < AT_REST * scales.speed()
    {
        return Vector2::new(wall, 0.0);
    }
    Vector2::new(state.x.min(highest).max(lowest), state.y)
}

/// Work that an orbit may cost per drive period, in scan windows: 32,000 crossings. A mass that bounces more
/// often is on its way to rest, and its motion is no orbit that could be followed.
const MAX_PERIOD_WORK: u64 = 1 << 21;

/// Carries a motion on by a drive period at most.
pub(crate) fn carry_on(
    motion: &mut Motion,
    until: Instant,
    observer: &mut impl Observer,
) -> Result<(), MotionError> {
    let mut effort = Effort::windows(MAX_PERIOD_WORK);
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

/// Carries a motion from time 0 on, one drive period after the other, and by what is left of one to the end.
pub(super) fn carry_through(
    motion: &mut Motion,
    end: Instant,
    observer: &mut impl Observer,
) -> Result<(), MotionError> {
    for cycle in 1..=end.cycles as u64 {
        carry_on(motion, Clock::at_cycle(cycle), observer)?;
    }
    carry_on(motion, end, observer)
}

struct MapRecorder<'a> {
    scene: &'a Scene,
    clock: Clock,
    impacts: Vec<f64>,
    sequence: Sequence,
    slowest: Option<Touch>,
    margin: f64,
    periods: f64,
    is_held: bool,
    /// The position at which a surface without a jump of the force was passed forward last, and whether the mass has
    /// turned since.
    touched: Option<(f64, bool)>,
    row: Option<Row>,
}

/// Ever weaker bounces at one place.
struct Row {
    position: f64,
    /// That of the last.
    velocity: f64,
    /// Up to the first: what happens how often, and impacts.
    sequence: Sequence,
    impacts: usize,
}

impl Observer for MapRecorder<'_> {
    fn arc(&mut self, arc: &Arc<'_>, _: f64) {
        let was_held = std::mem::replace(&mut self.is_held, arc.course.is_held());
        if self.is_held && arc.start == Clock::at_cycle(0) {
            self.margin = 0.0;
        }
        self.sequence.holds += usize::from(self.is_held && !was_held);
    }

    fn crossing(&mut self, crossing: &Crossing) {
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
        let bounces = matches!(crossing.kind, CrossingKind::Rebound { .. });
        if bounces || crossing.impact_velocity().is_some() {
            self.bounces(crossing);
        }
    }
}

impl MapRecorder<'_> {
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
        self.sequence.faces += usize::from(face.is_some());
        let gentle = face.is_none_or(|face| face.is_gentle(self.scene));
        let touched = self.touched.take();
        let is_back = matches!(crossing.kind, CrossingKind::Surface { forward: false, .. });
        let is_onward = amount > 0.0 && !is_back;
        if gentle {
            self.sequence.gentle[0] += 1;
            // Turning back in between comes and goes with the touch.
            match touched {
                Some((position, true)) if position == crossing.position => {
                    self.sequence.gentle[1] += 1;
                }
                _ if is_onward => self.touched = Some((crossing.position, false)),
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

    fn bounces(&mut self, crossing: &Crossing) {
        let (position, velocity) = (crossing.position, crossing.velocity.abs());
        match &mut self.row {
            Some(row) if row.position == position && velocity < row.velocity => {
                row.velocity = velocity;
            }
            row => {
                *row = Some(Row {
                    position,
                    velocity,
                    sequence: self.sequence,
                    impacts: self.impacts.len(),
                });
            }
        }
    }

    /// A row of ever weaker bounces counts as its first: how many of them are told one by one is the
    /// simulation's choice.
    fn rests(&mut self) {
        if let Some(row) = self.row.take() {
            self.impacts.truncate(row.impacts);
            let Sequence { rests, holds, .. } = self.sequence;
            self.sequence = Sequence {
                rests,
                holds,
                ..row.sequence
            };
        }
        self.sequence.rests += 1;
        self.slowest = None;
    }
}
