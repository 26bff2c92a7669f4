//! All motions of a scene, found from scratch: the coexisting motions of Peterka 2003, Figs. 8 and 9, and
//! what other stops settle on.

use softstop::{Machine, Scene, Start, Stop};
use softstop_dynamics::attractors::{
    Attractor, Chaos, SearchOptions, classify_start, find_attractors, find_attractors_until,
};
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::{MotionKind, Orbit, Regime, Survey};
use softstop_testing::{assert_near, is_near, loaded, unloaded, with_changes};

const OPTIONS: SearchOptions = SearchOptions {
    starts: 96,
    seed: 0,
    transient: 500,
    longest: 64,
    patience: 300_000,
    region: None,
};

fn survey(scene: &Scene) -> Survey {
    survey_by(scene, &OPTIONS)
}

fn survey_by(scene: &Scene, options: &SearchOptions) -> Survey {
    let survey = find_attractors(scene, options, &unmonitored).expect("a survey");
    assert_eq!(survey.lost, None);
    let starts: usize = survey.attractors.iter().map(|found| found.starts).sum();
    assert_eq!(starts, survey.starts, "every start counts once");
    survey
}

/// A motion in short: the order of its impacts, or what else it is.
fn name(found: &Attractor) -> String {
    if let (Some(orbit), Some(residuals)) = (&found.orbit, found.residuals) {
        assert!(residuals.residual <= residuals.rounding, "{residuals:?}");
        assert!(orbit.is_stable());
    }
    let order = found.motion.order().map(ToString::to_string);
    order.unwrap_or_else(|| found.motion.to_string())
}

fn names(survey: &Survey) -> Vec<String> {
    let mut names: Vec<String> = survey.attractors.iter().map(name).collect();
    names.sort();
    names
}

fn chaos(survey: &Survey) -> &Chaos {
    let mut attractors = survey.attractors.iter();
    let chaos = attractors.find_map(|found| found.chaos.as_ref());
    chaos.expect("chaos")
}

#[test]
fn below_grazing_chaos_lasts_long_but_not_for_ever() {
    let options = SearchOptions {
        patience: 3_000_000,
        ..OPTIONS
    };
    let survey = survey_by(&unloaded(0.952_647_5), &options);
    assert_eq!(names(&survey), ["0", "transient chaos"]);
    let lifetimes = survey
        .attractors
        .iter()
        .filter_map(|found| found.chaos?.lifetime);
    // Of 256 motions 243, 138, 59, 16, 2 and 1 are left after 1, 10, 20, 40, 60 and 100 thousand periods:
    // a mean lifetime of 12,000 to 16,000. Escapes are independent of each other, so that the mean over k of
    // them has a standard deviation of a share 1/sqrt(k), 10 % of some 90: 11,000 to 20,000 is two and a half
    // of these beside it.
    for lifetime in lifetimes {
        assert!((11e3..20e3).contains(&lifetime), "{lifetime}");
    }
    assert!(chaos(&survey).exponents.is_positive());
}

#[test]
fn long_periods_near_grazing_are_found_beside_each_other() {
    let tenth = "1-0-0-0-0-0-0-0-0-0";
    let two_in_21 = "1-0-0-0-0-0-0-0-0-0-1-0-0-0-0-0-0-0-0-0-0";
    assert_eq!(names(&survey(&unloaded(0.952_66))), [tenth, two_in_21]);
    assert_eq!(names(&survey(&unloaded(0.953_65))), [tenth, "chaos"]);
}

#[test]
fn three_motions_coexist_and_the_order_of_impacts_differs() {
    let survey = survey(&unloaded(0.9875));
    assert_eq!(names(&survey), ["1-1-0", "1-1-0-0", "chaos"]);
    let chaos = chaos(&survey);
    assert!(chaos.watched > 200_000, "{}", chaos.watched);
    let [largest, _] = chaos.exponents.per_period;
    assert!(
        is_near(largest, 0.137, 0.01 + chaos.exponents.error),
        "{:?}",
        chaos.exponents
    );
}

#[test]
fn the_half_order_motion_gives_way_to_chaos_at_its_flip() {
    // The flip of z = 1/2 is at 0.9884970: at 0.9885 it is still the attractor, by little.
    let above = survey(&unloaded(0.9885));
    assert_eq!(names(&above), ["1-0", "1-1-0", "1-1-0-0"]);
    let mut orbits = above.attractors.iter().flat_map(|found| &found.orbit);
    let half = orbits.find(|orbit| orbit.periods == 2);
    let half = half.map(|orbit| orbit.monodromy.multipliers()[0].re);
    let off = half.expect("z = 1/2") + 0.9994;
    assert_near(off, 0.0, 1e-5);
    let below = survey(&unloaded(0.988_494));
    assert_eq!(names(&below), ["1-1-0", "1-1-0-0", "chaos"]);
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let options = SearchOptions {
        starts: 200,
        patience: 100_000,
        ..OPTIONS
    };
    let scene = unloaded(0.9875);
    let [one, three] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("a pool")
            .install(|| find_attractors(&scene, &options, &unmonitored))
    });
    assert_eq!(one, three);
}

