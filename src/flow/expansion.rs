//! How a Taylor step of a nonlinear phase comes about: its series, and how far they hold.

use super::hertz::Hertz;
use super::series::{Series, majorant, value};
use super::slow_manifold::Equation;
use super::sphere::is_spherical;
use super::taylor::{DEGREE, RECIPROCALS, push_series};
use super::taylor_step::TaylorStep;
use super::{Departure, LinearLaw};

/// What the last coefficients may amount to, relative to the first: well below rounding.
const SMALLEST: f64 = f64::EPSILON / 64.0;
/// Its binary logarithm.
pub(super) const TRUNCATION: f64 = -58.0;
/// That bound for a sphere: what follows on the last coefficients is an eighth of the rounding together.
const OF_SPHERE: f64 = -54.0;
/// Share of the way to the face that a slow step covers at most.
const NEAR: f64 = 0.15;
/// How much longer than a usual step a slow one must be to be worth its price.
const LONGER: f64 = 20.0;

impl TaylorStep {
    /// The step from a departure that lies `deflection` m beyond the face.
    pub fn new(flow: &LinearLaw, hertz: &Hertz, from: &Departure, deflection: f64) -> Self {
        if hertz.side < 0.0 {
            return Self {
                is_mirrored: true,
                ..Self::new(flow, &hertz.on_side(-1.0), &from.mirrored(), deflection)
            };
        }
        let mut segment = if deflection <= 0.0 && from.velocity == 0.0 {
            Self::without_press(flow, hertz, from, 0.0)
        } else if is_spherical(hertz, from) {
            Self::from_root(flow, hertz, from, deflection)
        } else if hertz.exponent == 2.0 {
            Self::squared(flow, hertz, from, deflection.max(0.0))
        } else {
            let raised = deflection.max(0.0).powf(hertz.exponent);
            if is_off_face(hertz, (deflection, raised), from.velocity) {
                Self::pressed(flow, hertz, from, (deflection, raised))
                    .unwrap_or_else(|| Self::without_press(flow, hertz, from, deflection))
            } else {
                Self::from_root(flow, hertz, from, deflection)
            }
        };
        if let Some(creeping) = Self::creeping(flow, hertz, from, deflection, segment.end) {
            segment = creeping;
        }
        segment.departed = deflection;
        segment
    }

    /// A step of slow motion, where one is possible and much longer than `usual`.
    fn creeping(
        flow: &LinearLaw,
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
        segment.push = push;
        segment.is_pressed = true;
        segment.creep = Some(Box::new(creep));
        let holds = converges(&segment.depth).min(converges(&segment.velocity()));
        segment.ends_at(holds.min(span));
        (segment.end > LONGER * usual).then_some(segment)
    }

    /// The linear law's motion from a deflection next to nothing, in time itself, as long as the power law's part of it
    /// is below rounding.
    fn without_press(flow: &LinearLaw, hertz: &Hertz, from: &Departure, deflection: f64) -> Self {
        let start = (hertz.origin + deflection, from.velocity);
        let mut segment = Self::in_time(flow, hertz, from, start);
        segment.depth[0] = deflection;
        let bounds = [segment.depth, segment.velocity()].map(|series| majorant(&series));
        let reach = segment.reach_in_time(flow, from);
        segment.ends_at(if hertz.stiffness > 0.0 {
            shell(hertz, reach, |span| {
                (value(&bounds[0], span), value(&bounds[1], span), span)
            })
        } else {
            reach
        });
        segment
    }
}

/// Halvings of a finite number after which nothing is left of it.
const MOST_HALVINGS: i32 = 2200;

/// Sigma within which the power law's part of the motion, at most kappa d^n (1 + lambda v) t^2 / 2,
/// stays below rounding: as often halved from `reach` as it takes. `bounds` are those on depth, speed and time, which
/// grow with sigma.
pub(super) fn shell(hertz: &Hertz, reach: f64, bounds: impl Fn(f64) -> (f64, f64, f64)) -> f64 {
    let half = |halvings: i32| 0.5f64.powi(halvings);
    let span = |halvings: i32| reach * half(halvings / 2) * half(halvings - halvings / 2);
    let is_within = |halvings: i32| {
        let (depth, speed, time) = bounds(span(halvings));
        let grip = 1.0 + hertz.dissipation * speed;
        let press = hertz.rate() * depth.powf(hertz.exponent - 1.0) * grip;
        press * time * time <= SMALLEST
    };
    if reach.is_infinite() || is_within(0) {
        return reach;
    }
    let (mut too_few, mut enough) = (0, 1);
    while enough < MOST_HALVINGS && !is_within(enough) {
        (too_few, enough) = (enough, 2 * enough);
    }
    while enough - too_few > 1 {
        let middle = too_few.midpoint(enough);
        match is_within(middle) {
            true => enough = middle,
            false => too_few = middle,
        }
    }
    span(enough)
}

/// True where a step in time is worth more than one from the root: where the power law takes a good part of the
/// energy on the way to the face, or the root's own law is not regular there.
fn is_off_face(hertz: &Hertz, (deflection, raised): (f64, f64), velocity: f64) -> bool {
    if deflection <= 0.0 {
        return false;
    }
    let share = hertz.root_index().map_or(0.0, |_| NEAR_FACE);
    hertz.rate() * raised * deflection > share * velocity * velocity
}

/// Share of the energy that makes the difference.
const NEAR_FACE: f64 = 1e-3;

/// Where a series is below rounding of its first coefficients from its last one on, if the whole upper
/// half falls as a geometric series does. All of that half is looked at, since by symmetry many
/// coefficients may vanish.
pub(super) fn converges(series: &Series) -> f64 {
    falls_below(TRUNCATION, series, DEGREE.div_ceil(2))
}

/// True if a series converges of which no more than every other coefficient may vanish.
pub(super) fn converges_densely(series: &Series) -> f64 {
    falls_below(TRUNCATION, series, LAST)
}

/// True if the series of a sphere's velocity converges, of which at least every fifth coefficient does not vanish.
pub(super) fn converges_of_sphere(series: &Series) -> f64 {
    falls_below(OF_SPHERE, series, LAST)
}

/// From here on coefficients are looked at where few vanish.
const LAST: usize = DEGREE - 5;

fn falls_below(truncation: f64, series: &Series, lower: usize) -> f64 {
    falls_off(series, lower, |j| truncation * RECIPROCALS[DEGREE - j])
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
    let lower = lower.max(leading + FIRST);
    if lower > DEGREE {
        return f64::INFINITY;
    }
    let first = [0, 1, 2].map(|offset| {
        let j = leading + offset;
        (j, size(series[j]), margin(j))
    });
    let mut reach = f64::INFINITY;
    for (last, coefficient) in (lower..).zip(&series[lower..]) {
        let size = size(*coefficient);
        let mut within = f64::NEG_INFINITY;
        for (j, first, margin) in first {
            let against = (first - size) * RECIPROCALS[last - j] + margin;
            within = if against > within { against } else { within };
        }
        reach = if within < reach { within } else { reach };
    }
    reach.exp2()
}

/// The binary logarithm of a coefficient's size, at most a tenth too small; far below all others for zero.
fn size(coefficient: f64) -> f64 {
    const ONE: i64 = 1.0f64.to_bits() as i64;
    let bits = coefficient.abs().to_bits() as i64;
    (bits - ONE) as f64 * (1.0 / (1u64 << 52) as f64)
}
