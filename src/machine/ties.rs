//! Parameters that follow others by an expression.

use super::{Machine, UnitSystem, keys};
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
        let own = |parameter: Parameter| parameter.get(&machine.scene).unwrap_or(f64::NAN);
        match (self.unit, machine.preload_deflection) {
            (Some(unit), _) => own(self.parameter) / unit,
            (None, Some(deflection)) => deflection,
            (None, None) => own(self.parameter) / own(Parameter::StopStiffness),
        }
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

    /// The parameters that follow another one, at once or by others.
    pub fn followers(&self, of: Parameter) -> Vec<Parameter> {
        let mut found = vec![of];
        for tie in &self.ties.0 {
            if tie.terms.iter().any(|term| found.contains(&term.parameter)) {
                found.push(tie.quantity.parameter);
            }
        }
        found.split_off(1)
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
            match (parameter, otherwise) {
                (Parameter::Preload, _) => self.preload_deflection = otherwise.map(|_| 0.0),
                (Parameter::Frequency, Some(_)) => self.unit_system = UnitSystem::Hertz,
                (Parameter::Frequency, None) if self.unit_system == UnitSystem::Hertz => {
                    self.unit_system = UnitSystem::Si;
                }
                _ => {}
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
        let mut waiting = self.ties.0.clone();
        waiting.push(tie);
        waiting.sort_by_key(|it| it.quantity.parameter);
        let mut ordered = Vec::new();
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
            ordered.push(waiting.remove(place));
        }
        self.ties = Ties(ordered);
        Ok(())
    }

    /// Lets a parameter follow nothing any more.
    pub(super) fn untie(&mut self, parameter: Parameter) {
        self.ties.0.retain(|it| it.quantity.parameter != parameter);
    }

    /// Forgets the expressions of parameters that this machine has no longer.
    ///
    /// # Errors
    /// [`MachineError::Expression`] if another one follows such a parameter.
    pub(super) fn untie_missing(&mut self) -> Result<(), MachineError> {
        let scene = &self.scene;
        let has = |it: &Quantity| it.parameter.get(scene).is_some();
        self.ties.0.retain(|tie| has(&tie.quantity));
        for tie in &self.ties.0 {
            if let Some(term) = tie.terms.iter().find(|term| !has(term)) {
                return Err(MachineError::Expression {
                    line: None,
                    key: tie.key.to_owned(),
                    text: tie.text.clone(),
                    what: format!("this stop has no {}", term.parameter.name()),
                });
            }
        }
        Ok(())
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

    /// The quantity of a key; the preload has both names, whichever of them states it.
    fn quantity(&self, key: &str) -> Result<Quantity, MachineError> {
        let parameter = self.parameter(key)?;
        if parameter == Parameter::Preload {
            let otherwise = keys::stated_otherwise(&key.replace('-', "_"));
            return Ok(Quantity {
                parameter,
                unit: otherwise.is_none().then_some(1.0),
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
