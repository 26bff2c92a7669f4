//! Time derivatives of inputs and outputs.

use crate::fault::Fault;
use crate::instance::Instance;
use crate::lifecycle::Lifecycle;
use crate::reading::{Type, find};
use crate::signal::HIGHEST_ORDER;
use crate::unit::Unit;
use crate::variable::Access;

/// The orders that can be set of an input.
const AVAILABLE: &str = "orders 1 to 7 are (and zeros of any higher order)";
const _: () = assert!(HIGHEST_ORDER == 7);

impl<U: Unit> Instance<U> {
    /// Sets time derivatives of continuous inputs at the present time; those of other orders go on.
    pub(crate) fn set_input_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &[f64],
    ) -> Result<(), Fault> {
        self.require_settable()?;
        let now = self.time();
        let signals = self.signals.iter();
        let mut signals: Vec<_> = signals.map(|signal| signal.seen_from(now)).collect();
        let mut set = vec![false; signals.len()];
        for ((&reference, &order), &value) in references.iter().zip(orders).zip(values) {
            let variable = find::<U>(reference, Type::REAL)?;
            let fault = |available| Fault::DerivativeOrder {
                name: variable.name,
                order,
                available,
            };
            let Access::Signal(number) = variable.access else {
                return Err(fault("derivatives can be set of continuous inputs only"));
            };
            if !value.is_finite() {
                let range = format!("finite (derivative of order {order})");
                return Err(Fault::argument(variable.name, value, &range));
            }
            match usize::try_from(order) {
                Ok(order @ 1..=HIGHEST_ORDER) => signals[number][order] = value,
                _ if order < 1 || value != 0.0 => return Err(fault(AVAILABLE)),
                _ => {}
            }
            set[number] = true;
        }
        for (number, derivatives) in signals.into_iter().enumerate() {
            if set[number] {
                self.push(number, derivatives);
            }
        }
        Ok(())
    }

    /// Reads time derivatives of outputs.
    pub(crate) fn get_output_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &mut [f64],
    ) -> Result<(), Fault> {
        if matches!(self.lifecycle, Lifecycle::Initializing | Lifecycle::Event) {
            return Err(self.not_allowed("derivatives of outputs can be read after initialisation"));
        }
        self.ready_for_outputs()?;
        for ((&reference, &order), value) in references.iter().zip(orders).zip(values) {
            let variable = find::<U>(reference, Type::REAL)?;
            let derivative = match variable.access {
                Access::Continuous { derivatives, .. } => usize::try_from(order)
                    .ok()
                    .and_then(|order| derivatives.get(order.checked_sub(1)?)),
                _ => None,
            };
            let derivative = derivative.ok_or(Fault::DerivativeOrder {
                name: variable.name,
                order,
                available: "those of continuous outputs are, from order 1 to maxOutputDerivativeOrder",
            })?;
            *value = derivative(self.begun()?);
        }
        Ok(())
    }
}
