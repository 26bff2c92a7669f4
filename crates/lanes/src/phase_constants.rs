//! The constants of the law of a phase, computed once for all motions of a machine.

use std::f64::consts::TAU;

use nalgebra::{Complex, Vector2};

use super::lane_laws::{FREE_TERMS, PhaseConstants, WINDOW_ANGLE};
use softstop::PhaseKind;
use softstop::internals::{
    Beyond, Exit, MIN_SCALE_STIFFNESS, Modes, Phase, Phases, PowerLaw, SurfaceId,
};

/// Most scan windows per drive period with which lanes follow a phase: stiffer phases are left to the safe engine.
const MAX_WINDOWS_PER_PERIOD: f64 = 65_536.0;
/// Exponents of the power laws that lanes follow.
const POWER_LAW_EXPONENTS: [f64; 3] = [1.5, 2.0, 2.5];
/// Largest rate of damping and suspension in a power-law contact, in units of the drive's w, with which lanes follow it: under
/// heavier damping the mass creeps, which the safe engine follows in long steps.
const MAX_POWER_LAW_RATE: f64 = 100.0;

impl PhaseConstants {
    /// Sets all constants, zero before, to those of a phase of the engine; none if only the safe engine can follow it.
    pub fn set_to_phase(&mut self, phases: &Phases, phase: &Phase) -> Option<()> {
        (self.low, self.high) = (f64::NEG_INFINITY, f64::INFINITY);
        if let Some(hertz) = &phase.hertz {
            return self.set_to_power_law(phases, phase, hertz);
        }
        let constants = self;
        constants.set_linear_law(phases, phase)?;
        let mut guarded = false;
        for (guard, exit) in phase.guards.iter().zip(phase.exits.iter()) {
            let beyond = match *exit {
                Exit::Forward(surface) => {
                    constants.end_at(phases, surface, true);
                    continue;
                }
                Exit::Backward(surface) => {
                    constants.end_at(phases, surface, false);
                    continue;
                }
                Exit::Reversal { backward, .. } if guard.velocity < 0.0 => backward,
                Exit::Reversal { forward, .. } => forward,
                Exit::Switch(to) => to,
            };
            if guarded || guard.forcing != 0.0 {
                return None;
            }
            (guarded, constants.beyond_guard) = (true, beyond.index() as f64);
            constants.by_position = guard.position;
            constants.by_velocity = guard.velocity;
            constants.level = guard.level;
        }
        if !guarded {
            constants.level = f64::INFINITY;
        }
        let flow = &phase.flow;
        constants.set_single_end();
        constants.set_ambiguity(flow.frequency.max(flow.modes.fastest_rate()));
        let is_free = phase.kind == PhaseKind::Free;
        let reach = if constants.has_one_end() || is_free {
            f64::INFINITY
        } else {
            constants.window
        };
        constants.set_bounds(&flow.modes, flow.frequency, reach);
        if constants.is_released_before(constants.low, 1.0) {
            constants.low = f64::NEG_INFINITY;
        }
        if constants.is_released_before(constants.high, -1.0) {
            constants.high = f64::INFINITY;
        }
        constants.apply_side(constants.side);
        Some(())
    }

    /// Sets the constants of a phase in which a power-law contact acts; none if only the safe engine can follow it.
    fn set_to_power_law(&mut self, phases: &Phases, phase: &Phase, hertz: &PowerLaw) -> Option<()> {
        let constants = self;
        for exit in phase.exits.iter() {
            match *exit {
                Exit::Backward(surface) => constants.end_at(phases, surface, false),
                Exit::Switch(_) => {}
                Exit::Forward(_) | Exit::Reversal { .. } => return None,
            }
        }
        constants.set_single_end();
        if !POWER_LAW_EXPONENTS.contains(&hertz.exponent) || constants.end != hertz.origin {
            return None;
        }
        let flow = &phase.flow;
        if flow.modes.fastest_rate() > MAX_POWER_LAW_RATE * flow.frequency {
            return None;
        }
        let press = hertz.stiffness / hertz.mass;
        let forcing = phase.law.force / phases.mass - flow.modes.stiffness * hertz.origin;
        *constants = Self {
            damping: -2.0 * flow.modes.decay,
            stiffness: -flow.modes.stiffness,
            window: 1.0 / flow.frequency.max(flow.modes.fastest_rate()),
            press,
            exponent: hertz.exponent,
            grip: press * hertz.dissipation,
            slip: -1.0 / hertz.dissipation,
            side: hertz.side,
            amplitude: hertz.side * flow.amplitude,
            forcing: hertz.side * forcing,
            level: f64::INFINITY,
            ..*constants
        };
        Some(())
    }

