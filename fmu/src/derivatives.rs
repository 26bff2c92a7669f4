//! Time derivatives of inputs and outputs.

use crate::error::Fault;
use crate::instance::{Instance, Lifecycle};
use crate::values::{Type, find};
use crate::variables::{Access, View};

impl Instance {
    /// Sets time derivatives of the input `force`.
    ///
    /// # Errors
    /// For another variable, a value that is not finite, or an order other than 1 (a derivative of
    /// higher order may be set to zero).
    pub fn set_input_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &[f64],
    ) -> Result<(), Fault> {
        self.require_settable()?;
        let all = || references.iter().zip(orders).zip(values);
        for ((&reference, &order), &value) in all() {
            let variable = find(reference, Type::Real)?;
            let fault = |available| Fault::DerivativeOrder {
                name: variable.name,
                order,
                available,
            };
            if !matches!(variable.access, Access::Force) {
                return Err(fault("derivatives can be set of the input force only"));
            }
            if !value.is_finite() {
                return Err(Fault::OutOfRange {
                    name: variable.name,
                    value,
                    allowed: format!("finite (derivative of order {order})"),
                });
            }
            if order < 1 || (order > 1 && value != 0.0) {
                return Err(fault("order 1 is (and zeros of any higher order)"));
            }
        }
        for ((_, &order), &value) in all() {
            if order == 1 {
                self.push(self.force.at(self.time()), value);
            }
        }
        Ok(())
    }

    /// Reads time derivatives of outputs.
    ///
    /// # Errors
    /// Before initialisation, and for an order that the variable does not have.
    pub fn get_output_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &mut [f64],
    ) -> Result<(), Fault> {
        if self.lifecycle() == Lifecycle::Initializing {
            return Err(Fault::WrongState {
                state: self.lifecycle(),
                remedy: "derivatives of outputs can be read after initialisation",
            });
        }
        self.ready_for_outputs()?;
        let view = self.simulation.as_ref().map(View::new);
        for ((&reference, &order), value) in references.iter().zip(orders).zip(values) {
            let variable = find(reference, Type::Real)?;
            let derivative = match &variable.access {
                Access::Continuous { derivatives, .. } => usize::try_from(order)
                    .ok()
                    .and_then(|order| derivatives.get(order.checked_sub(1)?)),
                _ => None,
            };
            *value = view
                .as_ref()
                .zip(derivative)
                .map(|(view, derivative)| derivative(view))
                .ok_or(Fault::DerivativeOrder {
                    name: variable.name,
                    order,
                    available: "orders 1 and 2 of continuous outputs are",
                })?;
        }
        Ok(())
    }
}
