//! Time derivatives of inputs and outputs.

use softstop::flow::HIGHEST_ORDER;

use crate::error::Fault;
use crate::instance::{Instance, Lifecycle};
use crate::values::{Type, find};
use crate::variables::{Access, Kind, View};

/// The orders that can be set of the input `force`.
const AVAILABLE: &str = "orders 1 to 7 are (and zeros of any higher order)";
const _: () = assert!(HIGHEST_ORDER == 7);

/// An order that the force can have.
fn order_of(order: i32) -> Option<usize> {
    let order = usize::try_from(order).ok()?;
    (1..=HIGHEST_ORDER).contains(&order).then_some(order)
}

impl Instance {
    /// Sets time derivatives of the input `force` at the present time; those of other orders go on.
    ///
    /// # Errors
    /// For another variable, a value out of the range of the force, an order below 1, or one above
    /// [`HIGHEST_ORDER`] (a derivative of such an order may be set to zero).
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
            if let Kind::Real(kind) = &variable.kind
                && !kind.contains(value)
            {
                return Err(Fault::OutOfRange {
                    name: variable.name,
                    value,
                    allowed: format!("{} (derivative of order {order})", kind.range()),
                });
            }
            if order < 1 || (value != 0.0 && order_of(order).is_none()) {
                return Err(fault(AVAILABLE));
            }
        }
        let mut force = self.force.seen_from(self.time());
        for ((_, &order), &value) in all() {
            if let Some(order) = order_of(order) {
                force = force.with(order, value);
            }
        }
        self.push(force);
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