    /// True if a power law acts in the phase.
    pub fn has_power_law(&self) -> bool {
        self.press > 0.0
    }

    /// True if the further guard ends the phase before the position `end` does (`side` = 1 for the lower end, -1 for the upper
    /// one): a contact that must not pull is released before it is open.
    fn is_released_before(&self, end: f64, side: f64) -> bool {
        let off = self.by_position * end - self.level;
        side * self.by_velocity < 0.0 && off.abs() <= 4.0 * f64::EPSILON * self.level.abs()
    }

    /// True if one position and nothing else ends the phase, and its free motion never grows.
    pub fn has_one_end(&self) -> bool {
        let one_sided = self.low.is_finite() != self.high.is_finite();
        let plain = one_sided && self.level == f64::INFINITY && self.stiffness < 0.0;
        plain || self.has_power_law()
    }

    /// Indices of the phases that may follow on this one, those on the way to the stop first.
    pub fn successors(&self) -> impl Iterator<Item = usize> {
        let ends = [
            (self.high.is_finite(), self.beyond_high),
            (self.level.is_finite(), self.beyond_guard),
            (self.low.is_finite(), self.beyond_low),
        ];
        let real = ends.into_iter().filter(|(is_there, _)| *is_there);
        real.map(|(_, beyond)| beyond as usize)
    }

    /// These constants for a phase with several ends: of position x itself, not of the distance from its one end.
    pub fn in_absolute_position(&self) -> Self {
        let mut constants = *self;
        constants.apply_side(self.side);
        (constants.side, constants.edge) = (1.0, -self.offset);
        constants.guarded = 1.0;
        constants
    }

    /// Multiplies the constants of the steady motion by `side`: 1, or -1 where the guard is below the mass.
    fn apply_side(&mut self, side: f64) {
        for constant in [
            &mut self.cosine,
            &mut self.sine,
            &mut self.cosine_rate,
            &mut self.sine_rate,
            &mut self.cosine_of_position,
            &mut self.cosine_of_velocity,
            &mut self.sine_of_position,
            &mut self.sine_of_velocity,
        ] {
            *constant *= side;
        }
    }

    /// Ends the phase at a surface: sets position, phase beyond and impact; `forward`: on the way to the stop, not back.
    fn end_at(&mut self, phases: &Phases, surface: SurfaceId, forward: bool) {
        let at = &phases[surface];
        let impact = f64::from(u8::from(forward && at.is_clearance));
        let (beyond, bounce) = match phases.beyond(at, true) {
            Beyond::Phase(beyond) if forward => (beyond, 1.0),
            Beyond::Wall { restitution } if forward => (at.before, -restitution),
            _ => (at.before, 1.0),
        };
        let end = (at.position, beyond.index() as f64, bounce, impact);
        if forward == (at.side > 0.0) {
            (self.high, self.beyond_high, self.bounce, self.impact) = end;
        } else {
            (self.low, self.beyond_low, self.bounce_low, self.impact_low) = end;
        }
    }

    /// Sets the constants of a linear phase's equation of motion; none if too stiff for windows or without static deflection.
    fn set_linear_law(&mut self, phases: &Phases, phase: &Phase) -> Option<()> {
        let flow = &phase.flow;
        let (cosine, sine) = flow.steady?;
        let w = flow.frequency;
        let fastest = w.max(flow.modes.fastest_rate());
        let window = WINDOW_ANGLE / fastest;
        let soft = flow.modes.stiffness.abs() < MIN_SCALE_STIFFNESS * w * w;
        if TAU / w > MAX_WINDOWS_PER_PERIOD * window || (soft && phase.law.force != 0.0) {
            return None;
        }
        let [[xx, vx], [xv, vv]] = flow.modes.transition(window).data.0;
        let (sin, cos) = (w * window).sin_cos();
        let force = phase.law.force / phases.mass;
        let square = (cosine * cosine + sine * sine).max(f64::MIN_POSITIVE);
        *self = Self {
            damping: -2.0 * flow.modes.decay,
            stiffness: -flow.modes.stiffness,
            offset: force / flow.modes.stiffness,
            cosine,
            sine,
            swing: cosine.hypot(sine),
            cosine_rate: w * sine,
            sine_rate: -w * cosine,
            xx,
            xv,
            vx,
            vv,
            response: free_response(&flow.modes, window),
            cosine_of_position: cosine / square,
            cosine_of_velocity: sine / (w * square),
            sine_of_position: sine / square,
            sine_of_velocity: -cosine / (w * square),
            turn: cos,
            turn_by_velocity: sin / w,
            turn_by_position: -w * sin,
            window,
            third: window / 3.0,
            per_window: 1.0 / window,
            ..*self
        };
        Some(())
    }

