//! A linear law under the harmonic drive, with what can be computed of it once.

use nalgebra::Matrix2;

use super::drive_angle::DriveAngle;
use super::free_motion::Modes;

/// Largest factor by which a particular solution may exceed the motion: so much accuracy its cancellation costs.
pub(super) const MAX_DIGIT_LOSS: f64 = 64.0;

/// One linear equation of motion under the harmonic drive, per unit of mass, with what can be computed of it once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearLaw {
    /// The free motion.
    pub modes: Modes,
    /// A = F0/m in m/s^2.
    pub amplitude: f64,
    /// w in rad/s.
    pub frequency: f64,
    /// Steady state per drive, x = .0 cos(angle) + .1 sin(angle), where it is well conditioned.
    pub steady: Option<(f64, f64)>,
    /// The steady state wherever it exists, and the time in s after which nothing else is left.
    pub(super) late: Option<((f64, f64), f64)>,
    /// Time in s that one scan step spans.
    pub(crate) window: f64,
    /// Time in s that one scan step spans once the free motion has died out.
    pub(crate) long_window: f64,
    /// Bounds on the fundamental solutions over one window.
    pub(crate) window_bounds: (f64, f64),
    /// Time in s over which a Taylor polynomial is exact to round-off.
    pub(crate) reach: f64,
    pub(super) window_modes: Matrix2<f64>,
    pub(super) window_turn: DriveAngle,
}

impl LinearLaw {
    /// The law m x'' + `damping` x' + `stiffness` x = `amplitude` cos(w t) + ...; `mass` > 0, `damping` >= 0, `frequency` > 0.
    pub fn new(mass: f64, damping: f64, stiffness: f64, amplitude: f64, frequency: f64) -> Self {
        let modes = Modes::new(0.5 * damping / mass, stiffness / mass);
        Self::of_modes(modes, amplitude / mass, frequency)
    }

    /// This law under another drive, of this amplitude per mass.
    pub(crate) fn with_drive(&self, amplitude: f64, frequency: f64) -> Self {
        Self::of_modes(self.modes, amplitude, frequency)
    }

    /// The law with these modes of free motion under a drive of this amplitude per mass and this frequency.
    fn of_modes(modes: Modes, amplitude: f64, frequency: f64) -> Self {
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
            steady: is_well_conditioned(&modes, impedance, frequency).then_some(response),
            // After 60 lifetimes nothing of a mode is left beside a motion 10^10 times smaller.
            late: modes.slowest_decay().map(|slow| (response, 60.0 / slow)),
            window,
            long_window: 1.0 / frequency,
            window_bounds: modes.solution_bounds(window),
            reach,
            window_modes: modes.transition(window),
            window_turn: DriveAngle::at(frequency * window),
        }
    }

    /// Damping over mass of the linear law, 2 a, in 1/s.
    pub fn damping(&self) -> f64 {
        2.0 * self.modes.decay
    }

    /// x'' in m/s^2 of a state by the linear law under `forcing` per mass.
    pub fn acceleration(&self, x: f64, v: f64, forcing: f64) -> f64 {
        forcing - 2.0 * self.modes.decay * v - self.modes.stiffness * x
    }
}

/// True if the particular solution of a linear law does not dwarf the motion that it is part of: the steady state A /
/// (b - w^2 + 2 i a w), and the static deflection.
fn is_well_conditioned(modes: &Modes, impedance: f64, w: f64) -> bool {
    let (a, b) = (modes.decay, modes.stiffness);
    let resonant = impedance * MAX_DIGIT_LOSS < b.abs().max(w * w);
    let limp = b.abs() * MAX_DIGIT_LOSS < 4.0 * a * a || b == 0.0;
    !resonant && !limp
}
