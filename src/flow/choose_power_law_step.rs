//! Chooses the form of a Taylor step under a power law: in time, in regularised time, on the slow manifold, or without that law.

use super::convergence_reach::{convergence_reach, leading_convergence_reach};
use super::power_law::PowerLaw;
use super::series::{majorant, value};
use super::slow_manifold::SlowEquation;
use super::taylor_polynomials::forcing_series;
use super::taylor_step::TaylorStep;
use super::taylor_step_on_sphere::is_sphere;
use super::{Departure, LinearLaw};

/// Limits by which the form of a step under a power law is chosen.
struct FormLimits {
    /// Largest size of the power law's part of a motion that is left out: well below rounding.
    omitted_part: f64,
    /// Largest share of the way to the face that a step on the slow manifold covers.
    slow_way: f64,
    /// How many times longer than another step one on the slow manifold must be, to be worth its price.
    slow_gain: f64,
    /// Share of the kinetic energy that the power law must take on the way to the face for a step in time.
    energy_in_time: f64,
}

impl FormLimits {
    const DEFAULT: Self = Self {
        omitted_part: f64::EPSILON / 64.0,
        slow_way: 0.15,
        slow_gain: 20.0,
        energy_in_time: 1e-3,
    };
}

impl TaylorStep {
    /// The Taylor step under a power law from a departure `deflection` m beyond the face, in the form that reaches furthest.
    pub fn under_power_law(
        flow: &LinearLaw,
        hertz: &PowerLaw,
        from: &Departure,
        deflection: f64,
    ) -> Self {
        if hertz.side < 0.0 {
            return Self {
                is_mirrored: true,
                ..Self::under_power_law(flow, &hertz.on_side(-1.0), &from.mirrored(), deflection)
            };
        }
        let mut step = if deflection <= 0.0 && from.velocity == 0.0 {
            Self::step_without_power_law(flow, hertz, from, 0.0)
        } else if is_sphere(hertz, from) {
            Self::in_regularized_time(flow, hertz, from, deflection)
        } else if hertz.exponent == 2.0 {
            Self::in_time_under_square_law(flow, hertz, from, deflection.max(0.0))
        } else {
            let raised = deflection.max(0.0).powf(hertz.exponent);
            if prefers_time(hertz, (deflection, raised), from.velocity) {
                Self::in_time_under_power_law(flow, hertz, from, (deflection, raised))
                    .unwrap_or_else(|| Self::step_without_power_law(flow, hertz, from, deflection))
            } else {
                Self::in_regularized_time(flow, hertz, from, deflection)
            }
        };
        if let Some(creeping) =
            Self::slow_step_under_power_law(flow, hertz, from, deflection, step.end)
        {
            step = creeping;
        }
        step.departed = deflection;
        step
    }

    /// The Taylor step on the slow manifold of a power law, where one is possible and much longer than the length
    /// `usual` of that in another form.
    fn slow_step_under_power_law(
        flow: &LinearLaw,
        hertz: &PowerLaw,
        from: &Departure,
        deflection: f64,
        usual: f64,
    ) -> Option<Self> {
        let limits = FormLimits::DEFAULT;
        let rate = flow.frequency.max(flow.modes.stiffness.abs().sqrt());
        let span = (1.0 / rate).min(limits.slow_way * deflection / from.velocity.abs());
        if span.is_nan() || span <= limits.slow_gain * usual {
            return None;
        }
        let forcing = forcing_series(flow, from);
        let span = if from.forcing.is_linear() {
            span
        } else {
            span.min(leading_convergence_reach(&forcing))
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
        let mut step = Self::without_motion(flow, hertz);
        step.depth = slow_manifold.depth;
        step.forcing = forcing;
        step.is_pressed = true;
        step.slow_manifold = Some(Box::new(slow_manifold));
        let holds = convergence_reach(&step.depth).min(convergence_reach(&step.velocity_series()));
        step.end_at(holds.min(span));
        (step.end > limits.slow_gain * usual).then_some(step)
    }

    /// The Taylor step in time from hardly any deflection, as long as the power law's part of the motion is below rounding.
    fn step_without_power_law(
        flow: &LinearLaw,
        hertz: &PowerLaw,
        from: &Departure,
        deflection: f64,
    ) -> Self {
        let start = (hertz.origin + deflection, from.velocity);
        let mut step = Self::linear_in_time(flow, hertz, from, start);
        step.depth[0] = deflection;
        let bounds = [step.depth, step.velocity_series()].map(|series| majorant(&series));
        let reach = step.reach_under_polynomial_force(flow, from);
        step.end_at(if hertz.stiffness > 0.0 {
            span_without_power_law(hertz, reach, |span| {
                (value(&bounds[0], span), value(&bounds[1], span), span)
            })
        } else {
            reach
        });
        step
    }
}

/// Halvings of a step under a power law after which any finite length is zero.
const MAX_HALVINGS: i32 = 2200;

/// Sigma within which the power law's part of a motion, at most kappa d^n (1 + lambda v) t^2 / 2, stays below rounding,
/// found by halving `reach`. `bounds` are those on depth, speed and time, which grow with sigma.
pub(super) fn span_without_power_law(
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
        press * time * time <= FormLimits::DEFAULT.omitted_part
    };
    if reach.is_infinite() || is_within(0) {
        return reach;
    }
    let (mut too_few, mut enough) = (0, 1);
    while enough < MAX_HALVINGS && !is_within(enough) {
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

/// True where a step under a power law reaches further in time than in regularised time: the energy that the law takes
/// on the way to the face, deflection times kappa d^n (`raised`: d^n), is more than a small share of the kinetic
/// energy, or the law is not regular at the face in regularised time either.
fn prefers_time(hertz: &PowerLaw, (deflection, raised): (f64, f64), velocity: f64) -> bool {
    if deflection <= 0.0 {
        return false;
    }
    let share = hertz
        .root_index()
        .map_or(0.0, |_| FormLimits::DEFAULT.energy_in_time);
    hertz.factor() * raised * deflection > share * velocity * velocity
}
