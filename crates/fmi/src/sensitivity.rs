//! Directional derivatives of the outputs.
//!
//! After initialisation they lead from the beginning of the last communication step to its end, across
//! every event in between: from continuous inputs as they were set for that step, and, over the first
//! step, from the initial state. If an input has been set since, the step behind is over and what is
//! left is its direct feedthrough. In initialisation all real parameters are knowns as well.
//!
//! For an importer that integrates they are those of the present outputs by its states and the continuous inputs, in event
//! mode by tunable parameters as well, under the law that holds.

use std::cell::Cell;

use crate::fault::Fault;
use crate::instance::Instance;
use crate::lifecycle::Lifecycle;
use crate::reading::{Type, find};
use crate::solving::{number_of_state, space_of};
use crate::unit::{Known, Row, Unit};
use crate::variable::{Access, Scaled, Slot, Tangent};

/// Widths that a difference is tried with.
const MAX_WIDTH_COUNT: u32 = 8;
/// Share of a derivative by which differences to both sides may disagree.
const MAX_RELATIVE_GAP: f64 = 1e-7;
/// Shares of a value and of its order of magnitude that rounding may bring, over the first width.
const RELATIVE_ROUNDING: f64 = 1e-10;
const NOMINAL_ROUNDING: f64 = 1e-13;
/// How many times as far the differences may disagree that agree best, if no width lets them agree.
const MAX_GAP_FACTOR: f64 = 100.0;

/// Its name, its value and its derivative.
type UnknownAccess<U> = (&'static str, Scaled<U>, Tangent<U, <U as Unit>::Tangent>);

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
        present.iter_mut().for_each(U::set_checkpoint);
        let unit = present.as_ref().unwrap_or(unit);
        let (direction, parameters) = self.direction(unit, knowns, seed)?;
        let along = unit.tangent(&direction)?;
        for (&(name, output, tangent), value) in outputs.iter().zip(sensitivity) {
            *value = tangent(&along, output);
            for &(parameter, slot, seed) in &parameters {
                *value += seed * self.by_parameter(unit, parameter, slot, output);
            }
            if !value.is_finite() {
                return Err(Fault::NoDerivative(name));
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
    /// parameter, ends; by a parameter that cannot change at all it is zero.
    fn by_parameter(
        &self,
        unit: &U,
        parameter: &Row<U>,
        slot: Slot,
        (output, nominal): Scaled<U>,
    ) -> f64 {
        let (value, here) = (self.values[slot.0], output(unit));
        let width = if value == 0.0 {
            1e-3
        } else {
            0.01 * value.abs()
        };
        let can_change = Cell::new(false);
        let slope = slope(here, nominal, width, |step| {
            let moved = value + step;
            let moved = parameter
                .kind
                .contains(moved)
                .then(|| self.with_parameter(unit, slot, moved));
            let moved = moved?.ok()?;
            can_change.set(true);
            let there = output(&moved);
            // What stays as it is may do so under another law.
            (there == here || moved.law() == unit.law()).then_some(there)
        });
        if can_change.get() { slope } else { 0.0 }
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
/// true one: `here` is its value, `nominal` the order of magnitude of that, `at` the value after a change of its argument, none
/// where it goes on otherwise. They become narrower until those to both sides agree, or keep to the only side that there is.
/// NaN where no width is narrow enough.
pub fn slope(here: f64, nominal: f64, mut width: f64, at: impl Fn(f64) -> Option<f64>) -> f64 {
    let rounding = (RELATIVE_ROUNDING * here.abs()).max(NOMINAL_ROUNDING * nominal) / width;
    let mut best = (f64::INFINITY, f64::NAN);
    for _ in 0..MAX_WIDTH_COUNT {
        let side = |width: f64| -> Option<[f64; 4]> {
            let mut slopes = [0.125 * width, 0.25 * width, 0.5 * width, width];
            for step in &mut slopes {
                *step = (at(*step)? - here) / *step;
            }
            Some(slopes)
        };
        let found = match (side(width), side(-width)) {
            (Some(right), Some(left)) => {
                let mean = std::array::from_fn(|k| 0.5 * (right[k] + left[k]));
                let gap = extrapolated(right, 2.0).0 - extrapolated(left, 2.0).0;
                let (finest, finer) = extrapolated(mean, 4.0);
                Some((gap.abs().max((finest - finer).abs()), finest))
            }
            (one, other) => one.or(other).map(|side| {
                let (finest, finer) = extrapolated(side, 2.0);
                ((finest - finer).abs(), finest)
            }),
        };
        if let Some((gap, slope)) = found {
            // In parts of what may pass.
            let gap = gap / (MAX_RELATIVE_GAP * slope.abs() + rounding);
            if gap <= 1.0 || gap.is_nan() {
                return slope;
            }
            if gap < best.0 {
                best = (gap, slope);
            }
        }
        width *= 0.1;
    }
    if best.0 <= MAX_GAP_FACTOR {
        best.1
    } else {
        f64::NAN
    }
}

/// The limit of differences of which each is half as wide as the next one, and that of all but the widest; the first term
/// of their errors falls by `ratio` from one to the next.
fn extrapolated(mut slopes: [f64; 4], ratio: f64) -> (f64, f64) {
    let (mut factor, mut before) = (1.0, slopes[0]);
    for count in (1..slopes.len()).rev() {
        (factor, before) = (factor * ratio, slopes[0]);
        for k in 0..count {
            slopes[k] = (factor * slopes[k] - slopes[k + 1]) / (factor - 1.0);
        }
    }
    (slopes[0], before)
}

/// The name of an unknown, and how it and its derivative are read.
fn unknown<U: Unit>(reference: u32) -> Result<UnknownAccess<U>, Fault> {
    let variable = find::<U>(reference, Type::REAL)?;
    match variable.access {
        Access::Continuous { value, tangent, .. } | Access::Discrete { value, tangent, .. } => {
            Ok((variable.name, (value, variable.kind.nominal()), tangent))
        }
        _ => Err(Fault::NoUnknown(variable.name)),
    }
}
