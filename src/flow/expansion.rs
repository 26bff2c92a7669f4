//! How a Taylor step of a nonlinear phase comes about: its series, and how far they hold.

use super::creep::Equation;
use super::hertz::Hertz;
use super::rungs::Rungs;
use super::segment::Segment;
use super::series::{Power, Series, ZERO, convolve, derivative, majorant, power, value};
use super::taylor::{DEGREE, push_series};
use super::{Departure, Flow};

/// What the last coefficients may amount to, relative to the first: well below rounding.
const SMALLEST: f64 = f64::EPSILON / 64.0;
/// Its binary logarithm.
pub(super) const TRUNCATION: f64 = -58.0;
/// Share of the way to the face that a slow step covers at most.
const NEAR: f64 = 0.15;
/// How much longer than a usual step a slow one must be to be worth its price.
const LONGER: f64 = 20.0;

impl Segment {
    /// The step from a departure that lies `deflection` m beyond the face.
    pub fn new(flow: &Flow, hertz: &Hertz, from: &Departure, deflection: f64) -> Self {
        let root = deflection.max(0.0).sqrt();
        let mut segment = if root == 0.0 && from.velocity == 0.0 {
            Self::from_rest(flow, hertz, from)
        } else {
            Self::from_root(flow, hertz, from, deflection)
        };
        segment.reach = segment.convergence(from);
        if segment.power == ZERO && hertz.stiffness > 0.0 {
            segment.reach = segment.shell(segment.reach);
        }
        segment.contact = segment.last_contact();
        segment.end = value(&segment.time, segment.contact);
        let creeping = Self::creeping(flow, hertz, from, deflection, segment.end);
        Self {
            departed: deflection,
            ..creeping.unwrap_or(segment)
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
        let push = push_series(flow, from);
        let span = if from.push.is_linear() {
            span
        } else {
            span.min(outgrown(&push))
        };
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

    pub(super) fn blank(flow: &Flow, hertz: &Hertz) -> Self {
        Self {
            departed: 0.0,
            root: ZERO,
            depth: ZERO,
            low: 0.0,
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
        let mut segment = Self::in_time(flow, hertz, from, start);
        segment.depth[0] = 0.0;
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
        (cos[0], sin[0]) = (from.drive.cos, from.drive.sin);
        let mut power = Power::new(2.0 * hertz.exponent, root);
        let mut rungs = Rungs::new(&from.push);
        for k in 0..=DEGREE {
            // The deflection itself, not the square of its rounded root: a surface may stand there.
            segment.depth[k] = if k == 0 {
                deflection
            } else {
                convolve(s, s, k)
            };
            segment.power[k] = power.coefficient(s, k);
            segment.push[k] = flow.amplitude * cos[k] + from.push.rate() * t[k];
            if let Some(rungs) = &mut rungs {
                segment.push[k] += rungs.coefficient(s, k);
            }
            let mut pull = b * segment.depth[k];
            if k == 0 {
                segment.push[0] += from.push.value();
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
    fn convergence(&self, from: &Departure) -> f64 {
        if self.is_in_time() {
            return self.reach_in_time(from);
        }
        let limit = self.flow.reach;
        // t = s sigma + v sigma^2 / 4 + ...
        let within = (limit / self.root[0]).min(2.0 * (limit / self.velocity[0].abs()).sqrt());
        let holds = converges(&self.root)
            .min(converges(&self.velocity))
            .min(within);
        if from.push.is_linear() {
            return holds;
        }
        holds
            .min(outgrown(&self.root))
            .min(outgrown(&self.velocity))
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
}

/// Where a series is below rounding of its first coefficients from its last one on, if the whole upper
/// half falls as a geometric series does. All of that half is looked at, since by symmetry many
/// coefficients may vanish.
fn converges(series: &Series) -> f64 {
    falls_off(series, DEGREE.div_ceil(2), |j| {
        TRUNCATION / (DEGREE - j) as f64
    })
}

/// Where one of the higher coefficients' terms outgrows all of the first ones.
pub(super) fn outgrown(series: &Series) -> f64 {
    falls_off(series, leading(series) + FIRST, |_| 0.0)
}

/// How many of the first coefficients the others are measured against.
const FIRST: usize = 3;

/// The first coefficient to measure against: the very first one, unless the series begins with so many
/// zeros that nothing could be told from them.
fn leading(series: &Series) -> usize {
    let zeros = series.iter().take_while(|c| **c == 0.0).count();
    if zeros < FIRST { 0 } else { zeros }
}

/// Where the coefficients from `lower` on are still below one of the first, the `j`-th, times the binary
/// power `margin`(j) for each further order.
fn falls_off(series: &Series, lower: usize, margin: impl Fn(usize) -> f64) -> f64 {
    let leading = leading(series);
    let first = [0, 1, 2].map(|offset| {
        let j = leading + offset;
        (j, series.get(j).map_or(f64::NAN, |c| c.abs().log2()))
    });
    let mut reach = f64::INFINITY;
    for (last, coefficient) in series.iter().enumerate().skip(lower.max(leading + FIRST)) {
        let size = coefficient.abs().log2();
        // Comparisons pass over what is not a number: zero against zero.
        let against = |(j, first): (usize, f64)| (first - size) / (last - j) as f64 + margin(j);
        let within = first.map(against).into_iter().fold(f64::NAN, f64::max);
        reach = reach.min(within);
    }
    reach.exp2()
}
