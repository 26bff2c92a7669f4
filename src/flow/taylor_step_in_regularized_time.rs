//! Taylor steps under a power law in regularised time, at its face, and on a sphere throughout.

use super::choose_power_law_step::span_without_power_law;
use super::convergence_reach::{
    convergence_reach, leading_convergence_reach, sphere_convergence_reach,
};
use super::polynomial::HIGHEST_ORDER;
use super::power_law::PowerLaw;
use super::series::{PowerRecurrence, ReversedSeries, Series, ZERO, convolve, majorant, value};
use super::taylor_polynomials::{DEGREE, RECIPROCALS, value_and_rate};
use super::taylor_step::{RegularizedTime, TaylorStep};
use super::taylor_step_on_sphere::is_sphere;
use super::{Departure, LinearLaw, Polynomial};

impl TaylorStep {
    /// The Taylor step under a power law in regularised time, by series in sigma of the root of the deflection.
    pub(super) fn in_regularized_time(
        flow: &LinearLaw,
        hertz: &PowerLaw,
        from: &Departure,
        deflection: f64,
    ) -> Self {
        let mut step = Self::without_motion(flow, hertz);
        let deflection = deflection.max(0.0);
        let (regularized, holds) = if is_sphere(hertz, from) {
            let regularized = match hertz.dissipation > 0.0 {
                true => step.expand_sphere::<true>(flow, from, deflection),
                false => step.expand_sphere::<false>(flow, from, deflection),
            };
            let holds = sphere_convergence_reach(&regularized.velocity);
            (regularized, holds)
        } else {
            let regularized = step.expand_root(flow, from, deflection);
            let holds = convergence_reach(&regularized.velocity);
            (regularized, holds)
        };
        // What is below rounding of the velocity is so of the root.
        step.reach = holds.min(regularized.reach_within(flow.reach, from.forcing.is_linear()));
        if !step.is_pressed && hertz.stiffness > 0.0 {
            let bounds = [step.depth, regularized.velocity, regularized.time].map(|s| majorant(&s));
            step.reach = span_without_power_law(hertz, step.reach, |span| {
                let [depth, speed, time] = [0, 1, 2].map(|index| value(&bounds[index], span));
                (depth, speed, time)
            });
        }
        step.contact = regularized.last_contact(step.reach);
        step.end = value(&regularized.time, step.contact);
        step.regularized = Some(regularized);
        step.last = step.state_on_step_at(step.contact);
        step
    }

    /// Computes all series of a step in regularised time, that of the root of the deflection among them.
    fn expand_root(
        &mut self,
        flow: &LinearLaw,
        from: &Departure,
        deflection: f64,
    ) -> Box<RegularizedTime> {
        let hertz = self.hertz;
        let index = hertz.root_index().unwrap_or(2.0);
        let root = deflection.powf(1.0 / index);
        let (twice_decay, b, w) = (flow.damping(), flow.modes.stiffness, flow.frequency);
        let (kappa, lambda) = (hertz.factor(), hertz.dissipation);
        let mut regularized = Box::<RegularizedTime>::default();
        regularized.index = index;
        let RegularizedTime {
            root: s,
            velocity: v,
            time: t,
            ..
        } = &mut *regularized;
        (s[0], v[0]) = (root, from.velocity);
        let (mut cos, mut sin) = (ZERO, ZERO);
        let (mut power, mut acceleration) = (ZERO, ZERO);
        (cos[0], sin[0]) = (from.drive.cos, from.drive.sin);
        let (mut rate, mut roots, mut steepness) = (
            ReversedSeries::ZERO,
            ReversedSeries::ZERO,
            ReversedSeries::ZERO,
        );
        let mut rates = PowerRecurrence::new(index - 1.0, root);
        let mut steepnesses = PowerRecurrence::new(index * (hertz.exponent - 1.0), root);
        let mut rungs = ForcingSeries::new(&from.forcing);
        let share = 1.0 / index;
        for k in 0..=DEGREE {
            roots.set_coefficient(k, s[k]);
            let stretch = rates.coefficient(s, &roots, k);
            rate.set_coefficient(k, stretch);
            steepness.set_coefficient(k, steepnesses.coefficient(s, &roots, k));
            // The deflection itself, not the power of its rounded root: a surface may stand there.
            self.depth[k] = if k == 0 { deflection } else { rate.times(s, k) };
            power[k] = steepness.times(&self.depth, k);
            let mut forcing = flow.amplitude * cos[k] + from.forcing.rate() * t[k];
            if let Some(rungs) = &mut rungs {
                forcing += rungs.coefficient(&rate, k);
            }
            let mut pull = b * self.depth[k];
            if k == 0 {
                forcing += from.forcing.value();
                pull += b * hertz.origin;
            }
            self.forcing[k] = forcing;
            let mut press = power[k];
            if lambda > 0.0 {
                press += lambda * convolve(&power, v, k);
            }
            acceleration[k] = forcing - twice_decay * v[k] - pull - kappa * press;
            if k == DEGREE {
                break;
            }
            let next = RECIPROCALS[k + 1];
            s[k + 1] = share * next * v[k];
            v[k + 1] = next * rate.times(&acceleration, k);
            t[k + 1] = next * stretch;
            cos[k + 1] = -w * next * rate.times(&sin, k);
            sin[k + 1] = w * next * rate.times(&cos, k);
        }
        self.is_pressed = power != ZERO;
        regularized
    }
}

