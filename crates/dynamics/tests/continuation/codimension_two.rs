//! Points of codimension two against closed forms, scaling and counts of folds.

use super::curves::{followed, plane};
use super::*;
use softstop::{Machine, Release, Stop};
use softstop_dynamics::attractors::{SearchOptions, find_attractors};
use softstop_dynamics::continuation::{CodimensionTwo, switch_curves};
use softstop_dynamics::monitor::unmonitored;

/// A machine with m = k = F0 = 1 before a stop, at 0.95 of the clearance that the motion without impacts reaches.
fn beside_grazing(frequency: f64, damping: f64, stop: &str) -> Scene {
    let reach = (1.0 - frequency * frequency)
        .hypot(damping * frequency)
        .recip();
    let text = format!(
        "mass = 1.0\nstiffness = 1.0\ndamping = {damping}\nclearance = {}\ncontact.damping = {damping}\n\
         excitation = {{ amplitude = 1.0, frequency = {frequency} }}\nstop = {stop}",
        0.95 * reach
    );
    Machine::from_toml(&text).expect("a machine").scene
}

const STOPS: [&str; 2] = [
    "{ model = \"rigid\", restitution = 0.8 }",
    "{ model = \"preloaded\", stiffness = 7.0, preload = 2.0 }",
];

/// The special points of z = 1 over the clearance, from its stable motion.
fn over_the_clearance(scene: &Scene) -> Branch {
    let found = find_attractors(scene, &SearchOptions::default(), &unmonitored);
    let found = found.expect("attractors").attractors;
    let orbit = found.into_iter().find_map(|it| {
        let regime = it.motion.regime()?;
        (regime.impacts == 1 && regime.periods == 1).then_some(it.orbit?)
    });
    let family = ParameterFamily::new(scene.clone(), [Parameter::Clearance]).expect("a family");
    let from = (scene.clearance, orbit.expect("z = 1").state());
    let range = (0.6 * scene.clearance, 1.3 * scene.clearance);
    branches::follow(&family, 1, from, range, 2000).expect("a branch")
}

/// Grazing is resonant where the free motion comes back in half its own periods, at `2 omega_d / n` (Simpson and Ghosh,
/// arXiv 2602.22797). The curve of folds from below, that of flips from above and that of grazing meet there, at the
/// amplitude of the linear machine.
#[test]
fn folds_and_flips_end_in_resonant_grazing() {
    for (damping, stop) in [0.02, 0.04, 0.1f64]
        .into_iter()
        .flat_map(|it| STOPS.map(|stop| (it, stop)))
    {
        let resonant = 2.0 * (1.0 - damping * damping / 4.0).sqrt();
        let reach = (1.0 - resonant * resonant)
            .hypot(damping * resonant)
            .recip();
        for (frequency, symbol) in [(resonant - 0.01, "SN"), (resonant + 4e-4, "PD")] {
            let scene = beside_grazing(frequency, damping, stop);
            let branch = over_the_clearance(&scene);
            let parameters = [Parameter::Clearance, Parameter::Frequency];
            let family = ParameterFamily::new(scene, parameters).expect("a family");
            let ranges = [(0.2, 0.5), (frequency - 0.1, frequency + 0.1)];
            for kind in [symbol, "G"] {
                let special = of_kind(&branch, kind).remove(0);
                let curve = followed(&special, 1, &family, frequency, ranges);
                let [(CodimensionTwo::ResonantGrazing(_), point)] = &curve.specials[..] else {
                    panic!("{kind}: {:?}", curve.specials);
                };
                assert_near(point.parameters[1], resonant, SOLVED);
                assert_near(point.parameters[0], reach, SOLVED);
                let ends = [&curve.ends.0, &curve.ends.1];
                let ends = ends
                    .iter()
                    .filter(|it| matches!(it, CurveEnd::CodimensionTwo(_)));
                assert_eq!(
                    ends.count(),
                    usize::from(kind != "G"),
                    "{kind}: {:?}",
                    curve.ends
                );
            }
        }
    }
}

