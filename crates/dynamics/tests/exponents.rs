//! Lyapunov exponents: the laws that they obey.

use std::collections::BTreeMap;

use nalgebra::Vector2;
use softstop::{Scene, Stop};
use softstop_dynamics::{LyapunovExponents, Orbit, StroboscopicMap};
use softstop_testing::tolerance::{MOTION, ROUNDING, SOLVED};
use softstop_testing::{assert_near, is_near, unloaded};

/// Periodic motions: z = 1, z = 2/3, (2/4)B, the impact-less one; soft and rigid stops.
fn orbits() -> Vec<Orbit> {
    let settle = |scene: &Scene, from: Vector2<f64>, periods: u64| {
        let map = StroboscopicMap::new(&scene.check().expect("valid"), 600);
        let state = map.image(from).expect("bounded");
        Orbit::find_periodic(scene, state, periods).expect("an orbit")
    };
    let flung = Vector2::new(0.0, 14.0);
    let mut rigid = unloaded(1.15);
    rigid.stop = Stop::Rigid { restitution: 0.8 };
    vec![
        settle(&unloaded(1.15), flung, 1),
        settle(&unloaded(1.15), Vector2::zeros(), 1),
        settle(&unloaded(0.9526), Vector2::new(9.0, 3.3), 12),
        settle(&rigid, flung, 1),
    ]
}

#[test]
fn on_periodic_motions_they_are_the_logarithms_of_the_multipliers() {
    for orbit in orbits() {
        let exact = LyapunovExponents::of(&orbit);
        let (along, _) =
            LyapunovExponents::along_motion(&orbit.scene, orbit.state(), 200).expect("bounded");
        for (exact, along) in exact.per_period.iter().zip(along.per_period) {
            // Complex multipliers turn the frame: the mean is off by a fraction of a turn over 6,400 periods.
            assert!(is_near(*exact, along, 1e-3), "{exact} {along}");
        }
        let period = orbit.scene.period();
        for (map, flow) in exact.per_period.iter().zip(exact.per_second()) {
            assert_near(*map, period * flow, ROUNDING);
        }
        let sum: f64 = exact.per_period.iter().sum();
        let divergence = orbit.monodromy.determinant().abs().ln() / orbit.periods as f64;
        assert!(is_near(sum, divergence, MOTION), "{sum} {divergence}");
    }
}

#[test]
fn their_sum_is_the_mean_divergence_in_chaos_too() {
    let mut rigid = unloaded(0.9875);
    rigid.stop = Stop::Rigid { restitution: 0.8 };
    for (scene, restitution) in [(unloaded(0.9875), 1.0f64), (rigid, 0.8)] {
        let state = Vector2::new(9.258_494_864, 3.539_666_112);
        let (exponents, _) = LyapunovExponents::along_motion(&scene, state, 20).expect("bounded");
        let map = StroboscopicMap::new(&scene.check().expect("valid"), 1);
        let (mut state, mut divergence, mut impacts) = (state, 0.0, 0);
        for _ in 0..exponents.periods {
            let passage = map.apply(state).expect("bounded");
            state = passage.end;
            // Liouville: what dampers take, and R^2 at each rebound; forces that jump take nothing.
            let rebounds = passage.impacts.len();
            divergence += 2.0 * rebounds as f64 * restitution.ln() - passage.damping_integral;
            impacts += rebounds;
        }
        assert!(impacts > 100, "{impacts}");
        let sum: f64 = exponents.per_period.iter().sum();
        assert_near(sum, divergence / exponents.periods as f64, 10.0 * SOLVED);
    }
}

#[test]
fn chaos_has_a_positive_one_beyond_its_error() {
    let state = Vector2::new(9.258_494_864, 3.539_666_112);
    let (chaos, end) =
        LyapunovExponents::along_motion(&unloaded(0.9875), state, 100).expect("bounded");
    assert!(chaos.is_positive(), "{chaos:?}");
    assert!(chaos.error > 0.0 && chaos.error < 0.02, "{chaos:?}");
    // Another stretch of the same motion agrees within both errors, doubled.
    let (again, _) = LyapunovExponents::along_motion(&unloaded(0.9875), end, 100).expect("bounded");
    assert_near(
        again.per_period[0],
        chaos.per_period[0],
        2.0 * (again.error + chaos.error),
    );
}

#[test]
fn sticking_wipes_out_all_differences() {
    let mut scene = unloaded(0.3);
    scene.stop = Stop::Rigid { restitution: 0.6 };
    scene.clearance = 0.0;
    let (found, _) =
        LyapunovExponents::along_motion(&scene, Vector2::new(-0.5, 0.1), 2).expect("bounded");
    assert_eq!(found.per_period, [f64::NEG_INFINITY; 2]);
    assert!(!found.is_positive());
}

/// The information dimension of the states at one drive angle: how their entropy in boxes grows as the boxes shrink.
fn information_dimension(states: &[Vector2<f64>]) -> f64 {
    let entropy = |halvings: i32| {
        let side = 0.5f64.powi(halvings);
        let mut boxes = BTreeMap::<[i64; 2], u32>::new();
        for state in states {
            let place = [state.x, state.y].map(|it| (it / side).floor() as i64);
            *boxes.entry(place).or_default() += 1;
        }
        let all = states.len() as f64;
        let shares = boxes.values().map(|count| f64::from(*count) / all);
        shares.map(|share| -share * share.ln()).sum::<f64>()
    };
    let (coarse, fine) = (8, 11);
    (entropy(fine) - entropy(coarse)) / (f64::from(fine - coarse) * 2.0f64.ln())
}

#[test]
fn the_kaplan_yorke_dimension_is_the_information_dimension() {
    let scene = unloaded(0.9875);
    let state = Vector2::new(9.258_494_864, 3.539_666_112);
    let (exponents, state) = LyapunovExponents::along_motion(&scene, state, 1000).expect("bounded");
    let map = StroboscopicMap::new(&scene.check().expect("valid"), 1);
    let next = |state: &Vector2<f64>| map.image(*state).ok();
    let states = std::iter::successors(Some(state), next).take(400_000);
    let states: Vec<Vector2<f64>> = states.collect();
    let counted = information_dimension(&states);
    assert_near(exponents.kaplan_yorke_dimension(), counted, 0.03);
}

#[test]
fn what_dies_out_has_no_dimension_and_what_does_not_contract_fills_the_plane() {
    let orbit = &orbits()[0];
    assert_eq!(LyapunovExponents::of(orbit).kaplan_yorke_dimension(), 0.0);
    let mut exponents = LyapunovExponents::of(orbit);
    exponents.per_period = [0.1, f64::NEG_INFINITY];
    assert_eq!(exponents.kaplan_yorke_dimension(), 1.0);
    exponents.per_period = [0.1, -0.05];
    assert_eq!(exponents.kaplan_yorke_dimension(), 2.0);
}
