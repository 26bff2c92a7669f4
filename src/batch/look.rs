//! A close look at what lies ahead of a lane: nothing, a crossing, or a matter for the scalar engine.

use pulp::Simd;

use super::Watch;
use super::engine::Engine;
use super::judge::Stretch;
use super::lanes::{Lanes, Mask};
use super::law::Law;
use super::root::{Bracket, guess};
use super::scan::Hull;
use super::state::State;
use super::taylor::{Series, derivative, evaluate, expand, shifted};

/// Share of a window that is looked at last before the scalar engine decides.
const SHORTEST: f64 = 1.0 / 256.0;

/// The motion of all lanes over the stretch that they look at.
struct Ahead<S: Simd> {
    x: Series<S>,
    v: Series<S>,
    span: Lanes<S>,
    /// Position, velocity and acceleration at its end.
    end: (Lanes<S>, Lanes<S>, Lanes<S>),
}

/// The guard that each lane has to look at: g = position x + velocity v - level.
struct Guard<S: Simd> {
    position: Lanes<S>,
    velocity: Lanes<S>,
    level: Lanes<S>,
    grain: Lanes<S>,
    slow: Lanes<S>,
    slack: Lanes<S>,
    /// The lower end of the phase, or the further guard; else the upper end.
    is_low: Mask<S>,
    is_further: Mask<S>,
    /// Lanes that meet none, and lanes that may meet more than one.
    none: Mask<S>,
    several: Mask<S>,
}

/// What was found.
struct Found<S: Simd> {
    clear: Mask<S>,
    hits: Mask<S>,
    /// Lanes that the scalar engine has to decide.
    doubtful: Mask<S>,
    /// Time to the crossing.
    time: Lanes<S>,
}

impl<S: Simd, W: Watch, const GUARDED: bool> Engine<'_, S, W, GUARDED> {
    /// Looks at what lies ahead of the pending lanes and moves them on; those that came to the end of
    /// their job, and those that the scalar engine has to take.
    #[inline(always)]
    pub fn look(&mut self, law: &Law<S>) -> (Mask<S>, Mask<S>) {
        let ahead = Ahead::<S>::of::<GUARDED>(law, &self.state);
        let guard = Guard::of::<GUARDED>(law, &self.state, &ahead);
        let found = guard.search::<GUARDED>(&ahead, self.state.pending);
        self.move_on(law, &ahead, &guard, &found)
    }

    #[inline(always)]
    fn move_on(
        &mut self,
        law: &Law<S>,
        ahead: &Ahead<S>,
        guard: &Guard<S>,
        found: &Found<S>,
    ) -> (Mask<S>, Mask<S>) {
        let mut state = self.state;
        let one = state.x.like(1.0);
        let time = found.hits.choose(found.time, ahead.span);
        let (x, v) = evaluate(&ahead.x, time);
        let (hits, mut doubtful) = guard.confirm::<GUARDED>(law, &state, found, (x, v, time));
        let moves = hits | found.clear;
        let (cos, sin) = state.drive.turned(time);
        state.drive.cos = moves.choose(cos, state.drive.cos);
        state.drive.sin = moves.choose(sin, state.drive.sin);

        let is_high = guard.is_low.not().and_not(guard.is_further);
        let at_high = hits & is_high;
        let at_low = hits & guard.is_low;
        let at_further = hits & guard.is_further;
        let x = at_high.choose(law.high, at_low.choose(law.low, x));
        let turned = if GUARDED {
            let turns = at_further & law.by_position.equals(one.like(0.0));
            turns.choose(one.like(0.0), v)
        } else {
            v
        };
        state.x = moves.choose(x, state.x);
        state.v = moves.choose(at_high.choose(v * law.bounce, turned), state.v);
        if W::IMPACTS {
            self.tell_impacts(at_high & law.impact.equals(one), law, time, v);
        }
        state.impacts = at_high.choose(state.impacts + law.impact, state.impacts);

        // Lanes that split look at half of their stretch next.
        let halves = state.pending.and_not(moves | doubtful);
        let half = state.span * one.like(0.5);
        doubtful = doubtful | (halves & half.below(law.window * one.like(SHORTEST)));
        state.toward = found.clear.choose(state.toward - ahead.span, state.toward);
        let arrived = found.clear & state.toward.at_most(one.like(0.0));
        state.span = halves.choose(half, found.clear.choose(state.toward, state.span));

        let beyond = at_high.choose(law.beyond_high, law.beyond_low);
        let beyond = at_further.choose(law.beyond_guard, beyond);
        state.phase = hits.choose(beyond, state.phase);
        let left_at = state.node * law.window - state.toward + time;
        self.state = state;
        if hits.any() {
            self.aim(hits, left_at);
        }
        self.settle(arrived, doubtful, law)
    }

    /// Sets out from crossings, `offset` into the period, to the next node of the new phase.
    #[inline(always)]
    fn aim(&mut self, hits: Mask<S>, offset: Lanes<S>) {
        let law = self.law();
        let one = offset.like(1.0);
        let node = ((offset * law.per_window).floor() + one).min(law.windows);
        let least = law.window * one.like(1e-12);
        let toward = (node * law.window - offset).max(least);
        let state = &mut self.state;
        state.node = hits.choose(node, state.node);
        state.toward = hits.choose(toward, state.toward);
        state.span = hits.choose(toward, state.span);
    }

    /// Lets the lanes that have come to a node scan on.
    #[inline(always)]
    fn settle(&mut self, arrived: Mask<S>, doubtful: Mask<S>, law: &Law<S>) -> (Mask<S>, Mask<S>) {
        let state = &mut self.state;
        let zero = state.x.like(0.0);
        let ends = state.arrive(arrived, law);
        let done = arrived & state.left.at_most(zero);
        state.pending = state.pending.and_not(arrived | doubtful);
        state.scanning = state.scanning | arrived.and_not(done);
        if W::PERIODS && ends.any() {
            self.tell_periods(ends);
        }
        (done, doubtful)
    }

    /// Tells the watcher of impacts, `time` after the present state.
    fn tell_impacts(&mut self, lanes: Mask<S>, law: &Law<S>, time: Lanes<S>, velocity: Lanes<S>) {
        for lane in 0..Lanes::<S>::COUNT {
            if lanes.get(lane)
                && let Some((job, cycle)) = self.progress(lane)
            {
                let offset = self.state.offset(lane, law) + time.get(lane);
                self.task
                    .watch
                    .impact(job, cycle, offset, velocity.get(lane));
            }
        }
    }
}

