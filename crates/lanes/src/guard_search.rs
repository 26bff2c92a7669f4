//! Finds where the guard rises through zero in the window ahead.

use pulp::Simd;

use super::cubic::Cubic;
use super::free_and_steady_parts::Parts;
use super::guard_interval::GuardInterval;
use super::lane_laws::Laws;
use super::lanes::{Lanes, Mask, Pair};
use super::local_taylor;
use super::nearby_zero::nearby_zero;
use super::polynomial::value_and_rate;
use super::sine_cosine::SMALL_ANGLE_DEGREE;
use super::window_ahead::WindowAhead;
use super::window_guard::WindowGuard;

/// Most guesses, besides the first, of a crossing or a maximum of the guard; then the safe engine finds it.
const MAX_INSTANTS: usize = 6;

/// Result of the search for a crossing in the window ahead, in each lane.
pub(super) struct SearchResult<S: Simd, const N: usize> {
    /// Lanes that meet nothing, and lanes that cross.
    pub clear: Mask<S, N>,
    pub hits: Mask<S, N>,
    /// Lanes that the safe engine has to decide.
    pub doubtful: Mask<S, N>,
    /// Time to the crossing, or to where the lane may go.
    pub time: Lanes<S, N>,
    /// The motion there, its free part not quite, and the guard's rate.
    pub parts: Parts<S, N>,
    pub rate: Lanes<S, N>,
    /// Position and velocity at the crossing; the position where it is not that of a surface.
    pub position: Lanes<S, N>,
    pub velocity: Lanes<S, N>,
}

/// What each lane searches for in the window ahead, and its present guess.
struct SearchState<S: Simd, const N: usize> {
    /// Lanes that meet nothing.
    clear: Mask<S, N>,
    /// Lanes that look for the crossing.
    rises: Mask<S, N>,
    /// Lanes that look for the maximum.
    humps: Mask<S, N>,
    doubtful: Mask<S, N>,
    /// Time before which the crossing lies.
    end: Lanes<S, N>,
    /// Time of the present guess, or to where the lane goes.
    at: Lanes<S, N>,
}

impl<S: Simd, const N: usize> WindowGuard<S, N> {
    /// Searches the guard's first rise through zero in the lanes `pending`, and how far the others may go without one.
    /// `HAS_OTHER_ENDS`: the phase may end at something else than one position.
    #[inline(always)]
    pub fn search_window<const HAS_OTHER_ENDS: bool>(
        &self,
        law: &Laws<S, N>,
        ahead: &WindowAhead<S, N>,
        pending: Mask<S, N>,
    ) -> SearchResult<S, N> {
        let left = self.value_and_rate::<HAS_OTHER_ENDS>(law, ahead, &ahead.here);
        let right = self.value_and_rate::<HAS_OTHER_ENDS>(law, ahead, &ahead.there);
        let single = if HAS_OTHER_ENDS {
            pending.and_not(self.several | self.none)
        } else {
            pending
        };
        let cubic = Cubic::interpolate(left, right, ahead.span);
        let touches = (-self.ambiguity).below(left.0);
        let leaves = touches & left.1.below(-self.slow) & left.0.at_most(self.ambiguity);
        let root = cubic.guess_rise(leaves, single);
        let sound = single.and_not(touches) | (single & leaves);
        let mut goal = SearchState {
            clear: if HAS_OTHER_ENDS {
                pending & self.none
            } else {
                pending.and_not(pending)
            },
            rises: cubic.rises_once(self.error_bound, root, leaves, sound),
            humps: pending.and_not(pending),
            doubtful: single & touches.and_not(leaves),
            end: ahead.span,
            at: ahead.span * root,
        };
        let open = single.and_not(goal.rises | goal.doubtful);
        if open.any() {
            let interval = GuardInterval {
                left,
                right,
                span: ahead.span,
                error_bound: self.error_bound,
            };
            let verdict = interval.judge(touches, leaves);
            goal.clear = goal.clear | (open & verdict.clear);
            goal.rises = goal.rises | (open & verdict.rises);
            goal.humps = open & verdict.hump;
            let top = ahead.span * left.1 / (left.1 - right.1);
            goal.at = goal.humps.choose(top, goal.at);
        }
        // A crossing within rounding of the end: before it or after?
        let ends_there = (-self.ambiguity).below(right.0) & left.0.like(0.0).below(right.1);
        goal.doubtful = goal.doubtful | (goal.clear & single & ends_there);
        goal.rises = goal.rises.and_not(goal.doubtful);
        goal.clear = goal.clear.and_not(goal.doubtful);
        let still = goal.clear.choose(ahead.span, root.like(0.0));
        goal.at = (goal.rises | goal.humps).choose(goal.at, still);
        self.refine_search::<HAS_OTHER_ENDS>(law, ahead, left, goal)
    }

