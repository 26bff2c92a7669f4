//! What becomes of any machine between the bounds.

use nalgebra::Vector2;

use super::{PolynomialModel, StableMotion, Tolerances, motion_of};
use softstop_dynamics::orbit::{Orbit, OrbitError};
use softstop_dynamics::parallel;

/// How many times farther from where they should be other motions may be than those that are known, and so far anyway, in
/// the scales of the motion.
const FARTHER: f64 = 10.0;
const NEAR_STATE: f64 = 1e-3;
/// Machines to which the nominal motion is followed before others are led to.
const FIRST_MACHINES: usize = 64;

/// Knows the z = 1 motions of some machines of a spread, and by them where those of the others are.
#[derive(Debug)]
pub struct Surrogate<'a> {
    spread: &'a Tolerances,
    nominal: &'a Orbit,
    states: PolynomialModel,
    /// How far from where a motion should be it may be found, in the scales of the motion.
    reach: f64,
}

/// True if coordinates lie between the bounds, where polynomials hold.
pub fn is_inside(at: &[f64]) -> bool {
    at.iter().all(|at| at.abs() <= 1.0)
}

impl<'a> Surrogate<'a> {
    /// Looks at machines at some places between the bounds; [`PolynomialModel::wanted`] says how many serve best. To the first of
    /// them the motion is followed; what those tell leads to the others.
    ///
    /// # Errors
    /// [`OrbitError::NotIsolated`] if the nominal motion is not one to start from.
    pub fn new(
        spread: &'a Tolerances,
        nominal: &'a Orbit,
        places: &[Vec<f64>],
    ) -> Result<Self, OrbitError> {
        let known_at =
            |place: &Vec<f64>, settled: StableMotion| (place.clone(), settled.state.into());
        let followed = |place: &Vec<f64>| {
            let settled = motion_of(spread, nominal, place, None)?;
            Some(known_at(place, settled))
        };
        let (first, others) = places.split_at(FIRST_MACHINES.min(places.len()));
        let mut known: Vec<(Vec<f64>, [f64; 2])> = parallel::filter_map(first, followed);
        known.push((vec![0.0; spread.dimensions()], nominal.state().into()));
        let scales = nominal.scene.motion_scales();
        let guide = |known: &[(Vec<f64>, [f64; 2])]| {
            let (places, states): (Vec<_>, Vec<_>) = known.iter().cloned().unzip();
            let model = PolynomialModel::fit(&places, &states).ok_or(OrbitError::NotIsolated)?;
            let missed = |(place, state): (&Vec<f64>, &[f64; 2])| {
                let miss = Vector2::from(model.at(place)) - Vector2::from(*state);
                scales.state(&miss).norm()
            };
            let farthest = places.iter().zip(&states).map(missed).fold(0.0, f64::max);
            Ok(Self {
                spread,
                nominal,
                states: model,
                reach: (FARTHER * farthest).max(NEAR_STATE),
            })
        };
        let rough: Self = guide(&known)?;
        let led = |place: &Vec<f64>| Some(known_at(place, rough.motion(place)?));
        known.extend(parallel::filter_map(others, led));
        guide(&known)
    }

    /// The motion at some coordinates that goes on from the nominal one: by Newton's method from where it should be, and where
    /// that is in any doubt or outside the bounds, by following it there. None if it is lost on the way.
    pub fn motion(&self, at: &[f64]) -> Option<StableMotion> {
        let guess = || (Vector2::from(self.states.at(at)), self.reach);
        motion_of(self.spread, self.nominal, at, is_inside(at).then(guess))
    }
}
