//! Machines one by one.

use std::ops::ControlFlow;

use approx::assert_relative_eq;
use softstop::{Machine, Parameter, SceneError, Units};
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::spread_points::{SEQUENCE_LENGTH, sobol_point};
use softstop_dynamics::zone::Loss;
use softstop_dynamics::{Orbit, zone};
use softstop_optimize::robust::{
    AbsoluteTolerance, Distribution, Tolerances, VerifySettings, verify,
};
use softstop_optimize::spread::along;

use super::{Outcome, machines, press, shop, spread};

const FEW: VerifySettings = VerifySettings {
    machines: 4096,
    enough: usize::MAX,
    first: 0,
};

#[test]
fn points_fill_every_layer_of_every_coordinate_once() {
    for block in [0, 5] {
        for dimension in 0..8 {
            let mut layers = vec![0; SEQUENCE_LENGTH];
            for index in 0..SEQUENCE_LENGTH {
                let at = sobol_point(block * SEQUENCE_LENGTH + index, 8)[dimension];
                layers[(0.5 * (at + 1.0) * SEQUENCE_LENGTH as f64) as usize] += 1;
            }
            assert!(layers.iter().all(|points| *points == 1));
        }
    }
}

#[test]
fn a_machine_is_lost_if_its_drive_is_faster_than_the_fold() -> Outcome {
    for mut machine in machines()? {
        let fold = zone::hysteresis(&machine.scene)?.high.frequency;
        Parameter::Frequency.set(&mut machine.scene, 0.99 * fold);
        let (tolerances, nominal) = spread(&machine, &[(Parameter::Frequency, 2.0)], 1.0)?;
        let some = VerifySettings {
            machines: 512,
            ..FEW
        };
        let verdict = verify(&tolerances, &nominal, (some, &[]), &unmonitored)?;
        let frequency = |index| {
            tolerances
                .scene(&sobol_point(index, 1))
                .excitation
                .frequency
        };
        let beyond = (0..some.machines)
            .filter(|index| frequency(*index) > fold)
            .count();
        assert!(beyond > some.machines / 10);
        let lost = verdict.drawing.lost;
        assert_eq!((verdict.machines, lost), (some.machines, beyond));
        for index in (0..some.machines)
            .filter(|index| frequency(*index) > fold)
            .take(8)
        {
            let at = sobol_point(index, 1);
            let lost = along(&tolerances, &nominal, &at, 1.0)?;
            let share = (fold / (0.99 * fold) - 1.0) / (0.02 * at[0]);
            assert_relative_eq!(lost.share, share, max_relative = 1e-8);
            assert_eq!(lost.loss, Some(Loss::Fold));
        }
    }
    Ok(())
}

#[test]
fn every_velocity_is_that_of_the_orbit() -> Outcome {
    for machine in machines()? {
        let (tolerances, nominal) = spread(&machine, &shop(&machine), 1.0)?;
        let verdict = verify(&tolerances, &nominal, (FEW, &[]), &unmonitored)?;
        assert_eq!(verdict.drawing.lost, 0);
        let known = &verdict.velocities;
        for index in (0..FEW.machines).step_by(16) {
            let scene = tolerances.scene(&sobol_point(index, tolerances.dimensions()));
            let orbit = Orbit::find_near(&scene, nominal.state())?;
            assert!(orbit.is_stable());
            let velocity = orbit.before_impact_velocity();
            let least = known.partition_point(|it| *it < velocity * (1.0 - 1e-9));
            assert_relative_eq!(known[least], velocity, max_relative = 1e-9);
        }
        assert_eq!(known.first(), Some(&verdict.drawing.slowest));
        let bins = verdict.histogram(20);
        assert_eq!(
            bins.iter().map(|(_, machines)| machines).sum::<usize>(),
            FEW.machines
        );
    }
    Ok(())
}