    /// Refines the guesses by Newton's method: lanes whose guard has a maximum first find how high it is, lanes whose guard rises
    /// find the crossing; the others just go to the end of the window.
    #[inline(always)]
    fn refine_search<const HAS_OTHER_ENDS: bool>(
        &self,
        law: &Laws<S, N>,
        ahead: &WindowAhead<S, N>,
        left: Pair<S, N>,
        mut goal: SearchState<S, N>,
    ) -> SearchResult<S, N> {
        let zero = ahead.span.like(0.0);
        let mut tries = 0;
        loop {
            // Or the compiler would fetch the whole law before the loop, that seldom goes round twice, and spill it.
            let law = std::hint::black_box(law);
            let (here, next) = (&ahead.here, &ahead.next);
            let parts = here.within_window(law, ahead.frequency, next, goal.at);
            let derivatives = local_taylor::motion_derivatives(law, ahead.frequency, &parts);
            let weights = (self.position, self.velocity, self.level);
            let local = local_taylor::guard_taylor::<S, N, HAS_OTHER_ENDS>(&derivatives, weights);
            let mut sought = local;
            if goal.humps.any() {
                for (sought, falling) in sought.iter_mut().zip(local_taylor::negated_rate(&local)) {
                    *sought = goal.humps.choose(falling, *sought);
                }
            }
            let zeros = nearby_zero(&sought, law.window, goal.rises | goal.humps);
            let hits = goal.rises & zeros.sure;
            let open = (goal.rises | goal.humps).and_not(hits);
            tries += 1;
            if !open.any() || tries > MAX_INSTANTS {
                let moment = hits.choose(zeros.time, zero);
                let (position, velocity) = if HAS_OTHER_ENDS {
                    local_taylor::position_and_velocity_at(&derivatives, moment)
                } else {
                    (zero, zeros.slope)
                };
                return SearchResult {
                    clear: goal.clear,
                    hits,
                    doubtful: goal.doubtful | open,
                    time: goal.at + moment,
                    parts: parts.turn_drive::<SMALL_ANGLE_DEGREE>(ahead.frequency, moment),
                    rate: zeros.slope,
                    position,
                    velocity,
                };
            }
            let next = (goal.at + zeros.time).max(zero).min(goal.end);
            goal.at = open.choose(next, goal.at);
            let tops = goal.humps & zeros.sure;
            if tops.any() {
                let height = value_and_rate(&local, zeros.time).0;
                self.search_from_maximum(left, tops, height, ahead.span, &mut goal);
            }
        }
    }

    /// Decides lanes whose guard's maximum is found: below zero there is no crossing, above zero it is searched next, too close
    /// to tell is left to the safe engine.
    #[inline(always)]
    fn search_from_maximum(
        &self,
        left: Pair<S, N>,
        tops: Mask<S, N>,
        height: Lanes<S, N>,
        span: Lanes<S, N>,
        goal: &mut SearchState<S, N>,
    ) {
        let over = tops & self.ambiguity.below(height);
        let under = tops & height.below(-self.ambiguity);
        let none = height.like(0.0);
        goal.humps = goal.humps.and_not(tops);
        goal.clear = goal.clear | under;
        goal.doubtful = goal.doubtful | tops.and_not(over | under);
        goal.rises = goal.rises | over;
        goal.end = over.choose(goal.at, goal.end);
        let risen = Cubic::interpolate(left, (height, none), goal.end);
        let root = goal.end * risen.guess_rise(over.and_not(over), over);
        goal.at = over.choose(root, under.choose(span, goal.at));
    }
}
