//! Machines spread about a nominal one.

use approx::assert_relative_eq;
use softstop::{Machine, Parameter, Ratios};
use softstop_dynamics::orbit::find;
use softstop_dynamics::zone::{Loss, hysteresis};
use softstop_dynamics::{BranchLimits, Continuation, Orbit};
use softstop_optimize::robust::Distribution;
use softstop_optimize::spread::{
    AbsoluteTolerance, PolynomialModel, StableMotion, Tolerances, along,
};
use softstop_testing::assert_relative;

type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;

/// Other frequencies and clearances of a machine, by so large a share each, and its motion.
fn spread(ratios: Ratios, share: f64) -> Outcome<(Tolerances, Orbit)> {
    let scene = ratios.scene()?;
    let nominal = find(&scene)?;
    let tolerance = |parameter: Parameter| AbsoluteTolerance {
        parameter,
        half_width: share * parameter.get(&scene).unwrap_or(f64::NAN),
        distribution: Distribution::Box,
    };
    let tolerances = [Parameter::Frequency, Parameter::Clearance].map(tolerance);
    let machine = Machine::from(scene.clone());
    Ok((Tolerances::new(&machine, &tolerances)?, nominal))
}

#[test]
fn a_way_out_ends_at_the_fold_of_the_machine_there() -> Outcome {
    for ratios in [Ratios::unloaded(), Ratios::loaded()] {
        let (spread, nominal) = spread(ratios, 0.3)?;
        for to in [[1.0, 0.0], [1.0, 0.1], [1.0, -0.2], [0.9, 0.5]] {
            let reached = along(&spread, &nominal, &to, 1.0)?;
            assert_eq!(reached.loss, Some(Loss::Fold));
            let there = spread.scene(&to.map(|to| reached.share * to));
            let fold = hysteresis(&there)?.high.frequency;
            assert_relative(there.excitation.frequency, fold, 1e-8);
        }
    }
    Ok(())
}

#[test]
fn a_way_out_that_ends_in_a_flip_ends_at_that_of_its_branch() -> Outcome {
    let (spread, nominal) = spread(Ratios::loaded(), 0.5)?;
    let reached = along(&spread, &nominal, &[-1.0, 0.0], 1.0)?;
    assert_eq!(reached.loss, Some(Loss::Flip));
    let family =
        softstop_dynamics::ParameterFamily::new(spread.scene(&[0.0; 2]), [Parameter::Frequency])?;
    let limits = BranchLimits {
        range: (0.5, 1.2),
        points: 500,
    };
    let go_on = |_: &_| std::ops::ControlFlow::Continue(());
    let branch = Continuation::new(&family, 1).branch(1.15, nominal.state(), &limits, go_on)?;
    let test = softstop_dynamics::continuation::TestFunction::Flip;
    let flip = branch.critical_points(test).last().ok_or("a flip")?;
    let frequency = 1.15 * (1.0 - 0.5 * reached.share);
    assert_relative(frequency, flip.parameter, 1e-8);
    Ok(())
}

#[test]
fn what_settles_is_the_orbit() -> Outcome {
    for ratios in [Ratios::unloaded(), Ratios::loaded()] {
        let (spread, nominal) = spread(ratios, 0.01)?;
        for to in [[0.0, 0.0], [1.0, -1.0], [-0.3, 0.8]] {
            let scene = spread.scene(&to);
            let settled = StableMotion::near(&scene, nominal.state(), 1.0).ok_or("a motion")?;
            let is_away = to != [0.0, 0.0];
            let near = StableMotion::near(&scene, nominal.state(), 1e-9);
            assert_eq!(near.is_none(), is_away, "no farther than told");
            let orbit = Orbit::find_near(&scene, nominal.state())?;
            let velocity = orbit.before_impact_velocity();
            assert_relative(settled.velocity, velocity, 1e-9);
        }
    }
    Ok(())
}

#[test]
fn a_model_of_a_polynomial_is_that_polynomial() -> Outcome {
    let values = |at: &[f64]| [1.0 - 2.0 * at[0] * at[1] + at[2].powi(3), at[1] * at[1]];
    let place = |index: usize| -> Vec<f64> {
        let turn = |step: f64| 2.0 * (step * index as f64).fract() - 1.0;
        [0.618_034, 0.754_878, 0.569_840].map(turn).to_vec()
    };
    let places: Vec<Vec<f64>> = (0..PolynomialModel::wanted(3)).map(place).collect();
    let known: Vec<[f64; 2]> = places.iter().map(|at| values(at)).collect();
    let model = PolynomialModel::fit(&places, &known).ok_or("a model")?;
    for at in [[0.3, -0.9, 0.5], [1.0, 1.0, -1.0]] {
        for (found, value) in model.at(&at).into_iter().zip(values(&at)) {
            assert_relative_eq!(found, value, epsilon = 1e-10);
        }
    }
    Ok(())
}
