//! Motion under a linear law in closed form: u'' + b u' + k u = c + A cos(angle + w t), u the
//! displacement since the start.

use super::piece::{Bounds, Piece, State};

const ORDER: usize = 18;

/// The law of one arc with its start, per unit of mass.
#[derive(Debug, Clone, Copy)]
pub struct Setting {
    pub damping: f64,
    pub stiffness: f64,
    pub constant: f64,
    pub amplitude: f64,
    pub frequency: f64,
    pub angle: f64,
    pub velocity: f64,
}

/// The motion of a [`Setting`].
#[derive(Debug, Clone)]
pub struct Linear {
    at: Setting,
    /// Constant, cosine and sine of the particular solution.
    rest: f64,
    cosine: f64,
    sine: f64,
    /// Displacement and velocity of the free deviation from it at the start.
    deviation: (f64, f64),
    /// (b/2)^2 - k.
    discriminant: f64,
    /// Taylor coefficients about the start, for short times.
    taylor: [f64; ORDER],
    reach: f64,
}

impl Linear {
    pub fn new(at: Setting) -> Self {
        let (b, k, w) = (at.damping, at.stiffness, at.frequency);
        let gap = k - w * w;
        let size = gap * gap + (b * w) * (b * w);
        let (cosine, sine) = (at.amplitude * gap / size, at.amplitude * b * w / size);
        let rest = at.constant / k;
        let (s, c) = at.angle.sin_cos();
        let deviation = (
            -(rest + cosine * c + sine * s),
            at.velocity - w * (sine * c - cosine * s),
        );
        let rate = w.max(b).max(k.abs().sqrt());
        Self {
            at,
            rest,
            cosine,
            sine,
            deviation,
            discriminant: 0.25 * b * b - k,
            taylor: taylor(&at),
            reach: 0.5 / rate,
        }
    }

    /// How much an error of rounding grows over a time.
    pub fn growth(&self, time: f64) -> f64 {
        let (b, k) = (self.at.damping, self.at.stiffness);
        if k < 0.0 {
            (self.roots(b, k).1 * time).exp()
        } else {
            1.0 + k.sqrt() * time / 100.0
        }
    }

    /// Natural sizes of displacement and velocity: what the rounding of the closed form refers to.
    pub fn sizes(&self) -> (f64, f64) {
        let harmonic = self.cosine.hypot(self.sine);
        let frequency = self.at.stiffness.abs().sqrt();
        let (z, w) = self.deviation;
        let free = if self.discriminant < 0.0 {
            z.hypot(w / frequency)
        } else {
            z.abs() + w.abs() / (self.at.damping + frequency)
        };
        let length = self.rest.abs() + harmonic + free;
        let speed = frequency * self.rest.abs() + self.at.frequency * harmonic;
        (length, speed + self.at.velocity.abs() + z.abs() * frequency)
    }

    /// Displacement and velocity of the particular solution.
    fn particular(&self, t: f64) -> (f64, f64) {
        let w = self.at.frequency;
        let (s, c) = (self.at.angle + w * t).sin_cos();
        (
            self.rest + self.cosine * c + self.sine * s,
            w * (self.sine * c - self.cosine * s),
        )
    }

    /// Displacement and velocity of the free deviation.
    fn free(&self, t: f64) -> (f64, f64) {
        let (b, k) = (self.at.damping, self.at.stiffness);
        let (c, s, ds) = self.fundamental(t, b, k);
        let (z, w) = self.deviation;
        (c * z + s * w, -k * s * z + ds * w)
    }

    /// C, S and S' of the free motion.
    fn fundamental(&self, t: f64, b: f64, k: f64) -> (f64, f64, f64) {
        let (a, d2) = (0.5 * b, self.discriminant);
        let square = d2 * t * t;
        if square.abs() < 0.25 {
            let decay = (-a * t).exp();
            let (ch, sh) = (even(square), t * odd(square));
            return (decay * (ch + a * sh), decay * sh, decay * (ch - a * sh));
        }
        if d2 < 0.0 {
            let d = (-d2).sqrt();
            let decay = (-a * t).exp();
            let (sin, cos) = (d * t).sin_cos();
            let sh = sin / d;
            return (decay * (cos + a * sh), decay * sh, decay * (cos - a * sh));
        }
        let (r1, r2) = self.roots(b, k);
        let (e1, e2) = ((r1 * t).exp(), (r2 * t).exp());
        let gap = r2 - r1;
        (
            (r2 * e1 - r1 * e2) / gap,
            (e2 - e1) / gap,
            (r2 * e2 - r1 * e1) / gap,
        )
    }

