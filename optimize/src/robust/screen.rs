//! Whether machines are as required: by polynomials fitted to some of them where these leave no doubt, else by the motion.

use crate::spread::{PolynomialModel, StableMotion, Surrogate, is_inside};
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::parallel;
use softstop_dynamics::{CycleMetrics, Orbit};

use super::Tolerances;
use crate::design::cost::value_of_motion;
use crate::design::requirement::Requirement;

/// How many times the largest misfit of a polynomial a value has to lie within its bounds to be within them without doubt.
const RESERVE: f64 = 10.0;

/// Judges the machines of a spread.
pub(super) struct Screen<'a> {
    spread: &'a Tolerances,
    guide: Surrogate<'a>,
    required: &'a [Requirement],
    /// For two requirements each, with their largest misfits; none if too few of the machines that are known keep the motion.
    models: Option<Vec<(PolynomialModel, [f64; 2])>>,
}

impl<'a> Screen<'a> {
    /// About the motion of the nominal machine, from machines at some places of the box.
    ///
    /// # Errors
    /// [`OrbitError`] if the nominal motion is not one to start from.
    pub fn new(
        (spread, nominal): (&'a Tolerances, &'a Orbit),
        (places, required): (&[Vec<f64>], &'a [Requirement]),
    ) -> Result<Self, OrbitError> {
        let mut screen = Self {
            spread,
            guide: Surrogate::new(spread, nominal, places)?,
            required,
            models: None,
        };
        if !required.is_empty() {
            let values = parallel::filter_map(places, |at| {
                let values = screen.values(at, screen.guide.motion(at))?;
                Some((at.clone(), values))
            });
            let (kept, values): (Vec<Vec<f64>>, Vec<Vec<f64>>) = values.into_iter().unzip();
            // Polynomials of a few survivors tell nothing of what lies between them.
            let is_enough = 2 * kept.len() > places.len();
            screen.models = is_enough
                .then(|| models(&kept, &values, required.len()))
                .flatten();
        }
        Ok(screen)
    }

    /// The motion of a machine, if it keeps it, and whether it violates each requirement.
    pub fn judge(&self, at: &[f64]) -> (Option<StableMotion>, Vec<bool>) {
        let motion = self.guide.motion(at);
        (motion, self.violated(at, motion))
    }

    /// The figures of a machine in the order of the requirements; none if it has lost the motion, or one has no value.
    fn values(&self, at: &[f64], motion: Option<StableMotion>) -> Option<Vec<f64>> {
        let orbit = Orbit::find_near(&self.spread.scene(at), motion?.state).ok()?;
        let stroke = CycleMetrics::of(&orbit).ok()?;
        let cost = self.spread.cost();
        let value = |it: &Requirement| value_of_motion((it.figure, cost), &orbit, &stroke);
        self.required.iter().map(value).collect()
    }

    fn violated(&self, at: &[f64], motion: Option<StableMotion>) -> Vec<bool> {
        if motion.is_some() && self.is_clear(at) {
            return vec![false; self.required.len()];
        }
        match self.values(at, motion) {
            Some(values) => {
                let pairs = self.required.iter().zip(values);
                pairs.map(|(it, value)| !it.is_met(value)).collect()
            }
            None => vec![true; self.required.len()],
        }
    }

    /// True if the polynomials leave no doubt that a machine is as required.
    fn is_clear(&self, at: &[f64]) -> bool {
        let Some(models) = &self.models else {
            return self.required.is_empty();
        };
        let mut pairs = models.iter().zip(self.required.chunks(2));
        is_inside(at)
            && pairs.all(|((model, misfit), required)| {
                let values = model.at(at);
                let mut all = required.iter().zip(values).zip(misfit);
                all.all(|((it, value), misfit)| it.margin(value) > RESERVE * misfit)
            })
    }
}

fn models(
    places: &[Vec<f64>],
    values: &[Vec<f64>],
    count: usize,
) -> Option<Vec<(PolynomialModel, [f64; 2])>> {
    let pair = |first: usize| {
        let of = |row: &Vec<f64>| [row[first], row[(first + 1).min(count - 1)]];
        let pairs: Vec<[f64; 2]> = values.iter().map(of).collect();
        let model = PolynomialModel::fit(places, &pairs)?;
        let mut misfit = [0.0_f64; 2];
        for (at, pair) in places.iter().zip(&pairs) {
            for ((misfit, own), fitted) in misfit.iter_mut().zip(pair).zip(model.at(at)) {
                *misfit = misfit.max((own - fitted).abs());
            }
        }
        Some((model, misfit))
    };
    (0..count).step_by(2).map(pair).collect()
}
