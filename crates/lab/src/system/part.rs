//! A unit of the system, its variables by name, without the C functions between.

use anyhow::{Context, Result, anyhow};
use softstop_fmi::variable::Access;
use softstop_fmi::{Advance, Derivatives, Events, Imprint, Outcome, Row, Unit};

/// A unit under way and the values of its parameters and discrete inputs.
#[derive(Clone)]
pub(super) struct Part<U> {
    unit: U,
    values: Vec<f64>,
}

impl<U: Unit> Part<U> {
    /// A unit at time 0 with its start values, but for these.
    pub fn begin(imprint: &Imprint<U>, changes: &[(&str, f64)]) -> Result<Self> {
        let mut values = imprint.values().to_vec();
        for &(name, value) in changes {
            values[slot::<U>(name)?] = value;
        }
        let unit = told(U::begin(&values, 0.0))?;
        Ok(Self { unit, values })
    }

    /// The value of an output.
    pub fn get(&self, name: &str) -> Result<f64> {
        match row::<U>(name)?.access {
            Access::Continuous { value, .. } | Access::Discrete { value, .. } => {
                Ok(value(&self.unit))
            }
            Access::Integer { value, .. } => Ok(f64::from(value(&self.unit))),
            _ => Err(anyhow!("{name} is no output")),
        }
    }

    /// The value of a continuous output and its rate.
    pub fn get_moving(&self, name: &str) -> Result<(f64, f64)> {
        match row::<U>(name)?.access {
            Access::Continuous {
                value,
                derivatives: [rate, ..],
                ..
            } => Ok((value(&self.unit), rate(&self.unit))),
            _ => Err(anyhow!("{name} has no rate")),
        }
    }

    /// Sets a discrete input or a parameter that can be tuned.
    pub fn put(&mut self, name: &str, value: f64) -> Result<()> {
        let held = &mut self.values[slot::<U>(name)?];
        if *held == value {
            return Ok(());
        }
        *held = value;
        told(self.unit.tune(&self.values))
    }

    /// Lets a continuous input go on with this value and these derivatives.
    pub fn lead(&mut self, name: &str, known: &[f64]) -> Result<()> {
        let Access::Signal(number) = row::<U>(name)?.access else {
            return Err(anyhow!("{name} is no continuous input"));
        };
        let mut derivatives = Derivatives::default();
        for (own, known) in derivatives.iter_mut().zip(known) {
            *own = *known;
        }
        told(self.unit.drive(number, &derivatives))
    }

    /// Goes on to a time in s.
    pub fn advance(&mut self, until: f64) -> Result<()> {
        match told(self.unit.advance(until, &mut Events::default()))? {
            Advance::Arrived => Ok(()),
            Advance::Short { reason, .. } => Err(anyhow!(reason)),
        }
    }
}

fn row<U: Unit>(name: &str) -> Result<&'static Row<U>> {
    let row = U::about().table.by_name(name);
    row.with_context(|| format!("{} has no {name}", U::about().identifier))
}

fn slot<U: Unit>(name: &str) -> Result<usize> {
    let slot = row::<U>(name)?.slot();
    Ok(slot.with_context(|| format!("{name} is not set"))?.0)
}

fn told<T>(outcome: Outcome<T>) -> Result<T> {
    outcome.map_err(|error| anyhow!("{error}"))
}
