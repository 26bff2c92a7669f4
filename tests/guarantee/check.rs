//! Leg by leg: nothing missed, nothing invented, the end as stated, the next mode by the rules.

use softstop::{Crossing, CrossingKind};

use super::law::Machine;
use super::motion::{Departure, Motion};
use super::piece::{Seen, Watch};
use super::record::Leg;
use super::rules::Mode;
use super::scales::Scales;
use super::tally::Tally;

/// Evaluations spent on one case.
const BUDGET: u64 = 60_000;

/// Why a case ends early.
#[derive(Debug)]
pub enum Stop {
    /// The library is wrong, or the oracle.
    Wrong(String),
    /// Two outcomes cannot be told apart.
    Undecidable,
    /// The budget is spent.
    Cut,
}

/// Checks a record. Its tally is filled as far as the check goes.
pub fn check(machine: &Machine, legs: &[Leg], tally: &mut Tally) -> Result<(), (usize, Stop)> {
    let Some(first) = legs.first() else {
        return Ok(());
    };
    let mut modes = machine.at_start(first.position, first.velocity, first.angle);
    let mut watch = Watch {
        budget: BUDGET,
        margin: f64::INFINITY,
        touches: 0,
        away: false,
        doubt: false,
    };
    for (index, leg) in legs.iter().enumerate() {
        let mut one = || -> Result<Vec<Mode>, Stop> {
            let mode = choose(machine, &modes, leg)?;
            Check {
                machine,
                leg,
                watch: &mut watch,
                tally: &mut *tally,
            }
            .leg(mode)
        };
        modes = one().map_err(|stop| (index, stop))?;
        let next = legs.get(index + 1);
        if let (Some(next), Some(end)) = (next, &leg.end) {
            joined(machine, leg, end, next).map_err(|stop| (index, stop))?;
        }
    }
    Ok(())
}

/// The one mode that the rules allow and the library took.
fn choose(machine: &Machine, modes: &[Mode], leg: &Leg) -> Result<Mode, Stop> {
    let fits = |mode: &&Mode| {
        let rests = matches!(mode, Mode::Held { .. });
        machine.kind(**mode) == leg.kind && (!rests || leg.velocity == 0.0)
    };
    let mut fitting = modes.iter().filter(fits);
    match (fitting.next(), fitting.next()) {
        (Some(mode), None) => Ok(*mode),
        (Some(_), Some(_)) => Err(Stop::Undecidable),
        (None, _) => wrong(format!(
            "{:?} at the start, where the rules say {modes:?}",
            leg.kind
        )),
    }
}

/// The next leg starts when and where this one ends.
fn joined(machine: &Machine, leg: &Leg, end: &Crossing, next: &Leg) -> Result<(), Stop> {
    let cycles = next.start.0 - leg.start.0;
    let time = cycles * machine.period() + (next.start.1 - leg.start.1);
    let room = 1e-14 * (1.0 + cycles) * machine.period();
    if (time - leg.duration).abs() > room {
        return wrong(format!("the next leg starts after {time}"));
    }
    if next.position != end.position || next.velocity != end.velocity_after {
        return wrong("the next leg starts elsewhere".into());
    }
    Ok(())
}

pub fn wrong<T>(what: String) -> Result<T, Stop> {
    Err(Stop::Wrong(what))
}

/// One leg under check.
pub struct Check<'a> {
    pub machine: &'a Machine,
    pub leg: &'a Leg,
    pub watch: &'a mut Watch,
    pub tally: &'a mut Tally,
}

