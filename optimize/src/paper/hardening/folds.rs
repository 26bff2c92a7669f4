//! The branch of z = 1 from grazing to grazing: its folds and flips.

use std::ops::ControlFlow;

use anyhow::anyhow;
use rayon::prelude::*;
use softstop::continuation::{Along, Follower, Limits, Parameter, Special};
use softstop::orbit::{OrbitError, find};

use super::stops::{CLEARANCE, Law, grazing};
use super::swept::RANGE;
use crate::chart::StopFolds;
use crate::failure::Failure;
use crate::interrupt;
use crate::progress::Progress;

/// Where z = 1 is found: near the resonance.
const FREQUENCY: f64 = 1.1;
/// Halvings of the decade of k2 in which folds appear.
const HALVINGS: u32 = 7;

/// Folds and flips for each stiffness k2.
pub(super) fn folds(stiffnesses: &[f64]) -> Result<Vec<StopFolds>, Failure> {
    let progress = Progress::new(stiffnesses.len() as u64, "branches of z = 1");
    let folds = stiffnesses.par_iter().map(|&stiffness| {
        progress.step()?;
        Ok(of(stiffness).map_err(|error| anyhow!(error))?)
    });
    folds.collect()
}

/// The stiffness from which on there are folds, between one without and one with them.
pub(super) fn onset(without: f64, with: f64) -> Result<f64, Failure> {
    let (mut low, mut high) = (without.ln(), with.ln());
    for _ in 0..HALVINGS {
        if interrupt::requested() {
            return Err(Failure::Interrupted);
        }
        let middle = f64::midpoint(low, high);
        let folds = of(middle.exp()).map_err(|error| anyhow!(error))?;
        if folds.strong.is_some() {
            high = middle;
        } else {
            low = middle;
        }
    }
    Ok(f64::midpoint(low, high).exp())
}

fn of(stiffness: f64) -> Result<StopFolds, OrbitError> {
    let scene = Law::KelvinVoigt(stiffness).scene(FREQUENCY, CLEARANCE);
    let state = find(&scene)?.state();
    let family = Along::new(scene, [Parameter::Frequency])?;
    let limits = Limits {
        range: RANGE,
        points: 1000,
    };
    let go_on = |_: &_| {
        if interrupt::requested() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let branch = Follower::new(&family, 1).branch(FREQUENCY, state, &limits, go_on)?;
    let named = |symbol: &'static str| {
        let fits = move |special: &&Special| special.kind.symbol() == symbol;
        branch
            .specials
            .iter()
            .filter(fits)
            .map(|special| &special.point)
    };
    let (_, upper) = grazing(CLEARANCE);
    let strong = named("SN").map(|point| (point.parameter, point.before_impact_velocity()));
    let strong = strong.reduce(|a, b| if a.0 > b.0 { a } else { b });
    let weak = named("SN").filter(|point| point.parameter < upper);
    let weak = weak.map(|point| (point.parameter, point.before_impact_velocity()));
    let flips: Vec<f64> = named("PD").map(|point| point.parameter).collect();
    let first = flips.iter().copied().reduce(f64::min);
    Ok(StopFolds {
        stiffness,
        strong: strong.filter(|fold| fold.0 > upper),
        weak: weak.reduce(|a, b| if a.1 < b.1 { a } else { b }),
        // So near to grazing a branch may be too unstable to be followed to its first flip.
        first_flip: first.filter(|_| flips.len() > 1),
        flip: flips.iter().copied().reduce(f64::max),
    })
}
