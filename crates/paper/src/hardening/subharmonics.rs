//! Subharmonic motions of soft stops and where they lie.

use anyhow::Result;
use serde::{Deserialize, Serialize};
use softstop_dynamics::Orbit;
use softstop_dynamics::attractors::{SearchOptions, find_attractors};

use super::stops::{Law, grazing};
use crate::figure::Studio;
use softstop_console::interrupt;
use softstop_console::progress::Progress;

/// The frequencies eta.
pub const RANGE: (f64, f64) = (1.5, 10.0);
/// The clearance rho: so small that impacts go on far above the resonance.
pub const NARROW: f64 = 0.1;

/// A stable subharmonic motion z = p/n that was found.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct Subharmonic {
    pub stiffness: f64,
    pub eta: f64,
    pub impacts: u64,
    pub periods: u64,
    /// Whether the impact-less motion exists there, too.
    pub is_beside_rest: bool,
}

/// All that are found from scratch.
pub(super) fn subharmonics(stiffnesses: &[f64], studio: &Studio) -> Result<Vec<Subharmonic>> {
    let (frequencies, starts) = studio.detail.pick((72, 64), (18, 32));
    let places = stiffnesses.iter().flat_map(|&stiffness| {
        (0..frequencies).map(move |index| (stiffness, at(index, frequencies)))
    });
    let places: Vec<(f64, f64)> = places.collect();
    let progress = Progress::new(places.len() as u64, "searches for subharmonic motions");
    let found = studio.each("subharmonics", &places, |&(stiffness, frequency)| {
        progress.step()?;
        found(stiffness, frequency, starts)
    });
    Ok(found?.concat())
}

/// Frequencies with equal ratios.
fn at(index: usize, frequencies: usize) -> f64 {
    let share = index as f64 / (frequencies - 1) as f64;
    RANGE.0 * (RANGE.1 / RANGE.0).powf(share)
}

fn found(stiffness: f64, eta: f64, starts: usize) -> Result<Vec<Subharmonic>> {
    let (lower, upper) = grazing(NARROW);
    let options = SearchOptions {
        starts,
        transient: 300,
        patience: 2_000,
        ..SearchOptions::default()
    };
    let scene = Law::KelvinVoigt(stiffness).scene(eta, NARROW);
    let survey = find_attractors(&scene, &options, &interrupt::watch)?;
    let motions = survey.attractors.iter();
    let orbits = motions.filter_map(|it| it.orbit.as_deref());
    let sub = orbits.filter(|orbit| orbit.periods > 1 && !orbit.impacts.is_empty());
    let motion = |orbit: &Orbit| Subharmonic {
        stiffness,
        eta,
        impacts: orbit.impacts.len() as u64,
        periods: orbit.periods,
        is_beside_rest: eta < lower || eta > upper,
    };
    Ok(sub.map(motion).collect())
}

/// Longest period in drive periods of one impact among those of a stop that are beside the impact-less motion, or
/// that are not; 0 if there is none.
pub fn longest(found: &[Subharmonic], stiffness: f64, is_beside: bool) -> u64 {
    let own = found.iter().filter(|motion| motion.stiffness == stiffness);
    let fit = own.filter(|it| it.impacts == 1 && it.is_beside_rest == is_beside);
    fit.map(|motion| motion.periods).max().unwrap_or(0)
}
