//! One Taylor step of a nonlinear phase.
//!
//! The deflection d from the face obeys d'' + 2 a d' + b (d + x0) + kappa d^n (1 + lambda d') = push. At
//! the face d^n has a branch point. For every n that is a multiple of 1/2 it goes away if the root
//! s = sqrt(d) is the unknown and a stretched time sigma, dt = s dsigma, the variable (as Levi-Civita
//! did for collisions, 1920):
//!
//! ```text
//! ds/dsigma = v/2    dv/dsigma = s (push - 2 a v - b (x0 + s^2) - kappa s^(2n) (1 + lambda v))    dt/dsigma = s
//! ```
//!
//! All are power series in sigma whose coefficients follow one from the other (Moore 1966). For
//! other n the steps grow and shrink with the distance from the face; right at the face, while the
//! power law's part of the motion is below rounding, it is left out. So it is on a start from rest at
//! the face, where sigma is time itself; and so it is in slow motion under heavy damping
//! ([`super::creep`]).

use nalgebra::Matrix2;

use super::creep::{Creep, Equation};
use super::hertz::Hertz;
use super::power::gauss_nodes;
use super::series::{Power, Series, convolve, derivative, majorant, power, product, value};
use super::taylor::{DEGREE, Taylor, evaluate, push_series};
use super::{Departure, Flow};

/// The motion of one step, as series in sigma.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Segment {
    /// Root of the deflection in sqrt(m); zero where sigma is time itself.
    root: Series,
    /// Deflection in m.
    depth: Series,
    /// Velocity in m/s.
    velocity: Series,
    /// Time since departure in s.
    time: Series,
    /// Push per mass in m/s^2.
    push: Series,
    /// d^n.
    power: Series,
    /// How far the series hold, in sigma.
    reach: f64,
    /// How far the mass stays beyond the face, in sigma: further on time would run back.
    contact: f64,
    /// The same in time, in s.
    pub end: f64,
    hertz: Hertz,
    flow: Flow,
    /// What a slow motion remembers of its start.
    creep: Option<Box<Creep>>,
}

/// What the last coefficients may amount to, relative to the first: well below rounding.
const SMALLEST: f64 = f64::EPSILON / 64.0;
/// Its binary logarithm.
const TRUNCATION: f64 = -58.0;
/// Share of the way to the face that a slow step covers at most.
const NEAR: f64 = 0.15;
/// How much longer than a usual step a slow one must be to be worth its price.
const LONGER: f64 = 20.0;
const ZERO: Series = [0.0; DEGREE + 1];

impl Segment {
    /// The step from a departure that lies `deflection` m beyond the face.
    pub fn new(flow: &Flow, hertz: &Hertz, from: &Departure, deflection: f64) -> Self {
        let root = deflection.max(0.0).sqrt();
        let mut segment = if root == 0.0 && from.velocity == 0.0 {
            Self::from_rest(flow, hertz, from)
        } else {
            Self::from_root(flow, hertz, from, deflection)
        };
        segment.reach = segment.convergence();
        if segment.power == ZERO && hertz.stiffness > 0.0 {
            segment.reach = segment.shell(segment.reach);
        }
        segment.contact = segment.last_contact();
        segment.end = value(&segment.time, segment.contact);
        match Self::creeping(flow, hertz, from, deflection, segment.end) {
            Some(slow) => slow,
            None => segment,
        }
    }