    /// Copies the position that alone ends a phase into the constants `side`, `edge` and `end`.
    fn set_single_end(&mut self) {
        let is_low = self.high == f64::INFINITY && self.low > f64::NEG_INFINITY;
        if is_low {
            (self.side, self.edge) = (-1.0, self.offset - self.low);
            (self.end, self.beyond_end) = (self.low, self.beyond_low);
            (self.end_bounce, self.end_impact) = (self.bounce_low, self.impact_low);
        } else {
            (self.side, self.edge) = (1.0, self.high - self.offset);
            (self.end, self.beyond_end) = (self.high, self.beyond_high);
            (self.end_bounce, self.end_impact) = (self.bounce, self.impact);
        }
    }

    /// Sets the bounds on |x''''| and |v''''| over a window: |x''''| <= |y''''| C + |y'''''| S for the free part y, with the
    /// bounds C and S on the fundamental solutions over the time `reach`, plus w^4 times the steady amplitude.
    fn set_bounds(&mut self, modes: &Modes, w: f64, reach: f64) {
        let scale = self.window.powi(4) / 384.0;
        let (c, s) = modes.solution_bounds(reach);
        let amplitude = self.swing * scale;
        self.longest = s;
        // Rows of derivatives: y^(n) = row.0 y + row.1 y'.
        let next = |(x, v): (f64, f64)| (self.stiffness * v, x + self.damping * v);
        let fourth = next(next(next((0.0, 1.0))));
        let fifth = next(fourth);
        let sixth = next(fifth);
        self.steady = amplitude * w.powi(4);
        self.rate_steady = self.steady * w;
        (self.fourth_x, self.fourth_v) = (scale * c * fourth.0, scale * c * fourth.1);
        (self.fifth_x, self.fifth_v) = (scale * s * fifth.0, scale * s * fifth.1);
        (self.rate_fifth_x, self.rate_fifth_v) = (scale * c * fifth.0, scale * c * fifth.1);
        (self.rate_sixth_x, self.rate_sixth_v) = (scale * s * sixth.0, scale * s * sixth.1);
    }

    /// Sets the distance from a guard, and the velocity there, below which rounding may decide, so that the lane is handed to the
    /// safe engine. That tells rest from a faint bounce by the velocity after the impact before, so such velocities count, too.
    fn set_ambiguity(&mut self, fastest: f64) {
        let finite = |level: f64| if level.is_finite() { level.abs() } else { 0.0 };
        let size = finite(self.low)
            .max(finite(self.high))
            .max(self.swing + self.offset.abs());
        self.ambiguity = 1e-10 * size;
        let ends = [(self.low, self.bounce_low), (self.high, self.bounce)].into_iter();
        let walls = ends.filter(|(end, _)| end.is_finite());
        let restitution = walls.fold(1.0, |least: f64, (_, bounce)| least.min(bounce.abs()));
        // Where nothing is left after an impact, all are slow.
        self.slow = (1e-5 * size * fastest / restitution).min(f64::MAX);
        self.guard_scale = self.by_position.abs() + self.by_velocity.abs() * fastest;
    }

    /// Position and velocity of the phase's steady motion at a drive angle, given as cos + i sin.
    pub fn steady_state_at(&self, Complex { re: cos, im: sin }: Complex<f64>) -> Vector2<f64> {
        let p = self.cosine * cos + self.sine * sin;
        let q = self.cosine_rate * cos + self.sine_rate * sin;
        Vector2::new(p, q) * self.side
    }

    /// Amplitude of the drive's force per mass in the phase at the frequency w, from that of the steady motion.
    pub fn drive_acceleration(&self, w: f64) -> f64 {
        let (elastic, damped) = (self.stiffness + w * w, self.damping * w);
        self.swing * elastic.hypot(damped)
    }
}

/// Coefficients of [`PhaseConstants::response`]: the solution of x'' + 2 a x' + b x = 0 from (0, 1) as a power series in time
/// over `window`, by its recurrence.
fn free_response(modes: &Modes, window: f64) -> [f64; FREE_TERMS] {
    let (damping, stiffness) = (
        2.0 * modes.decay * window,
        modes.stiffness * window * window,
    );
    let mut terms = [1.0; FREE_TERMS];
    for n in 1..FREE_TERMS {
        let before = if n > 1 { terms[n - 2] } else { 0.0 };
        let pull = damping * n as f64 * terms[n - 1] + stiffness * before;
        terms[n] = -pull * (1.0 / (n * (n + 1)) as f64);
    }
    terms
}