impl RegularizedTime {
    /// Regularised time sigma up to which time stays within `limit`, and no power of a force that is not linear
    /// outgrows what the motion begins with.
    fn reach_within(&self, limit: f64, is_linear: bool) -> f64 {
        // With s = s0 + v sigma / m, t is the integral of s^(m - 1).
        let m = self.index;
        let speed = self.velocity[0].abs() / m;
        let beyond = match m {
            2.0 => (m * limit / speed).sqrt(),
            _ => (m * limit / speed.powf(m - 1.0)).powf(1.0 / m),
        };
        let within = (limit / self.time[1]).min(beyond);
        if is_linear {
            return within;
        }
        within
            .min(leading_convergence_reach(&self.root))
            .min(leading_convergence_reach(&self.velocity))
    }

    /// The last regularised time sigma up to `reach` at which the root of the deflection is not negative. Within one
    /// step it passes zero once.
    fn last_contact(&self, reach: f64) -> f64 {
        if value(&self.root, reach) >= 0.0 {
            return reach;
        }
        let (mut low, mut high) = (0.0, reach);
        let mut at = reach;
        loop {
            let (root, rate) = value_and_rate(&self.root, at);
            if root < 0.0 {
                high = at;
            } else {
                low = at;
            }
            let newton = at - root / rate;
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return low;
            }
            // Where Newton's method has settled, the next number on either side tells.
            at = if newton > low && newton < high {
                newton
            } else if newton == low {
                low.next_up()
            } else if newton == high {
                high.next_down()
            } else {
                middle
            };
        }
    }
}

/// The part of an external force beyond its linear part, and its derivatives, as series in regularised time sigma: from
/// one order to the next, d p^(j) / dsigma = p^(j+1) dt/dsigma.
pub(super) struct ForcingSeries([Series; HIGHEST_ORDER + 1]);

impl ForcingSeries {
    /// The series of a force in regularised time; none if the force is linear.
    pub fn new(force: &Polynomial) -> Option<Self> {
        (!force.is_linear()).then(|| {
            let curved = force.with_derivative(0, 0.0).with_derivative(1, 0.0);
            Self(curved.derivatives().map(|derivative| {
                let mut series = ZERO;
                series[0] = derivative;
                series
            }))
        })
    }

    /// The k-th coefficient of the force as a series in regularised time, from those of dt/dsigma below k. It is to be
    /// called for k = 0, 1, ... in order.
    pub fn coefficient(&mut self, rate: &ReversedSeries, k: usize) -> f64 {
        if let Some(before) = k.checked_sub(1) {
            for j in 0..HIGHEST_ORDER {
                self.0[j][k] = rate.times(&self.0[j + 1], before) / k as f64;
            }
        }
        self.0[0][k]
    }
}
