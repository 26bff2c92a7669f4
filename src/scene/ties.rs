//! Ties: parameters that follow others by an expression.

use std::sync::Arc;

use super::{Parameter, Scene};
use crate::expression::Expression;

/// A parameter that follows others.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tie {
    /// The key that states the parameter, and the text of the expression.
    pub key: &'static str,
    pub text: String,
    pub quantity: Quantity,
    pub expression: Expression,
    /// What the names of the expression stand for.
    pub terms: Vec<Quantity>,
}

impl Tie {
    /// The tie of a preload that stays the same deflection of the stop.
    pub fn of_deflection(deflection: f64) -> Self {
        Self {
            key: "stop.preload_deflection",
            text: deflection.to_string(),
            quantity: Quantity {
                parameter: Parameter::Preload,
                unit: None,
            },
            expression: Expression::constant(deflection),
            terms: Vec::new(),
        }
    }

    /// The value of the tied parameter, divided by the unit of its key.
    pub fn value_in(&self, scene: &Scene) -> f64 {
        let values: Vec<f64> = self.terms.iter().map(|term| term.value_in(scene)).collect();
        self.expression.eval(&values).value
    }

    /// Sets the tied parameter in a scene.
    pub fn apply_to(&self, scene: &mut Scene) {
        let value = self.value_in(scene) * self.quantity.unit_in(scene);
        self.quantity.parameter.set(scene, value);
    }

    /// Derivative of the tied parameter in SI units, where those of some parameters are known and all others are constant.
    fn derivative_in(&self, scene: &Scene, rates: &[(Parameter, f64)]) -> f64 {
        let of = |parameter: Parameter| {
            let known = rates.iter().find(|(own, _)| *own == parameter);
            known.map_or(0.0, |(_, rate)| *rate)
        };
        let of_unit = |quantity: Quantity| match quantity.unit {
            Some(_) => 0.0,
            None => of(Parameter::StopStiffness),
        };
        let values: Vec<f64> = self.terms.iter().map(|term| term.value_in(scene)).collect();
        let own = self.expression.eval(&values);
        let terms = self.terms.iter().zip(&values).zip(&own.by);
        let by_terms = terms.map(|((term, value), by)| {
            by * (of(term.parameter) - value * of_unit(*term)) / term.unit_in(scene)
        });
        by_terms.sum::<f64>() * self.quantity.unit_in(scene) + own.value * of_unit(self.quantity)
    }

    /// True if the tie's expression has one of these parameters.
    pub fn follows_any(&self, parameters: &[Parameter]) -> bool {
        let mut terms = self.terms.iter();
        terms.any(|term| parameters.contains(&term.parameter))
    }
}

/// Parameters that follow others, each after those that it follows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ties(pub(crate) Vec<Arc<Tie>>);

impl Ties {
    /// No parameter follows others.
    pub const NONE: Self = Self(Vec::new());

    /// True if there is no tie: no parameter follows others.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The tied parameters, which follow others.
    pub fn parameters(&self) -> impl Iterator<Item = Parameter> + '_ {
        self.0.iter().map(|tie| tie.quantity.parameter)
    }

    /// The tie of a parameter, if it follows others.
    pub(crate) fn tie_of(&self, parameter: Parameter) -> Option<&Tie> {
        let mut ties = self.0.iter().map(AsRef::as_ref);
        ties.find(|tie: &&Tie| tie.quantity.parameter == parameter)
    }
}

impl Scene {
    /// This machine at another frequency of its drive, in rad/s, with what follows it.
    #[must_use]
    pub fn at_frequency(&self, frequency: f64) -> Self {
        let mut scene = self.clone();
        scene.excitation.frequency = frequency;
        for tie in &self.followers.0 {
            tie.apply_to(&mut scene);
        }
        scene
    }

    /// Derivatives in SI units by the drive's frequency in rad/s of what follows it, by the chain rule.
    #[doc(hidden)]
    pub fn rates_of_followers(&self) -> Vec<(Parameter, f64)> {
        let mut rates = vec![(Parameter::Frequency, 1.0)];
        for tie in &self.followers.0 {
            let parameter = tie.quantity.parameter;
            let rate = tie.derivative_in(self, &rates);
            rates.retain(|(own, _)| *own != parameter);
            rates.push((parameter, rate));
        }
        rates.split_off(1)
    }
}

/// A parameter in the unit of a key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Quantity {
    pub parameter: Parameter,
    /// In SI units; none for a preload as a deflection of the stop.
    pub unit: Option<f64>,
}

impl Quantity {
    /// The unit of the quantity in a scene, in SI units: that of a preload as a deflection is the stiffness of the stop.
    pub fn unit_in(self, scene: &Scene) -> f64 {
        let stiffness = || Parameter::StopStiffness.get(scene).unwrap_or(f64::NAN);
        self.unit.unwrap_or_else(stiffness)
    }

    /// The value of the quantity in a scene; not a number if the scene lacks it.
    pub fn value_in(self, scene: &Scene) -> f64 {
        self.parameter.get(scene).unwrap_or(f64::NAN) / self.unit_in(scene)
    }
}
