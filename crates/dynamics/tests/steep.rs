//! Stable motions whose Jacobian has entries beyond 1e8: its determinant is known from damping and restitution alone.

use std::f64::consts::TAU;

use softstop::{Ratios, Scene, SceneError, Stop};
use softstop_dynamics::{Orbit, StroboscopicMap};
use softstop_testing::assert_relative;
use softstop_testing::tolerance::{GROWN, SOLVED};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A machine driven at its damped natural frequency, where the position after a drive period does not depend on the
/// velocity before: an impact, however weak, changes the trace by no more than rounding. The impact-less motion just
/// touches the stop.
fn machine(stop: &Stop, phase: f64) -> Result<Scene, SceneError> {
    let mut scene = Ratios::unloaded().scene()?;
    let decay = 0.5 * scene.damping;
    let eta = (1.0 - decay * decay).sqrt();
    scene.clearance = 1.0 / (1.0 - eta * eta).hypot(scene.damping * eta);
    (scene.excitation.frequency, scene.excitation.phase) = (eta, phase);
    scene.stop = stop.clone();
    Ok(scene)
}

/// When the impact-less motion touches the stop, in s.
fn touch(scene: &Scene) -> f64 {
    let (eta, phase) = (scene.excitation.frequency, scene.excitation.phase);
    let lag = (scene.damping * eta).atan2(1.0 - eta * eta);
    (lag - phase).rem_euclid(TAU) / eta
}

#[test]
fn stability_is_told_by_a_determinant_without_cancellation() -> Outcome {
    let preloaded = Ratios::unloaded().scene()?.stop;
    let rigid = Stop::Rigid { restitution: 0.8 };
    let (mut steep, mut deceived) = (0, 0);
    for (stop, loss) in [(preloaded, 1.0f64), (rigid, 0.8)] {
        for phase in [0.0, 1.0, 2.5, 4.0] {
            let scene = machine(&stop, phase)?.check()?;
            // To rounding, all impacts so weak fit.
            let impacts = [1e-9, 3e-9, 1e-8].map(|velocity| (touch(&scene), velocity));
            let orbits = impacts.map(|impact| Orbit::find_by_impacts(&scene, 1, &[impact]));
            for orbit in orbits.into_iter().flatten() {
                let matrix = orbit.monodromy.matrix;
                if matrix.norm() < 1e8 {
                    continue;
                }
                steep += 1;
                let known = (-orbit.damping_integral).exp() * loss * loss;
                let own = &orbit.monodromy;
                assert_relative(own.determinant(), known, SOLVED);
                assert!(own.is_stable() && !own.is_neutral());
                assert!(own.multipliers().iter().all(|it| it.norm() < 1.0));
                let passage = StroboscopicMap::new(&scene, 1).apply(orbit.state())?;
                if !passage.impacts.is_empty() {
                    let found = passage.monodromy.determinant();
                    assert_relative(found, known, GROWN);
                }
                let own = matrix.determinant();
                let is_stable = matrix.trace().abs() < 1.0 + own && own < 1.0;
                deceived += u32::from(!is_stable);
            }
        }
    }
    assert!(steep >= 8 && deceived >= 4, "{deceived} of {steep}");
    Ok(())
}
