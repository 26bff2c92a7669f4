//! Contacts that steps of fixed length pass over or never leave.

use super::*;
use softstop::Start;
use softstop_testing::assert_near;
use softstop_testing::tolerance::SOLVED;

/// The paper's machine from rest with a velocity at which it just reaches the stop within the first period.
fn grazing() -> Task {
    let task = |velocity| {
        Task::new(
            Ratios::unloaded().scene().expect("valid"),
            Start::new(0.0, velocity),
            0.5,
            1_000_000,
        )
    };
    let strikes = |velocity| {
        !Exact
            .integrate(&task(velocity))
            .expect("exact")
            .impacts
            .is_empty()
    };
    let (mut misses, mut hits) = (5.0, 14.0);
    assert!(!strikes(misses) && strikes(hits));
    while hits - misses > 1e-9 {
        let middle = 0.5 * (misses + hits);
        if strikes(middle) {
            hits = middle;
        } else {
            misses = middle;
        }
    }
    task(hits + 1e-6)
}

/// Two crossings within one step cancel: every method of fixed steps misses a graze that is shorter than its
/// step, events located or not; and sees it with steps that are short enough. The exact one needs none.
#[test]
fn a_graze_is_stepped_over() {
    let task = grazing();
    assert_eq!(Exact.integrate(&task).expect("exact").impacts.len(), 1);
    // The errors of first-order schemes decide for themselves whether these reach the stop.
    let accurate = |method: &FixedStep| method.scheme.order() > 1;
    for method in FixedStep::all(0.01).into_iter().filter(accurate) {
        let found = method.integrate(&task).expect("bounded");
        assert!(found.impacts.is_empty(), "{}", method.name());
    }
    let fine = FixedStep::new(Scheme::RungeKutta4, 1e-4, Events::Located);
    assert_eq!(fine.integrate(&task).expect("bounded").impacts.len(), 1);
}

/// Bounces that come to rest on a stop that the mass is pressed onto: located steps of second order and higher
/// follow them down to the rounding of a position, those of Moreau come to rest after the few that they see, all
/// others bounce on the grid for ever or stick too early. (Explicit Euler's shortest flights are straight,
/// semi-implicit Euler's come back without speed.)
#[test]
fn chatter_is_counted_by_location_only() {
    let base = Ratios::unloaded().scene().expect("valid");
    let scene = Scene {
        clearance: -0.5,
        stop: Stop::Rigid { restitution: 0.6 },
        excitation: Excitation {
            amplitude: 0.2,
            ..base.excitation
        },
        ..base
    };
    let task = Task::new(scene, Start::new(-0.6, 1.0), 3.0, 1_000_000);
    let exact = Exact.integrate(&task).expect("exact");
    assert_eq!(exact.end, (-0.5, 0.0));
    for method in FixedStep::all(1e-3) {
        let found = method.integrate(&task).expect("bounded");
        let apart = found.impacts.len().abs_diff(exact.impacts.len());
        let agrees = apart <= 3 && found.end == exact.end;
        let sees = method.events == Events::Located && method.scheme.order() > 1;
        assert_eq!(agrees, sees, "{}: {apart}", method.name());
    }
    let moreau = Moreau {
        step: 1e-3,
        theta: 0.5,
    };
    let found = moreau.integrate(&task).expect("bounded");
    assert_near(found.end.0, -0.5, 1e-3);
    assert_near(found.end.1, 0.0, 10.0 * SOLVED);
    assert!((3..exact.impacts.len()).contains(&found.impacts.len()));
}

/// On a preloaded face, pressed with less than the preload, bounces shrink by viscous damping alone: their number
/// has no end, but that of steps has: located steps of second order and higher follow them until none is left.
#[test]
fn bounces_without_end_are_stuck() {
    let base = Ratios::unloaded().scene().expect("valid");
    let task = Task::new(
        Scene {
            clearance: -2.0,
            ..base
        },
        Start::new(-2.000_001, 0.0),
        20.0,
        20_000,
    );
    Exact.integrate(&task).expect("exact");
    for method in FixedStep::all(1e-2) {
        let found = method.integrate(&task);
        let is_stuck = matches!(found, Err(MethodError::Stuck { .. }));
        let sees = method.events == Events::Located && method.scheme.order() > 1;
        assert_eq!(is_stuck, sees, "{}", method.name());
    }
}