    /// A step of slow motion, where one is possible and much longer than `usual`.
    fn creeping(
        flow: &Flow,
        hertz: &Hertz,
        from: &Departure,
        deflection: f64,
        usual: f64,
    ) -> Option<Self> {
        let rate = flow.frequency.max(flow.modes.stiffness.abs().sqrt());
        let span = (1.0 / rate).min(NEAR * deflection / from.velocity.abs());
        if span.is_nan() || span <= LONGER * usual {
            return None;
        }
        let push = push_series(flow, from.drive, (from.constant, from.ramp));
        let mut load = push;
        load[0] -= flow.modes.stiffness * hertz.origin;
        let equation = Equation {
            twice_decay: 2.0 * flow.modes.decay,
            stiffness: flow.modes.stiffness,
            hertz,
            push: &load,
        };
        let creep = equation.slow_motion((deflection, from.velocity), span)?;
        let mut segment = Self::blank(flow, hertz);
        segment.depth = creep.depth;
        segment.velocity = derivative(&creep.depth);
        segment.time[1] = 1.0;
        segment.push = push;
        segment.power = power(&creep.depth, hertz.exponent);
        segment.creep = Some(Box::new(creep));
        let holds = converges(&segment.depth).min(converges(&segment.velocity));
        segment.reach = holds.min(span);
        (segment.contact, segment.end) = (segment.reach, segment.reach);
        (segment.end > LONGER * usual).then_some(segment)
    }

    fn blank(flow: &Flow, hertz: &Hertz) -> Self {
        Self {
            root: ZERO,
            depth: ZERO,
            velocity: ZERO,
            time: ZERO,
            push: ZERO,
            power: ZERO,
            reach: 0.0,
            contact: 0.0,
            end: 0.0,
            hertz: *hertz,
            flow: *flow,
            creep: None,
        }
    }

    /// The linear law's motion from rest at the face, in time itself.
    fn from_rest(flow: &Flow, hertz: &Hertz, from: &Departure) -> Self {
        let start = (hertz.origin, 0.0);
        let linear = Taylor::about(flow, start, from.drive, (from.constant, from.ramp));
        let linear = match from.acceleration {
            Some(acceleration) => linear.with_acceleration(acceleration),
            None => linear,
        };
        let mut segment = Self::blank(flow, hertz);
        segment.depth = linear.position;
        segment.depth[0] = 0.0;
        segment.velocity = derivative(&linear.position);
        segment.time[1] = 1.0;
        segment.push = linear.push;
        segment
    }

    /// The series in sigma.
    fn from_root(flow: &Flow, hertz: &Hertz, from: &Departure, deflection: f64) -> Self {
        let root = deflection.max(0.0).sqrt();
        let (twice_decay, b, w) = (2.0 * flow.modes.decay, flow.modes.stiffness, flow.frequency);
        let (kappa, lambda) = (hertz.rate(), hertz.dissipation);
        let mut segment = Self::blank(flow, hertz);
        let (s, v, t) = (&mut segment.root, &mut segment.velocity, &mut segment.time);
        (s[0], v[0]) = (root, from.velocity);
        let (mut cos, mut sin, mut acceleration) = (ZERO, ZERO, ZERO);
        (cos[0], sin[0]) = from.drive;
        let mut power = Power::new(2.0 * hertz.exponent, root);
        for k in 0..=DEGREE {
            // The deflection itself, not the square of its rounded root: a surface may stand there.
            segment.depth[k] = if k == 0 {
                deflection
            } else {
                convolve(s, s, k)
            };
            segment.power[k] = power.coefficient(s, k);
            segment.push[k] = flow.amplitude * cos[k] + from.ramp * t[k];
            let mut pull = b * segment.depth[k];
            if k == 0 {
                segment.push[0] += from.constant;
                pull += b * hertz.origin;
            }
            let mut press = segment.power[k];
            if lambda > 0.0 {
                press += lambda * convolve(&segment.power, v, k);
            }
            acceleration[k] = segment.push[k] - twice_decay * v[k] - pull - kappa * press;
            if k == DEGREE {
                break;
            }
            let next = 1.0 / (k + 1) as f64;
            s[k + 1] = 0.5 * next * v[k];
            v[k + 1] = next * convolve(s, &acceleration, k);
            t[k + 1] = next * s[k];
            cos[k + 1] = -w * next * convolve(s, &sin, k);
            sin[k + 1] = w * next * convolve(s, &cos, k);
        }
        segment
    }

