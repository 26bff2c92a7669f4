//! All built-in scenes but that of a power law have a reference.

use softstop_lab::failures::{Axes, built_in};
use softstop_lab::precision::case::{self, ALL};

/// Points of the atlas on each axis, and other stiffnesses that tests look at.
const POINTS: usize = 29;
const MORE: [f64; 2] = [1e3, 1e5];
/// Numbers of drive periods that tests look at, beside a scene's own.
const SHORT: [(&str, f64); 5] = [
    ("chatter", 0.9),
    ("periodic", 1.0),
    ("periodic", 3.0),
    ("loaded", 2.0),
    ("sticking", 1.2),
];

#[test]
fn all_linear_scenes_are_stored() {
    let own = [(ALL, None)].into_iter();
    let short = SHORT.map(|(name, periods)| (name, Some(periods)));
    let cases = own
        .chain(short)
        .map(|(name, periods)| case::cases(name, periods));
    let cases = cases.flat_map(|cases| cases.expect("built-in scenes"));
    let missing = cases
        .filter(|it| it.stored(None).is_none())
        .map(|it| it.name);
    assert_eq!(missing.collect::<Vec<_>>(), ["hertz"]);
    for case in built_in().expect("the atlas") {
        for stiffness in Axes::new(POINTS).stiffness.into_iter().chain(MORE) {
            let stored = case.stored(Some(stiffness));
            assert!(stored.is_some(), "{}, {stiffness}", case.name);
        }
    }
}
