//! The Jacobian of a motion that all but grazes its stop against differences of motions in 67 digits, which
//! `tests/reference/lab.py graze` prints.

use nalgebra::{Matrix2, Vector2};
use softstop::Ratios;
use softstop_dynamics::Orbit;
use softstop_dynamics::zone::grazing_frequencies;
use softstop_testing::assert_near;
use softstop_testing::tolerance::DIFFERENCED;

/// A state of the motion, to rounding, and where it is a drive period later.
const STATE: [f64; 2] = [9.245388870997623, 3.6304389245854143];
const IMAGE: [f64; 2] = [9.245388871000909, 3.6304389245523994];
/// The Jacobian there, by rows, from states 2^-40 to all sides: 1.5e-4 of the distance at which the motion grazes no more.
const JACOBIAN: [f64; 4] = [
    3714.0982067625905,
    1601.974096569273,
    -37317.93698300773,
    -16096.065394087434,
];

#[test]
fn near_grazing_the_jacobian_is_that_of_differences_in_many_digits() {
    let mut scene = Ratios::unloaded().scene().expect("valid");
    let (lower, _) = grazing_frequencies(&scene).expect("grazing");
    scene.excitation.frequency = lower.expect("below resonance") * (1.0 + 1e-5);
    // The impact-less motion at drive angle 0, had it no stop, and 1e-3 beside it.
    let start = Vector2::new(9.1895 + 1e-3, 3.5428);
    let orbit = Orbit::find_periodic(&scene, start, 1).expect("an orbit");
    let velocity = orbit.before_impact_velocity();
    assert!((3.4e-4..3.6e-4).contains(&velocity), "{velocity}");
    let differences = Matrix2::from_row_slice(&JACOBIAN);
    let off = (orbit.monodromy.matrix - differences).norm() / differences.norm();
    // The state is rounded to 1.8e-15, which is 3e-7 of the same distance.
    assert!(off < 1e-6, "{off:e}");
    let largest = orbit.monodromy.multipliers()[0].re;
    assert_near(largest / differences.trace(), 1.0, DIFFERENCED);
    // The fixed point itself, but for the rounding of its state: at 9.19 and 3.54 half a unit in the last place is
    // 4 and 1 times 2.2e-16, and Newton's method stops within four halves of the best state; the map stretches that.
    let aside = orbit.state() - Vector2::from(STATE);
    let gap = (Vector2::from(IMAGE) + differences * aside - orbit.state()).norm();
    assert!(gap < 16.0 * f64::EPSILON * differences.norm(), "{gap:e}");
}
