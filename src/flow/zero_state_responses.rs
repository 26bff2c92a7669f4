//! Responses of a linear law from rest to the three forces a phase can meet (constant, ramp, harmonic), by Taylor
//! series and doubling. They have no preferred root, so they hold where the usual particular solutions blow up: zero
//! stiffness, zero frequency, exact resonance, repeated roots.

use nalgebra::Vector2;

use super::free_motion::Modes;
use crate::budget;

/// Responses from rest (position, velocity) of a linear law to the forces 1, t, cos(w t) and sin(w t) at one time.
#[derive(Debug, Clone, Copy)]
pub(super) struct ZeroStateResponses {
    pub constant: Vector2<f64>,
    pub ramp: Vector2<f64>,
    pub cosine: Vector2<f64>,
    pub sine: Vector2<f64>,
}

/// Terms of the Taylor series before the first doubling, up to (fastest rate) x (time) = 1/2: the next would be (1/2)^16 / 16! < 1e-18.
const TERMS: usize = 16;

impl ZeroStateResponses {
    /// The zero-state responses of x'' + 2 a x' + b x after `t` seconds, to forces with frequency `w`.
    pub fn after_time(modes: &Modes, w: f64, t: f64) -> Self {
        let rate = modes.fastest_rate().max(w);
        let doublings = (rate * t / 0.5).log2().ceil().clamp(0.0, 1000.0) as i32;
        budget::charge(budget::ZERO_STATE_RESPONSES + budget::DOUBLING * doublings as u64);
        let mut span = t * 0.5f64.powi(doublings);
        let mut responses = Self::sum_series(modes, w, span);
        for _ in 0..doublings {
            responses = responses.double_time(modes, w, span);
            span *= 2.0;
        }
        responses
    }

    /// The zero-state responses after a short time, by Taylor series.
    fn sum_series(modes: &Modes, w: f64, t: f64) -> Self {
        let unit = |n: usize| move |k: usize| if k == n { 1.0 } else { 0.0 };
        let harmonic = |offset: usize| {
            let mut term = 1.0;
            let coefficients: [f64; TERMS] = std::array::from_fn(|n| {
                if n > 0 {
                    term *= w / n as f64;
                }
                match (n + offset) % 4 {
                    0 => term,
                    2 => -term,
                    _ => 0.0,
                }
            });
            move |k: usize| coefficients[k]
        };
        Self {
            constant: sum_response(modes, t, unit(0)),
            ramp: sum_response(modes, t, unit(1)),
            cosine: sum_response(modes, t, harmonic(0)),
            sine: sum_response(modes, t, harmonic(3)),
        }
    }

    /// The zero-state responses after `2 h` from these after `h`: the state reached goes on freely while the force,
    /// shifted by `h`, begins again.
    fn double_time(&self, modes: &Modes, w: f64, h: f64) -> Self {
        let free = modes.transition(h);
        let (sin, cos) = (w * h).sin_cos();
        Self {
            constant: free * self.constant + self.constant,
            ramp: free * self.ramp + (self.ramp + h * self.constant),
            cosine: free * self.cosine + (cos * self.cosine - sin * self.sine),
            sine: free * self.sine + (sin * self.cosine + cos * self.sine),
        }
    }
}

/// The zero-state response of x'' + 2 a x' + b x to the force sum f_n t^n, by its Taylor series.
fn sum_response(modes: &Modes, t: f64, force: impl Fn(usize) -> f64) -> Vector2<f64> {
    let mut c = [0.0; TERMS + 2];
    for n in 0..TERMS {
        let k = n as f64;
        let sum = force(n) - 2.0 * modes.decay * (k + 1.0) * c[n + 1] - modes.stiffness * c[n];
        c[n + 2] = sum / ((k + 1.0) * (k + 2.0));
    }
    let (mut x, mut v) = (0.0, 0.0);
    for n in (1..c.len()).rev() {
        x = (x + c[n]) * t;
        v = v * t + n as f64 * c[n];
    }
    Vector2::new(x, v)
}
