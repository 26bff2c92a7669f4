//! What becomes of any machine between the bounds.

use nalgebra::Vector2;
use rayon::prelude::*;

use super::{Model, Reached, Settled, Spread, along};
use crate::orbit::{Orbit, OrbitError};
use crate::zone::Loss;

/// Knows the z = 1 motions of some machines of a spread, and by them where those of the others are.
#[derive(Debug)]
pub struct Guide<'a, S: ?Sized> {
    spread: &'a S,
    nominal: &'a Orbit,
    states: Model<2>,
}

/// What becomes of the nominal motion in another machine.
#[derive(Debug, Clone)]
pub enum Fate {
    /// It goes on.
    Kept(Settled),
    /// It ends on the way there.
    Lost {
        /// At this share of the way.
        share: f64,
        /// By this.
        loss: Loss,
    },
}

impl<'a, S: Spread + ?Sized> Guide<'a, S> {
    /// Looks at machines at some places between the bounds; [`Model::wanted`] says how many serve best.
    ///
    /// # Errors
    /// [`OrbitError::NotIsolated`] if the nominal motion is not one to start from.
    pub fn new(spread: &'a S, nominal: &'a Orbit, places: &[Vec<f64>]) -> Result<Self, OrbitError> {
        let centre = vec![0.0; spread.dimensions()];
        let kept = |place: &Vec<f64>| {
            let reached = along(spread, nominal, place, 1.0).ok()?;
            let state = reached.point.state();
            (reached.loss.is_none()).then(|| (place.clone(), state.into()))
        };
        let mut known: Vec<(Vec<f64>, [f64; 2])> = places.par_iter().filter_map(kept).collect();
        known.push((centre, nominal.state().into()));
        let (places, states): (Vec<_>, Vec<_>) = known.into_iter().unzip();
        let states = Model::fit(&places, &states).ok_or(OrbitError::NotIsolated)?;
        Ok(Self {
            spread,
            nominal,
            states,
        })
    }

    /// What becomes of the nominal motion at some coordinates: by Newton's method from where the motion should be, and
    /// where that is in any doubt, by following it there.
    pub fn fate(&self, at: &[f64]) -> Fate {
        let guess = Vector2::from(self.states.at(at));
        if let Some(settled) = Settled::near(&self.spread.scene(at), guess) {
            return Fate::Kept(settled);
        }
        match along(self.spread, self.nominal, at, 1.0) {
            Ok(Reached {
                share,
                loss: Some(loss),
                ..
            }) => Fate::Lost { share, loss },
            Ok(reached) => Fate::Kept(Settled::of(&reached.point)),
            Err(error) => Fate::Lost {
                share: 0.0,
                loss: Loss::Lost(error),
            },
        }
    }
}
