//! The response of a linear law to changes of its start and to forces, by Taylor series over a short time and
//! doubling: no root is preferred, so it holds at resonance, at repeated roots and without stiffness, and costs the
//! logarithm of the time.

use nalgebra::{Matrix4x2, SMatrix, SVector, Vector4};

use super::LinearLaw;
use super::departure::Departure;
use super::free_motion::Modes;
use super::parameter_response::{ParameterResponse, StateAndSupply};

/// The response of a linear law at one time. Columns: to a start with position 1, to one with velocity 1, and from rest
/// to the forces 1, cos(w t) and sin(w t). Rows: position y, velocity y', real and imaginary part of the integral of y'
/// e^(i w t); below them the response to the force y.
type DoubledResponse = SMatrix<f64, 8, 5>;

/// Terms of the series before the first doubling, up to (fastest rate) x (time) = 1/8: the next would be (1/8)^12 / 12! < 4e-20.
const TERMS: usize = 12;

/// Coefficients of a response as a power series in units of the time.
type ResponseSeries = [f64; TERMS];

impl LinearLaw {
    /// The response of this law, from a departure under a constant forcing, to changes of its start, its coefficients
    /// and its drive, after `elapsed` seconds.
    pub(super) fn parameter_response_by_doubling(
        &self,
        from: &Departure,
        elapsed: f64,
    ) -> ParameterResponse {
        let (modes, w) = (&self.modes, self.frequency);
        let found = self.doubled_response(elapsed);
        let Departure {
            drive, velocity, ..
        } = from;
        let forcing = from.forcing.value() - modes.stiffness * from.position;
        let along = SVector::from([
            0.0,
            *velocity,
            forcing,
            self.amplitude * drive.cos,
            -self.amplitude * drive.sin,
        ]);
        let motion = found * along;
        let answer =
            |y: Vector4<f64>| StateAndSupply::new(y.x, y.y, drive.cos * y.z - drive.sin * y.w);
        let own = |column: usize| found.fixed_view::<4, 1>(0, column).into_owned();
        let way: Vector4<f64> = motion.fixed_rows::<4>(4).into_owned();
        // The force x' leads to y' where x leads to y, both from rest.
        let (sin, cos) = (w * elapsed).sin_cos();
        let rate = motion[0] - self.damping() * way.y - modes.stiffness * way.x;
        let turned = (cos * way.y + w * way.w, sin * way.y - w * way.z);
        let velocity = Vector4::new(way.y, rate, turned.0, turned.1);
        let (cosine, sine) = (own(3), own(4));
        let mut forced = [StateAndSupply::zeros(); 9];
        forced[..5].copy_from_slice(&[
            answer(own(2)),
            answer(way),
            answer(velocity),
            answer(drive.cos * cosine - drive.sin * sine),
            answer(drive.sin * cosine + drive.cos * sine),
        ]);
        let [first, second] = [own(0), own(1)].map(answer);
        ParameterResponse {
            free: SMatrix::from_columns(&[first, second]),
            forced,
            travel: (
                drive.cos * motion[2] - drive.sin * motion[3],
                drive.sin * motion[2] + drive.cos * motion[3],
            ),
        }
    }

    /// The responses of this law after `elapsed` seconds, by doubling from a time that is short for law and drive.
    fn doubled_response(&self, elapsed: f64) -> DoubledResponse {
        let (modes, w) = (&self.modes, self.frequency);
        let rate = modes.fastest_rate().max(w);
        let doublings = (rate * elapsed / 0.125).log2().ceil().clamp(0.0, 1000.0) as i32;
        let mut span = elapsed * 0.5f64.powi(doublings);
        let mut found = response_series(modes, w, span);
        for _ in 0..doublings {
            found = doubled_time(&found, w * span);
            span *= 2.0;
            let free = modes.transition(span);
            found.fixed_view_mut::<2, 2>(0, 0).copy_from(&free);
        }
        found
    }
}

