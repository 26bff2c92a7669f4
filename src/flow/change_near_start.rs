//! The motion soon after a departure, by the Taylor series about it, with no more terms than it needs.
//!
//! Each term obeys the law itself: with T_n = c_n t^n and Q_n = q_n t^n of position and forcing,
//! (n + 1)(n + 2) T_(n+2) = t^2 Q_n - 2 a t (n + 1) T_(n+1) - b t^2 T_n.

use super::{Departure, LinearLaw};

/// Shares of the reach of a linear law, each with the number of Taylor terms beyond which all others are below the
/// rounding of the third. From the fourth on they come in pairs.
const TERMS: [(f64, usize); 4] = [
    (1.0 / 256.0, 9),
    (1.0 / 32.0, 11),
    (1.0 / 8.0, 13),
    (1.0 / 4.0, 15),
];
/// Number of Taylor terms up to half of the reach of a linear law.
const MAX_TERMS: usize = 17;

/// Factors of the Taylor recurrence, 1/((n + 1)(n + 2)), 1/(n + 2) and n + 2 from n = 1 on, for two terms at a time.
const FACTORS: [[[f64; 3]; 2]; (MAX_TERMS - 3) / 2] = {
    let mut table = [[[0.0; 3]; 2]; (MAX_TERMS - 3) / 2];
    let mut index = 0;
    while index < 2 * table.len() {
        let (first, second) = ((index + 2) as f64, (index + 3) as f64);
        table[index / 2][index % 2] = [1.0 / (first * second), 1.0 / second, second];
        index += 1;
    }
    table
};

/// The changes of position and velocity since a departure under a linear forcing, by Taylor series, for `elapsed` up to
/// half the reach of the law.
pub(super) fn change_near_start(flow: &LinearLaw, from: &Departure, elapsed: f64) -> (f64, f64) {
    if elapsed == 0.0 {
        return (0.0, 0.0);
    }
    let share = elapsed / flow.reach;
    let needed = TERMS.iter().find(|(most, _)| share <= *most);
    let terms = needed.map_or(MAX_TERMS, |(_, terms)| *terms);
    let (angle, square) = (flow.frequency * elapsed, elapsed * elapsed);
    let damping = flow.damping() * elapsed;
    let stiffness = flow.modes.stiffness * square;
    let forcing = from.forcing.value() + flow.amplitude * from.drive.cos;
    let start = from
        .acceleration
        .unwrap_or_else(|| flow.acceleration(from.position, from.velocity, forcing));
    // Of order n and n + 1, times t^2.
    let amplitude = square * flow.amplitude;
    let turn = -angle * angle;
    let mut odd = -amplitude * from.drive.sin * angle;
    let mut even = 0.5 * turn * amplitude * from.drive.cos;
    let mut ramp = square * elapsed * from.forcing.rate();
    let (mut first, mut second) = (from.velocity * elapsed, 0.5 * start * square);
    let (mut way, mut rise) = (0.0, 0.0);
    for [one, other] in &FACTORS[..(terms - 3) / 2] {
        let load = (odd + ramp) - stiffness * first;
        first = load * one[0] - damping * one[1] * second;
        let load = even - stiffness * second;
        second = load * other[0] - damping * other[1] * first;
        way += first + second;
        rise += one[2] * first + other[2] * second;
        odd *= turn * one[0];
        even *= turn * other[0];
        ramp = 0.0;
    }
    let way = 0.5 * start * elapsed * elapsed + way;
    (
        from.velocity * elapsed + way,
        start * elapsed + rise / elapsed,
    )
}