/// The orbits of a curve are periodic, and the test vanishes, in the map of the state at a drive angle, too; the curve passes
/// the point of the branch that it begins at.
#[test]
fn curves_from_impact_to_impact_are_those_of_the_stroboscopic_map() {
    let mut soft = loaded();
    soft.stop = Stop::KelvinVoigt {
        stiffness: 60.0,
        release: Release::Clearance,
    };
    let mut compared = [0; 3];
    for (scene, compared) in [unloaded(), loaded(), soft].into_iter().zip(&mut compared) {
        let orbit = softstop_dynamics::orbit::find(&scene).expect("z = 1");
        let along = ParameterFamily::new(scene.clone(), [Parameter::Frequency]).expect("a family");
        let branch = follow(&along, 1, (1.15, orbit.state()), (0.9, 1.8));
        let parameters = [Parameter::Frequency, Parameter::Clearance];
        let family = ParameterFamily::new(scene.clone(), parameters).expect("a family");
        for (symbol, test) in [("PD", TestFunction::Flip), ("SN", TestFunction::Fold)] {
            let Some(special) = of_kind(&branch, symbol).into_iter().next() else {
                continue;
            };
            let ranges = [(0.6, 1.8), (scene.clearance - 6.0, scene.clearance)];
            let curve = followed(&special, 1, &family, scene.clearance, ranges);
            let begin = special.point.parameter;
            let off = |point: &CurvePoint| (point.parameters[0] - begin).abs();
            let nearest = curve.points.iter().map(off).fold(f64::INFINITY, f64::min);
            assert_near(nearest, 0.0, SOLVED);
            for point in &curve.points {
                let [frequency, clearance] = point.parameters;
                let mut scene = scene.at_frequency(frequency);
                scene.clearance = clearance;
                let map = StroboscopicMap::new(&scene.check().expect("a map"), 1);
                let state = Vector2::new(point.position, point.velocity);
                let passage = map.apply(state).expect("an image");
                assert_near((passage.end - state).norm() / clearance, 0.0, GROWN);
                assert_near(test.scaled_value(&passage.monodromy), 0.0, 100.0 * GROWN);
                *compared += 1;
            }
        }
    }
    assert!(compared.iter().all(|count| *count > 20), "{compared:?}");
}