    /// Sigma up to which the last coefficients stay below rounding (Jorba and Zou 2005), and time
    /// within the reach of the linear law's own series.
    fn convergence(&self) -> f64 {
        let limit = self.flow.reach;
        if self.is_in_time() {
            return limit;
        }
        // t = s sigma + v sigma^2 / 4 + ...
        let within = (limit / self.root[0]).min(2.0 * (limit / self.velocity[0].abs()).sqrt());
        converges(&self.root)
            .min(converges(&self.velocity))
            .min(within)
    }

    /// True if sigma is time itself.
    fn is_in_time(&self) -> bool {
        self.time[1] == 1.0 && self.root == ZERO
    }

    /// Sigma within which the power law's part of the motion, at most kappa d^n (1 + lambda v) t^2 / 2,
    /// stays below rounding.
    fn shell(&self, reach: f64) -> f64 {
        let bounds = [&self.depth, &self.velocity, &self.time].map(majorant);
        let mut span = reach;
        // Halving a finite number this often leaves nothing.
        for _ in 0..2200 {
            let [depth, speed, time] = [0, 1, 2].map(|index| value(&bounds[index], span));
            let grip = 1.0 + self.hertz.dissipation * speed;
            let press = self.hertz.rate() * depth.powf(self.hertz.exponent - 1.0) * grip;
            if press * time * time <= SMALLEST {
                break;
            }
            span *= 0.5;
        }
        span
    }

