//! What a motion meets beyond the end of its window.

use super::explorer::Gathering;
use softstop::Start;
use softstop_dynamics::motion::MotionKind;
use softstop_dynamics::orbit::Orbit;

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
