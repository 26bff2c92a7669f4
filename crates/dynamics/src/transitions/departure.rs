//! What follows beyond the end of a window, and whether the way back leads into it again.

use nalgebra::Vector2;

use super::cause::Course;
use super::explore::Stage;
use super::way::Way;
use super::window::{EndKind, Window, WindowEnd};
use super::{Motion, Transition, TransitionError};
use crate::attractors::{Arrival, Options};
use crate::continuation::{Family, Limits, SpecialKind, Test};
use crate::orbit::{Exponents, Orbit};
use softstop::integrator::Start;
use softstop::scene::Scene;

/// Relative differences between motions started side by side.
const SPREAD: f64 = 1e-9;
/// Drive periods in each batch of an exponent.
const BATCH: u64 = 1600;
/// Share of a window within which the way back is tried.
const INSIDE: f64 = 0.25;
/// Points of a doubled branch on which its first special point is looked for.
const DOUBLED: usize = 300;

/// Where most of several motions are.
#[derive(Debug, Clone)]
pub(super) struct Gathering {
    /// What they do; none if that cannot be said yet.
    pub motion: Option<Motion>,
    /// The orbit, if they repeat.
    pub orbit: Option<Orbit>,
    /// Those that do so.
    pub states: Vec<Start>,
}

/// A motion that has left its window.
pub(super) struct Departure {
    pub transition: Transition,
    /// Where it settled.
    pub value: f64,
    pub gathering: Gathering,
}

