//! Motion in a Hertz contact: Taylor series of the equation itself, in short steps that grow and
//! shrink with the deflection.

use super::law::Machine;
use super::linear::horner;
use super::piece::{Bounds, Piece, State};

const ORDER: usize = 22;
/// Share of the momentum up to which the force of a first touch is told by its leading term alone.
const FAINT: f64 = 1e-13;

/// m d'' = ... - k d^n (1 + lambda v), per unit of mass.
#[derive(Debug, Clone, Copy)]
pub struct Power {
    pub damping: f64,
    pub suspension: f64,
    /// Force of the suspension at deflection zero.
    pub offset: f64,
    pub stiffness: f64,
    pub exponent: f64,
    pub dissipation: f64,
    pub amplitude: f64,
    pub frequency: f64,
}

/// A polynomial of the displacement over one step.
#[derive(Debug, Clone)]
pub struct Step {
    begin: f64,
    scale: f64,
    pub end: f64,
    c: [f64; ORDER],
}

/// A whole arc.
#[derive(Debug, Clone)]
pub struct Steps {
    pub steps: Vec<Step>,
    pub end: State,
    pub length: f64,
    pub speed: f64,
}

impl Piece for Step {
    fn at(&self, t: f64) -> State {
        let s = (t - self.begin) / self.scale;
        let (u, v) = horner(&self.c, s);
        let a = (2..ORDER)
            .rev()
            .fold(0.0, |sum, k| sum * s + (k * (k - 1)) as f64 * self.c[k]);
        State {
            u,
            v: v / self.scale,
            a: a / (self.scale * self.scale),
        }
    }

    fn bounds(&self, t: f64, h: f64) -> Bounds {
        let s = (t + h - self.begin) / self.scale;
        let sum = |n: usize| {
            let term = |k: usize| {
                let factor: usize = (0..n).map(|i| k - i).product();
                factor as f64 * self.c[k].abs() * s.powi((k - n) as i32)
            };
            (n..ORDER).map(term).sum::<f64>() / self.scale.powi(n as i32)
        };
        Bounds {
            a: sum(2),
            j: sum(3),
            drift: None,
            free: (0.0, 0.0),
        }
    }
}

impl Power {
    pub fn new(
        machine: &Machine,
        damping: f64,
        from: f64,
        (k, n, lambda): (f64, f64, f64),
    ) -> Self {
        let m = machine.mass;
        Self {
            damping: damping / m,
            suspension: machine.stiffness / m,
            offset: machine.stiffness * from / m,
            stiffness: k / m,
            exponent: n,
            dissipation: lambda,
            amplitude: machine.amplitude / m,
            frequency: machine.frequency,
        }
    }

    fn smooth(&self, d: f64, v: f64, angle: f64) -> f64 {
        let forcing = self.amplitude * angle.cos() - self.offset;
        forcing - self.suspension * d - self.damping * v
    }

    /// The motion from a deflection over a time; none if it takes more than `budget` steps.
    pub fn run(&self, start: (f64, f64), angle: f64, time: f64, budget: &mut u64) -> Option<Steps> {
        // Shorter times move nothing and would underflow.
        let time = if time < 1e-200 { 0.0 } else { time };
        let (d0, v0) = start;
        let (mut d, mut v, mut t) = (d0, v0, 0.0);
        let mut out = Steps {
            steps: Vec::new(),
            end: State {
                u: 0.0,
                v,
                a: self.smooth(d, v, angle),
            },
            length: d.abs(),
            speed: v.abs(),
        };
        while t < time {
            *budget = budget.checked_sub(10)?;
            let angle = angle + self.frequency * t;
            let touch = d <= 0.0;
            let (mut step, next) = if touch {
                if t > 0.0 {
                    return None;
                }
                self.touch(v, angle, time)?
            } else {
                self.step(d, v, angle, time - t)?
            };
            step.c[0] -= d0;
            step.begin = t;
            let end = t + step.end;
            step.end = if step.end >= time - t { time } else { end };
            t = step.end;
            (d, v) = next;
            out.steps.push(step);
            out.length = out.length.max(d.abs());
            out.speed = out.speed.max(v.abs());
        }
        let angle = angle + self.frequency * time;
        let power = self.stiffness * d.max(0.0).powf(self.exponent);
        let a = self.smooth(d, v, angle) - power * (1.0 + self.dissipation * v).max(0.0);
        out.end = State { u: d - d0, v, a };
        Some(out)
    }

