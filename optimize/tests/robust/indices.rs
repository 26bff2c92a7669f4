//! Sobol' indices: functions with known ones, and machines.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use approx::assert_relative_eq;
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::zone;
use softstop_optimize::robust::{Estimate, SampleSize, indices, scatter, sensitivities};

use super::{Outcome, press, shop, spread};

/// An estimate is right within five of its standard errors, or so much of rounding.
#[track_caller]
fn agrees(estimate: Estimate, known: f64, largest_error: f64) {
    let off = (estimate.value - known).abs();
    assert!(off <= 5.0 * estimate.error + 1e-12, "{estimate:?} {known}");
    assert!(estimate.error <= largest_error, "{estimate:?}");
}

#[test]
fn ishigami() -> Outcome {
    let (a, b) = (7.0, 0.1);
    let function = |at: &[f64]| {
        let [x, y, z] = [at[0], at[1], at[2]].map(|at| PI * at);
        Some([x.sin() + a * y.sin().powi(2) + b * z.powi(4) * x.sin()])
    };
    let [found] = indices(3, SampleSize::default(), function, &unmonitored).ok_or("indices")?;
    let pi = PI.powi(4);
    let variance = a * a / 8.0 + b * pi / 5.0 + b * b * pi * pi / 18.0 + 0.5;
    let alone = 0.5 * (1.0 + b * pi / 5.0).powi(2) / variance;
    let second = a * a / 8.0 / variance;
    let together = b * b * pi * pi * (1.0 / 18.0 - 1.0 / 50.0) / variance;
    for (found, first) in found.iter().zip([alone, second, 0.0]) {
        agrees(found.first, first, 0.01);
    }
    for (found, total) in found.iter().zip([alone + together, second, together]) {
        agrees(found.total, total, 0.01);
    }
    Ok(())
}

#[test]
fn shares_of_a_sum_are_those_of_its_parts() -> Outcome {
    let weights = [3.0, -2.0, 1.0, 0.0];
    let sum = |at: &[f64]| {
        let parts = at.iter().zip(weights).map(|(at, weight)| at * weight);
        let sum: f64 = parts.sum();
        Some([sum, 1e6 + sum])
    };
    let found = indices(4, SampleSize::default(), sum, &unmonitored).ok_or("indices")?;
    for found in found {
        for (index, weight) in found.iter().zip(weights) {
            agrees(index.first, weight * weight / 14.0, 0.01);
            agrees(index.total, weight * weight / 14.0, 0.01);
        }
        let sum: f64 = found.iter().map(|index| index.total.value).sum();
        assert_relative_eq!(sum, 1.0, epsilon = 1e-3);
    }
    Ok(())
}

#[test]
fn nothing_is_told_of_what_does_not_change_or_is_not_there() {
    let few = SampleSize {
        points: 16,
        sequences: 2,
    };
    let stop = |_: u64, _: u64| ControlFlow::Break(());
    assert!(indices(2, few, |_| Some([1.0]), &unmonitored).is_none());
    assert!(indices(2, few, |_| None::<[f64; 1]>, &unmonitored).is_none());
    assert!(indices(2, few, |at| Some([at[0]]), &stop).is_none());
}

#[test]
fn scatter_of_small_tolerances_is_that_of_the_slopes() -> Outcome {
    let machine = press()?;
    let (tolerances, nominal) = spread(&machine, &shop(&machine), 0.2)?;
    let effort = SampleSize {
        points: 256,
        sequences: 4,
    };
    let zone = zone::hysteresis(&machine.scene)?;
    let found = scatter(&tolerances, (&nominal, &zone), effort, &unmonitored)?;
    let found = found.ok_or("indices")?;
    let slopes = sensitivities(&tolerances, &nominal, &zone)?;
    let squares: f64 = slopes.velocity.iter().map(|slope| slope * slope).sum();
    for (index, slope) in found.velocity.iter().zip(&slopes.velocity) {
        let known = slope * slope / squares;
        assert!(
            (index.total.value - known).abs() < 0.02,
            "{index:?} {known}"
        );
        assert!(
            (index.first.value - known).abs() < 0.02,
            "{index:?} {known}"
        );
    }
    let sum: f64 = found.place.iter().map(|index| index.total.value).sum();
    assert!((sum - 1.0).abs() < 0.02, "{found:?}");
    Ok(())
}
