//! Chooses the form of a Taylor step under a power law: in time, in regularised time, on the slow manifold, or without
//! the power law.

use super::convergence::{convergence_reach, first_span};
use super::power_law::PowerLaw;
use super::series::{majorant, value};
use super::slow_manifold::SlowEquation;
use super::sphere::is_sphere;
use super::taylor::forcing_series;
use super::taylor_step::TaylorStep;
use super::{Departure, LinearLaw};

/// Largest size of the power law's part of a motion that is left out: well below rounding.
const SMALLEST: f64 = f64::EPSILON / 64.0;
/// Largest share of the way to the face that a step on the slow manifold covers.
const NEAR: f64 = 0.15;
/// How much longer than a usual step one on the slow manifold must be to be worth its price.
const LONGER: f64 = 20.0;

impl TaylorStep {
    /// The step from a departure that lies `deflection` m beyond the face.
    pub fn of_contact(
        flow: &LinearLaw,
        hertz: &PowerLaw,
        from: &Departure,
        deflection: f64,
    ) -> Self {
        if hertz.side < 0.0 {
            return Self {
                is_mirrored: true,
                ..Self::of_contact(flow, &hertz.on_side(-1.0), &from.mirrored(), deflection)
            };
        }
        let mut segment = if deflection <= 0.0 && from.velocity == 0.0 {
            Self::without_contact(flow, hertz, from, 0.0)
        } else if is_sphere(hertz, from) {
            Self::in_regularized_time(flow, hertz, from, deflection)
        } else if hertz.exponent == 2.0 {
            Self::in_time_under_square_law(flow, hertz, from, deflection.max(0.0))
        } else {
            let raised = deflection.max(0.0).powf(hertz.exponent);
            if prefers_time(hertz, (deflection, raised), from.velocity) {
                Self::in_time_under_power_law(flow, hertz, from, (deflection, raised))
                    .unwrap_or_else(|| Self::without_contact(flow, hertz, from, deflection))
            } else {
                Self::in_regularized_time(flow, hertz, from, deflection)
            }
        };
        if let Some(creeping) = Self::on_slow_manifold(flow, hertz, from, deflection, segment.end) {
            segment = creeping;
        }
        segment.departed = deflection;
        segment
    }

    /// A step on the slow manifold, where one is possible and much longer than the step `usual`.
    fn on_slow_manifold(
        flow: &LinearLaw,
        hertz: &PowerLaw,
        from: &Departure,
        deflection: f64,
        usual: f64,
    ) -> Option<Self> {
        let rate = flow.frequency.max(flow.modes.stiffness.abs().sqrt());
        let span = (1.0 / rate).min(NEAR * deflection / from.velocity.abs());
        if span.is_nan() || span <= LONGER * usual {
            return None;
        }
        let forcing = forcing_series(flow, from);
        let span = if from.forcing.is_linear() {
            span
        } else {
            span.min(first_span(&forcing))
        };
        let mut load = forcing;
        load[0] -= flow.modes.stiffness * hertz.origin;
        let equation = SlowEquation {
            twice_decay: 2.0 * flow.modes.decay,
            stiffness: flow.modes.stiffness,
            hertz,
            forcing: &load,
        };
        let slow_manifold = equation.slow_motion((deflection, from.velocity), span)?;
        let mut segment = Self::without_motion(flow, hertz);
        segment.depth = slow_manifold.depth;
        segment.forcing = forcing;
        segment.is_pressed = true;
        segment.slow_manifold = Some(Box::new(slow_manifold));
        let holds =
            convergence_reach(&segment.depth).min(convergence_reach(&segment.velocity_series()));
        segment.end_at(holds.min(span));
        (segment.end > LONGER * usual).then_some(segment)
    }

    /// The linear law's motion from a deflection next to nothing, in time itself, as long as the power law's part of it
    /// is below rounding.
    fn without_contact(
        flow: &LinearLaw,
        hertz: &PowerLaw,
        from: &Departure,
        deflection: f64,
    ) -> Self {
        let start = (hertz.origin + deflection, from.velocity);
        let mut segment = Self::linear_in_time(flow, hertz, from, start);
        segment.depth[0] = deflection;
        let bounds = [segment.depth, segment.velocity_series()].map(|series| majorant(&series));
        let reach = segment.reach_in_time(flow, from);
        segment.end_at(if hertz.stiffness > 0.0 {
            linear_span(hertz, reach, |span| {
                (value(&bounds[0], span), value(&bounds[1], span), span)
            })
        } else {
            reach
        });
        segment
    }
}

/// Halvings of a finite number after which it is zero.
const MOST_HALVINGS: i32 = 2200;

/// Sigma within which the power law's part of the motion, at most kappa d^n (1 + lambda v) t^2 / 2, stays below
/// rounding, found by halving `reach`. `bounds` are those on depth, speed and time, which grow with sigma.
pub(super) fn linear_span(
    law: &PowerLaw,
    reach: f64,
    bounds: impl Fn(f64) -> (f64, f64, f64),
) -> f64 {
    let half = |halvings: i32| 0.5f64.powi(halvings);
    let span = |halvings: i32| reach * half(halvings / 2) * half(halvings - halvings / 2);
    let is_within = |halvings: i32| {
        let (depth, speed, time) = bounds(span(halvings));
        let grip = 1.0 + law.dissipation * speed;
        let press = law.factor() * depth.powf(law.exponent - 1.0) * grip;
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

/// True where a step in time reaches further than one in regularised time: the energy that the power law takes on the
/// way to the face, deflection times kappa d^n (`raised`: d^n), is more than a small share of the kinetic energy, or
/// the law is not regular at the face in regularised time either.
fn prefers_time(hertz: &PowerLaw, (deflection, raised): (f64, f64), velocity: f64) -> bool {
    if deflection <= 0.0 {
        return false;
    }
    let share = hertz.root_index().map_or(0.0, |_| NEAR_FACE);
    hertz.factor() * raised * deflection > share * velocity * velocity
}

/// Share of the kinetic energy above which the power law makes a step in time worth more.
const NEAR_FACE: f64 = 1e-3;
