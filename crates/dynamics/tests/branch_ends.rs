//! Branches of random machines of all laws: each ends in something that has a name, and impacts come and go at grazings alone.
//! What they end in is printed.
//!
//! A thousand machines: `PROPTEST_CASES=1000 cargo test --release -p softstop-dynamics --test dynamics branch_ends -- --nocapture`

use std::cell::RefCell;
use std::collections::BTreeMap;

use crate::branches;
use nalgebra::Vector2;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use softstop::{Parameter, Scene, Stop};
use softstop_dynamics::continuation::{BranchEnd, SpecialKind};
use softstop_dynamics::orbit::{OrbitError, find};
use softstop_dynamics::{Branch, BranchPoint, Orbit, ParameterFamily, StroboscopicMap};
use softstop_testing::machines::machines;
use softstop_testing::random;

/// Points of a branch in each direction, as `softstop continue` has it.
const POINTS: usize = 2000;

/// A machine with any stop, walls without rebound and power laws of exponent 1 among them.
fn scenes() -> impl Strategy<Value = Scene> {
    let machine = (machines(), any::<bool>(), any::<bool>());
    machine.prop_map(|(mut scene, is_dead, is_linear)| {
        if let (Some(wall), true) = (&mut scene.rigid, is_dead) {
            wall.restitution = 0.0;
        }
        if let (Stop::Hertz { exponent, .. }, true) = (&mut scene.stop, is_linear) {
            *exponent = 1.0;
        }
        scene
    })
}

/// Its z = 1, or what it settles on from rest, if that repeats soon.
fn orbit(scene: &Scene) -> Option<Orbit> {
    if let Ok(orbit) = find(scene) {
        return Some(orbit);
    }
    let map = StroboscopicMap::new(&scene.check().ok()?, 1);
    let start = Vector2::new(scene.clearance - 1.0, 0.0);
    let state = (0..200).try_fold(start, |state, _| map.image(state)).ok()?;
    (1..=4).find_map(|periods| Orbit::find_periodic(scene, state, periods).ok())
}

/// Its branch along the frequency, over two octaves, or along the clearance.
fn branch(scene: &Scene, orbit: &Orbit, along: Parameter) -> Result<Branch, OrbitError> {
    let family = ParameterFamily::new(scene.clone(), [along]).expect("every machine has it");
    let value = along.get(scene).expect("every machine has it");
    let range = match along {
        Parameter::Frequency => (0.5 * value, 2.0 * value),
        _ => (value - 3.0, value + 3.0),
    };
    let from = (value, orbit.state());
    branches::follow(&family, orbit.periods, from, range, POINTS)
}

/// The determinant below which an orbit comes to rest: how many of its bounces are told one by one is the simulation's choice.
const RESTS: f64 = 1e-12;

/// Points between which the number of impacts changes without a grazing; where the branch merges into that of half as many
/// periods, it doubles.
fn untold(branch: &Branch) -> Vec<(&BranchPoint, &BranchPoint)> {
    let is_grazing = |point: &BranchPoint| {
        let special = branch.special_at(point);
        special.is_some_and(|special| matches!(special.kind, SpecialKind::Grazing(_)))
    };
    let [first, last] =
        [&branch.ends.0, &branch.ends.1].map(|end| usize::from(matches!(end, BranchEnd::Merged)));
    let points = &branch.points[first..branch.points.len() - last];
    let pairs = points.iter().zip(points.iter().skip(1));
    pairs
        .filter(|(a, b)| a.impacts.len() != b.impacts.len())
        .filter(|(a, b)| {
            [a, b]
                .iter()
                .all(|point| point.monodromy.determinant() > RESTS)
        })
        .filter(|(a, b)| !is_grazing(a) && !is_grazing(b))
        .collect()
}

#[test]
fn every_branch_ends_in_something_named_and_tells_each_grazing() {
    let along = prop_oneof![
        2 => Just(Parameter::Frequency),
        1 => Just(Parameter::Clearance)
    ];
    let counts = RefCell::new(BTreeMap::<String, usize>::new());
    let count = |what: String| *counts.borrow_mut().entry(what).or_default() += 1;
    let lost = RefCell::new(Vec::new());
    let judge = |(scene, along): (Scene, Parameter)| {
        let Some(orbit) = orbit(&scene) else {
            count("no orbit found".to_owned());
            return Ok(());
        };
        match branch(&scene, &orbit, along) {
            Ok(branch) => {
                for change in untold(&branch) {
                    lost.borrow_mut()
                        .push(format!("{along:?}: {change:?} {scene:?}"));
                }
                for end in [&branch.ends.0, &branch.ends.1] {
                    count(format!("{end:?}"));
                    if matches!(end, BranchEnd::Lost(_) | BranchEnd::Stopped) {
                        lost.borrow_mut()
                            .push(format!("{along:?}: {end:?} {scene:?}"));
                    }
                }
            }
            Err(OrbitError::NotIsolated) => count("rest for good".to_owned()),
            Err(error) => lost
                .borrow_mut()
                .push(format!("{along:?}: {error} {scene:?}")),
        }
        Ok(())
    };
    let judged = TestRunner::new(random::cases(120)).run(&(scenes(), along), judge);
    judged.expect("nothing is refused");
    println!("{:#?}", counts.borrow());
    assert!(lost.borrow().is_empty(), "{:#?}", lost.borrow());
}