    fn roots(&self, b: f64, k: f64) -> (f64, f64) {
        let fast = -(0.5 * b + self.discriminant.sqrt());
        (fast, k / fast)
    }

    /// Bounds of |z|, |z'|, |z''|, |z'''| of the free deviation from `t` to `t + h`.
    fn free_bounds(&self, t: f64, h: f64) -> [f64; 4] {
        let (b, k) = (self.at.damping, self.at.stiffness);
        if self.discriminant > 1e-4 * b * b {
            let (r1, r2) = self.roots(b, k);
            let (z, w) = self.deviation;
            let one = ((w - r2 * z) / (r1 - r2)).abs() * (r1 * t).exp();
            let two = ((w - r1 * z) / (r2 - r1)).abs() * (r2 * t).max(r2 * (t + h)).exp();
            return [0, 1, 2, 3].map(|n| one * r1.abs().powi(n) + two * r2.abs().powi(n));
        }
        // k z^2 + z'^2 never grows, nor does it for the derivatives.
        let (z, v) = self.free(t);
        let a = -b * v - k * z;
        let j = -b * a - k * v;
        let w = k.sqrt();
        [
            (v / w).hypot(z),
            v.hypot(w * z),
            a.hypot(w * v),
            j.hypot(w * a),
        ]
    }
}

impl Piece for Linear {
    fn at(&self, t: f64) -> State {
        let Setting {
            damping: b,
            stiffness: k,
            ..
        } = self.at;
        let (u, v) = if t <= self.reach {
            horner(&self.taylor, t)
        } else {
            let (p, f) = (self.particular(t), self.free(t));
            (p.0 + f.0, p.1 + f.1)
        };
        let forcing = self.at.amplitude * (self.at.angle + self.at.frequency * t).cos();
        State {
            u,
            v,
            a: self.at.constant + forcing - b * v - k * u,
        }
    }

    fn bounds(&self, t: f64, h: f64) -> Bounds {
        let free = self.free_bounds(t, h);
        let w = self.at.frequency;
        let harmonic = self.cosine.hypot(self.sine);
        let (u, v) = self.particular(t + 0.5 * h);
        Bounds {
            a: free[2] + harmonic * w * w,
            j: free[3] + harmonic * w * w * w,
            drift: Some((u, v, 0.5 * h * w * harmonic, w)),
            free: (free[0], free[1]),
        }
    }
}

fn taylor(at: &Setting) -> [f64; ORDER] {
    let (s, c) = at.angle.sin_cos();
    let mut forcing = at.amplitude;
    let mut out = [0.0; ORDER];
    out[1] = at.velocity;
    for n in 0..ORDER - 2 {
        let wave = [c, -s, -c, s][n % 4];
        let constant = if n == 0 { at.constant } else { 0.0 };
        let (i, j) = ((n + 1) as f64, (n + 2) as f64);
        let force = constant + forcing * wave - at.damping * i * out[n + 1] - at.stiffness * out[n];
        out[n + 2] = force / (i * j);
        forcing *= at.frequency / i;
    }
    out
}

/// Value and derivative of a polynomial.
pub fn horner(c: &[f64], t: f64) -> (f64, f64) {
    c.iter()
        .rev()
        .fold((0.0, 0.0), |(p, d), c| (p * t + c, d * t + p))
}

/// cosh sqrt(q) for small |q|.
fn even(q: f64) -> f64 {
    (1..=8).rev().fold(1.0, |sum, n| {
        let n = f64::from(n);
        1.0 + sum * q / (2.0 * n * (2.0 * n - 1.0))
    })
}

/// sinh sqrt(q) / sqrt(q) for small |q|.
fn odd(q: f64) -> f64 {
    (1..=8).rev().fold(1.0, |sum, n| {
        let n = f64::from(n);
        1.0 + sum * q / (2.0 * n * (2.0 * n + 1.0))
    })
}