    /// The last sigma within reach at which the root is not negative. Within one step it passes zero
    /// once.
    fn last_contact(&self) -> f64 {
        let (mut low, mut high) = (0.0, self.reach);
        if value(&self.root, high) >= 0.0 {
            return high;
        }
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return low;
            }
            if value(&self.root, middle) < 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
    }

    /// Sigma at a time: Newton's method on a function that grows, kept inside its bracket.
    pub fn parameter_at(&self, elapsed: f64) -> f64 {
        if elapsed >= self.end {
            return self.contact;
        }
        let (mut low, mut high) = (0.0, self.contact);
        let mut at = self.contact * (elapsed / self.end);
        for _ in 0..100 {
            let (time, rate) = evaluate(&self.time, at);
            if time > elapsed {
                high = at;
            } else {
                low = at;
            }
            let newton = at - (time - elapsed) / rate;
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            let settled = (time - elapsed).abs() <= f64::EPSILON * elapsed;
            if settled || next <= low || next >= high {
                return at;
            }
            at = next;
        }
        at
    }

    /// Position in m and velocity in m/s.
    pub fn state(&self, elapsed: f64) -> (f64, f64) {
        self.state_at(self.parameter_at(elapsed))
    }

    /// The same at sigma.
    pub fn state_at(&self, sigma: f64) -> (f64, f64) {
        let depth = self.depth_at(sigma);
        (self.hertz.origin + depth, value(&self.velocity, sigma))
    }

    fn depth_at(&self, sigma: f64) -> f64 {
        if self.is_in_time() {
            value(&self.depth, sigma)
        } else {
            let root = value(&self.root, sigma);
            root * root
        }
    }

    /// Deflection in m.
    pub fn deflection(&self, elapsed: f64) -> f64 {
        self.depth_at(self.parameter_at(elapsed))
    }

    /// Time since departure at sigma, in s.
    pub fn time_at(&self, sigma: f64) -> f64 {
        value(&self.time, sigma)
    }

    /// How far the series hold, in sigma.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// `position` x + `velocity` v + `push` q - `level` as a series in sigma; where it is the distance
    /// from the face itself, that of the root, which has the same sign.
    pub fn combination(&self, position: f64, velocity: f64, push: f64, level: f64) -> Series {
        // Seen from the face, a surface at the face is at zero exactly.
        let level = level - position * self.hertz.origin;
        let at_face = level == 0.0 && velocity == 0.0 && push == 0.0;
        let moved = if at_face && !self.is_in_time() {
            &self.root
        } else {
            &self.depth
        };
        let mut sum: Series = std::array::from_fn(|k| {
            position * moved[k] + velocity * self.velocity[k] + push * self.push[k]
        });
        sum[0] -= level;
        sum
    }

    /// Work of the push and work lost, per unit of mass, up to `elapsed`.
    pub fn work(&self, elapsed: f64) -> (f64, f64) {
        let kappa = self.hertz.rate() * self.hertz.dissipation;
        let (mut supplied, mut lost) = (0.0, 0.0);
        for (sigma, weight) in gauss_nodes(self.parameter_at(elapsed)) {
            let velocity = value(&self.velocity, sigma);
            let travel = weight * evaluate(&self.time, sigma).1 * velocity;
            let mut damping = 2.0 * self.flow.modes.decay;
            if kappa > 0.0 {
                damping += kappa * value(&self.power, sigma);
            }
            supplied += travel * value(&self.push, sigma);
            lost += travel * damping * velocity;
        }
        (supplied, lost)
    }

    /// d(state)/d(state at the start) after `elapsed`, and the integral of damping over mass: the
    /// equation y'' + damping y' + stiffness y = 0 along the motion, in sigma.
    pub fn transition(&self, elapsed: f64) -> (Matrix2<f64>, f64) {
        let sigma = self.parameter_at(elapsed);
        if let Some(creep) = &self.creep {
            return (creep.transition(sigma), self.damping_integral(sigma));
        }
        let rate = derivative(&self.time);
        let damping = product(&rate, &self.damping());
        let stiffness = product(&rate, &self.stiffness());
        let column = |start: (f64, f64)| {
            let (mut y, mut u) = (ZERO, ZERO);
            (y[0], u[0]) = start;
            for k in 0..DEGREE {
                let next = (k + 1) as f64;
                y[k + 1] = convolve(&rate, &u, k) / next;
                u[k + 1] = -(convolve(&damping, &u, k) + convolve(&stiffness, &y, k)) / next;
            }
            (value(&y, sigma), value(&u, sigma))
        };
        let (first, second) = (column((1.0, 0.0)), column((0.0, 1.0)));
        let matrix = Matrix2::new(first.0, second.0, first.1, second.1);
        (matrix, self.damping_integral(sigma))
    }

    /// 2 a + kappa lambda d^n.
    fn damping(&self) -> Series {
        let factor = self.hertz.rate() * self.hertz.dissipation;
        let mut damping = self.power.map(|w| factor * w);
        damping[0] += 2.0 * self.flow.modes.decay;
        damping
    }

    /// Its integral over time.
    fn damping_integral(&self, sigma: f64) -> f64 {
        product(&derivative(&self.time), &self.damping())
            .iter()
            .enumerate()
            .rev()
            .fold(0.0, |sum, (k, c)| sigma * (c / (k + 1) as f64 + sum))
    }

    /// b + kappa n d^(n-1) (1 + lambda v).
    fn stiffness(&self) -> Series {
        let mut sum = ZERO;
        if self.power != ZERO {
            let factor = self.hertz.rate() * self.hertz.exponent;
            let steepness = power(&self.root, 2.0 * self.hertz.exponent - 2.0);
            let damped = product(&steepness, &self.velocity);
            sum = std::array::from_fn(|k| {
                factor * (steepness[k] + self.hertz.dissipation * damped[k])
            });
        }
        sum[0] += self.flow.modes.stiffness;
        sum
    }
}

/// Where a series is below rounding of its first coefficients from its last one on, if the whole upper
/// half falls as a geometric series does. All of that half is looked at, since by symmetry many
/// coefficients may vanish.
fn converges(series: &Series) -> f64 {
    let [zeroth, first, second] = [0, 1, 2].map(|j| series[j].abs().log2());
    let mut reach = f64::INFINITY;
    for (last, coefficient) in series.iter().enumerate().skip(DEGREE.div_ceil(2)) {
        let size = coefficient.abs().log2();
        // Comparisons pass over what is not a number: zero against zero.
        let against = |size_first: f64, j: usize| {
            (size_first - size) / (last - j) as f64 + TRUNCATION / (DEGREE - j) as f64
        };
        let within = against(zeroth, 0)
            .max(against(first, 1))
            .max(against(second, 2));
        reach = reach.min(within);
    }
    reach.exp2()
}
