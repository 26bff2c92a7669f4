//! The Jacobian of a motion that all but grazes its stop against differences of motions in 67 digits.

use crate::many_digits::solve;
use nalgebra::{Matrix2, Vector2};
use softstop::{Ratios, Scene};
use softstop_dynamics::Orbit;
use softstop_dynamics::zone::grazing_frequencies;
use softstop_lab::methods::Task;
use softstop_testing::assert_near;
use softstop_testing::tolerance::DIFFERENCED;

/// Distance of the states that are compared: 1.5e-4 of that at which the motion grazes no more. Their images
/// are off by half a unit in the last place, 1e-15, and by the square of that share.
const WIDTH: f64 = 1.0 / (1u64 << 40) as f64;

fn image(scene: &Scene, state: Vector2<f64>) -> Vector2<f64> {
    let task = Task::new(scene.clone(), state.into(), 1.0, u64::MAX);
    let (position, velocity) = solve(&task, &|_| true).expect("a reference").end;
    Vector2::new(position, velocity)
}

#[test]
fn near_grazing_the_jacobian_is_that_of_differences_in_many_digits() {
    let mut scene = Ratios::unloaded().scene().expect("valid");
    let (lower, _) = grazing_frequencies(&scene).expect("grazing");
    scene.excitation.frequency = lower.expect("below resonance") * (1.0 + 1e-5);
    // The impact-less motion at drive angle 0, had it no stop, and 1e-3 beside it.
    let start = Vector2::new(9.1895 + 1e-3, 3.5428);
    let orbit = Orbit::periodic(&scene, start, 1).expect("an orbit");
    let velocity = orbit.before_impact_velocity();
    assert!((3.4e-4..3.6e-4).contains(&velocity), "{velocity}");
    let column = |direction: Vector2<f64>| {
        let ahead = image(&scene, orbit.state() + WIDTH * direction);
        let behind = image(&scene, orbit.state() - WIDTH * direction);
        (ahead - behind) / (2.0 * WIDTH)
    };
    let differences = Matrix2::from_columns(&[column(Vector2::x()), column(Vector2::y())]);
    let off = (orbit.monodromy.matrix - differences).norm() / differences.norm();
    // The state is rounded to 1.8e-15, which is 3e-7 of the same distance.
    assert!(off < 1e-6, "{off:e}");
    let largest = orbit.multipliers()[0].re;
    assert_near(largest / differences.trace(), 1.0, DIFFERENCED);
    // The fixed point itself, but for the rounding of its state: at 9.19 and 3.54 half a unit in the last place is
    // 4 and 1 times 2.2e-16, and Newton's method stops within four halves of the best state; the map stretches that.
    let gap = (image(&scene, orbit.state()) - orbit.state()).norm();
    assert!(gap < 16.0 * f64::EPSILON * differences.norm(), "{gap:e}");
}
