//! What follows beyond the end of a window, and whether the way back leads into it again.

use super::explorer::{Explorer, Gathering, Window, WindowEnd};
use super::{Transition, causes};
use softstop::Start;
use softstop_dynamics::continuation::{Continuation, SpecialKind, TestFunction};
use softstop_dynamics::monitor::stop_if;
use softstop_dynamics::motion_kind::MotionKind;
use softstop_dynamics::orbit::{Orbit, OrbitError};

/// Share of a window within which the way back is tried.
const INSIDE: f64 = 0.25;
/// Points of a doubled branch on which its first special point is looked for.
const DOUBLED: usize = 300;

impl Explorer<'_> {
    /// What follows beyond an end of a window, held at ever larger distances from it: the transition, and the motions where
    /// they have settled.
    pub(super) fn depart(
        &self,
        window: &Window,
        upper: bool,
    ) -> Result<Option<(Transition, Gathering)>, OrbitError> {
        let end = &window.ends[usize::from(upper)];
        let Some(kind) = end.kind else {
            return Ok(None);
        };
        let flips = kind == SpecialKind::Critical(TestFunction::Flip);
        let sign = if upper { 1.0 } else { -1.0 };
        let mut way = DeparturePath {
            states: self.fill(&[end.point.state().into()]),
            ..DeparturePath::default()
        };
        for distance in self.distances(end.point.parameter) {
            let value = end.point.parameter + sign * distance;
            let mut gathering = self.gather(value, &self.fill(&way.states))?;
            if gathering.motion.is_none()
                && flips
                && self.is_intermittent(value, &gathering.states, &window.motion)?
            {
                gathering.motion = Some(MotionKind::Chaos);
            }
            if way.meet(gathering, distance, (&window.motion, flips)) {
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
        let doubled = match flips {
            true => self.end_of_doubled(&way, window, end, upper)?,
            false => None,
        };
        let settling = self.settling(&way, end.point.parameter, sign)?;
        let mut transition = Transition {
            value: end.point.parameter,
            from: window.motion.clone(),
            state: Some(end.point.state().into()),
            causes: Vec::new(),
            doubled_until: doubled.map(|it| it.1),
            settled_at: settling.map(|it| it.0),
            settled_within: settling.map_or(0.0, |it| it.1),
            path: way.path,
            rising: upper,
            hysteresis,
            beyond: distance,
        };
        transition.causes = causes(&transition, kind, doubled.and_then(|it| it.0));
        Ok(Some((transition, gathering)))
    }

    /// Where the last motion on a way first follows, if others come before it, and half the width of where that may be:
    /// it is known no better where it is not clear whether most motions of the rules come to it.
    fn settling(
        &self,
        way: &DeparturePath,
        end: f64,
        sign: f64,
    ) -> Result<Option<(f64, f64)>, OrbitError> {
        let (Some((near, states)), Some((far, last))) = (&way.before, &way.first) else {
            return Ok(None);
        };
        let (mut near, mut far) = (*near, *far);
        let width = self.rules.width * end.abs();
        while far - near > width {
            let middle = 0.5 * (near + far);
            let there = self.gather(end + sign * middle, &self.fill(states))?;
            if !there.is_clear {
                break;
            }
            match there.motion.as_ref() == Some(last) {
                true => far = middle,
                false => near = middle,
            }
        }
        Ok(Some((end + sign * 0.5 * (near + far), 0.5 * (far - near))))
    }

    /// Distances beyond an end, each twice the one before.
    fn distances(&self, value: f64) -> impl Iterator<Item = f64> + use<> {
        let (first, largest) = self.rules.beyond;
        let unit = value.abs();
        std::iter::successors(Some(first * unit), |distance| Some(2.0 * distance))
            .take_while(move |distance| *distance <= largest * unit)
    }

    /// How the last doubled motion on the way ends.
    fn end_of_doubled(
        &self,
        way: &DeparturePath,
        window: &Window,
        end: &WindowEnd,
        upper: bool,
    ) -> Result<Option<(Option<SpecialKind>, f64)>, OrbitError> {
        let place = usize::from(upper);
        if let Some((distance, orbit)) = &way.doubled {
            let value = end.point.parameter + if upper { *distance } else { -distance };
            let window = self.window(value, orbit)?;
            let end = &window.ends[place];
            return Ok(Some((end.kind, end.point.parameter)));
        }
        let Some(periods) = window.motion.periods() else {
            return Ok(None);
        };
        let continuation = Continuation::new(self.family, periods);
        // Its first special point is the end of the doubled motion or, where the flip is hard, the fold from
        // which the doubled motion comes.
        let mut seen = 0;
        let branch = continuation.double_period(&end.point, &self.limits(), |_| {
            seen += 1;
            stop_if(seen == DOUBLED)
        });
        let first = branch.ok().and_then(|it| it.specials.into_iter().next());
        Ok(first.map(|special| (Some(special.kind), special.point.parameter)))
    }
}

/// What a motion has met beyond the end of its window.
#[derive(Default)]
pub(super) struct DeparturePath {
    pub states: Vec<Start>,
    pub path: Vec<MotionKind>,
    /// The last doubled motion and its distance.
    pub doubled: Option<(f64, Orbit)>,
    /// The last distance at which it is known what the motion does.
    pub last: Option<(f64, Gathering)>,
    /// The motion that is believed if it is met once more.
    pub tentative: Option<MotionKind>,
    /// The distance at which the last motion was first met, and the motion.
    pub first: Option<(f64, MotionKind)>,
    /// The last distance before that at which something else was, and the states there.
    pub before: Option<(f64, Vec<Start>)>,
    pub last_seen: Option<(f64, Vec<Start>)>,
}

impl DeparturePath {
    /// Enters what is met at a distance beyond an end of a window, which is a flip or not; true if that is where it settles.
    pub fn meet(
        &mut self,
        gathering: Gathering,
        distance: f64,
        (from, flips): (&MotionKind, bool),
    ) -> bool {
        if !gathering.states.is_empty() {
            self.states.clone_from(&gathering.states);
        }
        let Some(motion) = gathering.motion.clone() else {
            return false;
        };
        if motion == *from {
            return false;
        }
        if self.first.as_ref().is_none_or(|(_, last)| *last != motion) {
            self.before = self.last_seen.take();
            self.first = Some((distance, motion.clone()));
        }
        self.last_seen = Some((distance, self.states.clone()));
        let doubles = is_doubled(from, &motion);
        let goes_on = doubles || motion == MotionKind::Chaos;
        // A window within chaos is narrow.
        let is_doubtful = flips && !goes_on && self.path.contains(&MotionKind::Chaos);
        if is_doubtful && self.tentative.as_ref() != Some(&motion) {
            self.tentative = Some(motion);
            return false;
        }
        self.tentative = None;
        if doubles && let Some(orbit) = &gathering.orbit {
            self.doubled = Some((distance, orbit.clone()));
        }
        if self.path.last() != Some(&motion) {
            self.path.push(motion);
        }
        self.last = Some((distance, gathering));
        !(flips && goes_on)
    }
}

/// True if one motion is another with its period doubled once or several times.
pub(super) fn is_doubled(simple: &MotionKind, other: &MotionKind) -> bool {
    let (Some(periods), Some(longer)) = (simple.periods(), other.periods()) else {
        return false;
    };
    let times = longer / periods;
    let impacts = |motion: &MotionKind| motion.regime().map(|regime| regime.impacts);
    longer.is_multiple_of(periods)
        && times > 1
        && times.is_power_of_two()
        && impacts(other) == impacts(simple).map(|impacts| times * impacts)
}
