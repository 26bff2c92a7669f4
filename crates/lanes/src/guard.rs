//! The guard that ends a phase, and where it rises through zero.

use pulp::Simd;

use super::judge::Stretch;
use super::lanes::{Lanes, Mask};
use super::law::Law;
use super::parts::{Hull, Parts};
use super::root::{Bracket, Zero, guess};
use super::state::State;
use super::taylor::{Series, derivative, evaluate, expand, shifted};

/// The motion of all lanes over the stretch that they look at: x, or the guard itself where it is the only one.
pub(super) struct Ahead<S: Simd, const N: usize> {
    x: Series<S, N>,
    v: Series<S, N>,
    pub span: Lanes<S, N>,
    /// Its value, rate and second derivative at its end.
    end: (Lanes<S, N>, Lanes<S, N>, Lanes<S, N>),
}

/// The guard that each lane has to look at: g = position x + velocity v - level.
pub(super) struct Guard<S: Simd, const N: usize> {
    position: Lanes<S, N>,
    velocity: Lanes<S, N>,
    level: Lanes<S, N>,
    grain: Lanes<S, N>,
    pub slow: Lanes<S, N>,
    slack: Lanes<S, N>,
    /// The lower end of the phase, or the further guard; else the upper end.
    pub is_low: Mask<S, N>,
    pub is_further: Mask<S, N>,
    /// Lanes that meet none, and lanes that may meet more than one.
    none: Mask<S, N>,
    several: Mask<S, N>,
}

/// What was found.
pub(super) struct Found<S: Simd, const N: usize> {
    pub clear: Mask<S, N>,
    pub hits: Mask<S, N>,
    /// Lanes that the safe engine has to decide.
    pub doubtful: Mask<S, N>,
    /// Time to the crossing, and the guard's rate there.
    pub time: Lanes<S, N>,
    slope: Lanes<S, N>,
}

impl<S: Simd, const N: usize> Ahead<S, N> {
    #[inline(always)]
    pub fn of<const GUARDED: bool>(
        law: &Law<S, N>,
        state: &State<S, N>,
        parts: &Parts<S, N>,
        span: Lanes<S, N>,
    ) -> Self {
        let mut x = expand(law, state.drive.frequency, parts);
        x[0] = x[0] - law.edge;
        let (position, velocity) = evaluate(&x, span);
        let mut v = x;
        let mut acceleration = velocity;
        if GUARDED {
            v = derivative(&x);
            acceleration = evaluate(&v, span).1;
        }
        Self {
            x,
            v,
            span,
            end: (position, velocity, acceleration),
        }
    }
}

impl<S: Simd, const N: usize> Guard<S, N> {
    #[inline(always)]
    pub fn of<const GUARDED: bool>(
        law: &Law<S, N>,
        parts: &Parts<S, N>,
        ahead: &Ahead<S, N>,
    ) -> Self {
        let share = ahead.span * law.per_window;
        let square = share * share;
        let scale = square * square;
        let slack = law.slack(parts) * scale;
        if GUARDED {
            Self::of_several(law, parts, ahead, slack, scale)
        } else {
            Self::of_one(law, slack)
        }
    }

    /// The one that ends the phase.
    #[inline(always)]
    fn of_one(law: &Law<S, N>, slack: Lanes<S, N>) -> Self {
        let zero = slack.like(0.0);
        let never = zero.below(zero);
        Self {
            position: slack.like(1.0),
            velocity: zero,
            level: zero,
            grain: law.grain,
            slow: law.slow,
            slack,
            is_low: law.side.below(zero),
            is_further: never,
            none: never,
            several: never,
        }
    }

    /// The one that may be met.
    #[inline(always)]
    fn of_several(
        law: &Law<S, N>,
        parts: &Parts<S, N>,
        ahead: &Ahead<S, N>,
        slack: Lanes<S, N>,
        scale: Lanes<S, N>,
    ) -> Self {
        let one = slack.like(1.0);
        let third = ahead.span * one.like(1.0 / 3.0);
        let (x, v, acceleration) = ahead.end;
        let here = (ahead.x[0], ahead.x[1]);
        let hull = Hull::of(here, (x, v), third, slack);
        let is_low = law.low.below(hull.low).not();
        let is_high = hull.high.below(law.high).not();
        let mut guard = Self {
            position: is_low.choose(-one, one),
            level: is_low.choose(-law.low, law.high),
            is_low,
            none: (is_low | is_high).not(),
            several: is_low & is_high,
            ..Self::of_one(law, slack)
        };
        let rate_slack = law.rate_slack(parts) * scale;
        let before = (ahead.v[0], ahead.v[1]);
        let rates = Hull::of(before, (v, acceleration), third, rate_slack);
        let further = law.guard_top(&hull, &rates).below(law.level).not();
        guard.turn_to_further(law, further, rate_slack);
        guard
    }

