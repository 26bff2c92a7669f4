//! Derivatives of designs: of presses in SI units somewhere in their hysteresis zones, by all of their parameters, and of
//! the folds where they are lost. `PROPTEST_CASES=1000` looks at so many.

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use rayon::prelude::*;
use softstop::{Parameter, Ratios, Scene, Strip};
use softstop_dynamics::continuation::TestFunction;
use softstop_dynamics::derivatives::{self, Border};
use softstop_dynamics::nalgebra::Vector2;
use softstop_dynamics::{Orbit, zone};
use softstop_testing::tangent::differences_of;
use softstop_testing::tolerance::DIFFERENCED;
use softstop_testing::{cases, rigid_stop, units};

/// Shares of a parameter over which differences are taken: the best of them counts.
const WIDTHS: [f64; 4] = [1e-3, 2e-4, 4e-5, 8e-6];

/// A press and a place in its zone.
fn designs() -> impl Strategy<Value = (Scene, f64)> {
    (
        (2.0..20.0f64, 1.0..40.0f64, 0.0..100.0f64),
        (0.01..0.06f64, 0.02..0.3f64),
        (50.0..500.0f64, 1e5..1e7f64, 1e3..5e4f64),
        (any::<bool>(), any::<bool>()),
        0.05..0.95f64,
    )
        .prop_map(|(stop, (damping, contact_damping), scales, with, share)| {
            let (clearance, stiffness, preload) = stop;
            let rigid = rigid_stop(5.0, 0.5);
            let ratios = Ratios {
                frequency: 1.0,
                clearance,
                damping,
                contact_damping,
                stiffness,
                preload,
                rigid: with.0.then_some(rigid),
                piercing: with.1.then_some(Strip::PAPER),
            };
            let (mass, stiffness, force) = scales;
            let units = units(mass, stiffness, force);
            let scene = ratios.scene().and_then(|scene| scene.in_units(units));
            (scene.expect("valid"), share)
        })
}

/// What a design is judged by: strength and time of its impact, X_m, lowest position, force, energy.
fn figures(
    orbit: &Orbit,
    parameters: &[Parameter],
) -> Option<Vec<derivatives::DifferentiatedFigure>> {
    let found = derivatives::differentiate_orbit(orbit, parameters).ok()?;
    let strike = found.impacts.into_iter().next()?;
    let figures = [
        strike.velocity,
        strike.time,
        found.max_position,
        found.min_position,
        found.peak_force?,
        found.supplied,
    ];
    Some(figures.to_vec())
}

/// Differences of some numbers in units of themselves and of a parameter, with the error that they claim.
fn differences(
    value: f64,
    sizes: &[f64],
    at: impl Fn(f64) -> Option<Vec<f64>>,
) -> Option<Vec<(f64, f64)>> {
    let scaled = |share: f64| {
        let found = at(share * value)?;
        Some(
            found
                .iter()
                .zip(sizes)
                .map(|(it, size)| it / size)
                .collect(),
        )
    };
    let found = WIDTHS.map(|width| differences_of(scaled, width));
    let better = |a: (f64, f64), b: (f64, f64)| if a.1 < b.1 { a } else { b };
    found.into_iter().flatten().reduce(|a, b| {
        let pairs = a.into_iter().zip(b);
        pairs.map(|(a, b)| better(a, b)).collect()
    })
}

/// Derivatives compared, those that no difference follows, and the largest distance of the others.
type Tally = (usize, usize, f64);

fn compared(found: Option<Vec<(f64, f64)>>, exact: &[f64]) -> Tally {
    let Some(found) = found else {
        return (0, exact.len(), 0.0);
    };
    let each = found.into_iter().zip(exact).map(|((found, error), exact)| {
        let size = 1.0 + exact.abs();
        if error > DIFFERENCED * size {
            return (0, 1, 0.0);
        }
        (1, 0, (found - exact).abs() / size)
    });
    each.fold((0, 0, 0.0), joined)
}

fn joined(a: Tally, b: Tally) -> Tally {
    (a.0 + b.0, a.1 + b.1, a.2.max(b.2))
}

/// All derivatives of a design; none if it has no zone.
fn judged(scene: &Scene, share: f64) -> Option<Tally> {
    let zone = zone::hysteresis(scene).ok()?;
    let orbit = zone.orbit_at(share).ok()?;
    let own = |parameter: &Parameter| parameter.get(scene).is_some_and(|value| value != 0.0);
    let parameters: Vec<Parameter> = Parameter::ALL.into_iter().filter(own).collect();
    let slopes = derivatives::differentiate_orbit(&orbit, &parameters).expect("has derivatives");
    let figures_here = figures(&orbit, &parameters).expect("has derivatives");
    let sizes: Vec<f64> = figures_here
        .iter()
        .map(|figure| figure.value.abs())
        .collect();
    let fold = Border::at_special(
        scene,
        1,
        (TestFunction::Fold, &zone.high.point),
        &parameters,
    )
    .expect("smooth");
    let mut tally = (0, 0, 0.0);
    for (index, parameter) in parameters.iter().enumerate() {
        let value = parameter.get(&orbit.scene)?;
        let along = Vector2::new(slopes.position.by[index], slopes.velocity.by[index]);
        let beside = |shift: f64| {
            let mut scene = Scene::clone(&orbit.scene);
            parameter.set(&mut scene, value + shift);
            let other = Orbit::find_near(&scene, orbit.state() + shift * along).ok()?;
            let found = figures(&other, &[])?;
            Some(found.iter().map(|figure| figure.value).collect())
        };
        let scaled = figures_here.iter().zip(&sizes);
        let exact: Vec<f64> = scaled
            .map(|(figure, size)| figure.by[index] * value / size)
            .collect();
        tally = joined(tally, compared(differences(value, &sizes, beside), &exact));
        if *parameter == Parameter::Frequency {
            continue;
        }
        let value = parameter.get(&fold.scene)?;
        let moved = |shift: f64| {
            let mut scene = fold.scene.clone();
            parameter.set(&mut scene, value + shift);
            Some(vec![fold.find_again(&scene).ok()?.frequency()])
        };
        let size = [fold.frequency()];
        let exact = [-fold.normal[index] * value / size[0]];
        tally = joined(tally, compared(differences(value, &size, moved), &exact));
    }
    Some(tally)
}

#[test]
fn derivatives_of_designs_and_their_folds_equal_differences() {
    let config = cases(40);
    let count = config.cases;
    let mut runner = TestRunner::new(config);
    let mut draw = || designs().new_tree(&mut runner).expect("a design").current();
    let designs: Vec<(Scene, f64)> = (0..count).map(|_| draw()).collect();
    let judged: Vec<Tally> = designs
        .par_iter()
        .filter_map(|(scene, share)| judged(scene, *share))
        .collect();
    let (found, skipped, worst) = judged.iter().copied().fold((0, 0, 0.0), joined);
    println!(
        "{count} designs, {} with a zone: {found} derivatives, {skipped} that no difference follows; off by at most {worst:e}",
        judged.len()
    );
    assert!(judged.len() > count as usize / 2, "{}", judged.len());
    assert!(skipped < found / 50, "{skipped} of {found}");
    assert!(worst < DIFFERENCED, "{worst:e}");
}
