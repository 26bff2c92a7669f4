//! The exact motion inside one phase.
//!
//! Every linear phase obeys x'' + 2 a x' + b x = p(t) + A cos(angle + w t). [`LinearLaw`] holds a, b, A and w
//! and what can be computed once; a [`ArcSolution`] is one motion along it. Three evaluations share the
//! work, each where it is free of cancellation: a Taylor series for short times, the particular
//! solution plus the free modes for ordinary ones, and zero-state responses by doubling
//! where the particular solution blows up. They answer a push p = c + r t. Under a [`Polynomial`] of higher
//! degree, and in a phase with a power law ([`Hertz`]), the motion is followed in Taylor steps, each a course
//! of its own.

mod arc_solution;
mod change;
mod chatter;
mod doubled;
mod expansion;
mod forcing_series;
mod gauss;
mod hertz;
mod linearized;
mod modes;
mod near_start;
mod node;
mod pairs;
mod parameter_response;
mod particular;
mod place;
mod polynomial;
mod power;
mod pressed;
mod pushed;
mod regularized_time;
mod response;
mod series;
mod slow_manifold;
mod sphere;
mod taylor;
mod taylor_step;
mod variation;

pub use arc_solution::ArcSolution;
pub(crate) use change::{Change, Transition};
pub(crate) use chatter::{Chatter, Pressing};
pub(crate) use gauss::gauss_nodes;
pub use hertz::Hertz;
pub use modes::Modes;
pub(crate) use node::Window;
pub(crate) use parameter_response::{Answer, Forces, Source};
pub use place::{Departure, Drive, Node};
pub use polynomial::{HIGHEST_ORDER, Polynomial};
pub(crate) use taylor::{DEGREE, Taylor, evaluate, value};
pub(crate) use taylor_step::{Finer, TaylorStep};

use nalgebra::Matrix2;

/// Largest loss of digits (as a factor) that the particular-solution form may bring.
const LARGEST_LOSS: f64 = 64.0;

/// One linear law under the harmonic drive, per unit of mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearLaw {
    /// The free motion.
    pub modes: Modes,
    /// A = F0/m in m/s^2.
    pub amplitude: f64,
    /// w in rad/s.
    pub frequency: f64,
    /// Steady state per drive, x = .0 cos(angle) + .1 sin(angle), where it is well conditioned.
    steady: Option<(f64, f64)>,
    /// The steady state wherever it exists, and the time in s after which nothing else is left.
    late: Option<((f64, f64), f64)>,
    /// Time in s that one scan step spans.
    pub(crate) window: f64,
    /// Time in s that one scan step spans once the free motion has died out.
    pub(crate) long_window: f64,
    /// Bounds on the fundamental solutions over one window.
    pub(crate) window_bounds: (f64, f64),
    /// Time in s over which a Taylor polynomial is exact to round-off.
    pub(crate) reach: f64,
    window_modes: Matrix2<f64>,
    window_turn: Drive,
}

impl LinearLaw {
    /// The flow of m x'' + `damping` x' + `stiffness` x = `amplitude` cos(w t) + ..., all SI, with
    /// `mass` > 0, `damping` >= 0, `frequency` > 0.
    pub fn new(mass: f64, damping: f64, stiffness: f64, amplitude: f64, frequency: f64) -> Self {
        let modes = Modes::new(0.5 * damping / mass, stiffness / mass);
        Self::of(modes, amplitude / mass, frequency)
    }

    /// This law under a drive of another frequency.
    pub(crate) fn tuned(&self, frequency: f64) -> Self {
        Self::of(self.modes, self.amplitude, frequency)
    }

    /// This law under another drive, of this amplitude per mass.
    pub(crate) fn driven(&self, amplitude: f64, frequency: f64) -> Self {
        Self::of(self.modes, amplitude, frequency)
    }

    fn of(modes: Modes, amplitude: f64, frequency: f64) -> Self {
        let window = 1.0 / frequency.max(modes.slow_rate());
        let reach = 1.0 / frequency.max(modes.fastest_rate());
        // b - w^2 and 2 a w.
        let real = (-frequency).mul_add(frequency, modes.stiffness);
        let imaginary = 2.0 * modes.decay * frequency;
        let impedance = real.hypot(imaginary);
        let scale = amplitude / impedance;
        let response = (scale * (real / impedance), scale * (imaginary / impedance));
        Self {
            modes,
            amplitude,
            frequency,
            steady: describes(&modes, impedance, frequency).then_some(response),
            late: slowest(&modes).map(|slow| (response, LIFETIMES / slow)),
            window,
            long_window: 1.0 / frequency,
            window_bounds: modes.bounds(window),
            reach,
            window_modes: modes.at(window),
            window_turn: Drive::at(frequency * window),
        }
    }

    /// The steady state under the drive alone, x = .0 cos(angle) + .1 sin(angle), where it is well
    /// conditioned.
    pub fn steady(&self) -> Option<(f64, f64)> {
        self.steady
    }

    /// State transition d(x, v)(elapsed) / d(x, v)(0).
    pub fn transition(&self, elapsed: f64) -> Matrix2<f64> {
        self.modes.at(elapsed)
    }

    /// Damping over mass in 1/s.
    pub fn damping(&self) -> f64 {
        2.0 * self.modes.decay
    }

    /// x'' in m/s^2 of a state under `push` per mass.
    pub fn acceleration(&self, x: f64, v: f64, push: f64) -> f64 {
        push - 2.0 * self.modes.decay * v - self.modes.stiffness * x
    }
}

/// True if the steady state A / (b - w^2 + 2 i a w), or the static deflection, does not dwarf the motion that it has to
/// describe.
fn describes(modes: &Modes, impedance: f64, w: f64) -> bool {
    let (a, b) = (modes.decay, modes.stiffness);
    let resonant = impedance * LARGEST_LOSS < b.abs().max(w * w);
    let limp = b.abs() * LARGEST_LOSS < 4.0 * a * a || b == 0.0;
    !resonant && !limp
}

/// Rate in 1/s of the slower mode, where the free motion dies out.
fn slowest(modes: &Modes) -> Option<f64> {
    let (slow, _) = modes.decay_rates();
    (modes.stiffness > 0.0 && slow > 0.0).then_some(slow)
}

/// Lifetimes of a mode after which nothing of it is left beside a motion 10^10 times smaller.
const LIFETIMES: f64 = 60.0;
