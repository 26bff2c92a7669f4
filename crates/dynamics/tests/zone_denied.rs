//! Motions that were denied until their like was found by the judge ([`zone_judge`](super::zone_judge)).

use softstop::{Machine, Scene, Start};
use softstop_dynamics::zone::{Loss, Stretch, stretches};
use softstop_dynamics::{BranchPoint, Orbit};

fn scene(machine: &str) -> Scene {
    let text = format!("mass = 1.0\nstiffness = 1.0\nexcitation.amplitude = 1.0\n{machine}");
    Machine::from_toml(&text).expect("a machine").scene
}

/// True of the stable z = 1 motion near a start if it lies on a stretch of its machine.
fn is_told(machine: &str, (position, velocity): (f64, f64)) -> bool {
    let scene = scene(machine);
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

/// Where it grazes, its motions lie beside those of another branch.
#[test]
fn an_isola_between_two_frequencies_of_the_row() {
    let machine = "
        damping = 0.002033404738552938
        clearance = 10.453840456605448
        contact.damping = 0.009724299393046377
        excitation.frequency = 0.5111580020840815
        stop = { model = 'preloaded', stiffness = 2004.4758844134817, preload = 10.663534456201413 }
        piercing = { stiffness = 27.18485245196328, friction = 1.8009062528272928, thickness = 0.46158493811806434, travel = 0.3406792865417257 }
    ";
    assert!(is_told(machine, (-7.273318231527947, -6.397687767467933)));
}

#[test]
fn a_wide_isola_between_two_frequencies_of_the_row() {
    let machine = "
        damping = 0.0035551251403194996
        clearance = 1.2701450676237456
        contact.damping = 0.021677436801624317
        excitation.frequency = 1.0965668350178064
        stop = { model = 'preloaded', stiffness = 0.49166936216361135, preload = 0.0 }
        piercing = { stiffness = 4.903157625161329, friction = 24.47372752344692, thickness = 0.9013340102150477, travel = 0.6600647342221563 }
    ";
    assert!(is_told(machine, (-27.476254400476645, 68.92279830521788)));
}

#[test]
fn a_narrow_isola_between_two_frequencies_of_the_row() {
    let machine = "
        damping = 0.04355550064921474
        clearance = 9.663966720321387
        contact.damping = 0.009489320827367
        excitation.frequency = 1.0607518210308196
        stop = { model = 'preloaded', stiffness = 94.63699576555113, preload = 119.81643552108581 }
        piercing = { stiffness = 25.478880652995795, friction = 27.281858915665495, thickness = 0.786922276828439, travel = 0.8431145253209053 }
    ";
    assert!(is_told(machine, (-0.9999477767600924, 11.526446751150461)));
}

#[test]
fn one_that_begins_and_ends_at_rest() {
    let machine = "
        damping = 0.0026102809763279638
        clearance = 0.6429403524102947
        contact.damping = 0.038098397870512474
        excitation.frequency = 0.4498667908059995
        stop = { model = 'preloaded', stiffness = 2.2263801058997816, preload = 3.0606269884702426 }
        piercing = { stiffness = 3.771162172111246, friction = 2.818802822578746, thickness = 0.05407087499198875, travel = 0.14897296879227395 }
    ";
    assert!(is_told(machine, (0.6928098080615536, 0.013114112906199661)));
}

#[test]
fn one_between_a_touch_of_the_stop_and_the_fold_right_before_it() {
    let machine = "
        damping = 0.008119316497563278
        clearance = 5.176355884934091
        contact.damping = 0.002978555361943576
        excitation.frequency = 0.908711394736371
        stop = { model = 'preloaded', stiffness = 14.246889090823867, preload = 0.0 }
        piercing = { stiffness = 1.0501572417976546, friction = 2.5405987487101362, thickness = 0.3326101266602973, travel = 0.0637621029085123 }
    ";
    assert!(is_told(machine, (5.570457590587744, 0.17781788239404078)));
}

#[test]
fn another_one_between_a_touch_of_the_stop_and_the_fold_right_before_it() {
    let machine = "
        damping = 0.007301286168849878
        clearance = 5.804094502695941
        contact.damping = 0.05985137765010182
        excitation.frequency = 0.9392315415847812
        stop = { model = 'preloaded', stiffness = 38.602212634494755, preload = 0.0 }
        piercing = { stiffness = 10.38545382225519, friction = 5.230344057570957, thickness = 0.40670276309657377, travel = 0.5710406093137418 }
    ";
    assert!(is_told(machine, (6.766319952902796, 0.5025638041864631)));
}

#[test]
fn one_of_many_folds_right_after_a_corner() {
    let machine = "
        damping = 0.011203211423769408
        clearance = 0.2254015035633331
        contact.damping = 0.004710821270264558
        excitation.frequency = 0.33517699897618924
        [stop]
        model = 'piecewiseLinear'
        loading = [{ from = 0.0, stiffness = 3.826383438701028 }, { from = 0.1967466641056566, stiffness = 565.5778393731495 }]
        unloading = [{ from = 0.0, stiffness = 1.913191719350514 }, { from = 0.1967466641056566, stiffness = 282.78891968657473 }]
    ";
    assert!(is_told(machine, (0.422856493276939, 0.0)));
}

/// True if what ends the stretches of a machine has a name.
fn are_named(machine: &str) -> bool {
    let all = stretches(&scene(machine)).expect("stretches");
    let mut ends = all.iter().flat_map(|one| [&one.low, &one.high]);
    ends.all(|end| !matches!(end.loss, Loss::Lost(_) | Loss::Budget))
}

#[test]
fn ends_where_an_orbit_magnifies_rounding_and_forgets_it_again() {
    let machine = "
        damping = 0.04356216868377464
        clearance = 0.6055955814496878
        contact.damping = 0.021817543053882626
        excitation.frequency = 0.47869768680101077
        stop = { model = 'preloaded', stiffness = 93.15509241124083, preload = 0.37941424001682694 }
        piercing = { stiffness = 8.883809478704858, friction = 22.52097986231408, thickness = 0.22251267627921087, travel = 0.9783834793442382 }
    ";
    assert!(are_named(machine));
}

#[test]
fn ends_where_a_branch_bends_within_a_billionth() {
    let machine = "
        damping = 0.010590094131387607
        clearance = 0.24752148497480317
        contact.damping = 0.008126288356753221
        excitation.frequency = 0.26418275706330147
        [stop]
        model = 'piecewiseLinear'
        loading = [{ from = 0.0, stiffness = 0.25106511370265716 }, { from = 0.6027060536748576, stiffness = 616.3945227250241 }]
        unloading = [{ from = 0.0, stiffness = 0.12553255685132858 }, { from = 0.6027060536748576, stiffness = 308.19726136251205 }]
    ";
    assert!(are_named(machine));
}

#[test]
fn an_isola_so_flat_that_its_frequency_tells_its_sides_apart_by_a_thousandth() {
    let machine = "
        damping = 0.0023146245074345045
        clearance = 1.8767313932687464
        contact.damping = 0.002361272145129286
        excitation.frequency = 0.5026007498174982
        stop = { model = 'preloaded', stiffness = 1.214619100975209, preload = 3.8693613236562703 }
        piercing = { stiffness = 10.806760795085063, friction = 18.43664124335621, thickness = 0.2779983426861644, travel = 0.019179703115514 }
    ";
    assert!(is_told(machine, (0.7689488844469032, -0.9595454870441067)));
}

#[test]
fn ends_where_rounding_leaves_more_than_its_neighbours_tell() {
    let machine = "
        damping = 0.021383071793465817
        clearance = 0.38350930474631645
        contact.damping = 0.13029291999042028
        excitation.frequency = 1.15
        stop = { model = 'preloaded', stiffness = 2581.4583061696444, preload = 200.78527172810269 }
        piercing = { stiffness = 10.691316338866132, friction = 25.577189590775173, thickness = 0.15467698198168145, travel = 0.5232139746173134 }
    ";
    assert!(are_named(machine));
}

#[test]
fn ends_where_rounding_leaves_a_hundred_times_what_the_monodromy_matrix_tells() {
    let machine = "
        damping = 0.002070478913793451
        clearance = 0.47541371888294964
        contact.damping = 0.00555294555283473
        excitation.frequency = 1.15
        stop = { model = 'preloaded', stiffness = 0.6313069578007628, preload = 22.905384841383142 }
        piercing = { stiffness = 8.876940545223665, friction = 22.139197015361002, thickness = 0.19746014847192814, travel = 0.8916167974004743 }
    ";
    assert!(are_named(machine));
}
