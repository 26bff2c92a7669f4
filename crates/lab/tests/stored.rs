//! The stored references are what many digits give, and all built-in scenes have one.

use std::cell::Cell;
use std::fmt::Write;
use std::fs;

use softstop_lab::failures::{Axes, View};
use softstop_lab::methods::Task;
use softstop_lab::precision::case::{self, BUILT_IN};
use softstop_lab::reference::{Reference, stored};

use crate::many_digits::{self, solve};

/// Points of the atlas on each axis, and other stiffnesses that tests look at.
const POINTS: usize = 29;
const MORE: [f64; 2] = [1e3, 1e5];
/// Drive periods of `chatter` in a test, beside its own.
const SHORT: f64 = 0.9;
/// Taylor steps of a motion of the atlas, of both runs: some ten seconds.
const MOST_STEPS: u32 = 40_000;
/// The motions that are computed daily, of so many.
const EACH: usize = 7;

/// A scene by its name among the stored ones, its swept stiffness, and its task.
type Motion = (String, Option<f64>, Task);

/// All motions that are stored, but those of which there is none.
fn motions() -> Vec<Motion> {
    let mut motions = Vec::new();
    for name in BUILT_IN.iter().map(|it| it.name) {
        for periods in [None]
            .into_iter()
            .chain((name == "chatter").then_some(Some(SHORT)))
        {
            let cases = case::cases(name, periods).expect("a built-in scene");
            motions.extend(
                cases
                    .into_iter()
                    .map(|it| (format!("precision/{name}"), None, it.task)),
            );
        }
    }
    for view in View::built_in().expect("the atlas") {
        for stiffness in Axes::new(POINTS).stiffness.into_iter().chain(MORE) {
            let name = format!("failures/{}", view.name);
            motions.push((name, Some(stiffness), view.task(stiffness)));
        }
    }
    motions
}

/// A motion in many digits, unless there is none or the atlas would take too long.
fn solved((_, stiffness, task): &Motion) -> Option<Reference> {
    let asked = Cell::new(0);
    let go_on = |_| {
        asked.set(asked.get() + 1);
        stiffness.is_none() || asked.get() < MOST_STEPS
    };
    solve(task, &go_on)
        .ok()
        .map(many_digits::Reference::rounded)
}

#[test]
fn what_is_stored_is_what_many_digits_give() {
    for motion in motions().iter().step_by(EACH) {
        let (name, stiffness, task) = motion;
        let own = stored(name, task.periods, *stiffness);
        assert_eq!(own, solved(motion), "{name}, {stiffness:?}");
    }
}

#[test]
fn all_linear_scenes_are_stored() {
    let is_missing =
        |(name, stiffness, task): &Motion| stored(name, task.periods, *stiffness).is_none();
    let missing = motions().into_iter().filter(is_missing).map(|it| it.0);
    assert_eq!(missing.collect::<Vec<_>>(), ["precision/hertz"]);
}

/// `cargo test --release -p softstop-lab --test lab stored::write -- --ignored`
#[test]
#[ignore = "writes the references, which takes minutes"]
fn write() {
    let mut text = String::new();
    for motion in motions() {
        let Some(found) = solved(&motion) else {
            continue;
        };
        let (name, stiffness, task) = motion;
        let (stiffness, doubt) = (stiffness.unwrap_or(0.0), found.doubt);
        let head = [
            task.periods,
            stiffness,
            found.end.0,
            found.end.1,
            doubt.end,
            doubt.time,
            doubt.velocity,
        ];
        let impacts = found.impacts.iter().flat_map(|it| [it.time, it.velocity]);
        text += &name;
        for number in head.into_iter().chain(impacts) {
            write!(text, " {number:?}").expect("room");
        }
        text.push('\n');
    }
    let place = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/references.txt");
    fs::write(place, text).expect("written");
}
