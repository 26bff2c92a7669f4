//! A machine near a flip of z = 8/8, where motions settle slowly: on 8/8 before it, and beyond it, after long transients,
//! on z = 9/9.

use softstop::{Ratios, Scene, SceneError, Slope, Start, Stop};
use softstop_dynamics::Orbit;
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::settled::{SettledMotion, Settling};
use softstop_testing::assert_near;
use softstop_testing::tolerance::printed;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// As a study follows them.
const STUDY: Settling = Settling {
    periods: 1000,
    watched: 64,
    longest: 16_000,
    tolerance: 1e-4,
};

fn machine(frequency: f64) -> Result<Scene, SceneError> {
    let mut scene = Ratios::unloaded().scene()?.at_frequency(frequency);
    scene.damping = 0.0010035920352690947;
    scene.contact_damping = 0.055312340888448;
    scene.clearance = 0.43389208459215656;
    let slope = |from, stiffness| Slope { from, stiffness };
    scene.stop = Stop::PiecewiseLinear {
        loading: vec![
            slope(0.0, 7.724967006421391),
            slope(2.3699476894007003, 40439.83555026721),
        ],
        unloading: Vec::new(),
    };
    Ok(scene)
}

/// 45 starts on a grid.
fn starts() -> impl Iterator<Item = Start> {
    let position = |column: u32| -4.0 + 0.55 * f64::from(column);
    let velocity = |row: u32| -3.5 + 1.75 * f64::from(row);
    (0..9)
        .flat_map(move |column| (0..5).map(move |row| Start::new(position(column), velocity(row))))
}

fn follow(scene: &Scene, settling: Settling) -> Vec<SettledMotion> {
    let motions: Vec<_> = starts().map(|start| (scene, start)).collect();
    let seen = settling
        .follow_motions(&motions, &unmonitored)
        .expect("not stopped");
    seen.into_iter()
        .map(|seen| seen.expect("a motion"))
        .collect()
}

/// Multiplier -0.962: a motion returns after 16 periods to within 1e-4 long before it does after 8.
#[test]
fn before_a_flip_the_period_is_not_doubled() -> Outcome {
    let scene = machine(1.38739)?;
    let seen = follow(&scene, STUDY);
    let eights = seen.iter().filter(|seen| seen.periods != Some(9));
    let mut count = 0;
    for seen in eights {
        count += 1;
        assert_eq!(seen.periods, Some(8), "{seen:?}");
        for periods in [8, 16, 32] {
            let orbit = Orbit::find_periodic(&scene, seen.end.into(), periods)?;
            assert_eq!(orbit.regime().to_string(), "8/8");
            let [first, second] = orbit.monodromy.multipliers();
            assert_near(first.re, -0.962352, printed(6));
            assert_near(second.re, -0.628294, printed(6));
        }
    }
    assert!(count > 10, "{count}");
    Ok(())
}

/// 8/8 is unstable there, if little, and all motions leave it in the end.
#[test]
fn long_transients_are_followed_to_their_ends() -> Outcome {
    let scene = machine(1.3871499999999999)?;
    let seen = follow(&scene, STUDY);
    assert!(seen.iter().all(|seen| seen.periods == Some(9)), "{seen:?}");
    let late = seen.iter().filter(|seen| seen.followed > STUDY.periods);
    assert!(late.count() >= 2);
    // Each is told the same alone, though rounding may make its transient another.
    for (start, seen) in starts().zip(&seen) {
        let alone = STUDY.follow_motions(&[(&scene, start)], &unmonitored);
        let alone = alone.and_then(|mut alone| alone.pop()).ok_or("stopped")??;
        assert_eq!(alone.regime(), seen.regime());
    }
    Ok(())
}

/// Without patience it is told how long they were followed.
#[test]
fn what_has_not_settled_is_told_as_that() -> Outcome {
    let scene = machine(1.3871499999999999)?;
    let longest = STUDY.periods;
    let seen = follow(&scene, Settling { longest, ..STUDY });
    let open: Vec<&SettledMotion> = seen.iter().filter(|seen| seen.periods.is_none()).collect();
    assert!(open.len() >= 2 && open.iter().all(|seen| seen.followed == longest));
    Ok(())
}