    /// The first moments of contact: the smooth motion, the faint force by its leading term.
    fn touch(&self, v: f64, angle: f64, time: f64) -> Option<(Step, (f64, f64))> {
        let (n, a) = (self.exponent, self.smooth(0.0, v, angle));
        let wave = self.frequency * self.amplitude;
        let brisk = self.damping + self.frequency + self.suspension.sqrt();
        let rising = v > 0.0;
        let freed = v == 0.0 && a > 1e-9 * (self.amplitude + self.offset.abs());
        if !rising && !freed {
            return None;
        }
        let (h, power) = if rising {
            let brisk = brisk + self.dissipation * a.abs() + a.abs() / v;
            let share = self.stiffness * v.powf(n - 1.0) * (1.0 + self.dissipation * v);
            (
                (FAINT / share).powf(1.0 / (n + 1.0)).min(1e-5 / brisk),
                n + 1.0,
            )
        } else {
            let brisk = brisk + self.dissipation * a + wave / a;
            let share = self.stiffness * (0.5 * a).powf(n) / a;
            (
                (FAINT / share).powf(0.5 / n).min(1e-5 / brisk),
                2.0 * n + 1.0,
            )
        };
        let h = h.min(time);
        let base = if rising { v * h } else { 0.5 * a * h * h };
        let kick = self.stiffness * base.powf(n) * (1.0 + self.dissipation * v) * h / power;
        let step = self.expand(0.0, v, angle, h, 0.0, 0.0);
        let end = step.at(h);
        let next = (end.u - kick * h / (power + 1.0), end.v - kick);
        Some((Step { end: h, ..step }, next))
    }

    fn step(&self, d: f64, v: f64, angle: f64, left: f64) -> Option<(Step, (f64, f64))> {
        let power = self.stiffness * d.powf(self.exponent);
        let factor = 1.0 + self.dissipation * v;
        let brisk = self.damping + self.frequency + self.suspension.sqrt();
        let h = left.min(0.5 / brisk);
        let leaves = v < 0.0 && -v * h < 2.0 * d;
        if leaves && power * (1.0 + factor.abs()) * h < 1e-13 * v.abs() {
            let step = self.expand(d, v, angle, h, 0.0, power * factor);
            let end = step.at(h);
            return Some((Step { end: h, ..step }, (end.u, end.v)));
        }
        let a = self.smooth(d, v, angle) - power * factor;
        let local = (power * self.exponent / d * factor.abs() + self.suspension).sqrt();
        let rate = (v.abs() / d)
            .max((a.abs() / d).sqrt())
            .max(local)
            .max(self.frequency)
            .max(self.damping + self.dissipation * (power + a.abs()));
        let mut h = (0.3 / rate).min(left);
        for _ in 0..20 {
            let step = self.expand(d, v, angle, h, power, 0.0);
            let last = step.c[ORDER - 1].abs().max(step.c[ORDER - 2].abs());
            let size = d.max((v * h).abs());
            if last <= 1e-17 * size {
                let end = step.at(h);
                return (end.u > 0.0 || h >= left)
                    .then_some((Step { end: h, ..step }, (end.u, end.v)));
            }
            h *= (1e-18 * size / last)
                .powf(1.0 / (ORDER - 2) as f64)
                .min(0.9);
        }
        None
    }

    /// Taylor coefficients in units of `h`; `power` is k d^n at the start, `frozen` a force.
    fn expand(&self, d: f64, v: f64, angle: f64, h: f64, power: f64, frozen: f64) -> Step {
        let (n, lambda) = (self.exponent, self.dissipation / h);
        let (s, c) = angle.sin_cos();
        let mut x = [0.0; ORDER];
        let (mut w, mut q) = ([0.0; ORDER], [0.0; ORDER]);
        (x[0], x[1], w[0]) = (d, v * h, power);
        let mut forcing = self.amplitude;
        for j in 0..ORDER - 2 {
            let (i1, i2) = ((j + 1) as f64, (j + 2) as f64);
            let mut force = forcing * [c, -s, -c, s][j % 4];
            if j == 0 {
                force -= self.offset + frozen;
            }
            if power != 0.0 {
                if j > 0 {
                    let term = |l: usize| ((n + 1.0) * l as f64 - j as f64) * x[l] * w[j - l];
                    w[j] = (1..=j).map(term).sum::<f64>() / (j as f64 * d);
                }
                q[j] = lambda * i1 * x[j + 1] + if j == 0 { 1.0 } else { 0.0 };
                force -= (0..=j).map(|l| w[l] * q[j - l]).sum::<f64>();
            }
            force -= self.suspension * x[j] + self.damping * i1 * x[j + 1] / h;
            x[j + 2] = h * h * force / (i1 * i2);
            forcing *= self.frequency * h / i1;
        }
        Step {
            begin: 0.0,
            scale: h,
            end: h,
            c: x,
        }
    }
}
