//! Directional derivatives of the outputs.
//!
//! After initialisation they lead from the beginning of the last communication step to its end, across
//! every crossing in between: from `force` as it was set for that step, and, over the first step, from
//! the initial state. If `force` has been set since, the step behind is over and what is left is its
//! direct feedthrough. In initialisation all real parameters are knowns as well.

use softstop::tangent::{Perturbation, Sensitivity};

use crate::error::{Fault, argument};
use crate::instance::{Instance, Lifecycle};
use crate::start::Slot;
use crate::values::{Type, find};
use crate::variables::{Access, Kind, Variable, View};

impl Instance {
    /// The derivatives of `unknowns` along the direction `seed` of `knowns`.
    ///
    /// # Errors
    /// For a variable that is no real output, a known that the outputs have no derivative by at this
    /// time, a seed that is not finite, and before initialisation.
    pub fn directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        sensitivity: &mut [f64],
    ) -> Result<(), Fault> {
        self.ready_for_outputs()?;
        let rows = unknowns
            .iter()
            .map(|&reference| unknown(reference))
            .collect::<Result<Vec<_>, _>>()?;
        let (by, parameters) = self.direction(knowns, seed)?;
        let along = match &self.simulation {
            Some(simulation) => simulation.sensitivity(&by).map_err(Fault::from)?,
            None => Sensitivity::default(),
        };
        for (row, value) in rows.iter().zip(sensitivity.iter_mut()) {
            *value = (row.derivative)(&along);
        }
        for (parameter, seed) in parameters {
            for (row, value) in rows.iter().zip(sensitivity.iter_mut()) {
                *value += seed * self.by_parameter(parameter, row.value)?;
            }
        }
        Ok(())
    }

    /// The direction as a change of state and force, and the parameters that change with it.
    fn direction(
        &self,
        knowns: &[u32],
        seed: &[f64],
    ) -> Result<(Perturbation, Vec<Seeded>), Fault> {
        let mut by = Perturbation::default();
        let mut parameters = Vec::new();
        let at_start = self
            .simulation
            .as_ref()
            .is_some_and(softstop::Simulation::is_marked_at_start);
        for (&reference, &seed) in knowns.iter().zip(seed) {
            if !seed.is_finite() {
                return Err(argument("dvKnown", seed, "finite"));
            }
            let variable = find(reference, Type::Real)?;
            match variable.access {
                Access::Force => by.force += seed,
                Access::Parameter { slot, .. } if slot == Slot::INITIAL_POSITION && at_start => {
                    by.position += seed;
                }
                Access::Parameter { slot, .. } if slot == Slot::INITIAL_VELOCITY && at_start => {
                    by.velocity += seed;
                }
                Access::Parameter { .. } if self.lifecycle() == Lifecycle::Initializing => {
                    parameters.push((variable, seed));
                }
                _ => return Err(no_known(variable)),
            }
        }
        Ok((by, parameters))
    }

    /// The derivative of an output at the start by a parameter: outputs at the start are elementary
    /// functions of the parameters, so differences extrapolated to width zero (Richardson 1911) come
    /// within some 1e-10 of it. They keep to one side where the law of the motion, or the range of the
    /// parameter, ends; of one that cannot be changed at all the derivative is zero.
    fn by_parameter(&self, parameter: &Variable, output: fn(&View) -> f64) -> Result<f64, Fault> {
        let (Access::Parameter { slot, .. }, Kind::Real(kind)) = (parameter.access, parameter.kind)
        else {
            return Err(no_known(parameter));
        };
        let value = self.parameters.get(slot);
        let here = self.at_start_with(slot, value, output)?;
        let mut width = if value == 0.0 {
            1e-3
        } else {
            0.01 * value.abs()
        };
        for _ in 0..WIDTHS {
            let at = |step: f64| {
                let moved = Some(value + step * width).filter(|moved| kind.contains(*moved))?;
                let moved = self.at_start_with(slot, moved, output).ok()?;
                (moved.1 == here.1).then_some(moved.0)
            };
            let central = |n: f64| Some((at(n)? - at(-n)?) / (2.0 * n * width));
            if let (Some(one), Some(two), Some(four)) = (central(0.25), central(0.5), central(1.0))
            {
                let (fine, coarse) = ((4.0 * one - two) / 3.0, (4.0 * two - four) / 3.0);
                return Ok((16.0 * fine - coarse) / 15.0);
            }
            for side in [1.0, -1.0] {
                let one_sided = |n: f64| Some((at(side * n)? - here.0) / (side * n * width));
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
                    return Ok((8.0 * second[0] - second[1]) / 7.0);
                }
            }
            width *= 0.1;
        }
        Ok(0.0)
    }

    /// An output and the phase at the start with another value of a parameter.
    fn at_start_with(
        &self,
        slot: Slot,
        value: f64,
        output: fn(&View) -> f64,
    ) -> Result<(f64, softstop::PhaseKind), Fault> {
        let mut other = self.clone();
        other.parameters.set(slot, value);
        other.simulation = None;
        let simulation = other.settle()?;
        let view = View::new(simulation);
        Ok((output(&view), view.sample().phase))
    }
}

/// Widths that a difference is tried with.
const WIDTHS: u32 = 8;

/// A parameter and how fast it changes along the direction.
type Seeded = (&'static Variable, f64);

/// How an unknown and its derivative are read.
struct Row {
    value: fn(&View) -> f64,
    derivative: fn(&Sensitivity) -> f64,
}

fn unknown(reference: u32) -> Result<Row, Fault> {
    let variable = find(reference, Type::Real)?;
    match variable.access {
        Access::Continuous {
            value, sensitivity, ..
        }
        | Access::Discrete { value, sensitivity } => Ok(Row {
            value,
            derivative: sensitivity,
        }),
        _ => Err(Fault::NoUnknown {
            name: variable.name,
        }),
    }
}

fn no_known(variable: &Variable) -> Fault {
    Fault::NoKnown {
        name: variable.name,
    }
}
