//! Reference motions of the built-in scenes, stored with all digits of doubles.
//!
//! Taylor series in 67 decimal digits, checked in 48, gave them; they share no code with the exact method. The program that
//! wrote the file is `tests/reference/lab.py`.

use std::str::FromStr;

use softstop::Impact;

use crate::methods::Solution;

/// One motion in each line: scene, drive periods, stiffness of the stop in N/m if it is swept, else 0, position and velocity at
/// the end, the three figures of [`Doubt`], then time and velocity of each impact.
const STORED: &str = include_str!("../assets/references.txt");

/// Relative difference of stiffnesses that are the same but for rounding.
const ROUNDING: f64 = 1e-14;

/// Largest differences between the run in 48 digits and that in 67, which is the answer and far better than this.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Doubt {
    /// Of the position in m and of the velocity in m/s at the end.
    pub end: f64,
    /// Of the times of impacts in s.
    pub impact_time: f64,
    /// Of the velocities of impacts in m/s.
    pub impact_velocity: f64,
}

/// A motion, rounded from many digits.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Its end and its impacts, the summable ones of a rigid stop included.
    pub solution: Solution,
    /// How well it is known.
    pub doubt: Doubt,
}

/// The stored motion of a built-in scene, with its own stop or with one of this stiffness in N/m.
pub fn stored(scene: &str, periods: f64, stiffness: Option<f64>) -> Option<Reference> {
    let wanted = stiffness.unwrap_or(0.0);
    STORED.lines().find_map(|line| {
        let (name, numbers) = line.split_once(' ')?;
        if name != scene {
            return None;
        }
        let mut numbers = numbers
            .split(' ')
            .map_while(|word| f64::from_str(word).ok());
        let (length, own) = (numbers.next()?, numbers.next()?);
        let is_it = length == periods && (own - wanted).abs() <= ROUNDING * wanted;
        is_it.then(|| read(&numbers.collect::<Vec<_>>()))?
    })
}

fn read(numbers: &[f64]) -> Option<Reference> {
    let (&[position, velocity, end, impact_time, impact_velocity], impacts) =
        numbers.split_first_chunk()?;
    let impact = |pair: &[f64]| Impact {
        time: pair[0],
        velocity: pair[1],
    };
    Some(Reference {
        solution: Solution {
            end: (position, velocity),
            impacts: impacts.chunks_exact(2).map(impact).collect(),
            ..Solution::default()
        },
        doubt: Doubt {
            end,
            impact_time,
            impact_velocity,
        },
    })
}