impl<F: Family + Sync> Stage<'_, F> {
    /// Holds the parameter and lets motions settle.
    pub fn hold(
        &self,
        value: f64,
        starts: &[Start],
        periods: u64,
    ) -> Result<Vec<Arrival>, TransitionError> {
        let options = Options {
            transient: periods,
            ..self.rules.survey
        };
        let scene = self.family.scene([value])?;
        let watcher = |_, _| (self.watcher)();
        Ok(crate::attractors::settle(
            &scene, starts, &options, &watcher,
        )?)
    }

    /// What most of them do then.
    pub fn gather(&self, value: f64, starts: &[Start]) -> Result<Gathering, TransitionError> {
        let arrivals = self.hold(value, starts, self.rules.patience)?;
        let (settled, wandering): (Vec<Arrival>, Vec<Arrival>) =
            arrivals.into_iter().partition(|it| it.orbit.is_some());
        if wandering.len() > settled.len() {
            let states: Vec<Start> = wandering.into_iter().map(|it| it.state).collect();
            let scene = self.family.scene([value])?;
            let motion = is_chaotic(&scene, states[0])?.then_some(Motion::Chaos);
            return Ok(Gathering {
                motion,
                orbit: None,
                states,
            });
        }
        Ok(most(settled))
    }

    /// What follows beyond an end of a window: held at ever larger distances from it.
    pub fn depart(
        &self,
        window: &Window,
        upper: bool,
    ) -> Result<Option<Departure>, TransitionError> {
        let end = &window.ends[usize::from(upper)];
        if matches!(end.kind, EndKind::Merging | EndKind::Range | EndKind::Lost) {
            return Ok(None);
        }
        let sign = if upper { 1.0 } else { -1.0 };
        let mut way = Way::new(self.side_by_side(end.point.state()), window);
        for distance in self.distances(end.point.parameter) {
            let value = end.point.parameter + sign * distance;
            let mut gathering = self.gather(value, &self.fill(&way.states))?;
            if gathering.motion.is_none()
                && end.kind == EndKind::Flip
                && self.is_intermittent(value, &gathering.states, &window.motion)?
            {
                gathering.motion = Some(Motion::Chaos);
            }
            if way.meet(gathering, distance, end.kind) {
                break;
            }
        }
        let Some((distance, gathering)) = way.last.clone() else {
            return Ok(None);
        };
        let [low, high] = &window.ends;
        let width = high.point.parameter - low.point.parameter;
        let back = end.point.parameter - sign * distance.min(INSIDE * width);
        let returned = self.gather(back, &self.fill(&gathering.states))?;
        let hysteresis = returned.motion.as_ref() != Some(&window.motion);
        let doubled = match end.kind {
            EndKind::Flip => self.end_of_doubled(&way, window, end, upper)?,
            _ => None,
        };
        let course = Course {
            end: end.kind,
            doubled: doubled.map(|it| it.0),
            is_soft: doubled.is_some_and(|it| sign * (it.1 - end.point.parameter) > 0.0),
            path: &way.path,
            hysteresis,
        };
        let transition = Transition {
            value: end.point.parameter,
            from: window.motion.clone(),
            state: Some(end.point.state().into()),
            causes: course.causes(),
            doubled_until: doubled.map(|it| it.1),
            settled_at: self.settling(&way, end.point.parameter, sign)?,
            path: way.path,
            rising: upper,
            hysteresis,
            beyond: distance,
        };
        Ok(Some(Departure {
            transition,
            value: end.point.parameter + sign * distance,
            gathering,
        }))
    }

    /// Where the last motion on a way first follows, if others come before it.
    fn settling(&self, way: &Way, end: f64, sign: f64) -> Result<Option<f64>, TransitionError> {
        let (Some((near, states)), Some((far, last))) = (&way.before, &way.first) else {
            return Ok(None);
        };
        let (mut near, mut far) = (*near, *far);
        let width = self.rules.width * end.abs();
        while far - near > width {
            let middle = 0.5 * (near + far);
            let there = self.gather(end + sign * middle, &self.fill(states))?;
            if there.motion.as_ref() == Some(last) {
                far = middle;
            } else {
                near = middle;
            }
        }
        Ok(Some(end + sign * 0.5 * (near + far)))
    }

    /// Distances beyond an end, each twice the one before.
    fn distances(&self, value: f64) -> impl Iterator<Item = f64> + use<F> {
        let (first, largest) = self.rules.beyond;
        let unit = value.abs();
        std::iter::successors(Some(first * unit), |distance| Some(2.0 * distance))
            .take_while(move |distance| *distance <= largest * unit)
    }

    /// As many motions as the rules ask for about a state.
    fn side_by_side(&self, state: Vector2<f64>) -> Vec<Start> {
        self.fill(&[state.into()])
    }

    /// As many motions as the rules ask for: the given ones, and others beside them.
    pub fn fill(&self, states: &[Start]) -> Vec<Start> {
        let beside = |(index, state): (usize, &Start)| {
            let round = (index / states.len()) as f64;
            Start {
                position: state.position * (1.0 + SPREAD * round),
                velocity: state.velocity * (1.0 + SPREAD * round),
            }
        };
        states
            .iter()
            .cycle()
            .take(self.rules.motions)
            .enumerate()
            .map(beside)
            .collect()
    }

    /// How the last doubled motion on the way ends.
    fn end_of_doubled(
        &self,
        way: &Way,
        window: &Window,
        end: &WindowEnd,
        upper: bool,
    ) -> Result<Option<(EndKind, f64)>, TransitionError> {
        let place = usize::from(upper);
        if let Some((distance, orbit)) = &way.doubled {
            let value = end.point.parameter + if upper { *distance } else { -distance };
            let window = Window::of(self.family, value, orbit, self.range, &self.rules)?;
            let end = &window.ends[place];
            return Ok(Some((end.kind, end.point.parameter)));
        }
        let Some(periods) = window.motion.periods() else {
            return Ok(None);
        };
        let limits = Limits {
            range: self.range,
            points: self.rules.points,
        };
        let follower = crate::continuation::Follower::new(self.family, periods);
        // Its first special point is the end of the doubled motion or, where the flip is hard, the fold from
        // which the doubled motion comes.
        let mut seen = 0;
        let branch = follower.doubled(&end.point, &limits, |_| {
            seen += 1;
            if seen < DOUBLED {
                std::ops::ControlFlow::Continue(())
            } else {
                std::ops::ControlFlow::Break(())
            }
        });
        let first = branch.ok().and_then(|it| it.specials.into_iter().next());
        Ok(first.map(|special| {
            let kind = match special.kind {
                SpecialKind::Grazing(graze) => EndKind::Grazing { dies: graze.dies },
                SpecialKind::Critical(Test::Fold) => EndKind::Fold,
                SpecialKind::Critical(Test::Flip) => EndKind::Flip,
                SpecialKind::Critical(_) => EndKind::Lost,
            };
            (kind, special.point.parameter)
        }))
    }
}

/// The commonest orbit of motions that have settled.
pub(super) fn most(settled: Vec<Arrival>) -> Gathering {
    let mut kinds: Vec<(Motion, Orbit, Vec<Start>)> = Vec::new();
    for arrival in settled {
        let Some(orbit) = arrival.orbit else { continue };
        let motion = Motion::of(&orbit);
        match kinds.iter_mut().find(|kind| kind.0 == motion) {
            Some(kind) => kind.2.push(arrival.state),
            None => kinds.push((motion, orbit, vec![arrival.state])),
        }
    }
    let most = kinds.into_iter().max_by_key(|kind| kind.2.len());
    match most {
        Some((motion, orbit, states)) => Gathering {
            motion: Some(motion),
            orbit: Some(orbit),
            states,
        },
        None => Gathering {
            motion: None,
            orbit: None,
            states: Vec::new(),
        },
    }
}

fn is_chaotic(scene: &Scene, state: Start) -> Result<bool, TransitionError> {
    let (exponents, _) = Exponents::along(scene, state.into(), BATCH)?;
    Ok(exponents.is_positive())
}
