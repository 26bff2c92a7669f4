//! The branch of z = 1 from grazing to grazing, with its flip and its fold.

use approx::assert_abs_diff_eq;
use std::ops::ControlFlow;

use softstop::{Parameter, Ratios};
use softstop_dynamics::{BranchLimits, Continuation, ParameterFamily, orbit};

/// Runs the example.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Ratios::unloaded().scene()?;
    let state = orbit::find(&scene)?.state();
    let family = ParameterFamily::new(scene, [Parameter::Frequency])?;
    let limits = BranchLimits {
        range: (0.9, 1.5),
        points: 500,
    };
    let continuation = Continuation::new(&family, 1);
    let branch = continuation.branch(1.15, state, &limits, |_| ControlFlow::Continue(()))?;
    for special in &branch.specials {
        println!(
            "{} at eta = {}",
            special.kind.symbol(),
            special.point.parameter
        );
    }
    let symbols: Vec<&str> = branch.specials.iter().map(|it| it.kind.symbol()).collect();
    assert_eq!(symbols, ["G", "PD", "SN", "G"]);
    assert_abs_diff_eq!(
        branch.specials[2].point.parameter,
        1.369_036,
        epsilon = 1e-6
    );
    Ok(())
}
