//! The branch of z = 1 from grazing to grazing: its folds and flips.

use std::f64::consts::PI;

use anyhow::Result;
use rayon::prelude::*;
use softstop_dynamics::BranchPoint;
use softstop_dynamics::continuation::TestFunction;

use super::stops::{CLEARANCE, Law, grazing};
use super::swept::RANGE;
use crate::boundaries::branch;
use crate::figure::Findings;
use softstop_console::failure::check_interrupt;
use softstop_console::progress::Progress;

/// Where z = 1 is found: near the resonance.
const FREQUENCY: f64 = 1.1;
/// Largest step along a branch: two flips close to each other are not to be stepped over.
const LARGEST: f64 = 0.02;
/// Most points of a branch in each direction.
const MOST: usize = 2000;
/// Halvings of the decade of k2 in which folds appear.
const HALVINGS: u32 = 7;

/// Where the branch of z = 1 bends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Folds {
    /// k2/k1.
    pub(super) stiffness: f64,
    /// η and X'₋ where strong impacts end.
    pub(super) strong: Option<(f64, f64)>,
    /// η and X'₋ where weak impacts end.
    pub(super) weak: Option<(f64, f64)>,
    /// η of the flip right beyond grazing, below the resonance.
    pub(super) first_flip: Option<f64>,
    /// η of the flip from which on z = 1 is stable.
    pub(super) flip: Option<f64>,
}

impl Folds {
    /// The stiffness, and the widths of weak impacts and of hysteresis in η.
    pub(super) fn widths(&self) -> Option<[f64; 3]> {
        let (weak, strong) = (self.weak?.0, self.strong?.0);
        Some([self.stiffness, grazing(CLEARANCE).1 - weak, strong - weak])
    }
}

/// Folds and flips for each stiffness k2.
pub(super) fn folds(stiffnesses: &[f64]) -> Result<Vec<Folds>> {
    let progress = Progress::new(stiffnesses.len() as u64, "branches of z = 1");
    let folds = stiffnesses.par_iter().map(|&stiffness| {
        progress.step()?;
        of(stiffness)
    });
    folds.collect()
}

/// The stiffnesses from which on z = 1 has folds, and from which on it goes beyond grazing.
pub(super) fn onsets(findings: &mut Findings, folds: &[Folds]) -> Result<()> {
    let bends = |fold: &Folds| fold.strong.is_some();
    let exceeds = |fold: &Folds| fold.strong.is_some_and(|it| it.0 > grazing(CLEARANCE).1);
    let (first, second) = (onset(folds, bends)?, onset(folds, exceeds)?);
    findings.add("(1) k2/k1 from which on z = 1 has folds", first);
    findings.add("(1) k2/k1 from which on s_SN lies beyond g0", second);
    Ok(())
}

/// The stiffness from which on something is true, if it is so of some and not of others.
fn onset(folds: &[Folds], is_true: impl Fn(&Folds) -> bool) -> Result<Option<f64>> {
    let without = folds.iter().rfind(|fold| !is_true(fold));
    let with = folds.iter().find(|fold| is_true(fold));
    let (Some(without), Some(with)) = (without, with) else {
        return Ok(None);
    };
    let (mut low, mut high) = (without.stiffness.ln(), with.stiffness.ln());
    for _ in 0..HALVINGS {
        check_interrupt()?;
        let middle = f64::midpoint(low, high);
        match is_true(&of(middle.exp())?) {
            true => high = middle,
            false => low = middle,
        }
    }
    Ok(Some(f64::midpoint(low, high).exp()))
}

fn of(stiffness: f64) -> Result<Folds> {
    let mut scene = Law::KelvinVoigt(stiffness).scene(FREQUENCY, CLEARANCE);
    // Time 0 where the mass is on its way far from the stop.
    scene.excitation.phase = PI;
    let branch = branch(scene, RANGE, MOST, LARGEST)?;
    let described = |point: &BranchPoint| (point.parameter, point.before_impact_velocity());
    let folds = || branch.critical_points(TestFunction::Fold).map(described);
    let strong = folds().reduce(|a, b| if a.1 > b.1 { a } else { b });
    let weak = folds().reduce(|a, b| if a.1 < b.1 { a } else { b });
    let flips = branch
        .critical_points(TestFunction::Flip)
        .map(|point| point.parameter);
    let flips: Vec<f64> = flips.collect();
    let first = flips.iter().copied().reduce(f64::min);
    Ok(Folds {
        stiffness,
        strong: strong.filter(|_| strong != weak),
        weak: weak.filter(|_| strong != weak),
        // So near to grazing a branch may be too unstable to be followed to its first flip.
        first_flip: first.filter(|_| flips.len() > 1),
        flip: flips.iter().copied().reduce(f64::max),
    })
}