/// The responses after twice the time, in half of which the drive turns by `turn` rad: the state reached goes on
/// freely, while the forces, turned on, begin again.
fn doubled_time(once: &DoubledResponse, turn: f64) -> DoubledResponse {
    let (sin, cos) = turn.sin_cos();
    let free: Matrix4x2<f64> = once.fixed_view::<4, 2>(0, 0).into_owned();
    let [constant, cosine, sine] = [2, 3, 4].map(|column| once.column(column).into_owned());
    let forced = [
        SVector::zeros(),
        SVector::zeros(),
        constant,
        cos * cosine - sin * sine,
        cos * sine + sin * cosine,
    ];
    let mut both = DoubledResponse::zeros();
    for (index, mut onward) in forced.into_iter().enumerate() {
        let first = once.column(index);
        onward += once.fixed_columns::<2>(0) * first.fixed_rows::<2>(0);
        let mut next = onward.fixed_rows_mut::<4>(4);
        next += free * first.fixed_rows::<2>(4);
        for rows in [2, 6] {
            let (re, im) = (onward[rows], onward[rows + 1]);
            onward[rows] = first[rows] + (cos * re - sin * im);
            onward[rows + 1] = first[rows + 1] + (sin * re + cos * im);
        }
        both.set_column(index, &onward);
    }
    both
}

/// The responses after a time that is short for law and drive, by power series.
fn response_series(modes: &Modes, w: f64, time: f64) -> DoubledResponse {
    let mut wave = [[0.0; TERMS]; 2];
    let mut term = 1.0;
    for n in 0..TERMS {
        let sign = if n % 4 < 2 { 1.0 } else { -1.0 };
        wave[n % 2][n] = sign * term;
        term *= w * time / (n + 1) as f64;
    }
    // Of each power of the time against a wave.
    let integrals = wave.map(|wave| -> ResponseSeries {
        let integral = |n: usize| -> f64 {
            let terms = wave.iter().enumerate().rev();
            terms.map(|(j, term)| term / (n + j + 1) as f64).sum()
        };
        std::array::from_fn(integral)
    });
    let mut one = [0.0; TERMS];
    one[0] = 1.0;
    let zero = [0.0; TERMS];
    let solve = |start: (f64, f64), force: &ResponseSeries| -> ResponseSeries {
        let mut y = [0.0; TERMS];
        (y[0], y[1]) = (start.0, start.1 * time);
        let (damping, stiffness) = (2.0 * modes.decay * time, modes.stiffness * time * time);
        for n in 0..TERMS - 2 {
            let (next, after) = ((n + 1) as f64, (n + 2) as f64);
            let pulled = time * time * force[n] - stiffness * y[n];
            y[n + 2] = (pulled / next - damping * y[n + 1]) / after;
        }
        y
    };
    let summed = |y: &ResponseSeries| {
        let velocity: ResponseSeries = std::array::from_fn(|n| match y.get(n + 1) {
            Some(next) => (n + 1) as f64 * next,
            None => 0.0,
        });
        let against = |integrals: &ResponseSeries| -> f64 {
            let pairs = velocity.iter().zip(integrals).rev();
            pairs.map(|(rate, integral)| rate * integral).sum()
        };
        let speed: f64 = velocity.iter().rev().sum();
        let rate = if time > 0.0 { speed / time } else { y[1] };
        [
            y.iter().rev().sum(),
            rate,
            against(&integrals[0]),
            against(&integrals[1]),
        ]
    };
    let mut found = DoubledResponse::zeros();
    let starts = [(1.0, 0.0), (0.0, 1.0), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)];
    let forces = [&zero, &zero, &one, &wave[0], &wave[1]];
    for (index, (start, force)) in starts.into_iter().zip(forces).enumerate() {
        let own = solve(start, force);
        let next = solve((0.0, 0.0), &own);
        let column = [summed(&own), summed(&next)].concat();
        found.column_mut(index).copy_from_slice(&column);
    }
    if time == 0.0 {
        found[(1, 1)] = 1.0;
    }
    found
}