    /// Position, velocity and rate of the guard at a crossing; position and velocity at the end of the stretch
    /// in the lanes without one.
    #[inline(always)]
    pub fn crossing<const GUARDED: bool>(
        &self,
        law: &Law<S, N>,
        ahead: &Ahead<S, N>,
        found: &Found<S, N>,
    ) -> (Lanes<S, N>, Lanes<S, N>, Lanes<S, N>) {
        if GUARDED {
            let time = found.hits.choose(found.time, ahead.span);
            let (x, v) = evaluate(&ahead.x, time);
            let acceleration = evaluate(&ahead.v, time).1;
            let rate = self.velocity.mul_add(acceleration, self.position * v);
            return (x, v, rate);
        }
        let (g, rate, _) = ahead.end;
        let x = law.side.mul_add(g + law.edge, law.offset);
        let rate = found.hits.choose(found.slope, rate);
        (x, law.side * rate, rate)
    }

    /// Looks at the further guard in the lanes `at` instead.
    #[inline(always)]
    fn turn_to_further(&mut self, law: &Law<S, N>, at: Mask<S, N>, rate_slack: Lanes<S, N>) {
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
    fn series<const GUARDED: bool>(&self, ahead: &Ahead<S, N>) -> Series<S, N> {
        let mut g = ahead.x;
        if GUARDED {
            for (g, rate) in g.iter_mut().zip(&ahead.v) {
                *g = self.velocity.mul_add(*rate, *g * self.position);
            }
            g[0] = g[0] - self.level;
        }
        g
    }

    #[inline(always)]
    pub fn search<const GUARDED: bool>(
        &self,
        ahead: &Ahead<S, N>,
        pending: Mask<S, N>,
    ) -> Found<S, N> {
        let g = self.series::<GUARDED>(ahead);
        let (x, v, acceleration) = ahead.end;
        let mut right = (x, v);
        if GUARDED {
            let by_position = self.position.mul_add(x, -self.level);
            right.0 = self.velocity.mul_add(v, by_position);
            right.1 = self.velocity.mul_add(acceleration, self.position * v);
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
        // A crossing within rounding of the end: before it or after?
        let ends_there = (-self.grain).below(right.0) & g[0].like(0.0).below(right.1);
        doubtful = doubtful | (clear & single & ends_there);
        rises = rises.and_not(doubtful);
        let Zero { at, slope, sure } = first_rise(g, verdict.leaves, end, top, rises);
        Found {
            clear: clear.and_not(doubtful),
            hits: rises & sure,
            doubtful: doubtful | rises.and_not(sure),
            time: at,
            slope,
        }
    }
}

/// The maximum of g in lanes that have one: where, how high, and whether it was found.
#[inline(always)]
fn summit<S: Simd, const N: usize>(
    g: &Series<S, N>,
    span: Lanes<S, N>,
    of: Mask<S, N>,
) -> (Lanes<S, N>, Lanes<S, N>, Mask<S, N>) {
    let falls = derivative(g).map(|rate| -rate);
    let guess = span * span.like(0.5);
    let bracket = Bracket {
        series: &falls,
        span,
        guess,
    };
    let Zero { at, sure, .. } = bracket.solve(of);
    (at, evaluate(g, at).0, sure)
}

/// Where g rises through zero in the lanes `of`, between 0 and `end`, where it and its rate are `top`. In the
/// lanes that leave zero at 0 the rise is that of g(t)/t.
#[inline(always)]
fn first_rise<S: Simd, const N: usize>(
    mut g: Series<S, N>,
    leaves: Mask<S, N>,
    end: Lanes<S, N>,
    top: (Lanes<S, N>, Lanes<S, N>),
    of: Mask<S, N>,
) -> Zero<S, N> {
    let mut right = top;
    let divided = leaves & of;
    if divided.any() {
        let quotient = shifted(&g);
        for (to, from) in g.iter_mut().zip(quotient) {
            *to = divided.choose(from, *to);
        }
        let mean = top.0 / end;
        right.0 = divided.choose(mean, top.0);
        right.1 = divided.choose((top.1 - mean) / end, top.1);
    }
    let bracket = Bracket {
        series: &g,
        span: end,
        guess: guess((g[0], g[1]), right, end),
    };
    let zero = bracket.solve(of);
    Zero {
        slope: divided.choose(zero.slope * zero.at, zero.slope),
        ..zero
    }
}