#[test]
fn what_holds_a_mass_is_one_motion_and_chatter_is_counted_without_number() {
    let mut scene = loaded();
    scene.clearance = -1.0;
    assert_eq!(names(&survey(&scene)), ["rest"]);
    let mut scene = unloaded(2.6);
    scene.stop = Stop::Rigid { restitution: 0.6 };
    scene.clearance = 0.0;
    assert_eq!(names(&survey(&scene)), ["1"]);
    scene.excitation.frequency = 0.3;
    let found = classify_start(&scene, Start::new(-0.5, 0.1), &OPTIONS).expect("a motion");
    assert!(found.orbit.as_ref().expect("an orbit").chatters());
    assert_eq!(name(&found), "∞");
}

#[test]
fn single_motions_are_told_apart() {
    let classes = [
        (
            0.953_65,
            Start::new(8.675_183_838_401_669, 3.996_471_798_674_918_8),
            "chaos",
        ),
        (0.953_65, Start::new(8.042, 3.759), "1-0-0-0-0-0-0-0-0-0"),
        (1.15, Start::new(0.0, 14.0), "1"),
        (1.15, Start::new(0.0, 0.0), "0"),
    ];
    for (frequency, start, expected) in classes {
        let found = classify_start(&unloaded(frequency), start, &OPTIONS).expect("a motion");
        assert_eq!(name(&found), expected, "from {start:?} at {frequency}");
    }
}

/// Without damping no free motion settles: all that wander without chaos are told as one.
#[test]
fn what_does_not_settle_is_told_once() {
    let mut scene = unloaded(1.15);
    (scene.stop, scene.damping) = (Stop::None, 0.0);
    let names = names(&survey(&scene)).into_iter();
    assert_eq!(names.filter(|it| it == "unsettled").count(), 1);
}

/// Starts leave transient chaos for z = 1/2 one by one: the search for it goes on until one does, and no farther.
#[test]
fn a_motion_behind_transient_chaos_is_searched_until_it_is_met() {
    let scene = Machine::from_toml(
        r#"
        mass = 0.719456
        stiffness = 1.31025
        damping = 0.02
        clearance = 2.37509
        contact.damping = 0.0198674
        excitation = { amplitude = 1.61208, frequency = 1.10424, phase = -1.42145 }
        stop = { model = "preloaded", stiffness = 14.009061975, preload = 37.9959 }
        piercing = { stiffness = 35.95352205, friction = 2.50462149, thickness = 0.273148, travel = 0.530812 }
        initial = { position = 0, velocity = 0 }
        "#,
    );
    let scene = scene.expect("a machine").scene;
    let options = SearchOptions {
        patience: 4_000_000,
        ..OPTIONS
    };
    let is_half = |orbit: &Orbit| {
        MotionKind::of(orbit).regime()
            == Some(Regime {
                impacts: 1,
                periods: 2,
            })
    };
    let survey = find_attractors_until(&scene, &options, is_half, &unmonitored).expect("a survey");
    assert!(survey.periods < options.patience / 2, "{}", survey.periods);
    let mut orbits = survey.attractors.iter().flat_map(|found| &found.orbit);
    assert!(orbits.any(|orbit| is_half(orbit)));
}

/// With so much damping a motion comes back by a share of 3e-5 a period: Newton's method leaves 3e-11 of a motion of 4e-6, each start
/// another rest of it.
#[test]
fn a_slow_motion_is_one_motion() {
    let survey = survey(&with_changes("unloaded", "eta=1.15 rho=10 damping=1e5"));
    assert_eq!(names(&survey), ["0"]);
}

/// Without a suspension 1 - M is singular but for rounding: nothing is known of the error of a state, and a motion that rattles between
/// two stops is none of those that touch none.
#[test]
fn motions_that_are_known_badly_are_not_one() {
    let rattle = include_str!("../../../docs/scenes/rattle.toml");
    let mut scene = Machine::from_toml(rattle).expect("a machine").scene;
    (scene.damping, scene.clearance) = (0.2, 3.0);
    scene.below.as_mut().expect("a stop below").clearance = 3.0;
    let survey = survey(&scene);
    let z_2 = Some(Regime {
        impacts: 2,
        periods: 1,
    });
    let rattling = survey
        .attractors
        .iter()
        .filter(|it| it.motion.regime() == z_2);
    let starts: usize = rattling.map(|it| it.starts).sum();
    let share = starts as f64 / survey.starts as f64;
    assert!((0.5..0.9).contains(&share), "{share}");
}
