//! Directional derivatives of the outputs.
//!
//! After initialisation they lead from the beginning of the last communication step to its end, across
//! every event in between: from continuous inputs as they were set for that step, and, over the first
//! step, from the initial state. If an input has been set since, the step behind is over and what is
//! left is its direct feedthrough. In initialisation all real parameters are knowns as well.
//!
//! For an importer that integrates they are those of the present outputs by its states and the continuous inputs, in event
//! mode by tunable parameters as well, under the law that holds.

use crate::fault::Fault;
use crate::instance::Instance;
use crate::lifecycle::Lifecycle;
use crate::reading::{Type, find};
use crate::solving::{number_of_state, space_of};
use crate::unit::{Known, Row, Unit};
use crate::variable::{Access, Reading, Slot, Value};

/// Widths that a difference is tried with.
const WIDTHS: u32 = 8;

impl<U: Unit> Instance<U> {
    /// The derivatives of `unknowns` along the direction `seed` of `knowns`.
    pub(crate) fn directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        sensitivity: &mut [f64],
    ) -> Result<(), Fault> {
        self.ready_for_outputs()?;
        let outputs = unknowns
            .iter()
            .map(|&reference| unknown::<U>(reference))
            .collect::<Result<Vec<_>, _>>()?;
        let unit = self.begun()?;
        let mut present = self.exchange.as_ref().map(|_| unit.clone());
        present.iter_mut().for_each(U::mark);
        let unit = present.as_ref().unwrap_or(unit);
        let (direction, parameters) = self.direction(unit, knowns, seed)?;
        let along = unit.tangent(&direction)?;
        for (&(output, tangent), value) in outputs.iter().zip(sensitivity) {
            *value = tangent(&along, output);
            for &(parameter, slot, seed) in &parameters {
                *value += seed * self.by_parameter(unit, parameter, slot, output)?;
            }
        }
        Ok(())
    }

    /// The derivatives by each of `knowns` of the sum of `unknowns`, each of these taken `seed` times: the transposed of
    /// what [`Instance::directional_derivative`] multiplies by, column by column.
    pub(crate) fn adjoint_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        sensitivity: &mut [f64],
    ) -> Result<(), Fault> {
        let mut column = vec![0.0; unknowns.len()];
        if let Some(seed) = seed.iter().find(|seed| !seed.is_finite()) {
            return Err(Fault::argument("seed", *seed, "finite"));
        }
        for (&known, value) in knowns.iter().zip(sensitivity) {
            self.directional_derivative(unknowns, &[known], &[1.0], &mut column)?;
            *value = column.iter().zip(seed).map(|(of, seed)| of * seed).sum();
        }
        Ok(())
    }

    /// The direction as the unit knows it, and the parameters that change with it.
    #[expect(
        clippy::type_complexity,
        reason = "two lists, each taken apart at once"
    )]
    fn direction(
        &self,
        unit: &U,
        knowns: &[u32],
        seed: &[f64],
    ) -> Result<(Vec<(Known, f64)>, Vec<(&'static Row<U>, Slot, f64)>), Fault> {
        let (integrates, mut parameters) = (self.exchange.is_some(), Vec::new());
        let parameters_in = match integrates {
            true => Lifecycle::Event,
            false => Lifecycle::Initializing,
        };
        // With its states, if only as they are, a direction is one of the present state.
        let states = 0..usize::from(integrates) * space_of::<U>().states.len();
        let mut direction: Vec<_> = states.map(|state| (Known::State(state), 0.0)).collect();
        for (&reference, &seed) in knowns.iter().zip(seed) {
            if !seed.is_finite() {
                return Err(Fault::argument("dvKnown", seed, "finite"));
            }
            let variable = find::<U>(reference, Type::REAL)?;
            let known = match variable.access {
                Access::Signal(number) => Some(Known::Signal(number)),
                Access::Parameter { slot, tunable } if tunable || !integrates => {
                    Some(Known::Parameter(slot))
                }
                _ => number_of_state(variable)
                    .filter(|_| integrates)
                    .map(Known::State),
            };
            match known {
                Some(known) if unit.has_tangent(known) => direction.push((known, seed)),
                Some(Known::Parameter(slot)) if self.lifecycle == parameters_in => {
                    parameters.push((variable, slot, seed));
                }
                _ => {
                    return Err(Fault::NoKnown {
                        name: variable.name,
                        available: match integrates {
                            true => {
                                "states and continuous inputs, in event mode also by tunable parameters"
                            }
                            false => U::about().knowns,
                        },
                    });
                }
            }
        }
        Ok((direction, parameters))
    }

    /// The derivative of an output at the start, or of an importer that integrates now, by a parameter, of which such
    /// outputs are elementary functions. Differences keep to one side where the law of the motion, or the range of the
    /// parameter, ends.
    fn by_parameter(
        &self,
        unit: &U,
        parameter: &Row<U>,
        slot: Slot,
        output: Value<U>,
    ) -> Result<f64, Fault> {
        let (value, here) = (self.values[slot.0], output(unit));
        let width = if value == 0.0 {
            1e-3
        } else {
            0.01 * value.abs()
        };
        Ok(slope(here, width, |step| {
            let moved = value + step;
            let moved = parameter
                .kind
                .contains(moved)
                .then(|| self.with_parameter(unit, slot, moved));
            let moved = moved?.ok()?;
            (moved.law() == unit.law()).then(|| output(&moved))
        }))
    }

    /// The unit with another value of a parameter.
    fn with_parameter(&self, unit: &U, slot: Slot, value: f64) -> Result<U, Fault> {
        let mut other = self.clone();
        other.values[slot.0] = value;
        if self.exchange.is_some() {
            let mut tuned = unit.clone();
            tuned.tune(&other.values)?;
            return Ok(tuned);
        }
        other.unit = None;
        other.settle().cloned()
    }
}

