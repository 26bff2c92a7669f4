//! Parameters that outgrow the scales of their family, as where a machine's own value is tiny.

use super::curves::{followed, plane};
use super::*;
use softstop::{CheckedScene, MotionError};

/// A family with scales of its parameters that are tiny against their values.
#[derive(Debug)]
pub(crate) struct Outgrown<const N: usize>(pub ParameterFamily<N>);

impl<const N: usize> Family<N> for Outgrown<N> {
    fn scene(&self, parameters: [f64; N]) -> Result<CheckedScene, MotionError> {
        self.0.scene(parameters)
    }

    fn state_scales(&self) -> [f64; 2] {
        self.0.state_scales()
    }

    fn parameter_scales(&self) -> [f64; N] {
        self.0.parameter_scales().map(|scale| 1e-6 * scale)
    }

    fn by_frequency(&self) -> [Option<f64>; N] {
        self.0.by_frequency()
    }
}

/// Unknowns are the parameters in other units up to twenty scales, and grow as their logarithm beyond.
#[test]
fn unknowns_of_parameters_are_taken_back() {
    let family: &dyn Family<2> = &Outgrown(plane([Parameter::Frequency, Parameter::Clearance]));
    let scales = family.parameter_scales();
    for size in [0.0, 1.0, 19.0, 21.0, 1e3, 1e9] {
        let values = [size * scales[0], -size * scales[1]];
        let unknowns = family.scaled_parameters(values);
        let back = family.unscaled_parameters(&unknowns);
        let slopes = family.parameter_derivatives(values);
        for index in 0..2 {
            let rounding = GROWN * values[index].abs();
            assert_near(back[index], values[index], rounding);
            let beside = |step: f64| {
                let mut moved = unknowns;
                moved[index] += step;
                family.unscaled_parameters(&moved)[index]
            };
            let slope = (beside(1e-4) - beside(-1e-4)) / 2e-4;
            assert_near(slope / slopes[index], 1.0, DIFFERENCED);
        }
    }
}

/// The branch of twice the period is the same, from flip to grazing.
#[test]
fn a_doubled_branch_is_that_of_usual_scales() {
    let flip = of_kind(&all_of_z1(), "PD").remove(0).point;
    let usual = double(&frequencies(1.15), 1, &flip);
    let found = double(&Outgrown(frequencies(1.15)), 1, &flip);
    assert_eq!(symbols(&found), symbols(&usual));
    for (found, usual) in found.specials.iter().zip(&usual.specials) {
        assert_near(found.point.parameter, usual.point.parameter, SOLVED);
    }
}

/// Curves in two parameters come as far.
#[test]
fn curves_are_those_of_usual_scales() {
    let parameters = [Parameter::Frequency, Parameter::Clearance];
    let ranges = [(0.9, 2.0), (9.0, 12.0)];
    let branch = all_of_z1();
    for symbol in ["G", "PD", "SN"] {
        let special = of_kind(&branch, symbol).remove(0);
        let usual = followed(&special, 1, &plane(parameters), 10.0, ranges);
        let found = followed(&special, 1, &Outgrown(plane(parameters)), 10.0, ranges);
        let ends = |curve: &Curve| {
            assert!(
                matches!(curve.ends, (CurveEnd::Range, CurveEnd::Range)),
                "{symbol}: {:?}",
                curve.ends
            );
            [0, curve.points.len() - 1].map(|index| curve.points[index].parameters)
        };
        for (found, usual) in ends(&found).iter().zip(ends(&usual)) {
            assert_near(found[0], usual[0], SOLVED);
            assert_near(found[1], usual[1], SOLVED);
        }
    }
}

/// Steps are shares of a parameter that has outgrown its scale, also where it falls again.
#[test]
fn steps_shrink_with_the_parameter() {
    let family = Outgrown(frequencies(0.9));
    let rest = frequencies(0.9).scene([0.9]).expect("a scene");
    let settled = rest.trajectory(Start::REST, 400).expect("a motion").end;
    let branch = branches::follow(&family, 1, (0.9, settled), (0.01, 0.91), 2000);
    let branch = branch.expect("a branch");
    assert!(
        matches!(branch.ends.0, BranchEnd::Range),
        "{:?}",
        branch.ends
    );
    let steps = branch.points.windows(2);
    let largest = steps
        .map(|pair| pair[1].parameter / pair[0].parameter)
        .fold(1.0, f64::max);
    assert!((1.01..1.02).contains(&largest), "{largest}");
}
