//! Motions that were denied until their like was found by the judge ([`zone_judge`](super::zone_judge)).

use softstop::{Machine, Start};
use softstop_dynamics::zone::{Stretch, stretches};
use softstop_dynamics::{BranchPoint, Orbit};

/// True of the stable z = 1 motion near a start if it lies on a stretch of its machine.
fn is_told(machine: &str, (position, velocity): (f64, f64)) -> bool {
    let text = format!("mass = 1.0\nstiffness = 1.0\nexcitation.amplitude = 1.0\n{machine}");
    let scene = Machine::from_toml(&text).expect("a machine").scene;
    let orbit = Orbit::near(&scene, Start::new(position, velocity).into()).expect("a motion");
    assert!(orbit.is_stable());
    let point = BranchPoint {
        parameter: scene.excitation.frequency,
        position: orbit.position,
        velocity: orbit.velocity,
        impacts: orbit.before_impact_velocities().collect(),
        monodromy: orbit.monodromy,
    };
    let on = |one: &Stretch| one.contains(&scene, &point).expect("followed");
    stretches(&scene).expect("stretches").iter().any(on)
}

#[test]
fn one_of_three_motions_within_a_hundredth_beyond_a_touch_of_the_stop() {
    let machine = "
        damping = 0.09020124158576484
        clearance = 7.540710228126493
        contact.damping = 0.029680496547639133
        excitation.frequency = 1.0653057582059908
        stop = { model = 'preloaded', stiffness = 527.0936789766142, preload = 0.0 }
        piercing = { stiffness = 23.39060897052529, friction = 0.3547836468118582, thickness = 0.8992862845647513, travel = 0.5707042098947991 }
    ";
    assert!(is_told(machine, (1.3623487605892457, 9.932384171006522)));
}

/// At all frequencies that are looked at, its two motions lie in one cell of the lattice.
#[test]
fn an_isola_whose_motions_lie_close_together() {
    let machine = "
        damping = 0.0029032875400507147
        clearance = 8.020638162572078
        contact.damping = 0.16106257481039904
        excitation.frequency = 0.9404154281170832
        stop = { model = 'preloaded', stiffness = 9574.30799896377, preload = 407.44498328333964 }
        piercing = { stiffness = 11.98138151575813, friction = 28.537369546541143, thickness = 0.9150222518878556, travel = 0.8445363265014925 }
    ";
    assert!(is_told(machine, (4.935526859345018, 9.564266502784427)));
}

#[test]
fn a_weak_impact_beside_a_fold_to_which_no_guess_between_neighbours_leads() {
    let machine = "
        damping = 0.0027317914744214677
        clearance = 1.4569093802206396
        contact.damping = 0.006251750477369844
        excitation.frequency = 0.5006834554190766
        stop = { model = 'kelvinVoigt', stiffness = 324.95557311297836, release = 'clearance' }
    ";
    assert!(is_told(machine, (1.0081353669864763, -0.4993933704242126)));
}

#[test]
fn one_that_was_told_at_another_frequency_than_the_one_asked_for() {
    let machine = "
        damping = 0.004683406516899686
        clearance = 4.001646629655347
        contact.damping = 0.017110657495559376
        excitation.frequency = 0.5127158092545029
        stop = { model = 'preloaded', stiffness = 836.8438998876471, preload = 0.29433433460024894 }
        piercing = { stiffness = 28.633962106895556, friction = 7.30901821276743, thickness = 0.15060770956529826, travel = 0.5771394207776008 }
    ";
    assert!(is_told(machine, (0.9231620300391603, -3.272089421104891)));
}

#[test]
fn one_on_a_step_on_which_a_grazing_far_off_was_taken_for_its_own() {
    let machine = "
        damping = 0.016609291163912052
        clearance = 10.178970313969193
        contact.damping = 0.0461120476464316
        excitation.frequency = 1.0666413144009494
        [stop]
        model = 'piecewiseLinear'
        loading = [{ from = 0.0, stiffness = 97.43152261549521 }, { from = 0.4499948998107079, stiffness = 7.813014492967297 }]
        unloading = [{ from = 0.0, stiffness = 48.715761307747606 }, { from = 0.4499948998107079, stiffness = 3.9065072464836486 }]
    ";
    assert!(is_told(machine, (9.268867954931542, 6.939802765497669)));
}

/// Its branch begins at the lowest frequency that is looked at and leads out of the range there.
#[test]
fn one_at_the_end_of_the_frequencies_that_are_followed() {
    let machine = "
        damping = 0.009093879386146458
        clearance = 1.0322322516199183
        contact.damping = 0.04773586427391478
        excitation.frequency = 0.25
        stop = { model = 'rigid', restitution = 0.24014324975839776 }
    ";
    assert!(is_told(machine, (1.0086977011087712, -0.03553960160912532)));
}

#[test]
fn a_weak_one_at_the_end_of_the_frequencies_that_are_followed() {
    let machine = "
        damping = 0.012444320113856539
        clearance = 1.0070225186298458
        contact.damping = 0.1897849389316958
        excitation.frequency = 0.25
        stop = { model = 'preloaded', stiffness = 363.8090274997799, preload = 0.2674011704804397 }
    ";
    assert!(is_told(
        machine,
        (0.9753343494744439, -0.021087647923136096)
    ));
}