/// The derivative of a function by differences extrapolated to width zero (Richardson 1911), within some 1e-10 of the
/// true one: `here` is its value, `at` that after a change of its argument, none where it goes on otherwise. Then they
/// keep to one side or become narrower; of what cannot be changed at all the derivative is zero.
pub fn slope(here: f64, mut width: f64, at: impl Fn(f64) -> Option<f64>) -> f64 {
    for _ in 0..WIDTHS {
        let central = |n: f64| Some((at(n * width)? - at(-n * width)?) / (2.0 * n * width));
        if let (Some(one), Some(two), Some(four)) = (central(0.25), central(0.5), central(1.0)) {
            let (fine, coarse) = ((4.0 * one - two) / 3.0, (4.0 * two - four) / 3.0);
            return (16.0 * fine - coarse) / 15.0;
        }
        for side in [1.0, -1.0] {
            let one_sided = |n: f64| Some((at(side * n * width)? - here) / (side * n * width));
            if let (Some(a), Some(b), Some(c), Some(d)) = (
                one_sided(0.125),
                one_sided(0.25),
                one_sided(0.5),
                one_sided(1.0),
            ) {
                let first = [2.0 * a - b, 2.0 * b - c, 2.0 * c - d];
                let second = [
                    (4.0 * first[0] - first[1]) / 3.0,
                    (4.0 * first[1] - first[2]) / 3.0,
                ];
                return (8.0 * second[0] - second[1]) / 7.0;
            }
        }
        width *= 0.1;
    }
    0.0
}

/// How an unknown and its derivative are read.
fn unknown<U: Unit>(reference: u32) -> Result<Reading<U, U::Tangent>, Fault> {
    let variable = find::<U>(reference, Type::REAL)?;
    match variable.access {
        Access::Continuous { value, tangent, .. } | Access::Discrete { value, tangent, .. } => {
            Ok((value, tangent))
        }
        _ => Err(Fault::NoUnknown(variable.name)),
    }
}