/// The flips of the paper's unloaded machine end at a third of its own frequency, twice over; those of the loaded machine
/// and its folds where the mass grazes the stop behind the strip, beside a cusp.
#[test]
fn the_papers_machines_have_resonant_grazings() {
    let flip = of_kind(&all_of_z1(), "PD").remove(0);
    let family = plane([Parameter::Frequency, Parameter::Clearance]);
    let curve = followed(&flip, 1, &family, 10.0, [(0.5, 2.0), (1.0, 24.0)]);
    let [
        (CodimensionTwo::ResonantGrazing(_), resonant),
        (CodimensionTwo::GeneralisedFlip, generalised),
    ] = &curve.specials[..]
    else {
        panic!("{:?}", curve.specials);
    };
    let own = (1.0 - 0.02 * 0.02f64).sqrt();
    assert_near(resonant.parameters[0], 2.0 * own / 3.0, SOLVED);
    // The orbits of twice the period begin stable on one side of the generalised flip, unstable on the other.
    let is_beside = |point: &&CurvePoint| {
        let off = (point.parameters[1] - generalised.parameters[1]).abs();
        (0.05..0.4).contains(&off)
    };
    let mut sides = [0, 0];
    for point in curve.points.iter().filter(is_beside) {
        let [frequency, clearance] = point.parameters;
        let scene = Scene {
            clearance,
            ..unloaded().at_frequency(frequency)
        };
        let state = Vector2::new(point.position, point.velocity);
        let checked = scene.check().expect("valid");
        let coefficient = normal_form_coefficient(&checked, 1, TestFunction::Flip, state);
        let coefficient = coefficient.expect("a motion").expect("a coefficient");
        let map = StroboscopicMap::new(&checked, 1);
        let flip = BranchPoint {
            parameter: frequency,
            position: point.position,
            velocity: point.velocity,
            impacts: point.impacts.clone(),
            monodromy: map.apply(state).expect("an image").monodromy,
        };
        let along = ParameterFamily::new(scene, [Parameter::Frequency]).expect("a family");
        let doubled = double_within(&along, 1, &flip, (frequency - 0.01, frequency + 0.01));
        let first = &doubled.points[0];
        assert_eq!(first.is_stable(), coefficient > 0.0, "{point:?}");
        sides[usize::from(coefficient > 0.0)] += 1;
    }
    assert!(sides.iter().all(|count| *count > 0), "{sides:?}");

    let frequencies = ParameterFamily::new(loaded(), [Parameter::Frequency]).expect("a family");
    let orbit = softstop_dynamics::orbit::find(&loaded()).expect("z = 1");
    let branch = follow(&frequencies, 1, (1.15, orbit.state()), (0.5, 2.0));
    let family = ParameterFamily::new(loaded(), [Parameter::Frequency, Parameter::Clearance]);
    let family = family.expect("a family");
    let ends = ["PD", "SN"].map(|symbol| {
        let special = of_kind(&branch, symbol).remove(0);
        let curve = followed(&special, 1, &family, 10.0, [(0.5, 2.0), (1.0, 24.0)]);
        let mut resonant = curve.specials.into_iter();
        let resonant = resonant.find(|it| matches!(it.0, CodimensionTwo::ResonantGrazing(_)));
        resonant.expect("a resonant grazing").1.parameters
    });
    assert_near(ends[0][0], ends[1][0], SOLVED);
    assert_near(ends[0][1], ends[1][1], GROWN);
}

/// The soft stop alone has a scale of its own, its clearance: the cusp stands at one ratio of amplitude to clearance, and
/// of the machines on either side of it one has two folds more.
#[test]
fn folds_of_a_soft_stop_meet_in_a_cusp() {
    let soft = Machine::from_toml(
        "mass = 1.0\nstiffness = 1.0\ndamping = 0.1\nclearance = 1.0\ncontact.damping = 0.1\n\
         excitation = { amplitude = 0.5, frequency = 1.2 }\nstop = { model = \"kelvinVoigt\", stiffness = 3.0 }",
    );
    let soft = soft.expect("a machine").scene;
    let folds = |amplitude: f64| {
        let mut scene = soft.clone();
        scene.excitation.amplitude = amplitude;
        scene.excitation.frequency = 1.0;
        let orbit = softstop_dynamics::orbit::find(&scene).expect("z = 1");
        let family = ParameterFamily::new(scene, [Parameter::Frequency]).expect("a family");
        let branch = branches::follow(&family, 1, (1.0, orbit.state()), (0.8, 2.5), 4000);
        of_kind(&branch.expect("a branch"), "SN")
    };
    let fold = folds(0.5).remove(0);
    let cusps = [
        (Parameter::Amplitude, 0.5, (0.5, 2.0)),
        (Parameter::Clearance, 1.0, (0.1, 1.0)),
    ]
    .map(|(second, value, range)| {
        let family =
            ParameterFamily::new(soft.clone(), [Parameter::Frequency, second]).expect("a family");
        let curve = followed(&fold, 1, &family, value, [(0.9, 2.5), range]);
        let [(CodimensionTwo::Cusp, point)] = &curve.specials[..] else {
            panic!("{:?}", curve.specials);
        };
        point.parameters
    });
    let [[frequency, amplitude], [same, clearance]] = cusps;
    assert_near(frequency, same, GROWN);
    assert_near(amplitude / 1.0, 0.5 / clearance, GROWN);
    let counts = [0.999, 1.001].map(|share| folds(share * amplitude).len());
    assert_eq!(counts, [2, 0]);
}

