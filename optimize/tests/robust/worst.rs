//! The slowest impact between the bounds, and what changes it.

use approx::assert_relative_eq;
use rayon::prelude::*;
use softstop::Parameter;
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::spread_points::sobol_point;
use softstop_dynamics::{CycleMetrics, Orbit, zone};
use softstop_optimize::design::figure::{Figure, Sense};
use softstop_optimize::robust::{Tolerances, VerifySettings, Worst, sensitivities, verify, worst};
use softstop_optimize::spread::along;

use super::{Outcome, machines, press, shop, spread};

/// The machine that strikes the least.
fn slowest(spread: &Tolerances, nominal: &Orbit) -> Result<Worst, OrbitError> {
    let figures = [(Figure::Velocity, Sense::Least)];
    let mut found = worst(spread, nominal, &figures, &unmonitored)?;
    found.pop().ok_or(OrbitError::NotIsolated)
}

/// Of other figures, too, with exact derivatives and without.
#[test]
fn no_machine_is_beyond_the_worst() -> Outcome {
    let figures = [
        (Figure::StopForce, Sense::Most),
        (Figure::Stroke, Sense::Most),
        (Figure::DrivePower, Sense::Most),
        (Figure::ImpactPower, Sense::Least),
        (Figure::Multiplier, Sense::Most),
    ];
    for machine in machines()? {
        let (tolerances, nominal) = spread(&machine, &shop(&machine), 1.0)?;
        let all = worst(&tolerances, &nominal, &figures, &unmonitored)?;
        for index in 0..512 {
            let scene = tolerances.scene(&sobol_point(index, tolerances.dimensions()));
            let orbit = Orbit::find_near(&scene, nominal.state())?;
            let stroke = CycleMetrics::of(&orbit)?;
            for ((figure, sense), worst) in figures.iter().zip(&all) {
                let value = figure.of_motion(&orbit, &stroke).ok_or("a figure")?;
                let is_within = match sense {
                    Sense::Least => value >= worst.value,
                    Sense::Most => value <= worst.value,
                };
                assert!(is_within, "{figure:?}: {value} beyond {}", worst.value);
            }
        }
    }
    Ok(())
}

#[test]
fn no_machine_strikes_less_than_the_worst() -> Outcome {
    let few = VerifySettings {
        machines: 4096,
        enough: 1,
        first: 0,
    };
    for machine in machines()? {
        for factor in [1.0, 3.0] {
            let (tolerances, nominal) = spread(&machine, &shop(&machine), factor)?;
            let worst = slowest(&tolerances, &nominal)?;
            let least = worst.orbit.before_impact_velocity();
            assert!(worst.at.iter().all(|at| at.abs() <= 1.0));
            let sampled = verify(&tolerances, &nominal, (few, &[]), &unmonitored)?;
            let sampled = sampled.drawing.slowest;
            let loss = nominal.before_impact_velocity() - least;
            assert!(least <= sampled, "{least} {sampled}");
            assert!(sampled - least < 0.5 * loss, "{least} {sampled}");
        }
    }
    Ok(())
}

#[test]
fn a_dense_grid_finds_no_slower_impact() -> Outcome {
    let machine = press()?;
    let two = [(Parameter::Clearance, 10.0), (Parameter::Frequency, 2.0)];
    let (tolerances, nominal) = spread(&machine, &two, 1.0)?;
    let worst = slowest(&tolerances, &nominal)?;
    let least = worst.orbit.before_impact_velocity();
    let velocity = |index: usize| {
        let at = [index / 21, index % 21].map(|index| 0.1 * index as f64 - 1.0);
        let reached = along(&tolerances, &nominal, &at, 1.0)?;
        assert_eq!(reached.loss, None);
        Ok(reached.point.before_impact_velocity())
    };
    let all: Result<Vec<f64>, OrbitError> = (0..441).into_par_iter().map(velocity).collect();
    let grid = all?.into_iter().fold(f64::INFINITY, f64::min);
    assert!(grid >= least * (1.0 - 1e-9), "{grid} {worst:?}");
    assert!(grid <= least * 1.01, "{grid} {worst:?}");
    Ok(())
}

#[test]
fn sensitivities_are_those_of_machines_beside() -> Outcome {
    let step = 1e-3;
    for machine in machines()? {
        let (tolerances, nominal) = spread(&machine, &shop(&machine), 1.0)?;
        let found = sensitivities(&tolerances, &nominal, &zone::hysteresis(&machine.scene)?)?;
        for index in 0..tolerances.dimensions() {
            let beside = |change: f64| -> Result<[f64; 3], Box<dyn std::error::Error>> {
                let mut at = vec![0.0; tolerances.dimensions()];
                at[index] = change;
                let scene = tolerances.scene(&at);
                let orbit = Orbit::find_near(&scene, nominal.state())?;
                let zone = zone::hysteresis(&scene)?;
                let frequency = scene.excitation.frequency;
                Ok([
                    orbit.before_impact_velocity(),
                    zone.high.frequency - frequency,
                    frequency - zone.frequency_g0,
                ])
            };
            let (below, above) = (beside(-step)?, beside(step)?);
            let [to_fold, to_free] =
                [&found.to_fold, &found.to_free].map(|it| it.clone().unwrap_or_default());
            let exact = [&found.velocity, &to_fold, &to_free];
            for (which, exact) in exact.into_iter().enumerate() {
                let slope = (above[which] - below[which]) / (2.0 * step);
                let size = exact.iter().fold(0.0, |most: f64, one| most.max(one.abs()));
                assert_relative_eq!(exact[index], slope, epsilon = 2e-6 * size);
            }
        }
    }
    Ok(())
}
