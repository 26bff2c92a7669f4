//! Periodic motions that all but graze their stop, where the stroboscopic map has a square root.

use nalgebra::Vector2;
use softstop::{Ratios, Release, Scene, Stop};
use softstop_dynamics::orbit::{OrbitError, find, find_fixed_point};
use softstop_dynamics::zone::grazing_frequencies;
use softstop_dynamics::{Orbit, StroboscopicMap};
use softstop_testing::scenes::kelvin_voigt;
use softstop_testing::tolerance::{GROWN, MOTION, SOLVED};
use softstop_testing::{assert_near, is_near, loaded};

/// The unloaded machine a relative distance above its lower (or upper) grazing frequency.
fn beside(upper: bool, distance: f64) -> Scene {
    let mut scene = Ratios::unloaded().scene().expect("valid");
    let (lower, higher) = grazing_frequencies(&scene).expect("grazing");
    let grazing = if upper {
        higher
    } else {
        lower.expect("below resonance")
    };
    scene.excitation.frequency = grazing * (1.0 + distance);
    scene
}

/// The impact-less motion at drive angle 0, as if there were no stop.
fn steady(scene: &Scene) -> Vector2<f64> {
    let eta = scene.excitation.frequency;
    let (real, imaginary) = (1.0 - eta * eta, scene.damping * eta);
    let square = real * real + imaginary * imaginary;
    Vector2::new(real / square, eta * imaginary / square)
}

/// The z = 1 motion near grazing from a start 1e-3 away.
fn near_grazing(scene: &Scene) -> Orbit {
    let start = steady(scene) + Vector2::new(1e-3, -1e-3);
    Orbit::find_periodic(scene, start, 1).expect("an orbit")
}

#[test]
fn newton_settles_down_to_a_distance_of_1e_9_from_grazing() {
    let mut rigid = beside(false, 0.0);
    rigid.stop = Stop::Rigid { restitution: 0.8 };
    for (stop, loss) in [(beside(false, 0.0).stop, 1.0f64), (rigid.stop, 0.8)] {
        let orbit = |distance| {
            let mut scene = beside(false, distance);
            scene.stop = stop.clone();
            near_grazing(&scene)
        };
        let slope = orbit(1e-6).before_impact_velocity() / 1e-6;
        for distance in [1e-3, 1e-4, 1e-5, 1e-7, 1e-8, 1e-9] {
            let orbit = orbit(distance);
            assert_eq!(orbit.impacts.len(), 1, "{distance:e}");
            // The before-impact velocity is a smooth function v = a d (1 + c d + ...) of the distance d (from impact
            // to impact there is no square root), and `slope` is a (1 + c 1e-6). This holds c, which is of order
            // one, below 2 in size. The frequency itself is rounded by 1e-16.
            let off = orbit.before_impact_velocity() / (slope * distance) - 1.0;
            assert!(
                is_near(off, 0.0, 2.0 * (distance + 1e-6) + 1e-16 / distance),
                "{distance:e}: {off:e}"
            );
            let lost = (-orbit.damping_integral).exp() * loss * loss;
            assert!(
                is_near(orbit.monodromy.determinant() / lost, 1.0, 10.0 * GROWN),
                "{distance:e}"
            );
            // It blows up as the reciprocal of the velocity: there is no bounded linear map at grazing.
            let steep = orbit.monodromy.multipliers()[0].re * orbit.before_impact_velocity();
            assert!((-4.5..-4.2).contains(&steep), "{distance:e}: {steep}");
        }
    }
}

#[test]
fn on_the_map_newton_does_not_settle_there() {
    let scene = beside(false, 1e-7);
    let map = StroboscopicMap::new(&scene.check().expect("valid"), 1);
    let found = find_fixed_point(&map, steady(&scene) + Vector2::new(1e-3, -1e-3));
    assert!(
        matches!(found, Err(OrbitError::Diverged { .. })),
        "{found:?}"
    );
}

#[test]
fn above_resonance_an_unstable_motion_ends_in_grazing() {
    // Both exist: the impact-less motion, which is what is near, and one with a weak impact.
    let scene = beside(true, 1e-9);
    let near = Orbit::find_periodic(&scene, steady(&scene), 1).expect("an orbit");
    assert_eq!(near.impacts.len(), 0);
    let state = steady(&scene);
    let eta = scene.excitation.frequency;
    // Its largest position lies where the drive has turned by the phase lag.
    let time = (state.y / eta).atan2(state.x) / eta;
    let orbit = Orbit::find_by_impacts(&scene.check().expect("valid"), 1, &[(time, 1e-3)])
        .expect("an orbit");
    assert!(!orbit.is_stable());
    let velocity = orbit.before_impact_velocity();
    assert!(velocity > 0.0 && velocity < 1e-6, "{velocity:e}");
    // Twice over the same motion is found as what it is.
    let period = scene.period();
    let twice = Orbit::find_by_impacts(
        &scene.check().expect("valid"),
        2,
        &[(time, 1e-3), (time + period, 1e-3)],
    );
    assert_eq!(twice.expect("an orbit").periods, 1);
}

#[test]
fn from_impact_to_impact_strong_motions_are_the_same() {
    let scene = Ratios::unloaded().scene().expect("valid");
    let loaded = loaded();
    for scene in [scene, loaded] {
        let orbit = softstop_dynamics::orbit::find(&scene).expect("an orbit");
        let touch = orbit.impacts[0];
        let guess = (
            touch.instant.offset + 1e-2,
            touch.before_impact_velocity - 1e-2,
        );
        let again =
            Orbit::find_by_impacts(&scene.check().expect("valid"), 1, &[guess]).expect("an orbit");
        assert_near((again.state() - orbit.state()).norm(), 0.0, 10.0 * MOTION);
        assert_near(
            (again.monodromy.matrix - orbit.monodromy.matrix).norm(),
            0.0,
            SOLVED,
        );
        assert_near(again.damping_integral, orbit.damping_integral, MOTION);
        assert_near(again.max_position, orbit.max_position, 10.0 * MOTION);
    }
}

/// A free mass that touches a soft stop is pushed away in each period, whatever the scales: no motion repeats. On a suspension
/// the touch is one as soon as it is more than rounding.
#[test]
fn a_touch_that_nothing_balances_is_no_motion() {
    let refused = |scene: &Scene| matches!(find(scene), Err(OrbitError::NotFound { .. }));
    for (mass, length, frequency) in [
        (9.0, 0.6, 1.52),
        (1.0, 0.6, 1.1),
        (1e-3, 2e-5, 900.0),
        (3e4, 40.0, 0.02),
    ] {
        let mut scene = beside(false, 0.0);
        (scene.mass, scene.stiffness, scene.damping) = (mass, 0.0, 0.0);
        (scene.clearance, scene.excitation.frequency) = (length, frequency);
        scene.excitation.amplitude = 0.144 * length * mass * frequency.powi(2);
        let stiffness = 6.0 * mass * frequency.powi(2);
        scene.contact_damping = 0.063 * mass * frequency;
        scene.stop = kelvin_voigt(stiffness, Release::Clearance);
        assert!(refused(&scene), "{mass} kg");
        scene.stiffness = 0.1 * mass * frequency.powi(2);
        scene.damping = 0.02 * mass * frequency;
        let reach = 0.144 * length / f64::hypot(0.9, 0.02);
        scene.clearance = reach * (1.0 - 1e-9);
        assert!(!refused(&scene), "{mass} kg on a suspension");
    }
}