/// From resonant grazing begin the curves of folds and of grazing, too, and from a generalised flip that of the folds of doubled
/// orbits. This one leads back to the flips, and passes the folds that each machine's own doubled branch has.
#[test]
fn curves_begin_in_points_of_codimension_two() {
    let flip = of_kind(&all_of_z1(), "PD").remove(0);
    let family = plane([Parameter::Frequency, Parameter::Clearance]);
    let ranges = [(0.5, 2.0), (1.0, 24.0)];
    let region = CurveLimits {
        ranges,
        points: 500,
        settings: ContinuationSettings::of_curves(0.02),
    };
    let flips = followed(&flip, 1, &family, 10.0, ranges);
    let places = flips.specials.iter().map(|it| it.1.parameters);
    let [resonant, generalised] = places.collect::<Vec<_>>()[..] else {
        panic!("{:?}", flips.specials);
    };
    let from_flips = switch_curves(
        &family,
        &flips,
        &region,
        |kind, _, _| *kind == flips.kind,
        go_on,
    );
    let kinds = from_flips.iter().map(|it| (it.kind.symbol(), it.periods));
    assert_eq!(kinds.collect::<Vec<_>>(), [("SN", 1), ("G", 1), ("SN", 2)]);
    #[track_caller]
    fn begins_at(curve: &Curve, place: [f64; 2]) {
        let off = |it: &[f64; 2]| (it[0] - place[0]).abs().max((it[1] - place[1]).abs());
        let mut places = curve.specials.iter().map(|it| it.1.parameters);
        assert!(
            places.any(|it| off(&it) < 1e-6),
            "{place:?}: {:?}",
            curve.specials
        );
    }
    begins_at(&from_flips[0], resonant);
    begins_at(&from_flips[1], resonant);
    let folds = &from_flips[2];
    begins_at(folds, generalised);
    let mut specials = folds.specials.iter();
    let end = specials.find(|it| it.0 == CodimensionTwo::GeneralisedFlip);
    let end = &end.expect("a generalised flip").1;
    assert_eq!(end.impacts.len(), 2);
    assert_near(end.monodromy.fold_test(), 0.0, SOLVED);

    let mut compared = 0;
    let beside = |it: &&CurvePoint| it.parameters[0] < 0.97 && it.parameters[1] < 2.5;
    for flip in flips.points.iter().filter(beside) {
        let [frequency, clearance] = flip.parameters;
        let scene = Scene {
            clearance,
            ..unloaded()
        };
        let along = ParameterFamily::new(scene, [Parameter::Frequency]).expect("a family");
        let continuation = Continuation::new(&along, 1);
        let flip = continuation.find_point(frequency, flip.state());
        let limits = BranchLimits {
            range: (frequency - 0.1, frequency + 0.1),
            points: 500,
        };
        // Near grazing the doubled orbits are too steep to begin at.
        let Ok(doubled) = continuation.double_period(&flip.expect("an orbit"), &limits, go_on)
        else {
            continue;
        };
        for fold in of_kind(&doubled, "SN") {
            let crosses = folds.points.windows(2).any(|pair| {
                let [[a, c], [b, d]] = [pair[0].parameters, pair[1].parameters];
                let share = (clearance - c) / (d - c);
                let at = a + share * (b - a);
                (0.0..=1.0).contains(&share) && (at - fold.point.parameter).abs() < 1e-4
            });
            assert!(crosses, "{clearance}: {}", fold.point.parameter);
            compared += 1;
        }
    }
    assert!(compared >= 5, "{compared}");

    let back = switch_curves(&family, folds, &region, |_, periods, _| periods == 2, go_on);
    let [back] = &back[..] else {
        panic!("{} curves", back.len());
    };
    assert_eq!((back.kind.symbol(), back.periods), ("PD", 1));
    begins_at(back, generalised);
    begins_at(back, resonant);
}
