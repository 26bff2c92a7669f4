//! Parameters of a machine that follow others by an expression (ties).

use super::{Machine, UnitSystem, keys};
use crate::error::MachineError;
use crate::expression::Expression;
use crate::scene::{Parameter, Quantity, Tie, Ties};

impl Machine {
    /// The key of a parameter that is stated as an expression, and the text of that.
    pub(super) fn tie_of(&self, parameter: Parameter) -> Option<(&'static str, &str)> {
        self.ties.tie_of(parameter).map(|tie| (tie.key, &*tie.text))
    }

    /// The expression by which a parameter is tied to others, if it is.
    pub fn expression(&self, parameter: Parameter) -> Option<&str> {
        Some(&self.ties.tie_of(parameter)?.text)
    }

    /// The parameters that are tied to another one, at once or by others.
    pub fn followers(&self, of: Parameter) -> Vec<Parameter> {
        let mut all: Vec<Parameter> = self.ties_to(of).parameters().collect();
        all.sort();
        all.dedup();
        all
    }

    /// What follows a parameter, at once or by others: after the stiffness of the stop a preload stated as a deflection, too.
    fn ties_to(&self, parameter: Parameter) -> Ties {
        let tied = self.ties.0.iter().find(|tie| tie.quantity.unit.is_none());
        let constant = || Some(Tie::of_deflection(self.preload_deflection?).into());
        let deflection = tied.cloned().or_else(constant);
        let (mut changed, mut found) = (vec![parameter], Vec::new());
        for tie in self.ties.0.iter() {
            if !tie.follows_any(&changed) {
                continue;
            }
            let own = tie.quantity.parameter;
            changed.push(own);
            found.push(tie.clone());
            if let (Parameter::StopStiffness, Some(deflection)) = (own, &deflection) {
                changed.push(Parameter::Preload);
                found.push(deflection.clone());
            }
        }
        Ties(found)
    }

    /// The parameter of a key that may be changed by itself, and the key's unit, as [`Machine::stated`].
    ///
    /// # Errors
    /// As [`Machine::stated`]; [`MachineError::Follows`] if it follows others.
    pub fn free_parameter(&self, key: &str) -> Result<(Parameter, f64), MachineError> {
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
    pub(super) fn tie_parameters(
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
            self.untie_parameter(parameter);
            let otherwise = keys::other_statement_of(&key.replace('-', "_"));
            match (parameter, otherwise) {
                (Parameter::Preload, _) => self.preload_deflection = otherwise.map(|_| 0.0),
                (Parameter::Frequency, Some(_)) => self.unit_system = UnitSystem::Hertz,
                (Parameter::Frequency, None) if self.unit_system == UnitSystem::Hertz => {
                    self.unit_system = UnitSystem::Si;
                }
                _ => {}
            }
            let quantity = self.quantity_of(key)?;
            let terms = expression.names().iter().map(|name| {
                let found = self.quantity_of(name);
                found.map_err(|error| wrong(error.to_string()))
            });
            let tie = Tie {
                key: match (otherwise, parameter) {
                    (None, _) => parameter.name(),
                    (Some(_), Parameter::Preload) => keys::PRELOAD_DEFLECTION,
                    (Some(_), _) => keys::FREQUENCY_HZ,
                },
                text: text.clone(),
                quantity,
                terms: terms.collect::<Result<_, _>>()?,
                expression,
            };
            self.add_tie(tie).map_err(|what| wrong(what.to_owned()))?;
        }
        self.update_followers();
        Ok(())
    }

    /// Puts a tie after those that it follows and before those that follow it, else in the order of the parameters.
    fn add_tie(&mut self, tie: Tie) -> Result<(), &'static str> {
        let mut waiting = self.ties.0.clone();
        waiting.push(tie.into());
        waiting.sort_by_key(|it| it.quantity.parameter);
        let mut ordered = Vec::new();
        while !waiting.is_empty() {
            let others: Vec<Parameter> = waiting.iter().map(|it| it.quantity.parameter).collect();
            let place = waiting.iter().position(|tie| !tie.follows_any(&others));
            let place = place.ok_or("follows itself, at once or by others")?;
            ordered.push(waiting.remove(place));
        }
        self.ties = Ties(ordered);
        Ok(())
    }

    /// Unties a parameter: it follows nothing any more.
    pub(super) fn untie_parameter(&mut self, parameter: Parameter) {
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

    /// Sets all parameters that are tied to others.
    pub(super) fn update_followers(&mut self) {
        self.update_preload();
        for index in 0..self.ties.0.len() {
            let tie = self.ties.0[index].clone();
            if tie.quantity.unit.is_none() {
                self.preload_deflection = Some(tie.value_in(&self.scene));
            }
            tie.apply_to(&mut self.scene);
            self.update_preload();
        }
        self.scene.followers = self.ties_to(Parameter::Frequency);
    }

    /// Computes the preload anew from the deflection that states it.
    fn update_preload(&mut self) {
        let stiffness = Parameter::StopStiffness.get(&self.scene);
        if let (Some(deflection), Some(stiffness)) = (self.preload_deflection, stiffness) {
            Parameter::Preload.set(&mut self.scene, deflection * stiffness);
        }
    }

    /// The quantity of a key; the preload has both names, whichever of them states it.
    fn quantity_of(&self, key: &str) -> Result<Quantity, MachineError> {
        let parameter = self.parameter(key)?;
        if parameter == Parameter::Preload {
            let otherwise = keys::other_statement_of(&key.replace('-', "_"));
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
