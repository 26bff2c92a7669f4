//! A stretch of motion as a Taylor polynomial of its own equation.

use super::machine::{Drive, Law};
use super::number::{Digits, Real, derivative, is_negative, is_zero, size, value};

/// Where an arc begins.
#[derive(Debug, Clone)]
pub struct State {
    /// Time in s.
    pub time: Real,
    /// Position in m.
    pub position: Real,
    /// Velocity in m/s.
    pub velocity: Real,
}

/// Position and velocity as polynomials of the time since the start, good up to `reach`.
#[derive(Debug, Clone)]
pub struct Arc {
    /// Position in m.
    pub position: Vec<Real>,
    /// Velocity in m/s.
    pub velocity: Vec<Real>,
    /// Time in s that the polynomials cover.
    pub reach: Real,
}

impl Arc {
    /// An arc from its position.
    pub fn new(position: Vec<Real>, reach: Real) -> Self {
        Self {
            velocity: derivative(&position),
            position,
            reach,
        }
    }

    /// Position and velocity.
    pub fn at(&self, elapsed: &Real) -> (Real, Real) {
        let at = |terms| value(terms, elapsed);
        (at(&self.position), at(&self.velocity))
    }
}

/// Reach of a Taylor polynomial in units of the fastest rate: four digits at most are lost to cancellation.
const REACH: f64 = 4.0;

/// Guard digits of the truncation.
const GUARD: isize = 8;

impl Drive {
    /// Push per mass at a time.
    pub fn at(&self, time: &Real) -> Real {
        &self.amplitude * (&self.frequency * time + &self.phase).cos()
    }

    /// Its Taylor coefficients from a time on.
    pub fn series(&self, time: &Real, count: usize) -> Vec<Real> {
        let (sine, cosine) = (&self.frequency * time + &self.phase).sin_cos();
        let square = &self.frequency * &self.frequency;
        let rate = -(&self.amplitude * &self.frequency * sine);
        let mut series = vec![&self.amplitude * cosine, rate];
        for n in 2..count {
            let next = -(&series[n - 2] * &square) / Real::from(n * (n - 1));
            series.push(next);
        }
        series.truncate(count);
        series
    }
}

/// The arc of a linear law from a state on, below a surface if there is one. `balanced` are the forces on a mass at rest
/// that is let go.
pub fn linear(
    (law, drive): (&Law, &Drive),
    from: &State,
    balanced: bool,
    above: Option<&Real>,
    digits: Digits,
) -> Arc {
    let (x, v) = (&from.position, &from.velocity);
    let rate = rate(law, drive);
    let acceleration = match balanced {
        true => digits.real(0.0),
        false => drive.at(&from.time) + &law.force - &law.damping * v - &law.stiffness * x,
    };
    let mut reach = digits.real(REACH) / &rate;
    if let Some(near) = near(from, &acceleration, above, digits)
        && near < reach
    {
        reach = near;
    }
    let count = terms(&(&reach * rate), digits);
    let mut push = drive.series(&from.time, count);
    push[0] += &law.force;
    let mut c = vec![x.clone(), v.clone(), acceleration >> 1isize];
    for n in 1..count {
        let pull = &law.damping * &c[n + 1] * Real::from(n + 1) + &law.stiffness * &c[n];
        c.push((&push[n] - pull) / Real::from((n + 1) * (n + 2)));
    }
    Arc::new(c, reach)
}

/// The fastest rate in 1/s of law and drive.
fn rate(law: &Law, drive: &Drive) -> Real {
    let own = size(&law.stiffness).sqrt() + &law.damping;
    own.max(drive.frequency.clone())
}

/// Several times the time to a turn that is near, or to a surface above: there the arc is to be short, so that
/// what happens is not small in it.
fn near(from: &State, a: &Real, above: Option<&Real>, digits: Digits) -> Option<Real> {
    let v = &from.velocity;
    let eight = digits.real(8.0);
    if is_negative(&(v * a)) {
        return Some(-(eight * v / a));
    }
    let way = above? - &from.position;
    if is_zero(a) || is_zero(&way) || is_negative(&(&way * a)) {
        return None;
    }
    Some(eight * (way / a).sqrt())
}

/// The number of terms that leaves nothing at a reach in units of the rate.
fn terms(reach: &Real, digits: Digits) -> usize {
    let least = digits.power_of_two(-(digits.0 as isize + GUARD));
    let (mut n, mut term) = (2, digits.real(1.0));
    while n < 9 || term > least {
        n += 1;
        term = term * reach / Real::from(n);
    }
    n
}
