//! Parameters that follow others by an expression.

use super::{Machine, keys};
use crate::error::MachineError;
use crate::expression::Expression;
use crate::scene::Parameter;

/// The parameters of a machine that follow others, each after those that it follows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ties(Vec<Tie>);

/// A parameter that follows others.
#[derive(Debug, Clone, PartialEq)]
struct Tie {
    key: &'static str,
    quantity: Quantity,
    text: String,
    expression: Expression,
    /// What the names of the expression stand for.
    terms: Vec<Quantity>,
}

/// A parameter in the unit of a key.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Quantity {
    parameter: Parameter,
    /// In SI units; none for a preload as a deflection of the stop.
    unit: Option<f64>,
}

impl Ties {
    /// True if no parameter follows others.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl Quantity {
    fn value(self, machine: &Machine) -> f64 {
        let value = self.parameter.get(&machine.scene).unwrap_or(f64::NAN);
        let unit = match self.unit {
            Some(unit) => unit,
            None => Parameter::StopStiffness
                .get(&machine.scene)
                .unwrap_or(f64::NAN),
        };
        value / unit
    }
}

impl Machine {
    /// The expression that a parameter follows, if it follows others.
    pub fn expression(&self, parameter: Parameter) -> Option<&str> {
        self.tie_of(parameter).map(|(_, text)| text)
    }

    /// The key that is stated as an expression, and that.
    pub(super) fn tie_of(&self, parameter: Parameter) -> Option<(&'static str, &str)> {
        let mut ties = self.ties.0.iter();
        let tie = ties.find(|tie| tie.quantity.parameter == parameter)?;
        Some((tie.key, &tie.text))
    }

    /// A parameter that follows another one, at once or by others.
    pub fn follower(&self, of: Parameter) -> Option<Parameter> {
        let follows = |tie: &&Tie| tie.terms.iter().any(|term| term.parameter == of);
        let tie = self.ties.0.iter().find(follows)?;
        Some(tie.quantity.parameter)
    }

    /// The parameter of a key that may be changed by itself, and the key's unit, as [`Machine::stated`].
    ///
    /// # Errors
    /// As [`Machine::stated`]; [`MachineError::Follows`] if it follows others.
    pub fn free(&self, key: &str) -> Result<(Parameter, f64), MachineError> {
        let (parameter, unit) = self.stated(key)?;
        match self.expression(parameter) {
            None => Ok((parameter, unit)),
            Some(text) => Err(MachineError::Follows {
                key: self.name(parameter),
                text: text.to_owned(),
            }),
        }
    }

    /// Makes parameters follow others: keys of the file with expressions of other keys.
    ///
    /// # Errors
    /// [`MachineError`] with the line, the key and what is wrong with its expression.
    pub(super) fn tie(
        &mut self,
        stated: &[(String, String, Option<usize>)],
    ) -> Result<(), MachineError> {
        for (key, text, line) in stated {
            let wrong = |what: String| MachineError::Expression {
                line: *line,
                key: key.clone(),
                text: text.clone(),
                what,
            };
            let expression = Expression::parse(text).map_err(wrong)?;
            let parameter = self.parameter(key)?;
            self.untie(parameter);
            let otherwise = keys::stated_otherwise(&key.replace('-', "_"));
            if parameter == Parameter::Preload {
                self.preload_deflection = otherwise.map(|_| 0.0);
            }
            let quantity = self.quantity(key)?;
            let terms = expression.names().iter().map(|name| {
                let found = self.quantity(name);
                found.map_err(|error| wrong(error.to_string()))
            });
            let tie = Tie {
                key: match (otherwise, parameter) {
                    (None, _) => parameter.name(),
                    (Some(_), Parameter::Preload) => keys::DEFLECTION,
                    (Some(_), _) => keys::FREQUENCY_HZ,
                },
                quantity,
                text: text.clone(),
                terms: terms.collect::<Result<_, _>>()?,
                expression,
            };
            self.insert(tie).map_err(|what| wrong(what.to_owned()))?;
        }
        self.follow();
        Ok(())
    }

    /// Puts a tie after those that it follows and before those that follow it, else in the order of the parameters.
    fn insert(&mut self, tie: Tie) -> Result<(), &'static str> {
        let mut waiting = std::mem::take(&mut self.ties.0);
        waiting.push(tie);
        waiting.sort_by_key(|it| it.quantity.parameter);
        while !waiting.is_empty() {
            let is_ready = |tie: &Tie| {
                let mut others = waiting.iter();
                !others.any(|other| {
                    let mut terms = tie.terms.iter();
                    terms.any(|term| term.parameter == other.quantity.parameter)
                })
            };
            let place = waiting.iter().position(is_ready);
            let place = place.ok_or("follows itself, at once or by others")?;
            let tie = waiting.remove(place);
            self.ties.0.push(tie);
        }
        Ok(())
    }

    /// Lets a parameter follow nothing any more.
    pub(super) fn untie(&mut self, parameter: Parameter) {
        self.ties.0.retain(|it| it.quantity.parameter != parameter);
    }

    /// Lets go what this machine has no longer.
    pub(super) fn untie_missing(&mut self) {
        let scene = &self.scene;
        let has = |it: &Quantity| it.parameter.get(scene).is_some();
        self.ties
            .0
            .retain(|tie| has(&tie.quantity) && tie.terms.iter().all(has));
    }

    /// Sets all parameters that follow others.
    pub(super) fn follow(&mut self) {
        for index in 0..self.ties.0.len() {
            let tie = &self.ties.0[index];
            let values: Vec<f64> = tie.terms.iter().map(|term| term.value(self)).collect();
            let value = tie.expression.at(&values).value;
            let Quantity { parameter, unit } = tie.quantity;
            match unit {
                Some(unit) => parameter.set(&mut self.scene, value * unit),
                None => self.preload_deflection = Some(value),
            }
            self.follow_stiffness();
        }
    }

    fn quantity(&self, key: &str) -> Result<Quantity, MachineError> {
        if keys::stated_otherwise(&key.replace('-', "_")) == Some(Parameter::Preload) {
            let parameter = self.parameter(key)?;
            return Ok(Quantity {
                parameter,
                unit: None,
            });
        }
        let (parameter, unit) = self.stated(key)?;
        let unit = unit * self.to_si(parameter.about().dimension, 1.0);
        Ok(Quantity {
            parameter,
            unit: Some(unit),
        })
    }
}