impl<S: Simd> Ahead<S> {
    #[inline(always)]
    fn of<const GUARDED: bool>(law: &Law<S>, state: &State<S>) -> Self {
        let x = expand(law, &state.drive, state.x, state.v);
        let v = derivative(&x);
        let (position, velocity) = evaluate(&x, state.span);
        let acceleration = if GUARDED {
            evaluate(&v, state.span).1
        } else {
            velocity
        };
        Self {
            x,
            v,
            span: state.span,
            end: (position, velocity, acceleration),
        }
    }
}

impl<S: Simd> Guard<S> {
    #[inline(always)]
    fn of<const GUARDED: bool>(law: &Law<S>, state: &State<S>, ahead: &Ahead<S>) -> Self {
        let one = state.x.like(1.0);
        let (px, pv) = law.particular(state.drive.cos, state.drive.sin);
        let (y, u) = (state.x - px, state.v - pv);
        let share = ahead.span * law.per_window;
        let square = share * share;
        let scale = square * square;
        let third = ahead.span * one.like(1.0 / 3.0);
        let slack = law.slack(y, u) * scale;
        let (x, v, acceleration) = ahead.end;
        let hull = Hull::of((state.x, state.v), (x, v), third, slack);
        let is_low = law.low.below(hull.low).not();
        let is_high = hull.high.below(law.high).not();
        let mut guard = Self {
            position: is_low.choose(-one, one),
            velocity: one.like(0.0),
            level: is_low.choose(-law.low, law.high),
            grain: law.grain,
            slow: law.slow,
            slack,
            is_low,
            is_further: is_low.and_not(is_low),
            none: (is_low | is_high).not(),
            several: is_low & is_high,
        };
        if GUARDED {
            let slack = law.rate_slack(y, u) * scale;
            let here = ahead.v[1];
            let rates = Hull::of((state.v, here), (v, acceleration), third, slack);
            let further = law.guard_top(&hull, &rates).below(law.level).not();
            guard.turn_to_further(law, further, slack);
        }
        guard
    }

    /// Looks at the further guard in the lanes `at` instead.
    #[inline(always)]
    fn turn_to_further(&mut self, law: &Law<S>, at: Mask<S>, rate_slack: Lanes<S>) {
        let (a, b) = (law.by_position, law.by_velocity);
        self.several = self.several | at.and_not(self.none);
        self.none = self.none.and_not(at);
        self.is_low = self.is_low.and_not(at);
        self.is_further = at;
        self.position = at.choose(a, self.position);
        self.velocity = at.choose(b, self.velocity);
        self.level = at.choose(law.level, self.level);
        self.slack = at.choose(a.abs() * self.slack + b.abs() * rate_slack, self.slack);
        self.grain = at.choose(self.grain * law.guard_scale, self.grain);
        self.slow = at.choose(self.slow * law.guard_scale, self.slow);
    }