#[test]
fn ratios_and_si_tell_the_same() -> Outcome {
    let machine = Machine::named("loaded").ok_or("point B")?;
    let units = Units {
        mass: 120.0,
        stiffness: 2.4e6,
        force: 9e3,
    };
    let dimensional = Machine::from(machine.scene.in_units(units)?);
    let unit = units.length() * units.frequency();
    let mut means = Vec::new();
    for machine in [machine.clone(), dimensional] {
        let (tolerances, nominal) =
            spread(&machine, &shop(&Machine::named("loaded").ok_or("B")?), 1.0)?;
        let verdict = verify(&tolerances, &nominal, (FEW, &[]), &unmonitored)?;
        let sum: f64 = verdict.velocities.iter().sum();
        means.push(sum / verdict.velocities.len() as f64);
    }
    assert_relative_eq!(means[0] * unit, means[1], max_relative = 1e-9);
    Ok(())
}

#[test]
fn any_number_of_threads_tells_the_same() -> Outcome {
    let machine = press()?;
    let (tolerances, nominal) = spread(&machine, &shop(&machine), 9.0)?;
    let some = VerifySettings {
        machines: 1024,
        ..FEW
    };
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()?;
        let verdict = pool.install(|| verify(&tolerances, &nominal, (some, &[]), &unmonitored))?;
        assert!(verdict.drawing.lost > 0);
        Ok::<_, Box<dyn std::error::Error>>(format!("{verdict:?}"))
    };
    assert_eq!(with(1)?, with(3)?);
    Ok(())
}

#[test]
fn enough_lost_machines_or_a_watcher_end_it() -> Outcome {
    let machine = press()?;
    let (tolerances, nominal) = spread(&machine, &shop(&machine), 9.0)?;
    let settings = VerifySettings {
        machines: 4 * SEQUENCE_LENGTH,
        enough: 10,
        first: 0,
    };
    let verdict = verify(&tolerances, &nominal, (settings, &[]), &unmonitored)?;
    assert!(verdict.drawing.lost >= 10 && verdict.machines < SEQUENCE_LENGTH);
    let stopped = verify(&tolerances, &nominal, (settings, &[]), &|_, _| {
        ControlFlow::Break(())
    })?;
    assert_eq!((stopped.machines, stopped.velocities.len()), (0, 0));
    Ok(())
}

#[test]
fn a_preload_stated_as_a_deflection_follows_the_stiffness() -> Outcome {
    let machine = press()?;
    let stiffness = Parameter::StopStiffness;
    let (tolerances, _) = spread(
        &machine,
        &[(stiffness, 2.0), (Parameter::Preload, 1.0)],
        1.0,
    )?;
    let scene = tolerances.scene(&[1.0, -1.0]);
    let value = |parameter: Parameter| parameter.get(&scene).ok_or("a preloaded stop");
    assert_relative_eq!(value(stiffness)?, 1.02 * 1.68e7, max_relative = 1e-12);
    let preload = 1.02 * 1.68e7 * 0.99 * 0.0375;
    assert_relative_eq!(value(Parameter::Preload)?, preload, max_relative = 1e-12);
    Ok(())
}

#[test]
fn tolerances_of_nothing_or_of_what_is_not_there_are_refused() -> Outcome {
    let machine = Machine::named("unloaded").ok_or("point A")?;
    let with = |parameter, half_width| {
        let tolerance = AbsoluteTolerance {
            parameter,
            half_width,
            distribution: Distribution::Box,
        };
        Tolerances::new(&machine, &[tolerance]).err()
    };
    for parameter in [Parameter::Thickness, Parameter::Mass] {
        assert!(matches!(with(parameter, 0.1), Some(SceneError::Lacks(_))));
    }
    for half_width in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = with(Parameter::Clearance, half_width);
        assert!(
            matches!(refused, Some(SceneError::OutOfRange { .. })),
            "{refused:?}"
        );
    }
    Ok(())
}