impl Check<'_> {
    fn leg(mut self, mode: Mode) -> Result<Vec<Mode>, Stop> {
        self.tally.arcs += 1;
        if let Some(joint) = self
            .leg
            .joints
            .iter()
            .find(|joint| joint.3 != self.leg.kind)
        {
            return wrong(format!("the kind changes without a crossing: {joint:?}"));
        }
        if let Some(end) = &self.leg.end {
            self.tally.count(end.kind);
        }
        match mode {
            Mode::Moving {
                layer,
                forward,
                released,
            } => {
                let Leg {
                    position,
                    velocity,
                    angle,
                    ..
                } = *self.leg;
                self.moving(&Departure {
                    layer,
                    forward,
                    released,
                    position,
                    velocity,
                    angle,
                })
            }
            Mode::Held { upper, lower } => self.held(upper, lower),
            Mode::Chatter { layer } => self.chatter(layer),
        }
    }

    fn moving(&mut self, at: &Departure) -> Result<Vec<Mode>, Stop> {
        let budget = &mut self.watch.budget;
        let motion = Motion::new(self.machine, at, self.leg.duration, budget).ok_or(Stop::Cut)?;
        let scales = Scales::new(self.machine, at, &motion, self.leg.duration);
        self.nothing_missed(at, &motion, &scales)?;
        self.joints(at, &motion, &scales)?;
        match &self.leg.end {
            None => Ok(Vec::new()),
            Some(end) => self.crossing(end, at, &motion, &scales),
        }
    }

    fn nothing_missed(
        &mut self,
        at: &Departure,
        motion: &Motion,
        scales: &Scales,
    ) -> Result<(), Stop> {
        let before = self.watch.touches;
        self.watch.margin = f64::INFINITY;
        for (name, guard) in scales.guards(self.machine, at) {
            self.watch.renew();
            match motion.search(&guard, self.watch) {
                Seen::Clear => {}
                Seen::Exhausted => return Err(Stop::Cut),
                Seen::Met { time, value } => {
                    return wrong(format!(
                        "missed: {name} by {value:e} (grain {:e}) {time} after the start",
                        guard.grain
                    ));
                }
            }
        }
        self.tally.touches += self.watch.touches - before;
        self.tally.near_misses += u64::from(self.watch.margin < 1e-6);
        self.tally.closest = self.tally.closest.min(self.watch.margin);
        Ok(())
    }

    /// Stretches that the library joins must lie on one motion.
    fn joints(&mut self, at: &Departure, motion: &Motion, scales: &Scales) -> Result<(), Stop> {
        for (time, position, velocity, _) in &self.leg.joints {
            let state = motion.at(*time);
            let errors = (
                (at.position + state.u - position).abs() / scales.x,
                (state.v - velocity).abs() / scales.v,
            );
            self.tally.error(errors.0.max(errors.1));
            if errors.0.max(errors.1) > 1.0 {
                return wrong(format!("joint after {time}: errors {errors:?} grains"));
            }
        }
        Ok(())
    }

    fn crossing(
        &mut self,
        end: &Crossing,
        at: &Departure,
        motion: &Motion,
        scales: &Scales,
    ) -> Result<Vec<Mode>, Stop> {
        let state = motion.end();
        let errors = (
            (at.position + state.u - end.position).abs() / scales.x,
            (state.v - end.velocity).abs() / scales.v,
        );
        self.tally.error(errors.0.max(errors.1));
        if errors.0.max(errors.1) > 1.0 {
            return wrong(format!(
                "end state off by {errors:?} grains {:?}: {} {}",
                (scales.x, scales.v),
                at.position + state.u,
                state.v
            ));
        }
        let angle = self.leg.angle + self.machine.frequency * self.leg.duration;
        let m = self.machine;
        match end.kind {
            CrossingKind::Surface {
                forward, impact, ..
            } => {
                let face = if forward { at.layer + 1 } else { at.layer };
                let lower = face.wrapping_sub(1);
                if face == 0 || face >= m.layers.len() || impact != (forward && face == 1) {
                    return wrong("no such surface".into());
                }
                self.reaches(end, m.layers[face].from, forward, state.a, scales)?;
                let kept = end.velocity_after == end.velocity || end.velocity_after == 0.0;
                if !kept {
                    return wrong("the velocity jumps".into());
                }
                Ok(m.on_face(lower, end.velocity, angle))
            }
            CrossingKind::Rebound { .. } => {
                let Some((wall, restitution)) = m.wall.filter(|_| at.layer + 1 == m.layers.len())
                else {
                    return wrong("no wall here".into());
                };
                self.reaches(end, wall, true, state.a, scales)?;
                let newton = (end.velocity_after + restitution * end.velocity).abs();
                let rests = end.velocity_after == 0.0 && m.faint(at.layer, end.velocity, angle);
                if newton > 1e-15 * end.velocity && !rests {
                    return wrong("not Newton's impact law".into());
                }
                Ok(m.on_wall(at.layer, end.velocity_after, angle))
            }
            CrossingKind::Reversal => self.reverses(end, at, &state, scales, angle),
            CrossingKind::Switch => self.switches(end, at, &state, scales),
            CrossingKind::Rest | CrossingKind::Release => {
                wrong("a moving mass is no held one".into())
            }
        }
    }
}
