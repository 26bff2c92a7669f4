//! The nearest machine that loses the motion.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use approx::assert_relative_eq;
use rayon::prelude::*;
use softstop::Parameter;
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::zone::{self, Loss};
use softstop_optimize::robust::{Manifold, Nearest, Norm, VerifySettings, nearest, verify};
use softstop_optimize::spread::along;

use super::{Outcome, machines, press, shop, spread};

const TWO: [(Parameter, f64); 2] = [(Parameter::Clearance, 2.0), (Parameter::Frequency, 2.0)];

/// Within which losses are looked for.
const FARTHEST: f64 = 10.0;

fn of<'a>(found: &'a [Nearest], manifold: &Manifold) -> Result<&'a Nearest, &'static str> {
    let own = found.iter().find(|one| one.manifold == *manifold);
    own.ok_or("a manifold that was not found")
}

#[test]
fn along_the_frequency_it_is_the_border_of_the_zone() -> Outcome {
    for machine in machines()? {
        let (tolerances, nominal) = spread(&machine, &[(Parameter::Frequency, 2.0)], 1.0)?;
        let zone = zone::hysteresis(&machine.scene)?;
        let frequency = machine.scene.excitation.frequency;
        for norm in [Norm::Box, Norm::Ball] {
            let found = nearest(&tolerances, &nominal, norm, 12.0, &unmonitored)?;
            let fold = of(&found, &Manifold::Motion(Loss::Fold))?;
            let share = (zone.high.frequency / frequency - 1.0) / 0.02;
            assert_relative_eq!(fold.distance, share, max_relative = 1e-8);
            assert!(fold.at[0] > 0.0);
            let free = of(&found, &Manifold::Hysteresis)?;
            let share = (1.0 - zone.frequency_g0 / frequency) / 0.02;
            assert_relative_eq!(free.distance, share, max_relative = 1e-12);
            assert!(free.at[0] < 0.0);
        }
    }
    Ok(())
}

#[test]
fn no_direction_of_a_dense_fan_leads_to_a_nearer_loss() -> Outcome {
    let machine = press()?;
    let (tolerances, nominal) = spread(&machine, &TWO, 1.0)?;
    for norm in [Norm::Box, Norm::Ball] {
        let found = nearest(&tolerances, &nominal, norm, 10.0, &unmonitored)?;
        let fold = of(&found, &Manifold::Motion(Loss::Fold))?;
        let distance = |index: usize| {
            let (sin, cos) = (TAU * index as f64 / 240.0).sin_cos();
            let length = match norm {
                Norm::Box => sin.abs().max(cos.abs()),
                Norm::Ball => 1.0,
            };
            let to = [cos / length, sin / length];
            let reached = along(&tolerances, &nominal, &to, 1.1 * fold.distance)?;
            Ok(reached.loss.map_or(f64::INFINITY, |_| reached.share))
        };
        let all: Result<Vec<f64>, OrbitError> = (0..240).into_par_iter().map(distance).collect();
        let least = all?.into_iter().fold(f64::INFINITY, f64::min);
        assert!(least >= fold.distance * (1.0 - 1e-8), "{least} {fold:?}");
        assert!(least <= fold.distance * 1.01, "{least} {fold:?}");
    }
    Ok(())
}

#[test]
fn no_machine_within_is_lost_and_some_are_just_outside() -> Outcome {
    let few = |machines| VerifySettings {
        machines,
        enough: 1,
        first: 0,
    };
    for machine in machines()? {
        for percent in [TWO.to_vec(), shop(&machine)] {
            let (tolerances, nominal) = spread(&machine, &percent, 1.0)?;
            let found = nearest(&tolerances, &nominal, Norm::Box, FARTHEST, &unmonitored)?;
            let mut lost = found
                .iter()
                .filter(|one| one.manifold != Manifold::Hysteresis);
            let least = lost.next();
            let factor = least.map_or(FARTHEST, |least| least.distance);
            let (within, _) = spread(&machine, &percent, 0.9999 * factor)?;
            let verdict = verify(&within, &nominal, (few(4096), &[]), &unmonitored)?;
            assert_eq!(
                verdict.drawing.lost, 0,
                "{:?} {percent:?} {found:?}",
                machine.name
            );
            let Some(least) = least else { continue };
            let worst: Vec<f64> = least.at.iter().map(|at| at / factor).collect();
            let end = along(&tolerances, &nominal, &worst, 1.0001 * factor)?;
            assert_eq!(end.loss.map(Manifold::Motion), Some(least.manifold.clone()));
            if percent.len() == 2 {
                let (outside, _) = spread(&machine, &percent, 1.02 * factor)?;
                let verdict = verify(&outside, &nominal, (few(1 << 15), &[]), &unmonitored)?;
                assert!(verdict.drawing.lost > 0, "{least:?}");
            }
        }
    }
    Ok(())
}

#[test]
fn a_watcher_stops_it() -> Outcome {
    let machine = press()?;
    let (tolerances, nominal) = spread(&machine, &TWO, 1.0)?;
    assert_eq!(tolerances.dimensions(), 2);
    let stopped = nearest(&tolerances, &nominal, Norm::Box, 10.0, &|_, _| {
        ControlFlow::Break(())
    });
    assert!(matches!(stopped, Err(OrbitError::Stopped)));
    Ok(())
}
