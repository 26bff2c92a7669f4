//! The branch of z = 1 from grazing to grazing: its folds and flips.

use std::f64::consts::PI;

use anyhow::Result;
use rayon::prelude::*;
use softstop_dynamics::continuation::{Along, BranchPoint, Follower, Limits, Parameter, Test};
use softstop_dynamics::orbit::{OrbitError, find};

use super::stops::{CLEARANCE, Law, grazing};
use super::swept::RANGE;
use crate::hardening::chart::StopFolds;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::progress::Progress;

/// Where z = 1 is found: near the resonance.
const FREQUENCY: f64 = 1.1;
/// Largest step along a branch: two flips close to each other are not to be stepped over.
const LARGEST: f64 = 0.02;
/// Halvings of the decade of k2 in which folds appear.
const HALVINGS: u32 = 7;

/// Folds and flips for each stiffness k2.
pub(super) fn folds(stiffnesses: &[f64]) -> Result<Vec<StopFolds>> {
    let progress = Progress::new(stiffnesses.len() as u64, "branches of z = 1");
    let folds = stiffnesses.par_iter().map(|&stiffness| {
        progress.step()?;
        Ok(of(stiffness)?)
    });
    folds.collect()
}

/// The stiffness from which on something is true, between one at which it is not and one at which it is.
fn onset((without, with): (f64, f64), is_true: impl Fn(&StopFolds) -> bool) -> Result<f64> {
    let (mut low, mut high) = (without.ln(), with.ln());
    for _ in 0..HALVINGS {
        if interrupt::requested() {
            return Err(Failure::Interrupted.into());
        }
        let middle = f64::midpoint(low, high);
        if is_true(&of(middle.exp())?) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Ok(f64::midpoint(low, high).exp())
}

/// The stiffnesses from which on z = 1 has folds, and from which on it goes beyond grazing, with their names.
pub(super) fn onsets(folds: &[StopFolds]) -> Result<Vec<(String, f64)>> {
    let bends = |fold: &StopFolds| fold.strong.is_some();
    let exceeds = |fold: &StopFolds| {
        fold.strong
            .is_some_and(|fold| fold.0 > grazing(CLEARANCE).1)
    };
    let mut onsets = Vec::new();
    let mut add = |name: &str, is_true: &dyn Fn(&StopFolds) -> bool| -> Result<()> {
        let without = folds.iter().rfind(|fold| !is_true(fold));
        let with = folds.iter().find(|fold| is_true(fold));
        if let (Some(without), Some(with)) = (without, with) {
            let between = (without.stiffness, with.stiffness);
            onsets.push((name.to_owned(), onset(between, is_true)?));
        }
        Ok(())
    };
    add("(1) k2/k1 from which on z = 1 has folds", &bends)?;
    add("(1) k2/k1 from which on s_SN lies beyond g0", &exceeds)?;
    Ok(onsets)
}

fn of(stiffness: f64) -> Result<StopFolds, OrbitError> {
    let mut scene = Law::KelvinVoigt(stiffness).scene(FREQUENCY, CLEARANCE);
    // Time 0 where the mass is on its way far from the stop.
    scene.excitation.phase = PI;
    let state = find(&scene)?.state();
    let family = Along::new(scene, [Parameter::Frequency])?;
    let limits = Limits {
        range: RANGE,
        points: 2000,
    };
    let branch =
        Follower::new(&family, 1)
            .with_steps(LARGEST)
            .branch(FREQUENCY, state, &limits, |_| interrupt::go_on())?;
    let described = |point: &BranchPoint| (point.parameter, point.before_impact_velocity());
    let folds = || branch.critical(Test::Fold).map(described);
    let strong = folds().reduce(|a, b| if a.1 > b.1 { a } else { b });
    let weak = folds().reduce(|a, b| if a.1 < b.1 { a } else { b });
    let flips: Vec<f64> = branch
        .critical(Test::Flip)
        .map(|point| point.parameter)
        .collect();
    let first = flips.iter().copied().reduce(f64::min);
    Ok(StopFolds {
        stiffness,
        strong: strong.filter(|_| strong != weak),
        weak: weak.filter(|_| strong != weak),
        // So near to grazing a branch may be too unstable to be followed to its first flip.
        first_flip: first.filter(|_| flips.len() > 1),
        flip: flips.iter().copied().reduce(f64::max),
    })
}