    /// g as a series.
    #[inline(always)]
    fn series<const GUARDED: bool>(&self, ahead: &Ahead<S>) -> Series<S> {
        let mut g = ahead.x;
        for (g, rate) in g.iter_mut().zip(&ahead.v) {
            *g = *g * self.position;
            if GUARDED {
                *g = self.velocity.mul_add(*rate, *g);
            }
        }
        g[0] = g[0] - self.level;
        g
    }

    #[inline(always)]
    fn search<const GUARDED: bool>(&self, ahead: &Ahead<S>, pending: Mask<S>) -> Found<S> {
        let g = self.series::<GUARDED>(ahead);
        let (x, v, acceleration) = ahead.end;
        let mut right = (self.position.mul_add(x, -self.level), self.position * v);
        if GUARDED {
            right.0 = self.velocity.mul_add(v, right.0);
            right.1 = self.velocity.mul_add(acceleration, right.1);
        }
        let stretch = Stretch {
            left: (g[0], g[1]),
            right,
            span: ahead.span,
            slack: self.slack,
        };
        let verdict = stretch.judge(self.grain, self.slow);
        let single = pending.and_not(self.several | self.none);
        let mut clear = (single & verdict.clear) | (pending & self.none);
        let mut rises = single & verdict.rises;
        let mut doubtful = single & verdict.touches.and_not(verdict.leaves);
        let (mut end, mut top) = (ahead.span, right);
        let hump = single & verdict.hump;
        if hump.any() {
            let (at, value, sure) = summit(&g, ahead.span, hump);
            let over = sure & self.grain.below(value);
            let under = sure & value.below(-self.grain);
            clear = clear | under;
            doubtful = doubtful | hump.and_not(over | under);
            rises = rises | over;
            end = over.choose(at, end);
            top = (over.choose(value, top.0), over.choose(end.like(0.0), top.1));
        }
        rises = rises.and_not(doubtful);
        let (time, sure) = first_rise(&g, verdict.leaves, end, top, rises);
        Found {
            clear: clear.and_not(doubtful),
            hits: rises & sure,
            doubtful: doubtful | rises.and_not(sure),
            time,
        }
    }

    /// Hits that are plain crossings, and the lanes that the scalar engine has to decide.
    #[inline(always)]
    fn confirm<const GUARDED: bool>(
        &self,
        law: &Law<S>,
        state: &State<S>,
        found: &Found<S>,
        (x, v, time): (Lanes<S>, Lanes<S>, Lanes<S>),
    ) -> (Mask<S>, Mask<S>) {
        let mut rate = self.position * v;
        if GUARDED {
            let (cos, _) = state.drive.turned(time);
            let acceleration = law.acceleration(x, v, state.drive.amplitude * cos);
            rate = self.velocity.mul_add(acceleration, rate);
        }
        let plain = found.hits & self.slow.below(rate);
        (plain, found.doubtful | found.hits.and_not(plain))
    }
}

/// The maximum of g in lanes that have one: where, how high, and whether it was found.
#[inline(always)]
fn summit<S: Simd>(g: &Series<S>, span: Lanes<S>, of: Mask<S>) -> (Lanes<S>, Lanes<S>, Mask<S>) {
    let falls = derivative(g).map(|rate| -rate);
    let guess = span * span.like(0.5);
    let bracket = Bracket {
        series: &falls,
        span,
        guess,
    };
    let (at, sure) = bracket.solve(of);
    (at, evaluate(g, at).0, sure)
}

/// Where g rises through zero in the lanes `of`, between 0 and `end`, where it and its rate are `top`. In the
/// lanes that leave zero at 0 the rise is that of g(t)/t.
#[inline(always)]
fn first_rise<S: Simd>(
    g: &Series<S>,
    leaves: Mask<S>,
    end: Lanes<S>,
    top: (Lanes<S>, Lanes<S>),
    of: Mask<S>,
) -> (Lanes<S>, Mask<S>) {
    let mut series = *g;
    for (to, from) in series.iter_mut().zip(shifted(g)) {
        *to = leaves.choose(from, *to);
    }
    let mean = top.0 / end;
    let right = (
        leaves.choose(mean, top.0),
        leaves.choose((top.1 - mean) / end, top.1),
    );
    let bracket = Bracket {
        series: &series,
        span: end,
        guess: guess((series[0], series[1]), right, end),
    };
    bracket.solve(of)
}
