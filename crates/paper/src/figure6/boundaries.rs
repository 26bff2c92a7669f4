//! The boundaries g0, s_SN and s_PD across the clearances.

use anyhow::{Context, Result};
use nalgebra::Vector2;
use rayon::prelude::*;
use softstop::internals::highest;
use softstop::{Ratios, Scene};
use softstop_dynamics::continuation::{CurvePoint, Heading, Region, SpecialKind, Test};
use softstop_dynamics::orbit::find;
use softstop_dynamics::zone::{
    ZoneError, free_amplitude, grazing_frequencies, hysteresis, loss_of_stability,
};
use softstop_dynamics::{BranchPoint, Orbit, StroboscopicMap};

use crate::{curves, figure};
use softstop_console::progress::Progress;

/// Frequencies within which z = 1 is followed.
const RANGE: (f64, f64) = (0.7, 1.9);
/// Clearances of the curves.
const CLEARANCES: (f64, f64) = (1.0, 24.5);
/// Clearances from one point of g0 to the next.
const SPACING: f64 = 0.5;
/// Most points of a curve in each direction: one that comes to an orbit that grazes creeps.
const CURVE_POINTS: usize = 300;
/// Width to which the best clearance is found.
const WIDTH: f64 = 1e-3;

/// eta, X_m, X'-.
type Figures = [f64; 3];
/// A special point of z = 1.
type Critical = (BranchPoint, Figures);

/// The ends of z = 1 of one machine.
pub struct Ends {
    /// rho.
    pub clearance: f64,
    /// z = 1 at the upper grazing frequency g0.
    pub grazing: Figures,
    /// Its fold s_SN.
    pub fold: Option<Critical>,
    /// Its flip s_PD.
    pub flip: Option<Critical>,
}

/// Boundaries across the clearances.
pub struct Boundaries {
    /// Amplitude of the free mass over eta.
    pub response: Vec<(f64, f64)>,
    /// z = 1 at the grazing g0 above resonance.
    pub grazing: Vec<Figures>,
    /// s_SN in pieces.
    pub folds: Vec<Vec<Figures>>,
    /// s_PD in pieces.
    pub flips: Vec<Vec<Figures>>,
}

/// The ends of z = 1 at each clearance.
pub fn ends(machine: &Ratios, clearances: &[f64], progress: &Progress) -> Result<Vec<Ends>> {
    let ends = clearances.par_iter().map(|clearance| {
        progress.step()?;
        let machine = machine.at_clearance(*clearance);
        ends_of(&machine).with_context(|| format!("rho = {clearance}"))
    });
    ends.collect()
}

fn ends_of(machine: &Ratios) -> Result<Ends> {
    let scene = machine.scene()?;
    let at_g0 = grazing(&scene)?;
    let described = |point: BranchPoint| -> Result<Critical> {
        let found = describe(machine, point.parameter, point.state(), &point.impacts)?;
        Ok((point, found))
    };
    let fold = match hysteresis(&scene) {
        Ok(zone) => Some(zone.fold),
        Err(ZoneError::NoFold { .. } | ZoneError::Flip { .. }) => None,
        Err(error) => return Err(error.into()),
    };
    let flip = loss_of_stability(&at_g0, Heading::Down, Test::Flip)?;
    let flip = flip.filter(|point| point.parameter > RANGE.0);
    Ok(Ends {
        clearance: machine.clearance,
        grazing: figures(&at_g0),
        fold: fold.map(described).transpose()?,
        flip: flip.map(described).transpose()?,
    })
}

/// z = 1 at g0.
fn grazing(scene: &Scene) -> Result<Orbit> {
    let (_, above) = grazing_frequencies(scene)?;
    Ok(find(&scene.at_frequency(above))?)
}

/// Those of a motion.
pub fn figures(orbit: &Orbit) -> Figures {
    let eta = orbit.scene.excitation.frequency;
    [eta, orbit.max_position, orbit.before_impact_velocity()]
}

/// Those of z = 1 at a frequency, by a state and the impacts of it.
fn describe(machine: &Ratios, eta: f64, state: Vector2<f64>, impacts: &[f64]) -> Result<Figures> {
    let map = StroboscopicMap::new(&machine.at_frequency(eta).scene()?, 1)?;
    let velocity = impacts.iter().copied().fold(0.0, f64::max);
    Ok([eta, map.max_position(state)?, velocity])
}

/// The curves across the clearances, from the points at some of them; `step` as in [`Region`].
pub fn across(
    machine: &Ratios,
    ends: &[Ends],
    step: f64,
    progress: &Progress,
) -> Result<Boundaries> {
    let follow = |test: Test, pick: fn(&Ends) -> Option<&Critical>| {
        let found = ends.iter();
        let found = found.filter_map(|end| Some((end.clearance, &pick(end)?.0)));
        let found: Vec<(f64, &BranchPoint)> = found.collect();
        let pieces = (0..found.len()).into_par_iter().map(|index| {
            progress.step()?;
            let (clearance, point) = found[index];
            let half_way = |other: &(f64, &BranchPoint)| f64::midpoint(clearance, other.0);
            let before = index.checked_sub(1).map(|before| half_way(&found[before]));
            let after = found.get(index + 1).map(half_way);
            let clearances = (
                before.unwrap_or(CLEARANCES.0),
                after.unwrap_or(CLEARANCES.1),
            );
            let region = Region {
                ranges: [RANGE, clearances],
                points: CURVE_POINTS,
                step,
            };
            let special = (SpecialKind::Critical(test), point);
            Ok(piece(&machine.at_clearance(clearance), special, &region))
        });
        pieces.collect::<Result<Vec<_>>>()
    };
    let count = ((CLEARANCES.1 - CLEARANCES.0) / SPACING) as usize;
    let at_grazing = (0..=count).into_par_iter().map(|index| {
        let machine = machine.at_clearance(CLEARANCES.0 + SPACING * index as f64);
        Some(figures(&grazing(&machine.scene().ok()?).ok()?))
    });
    Ok(Boundaries {
        response: response(&machine.scene()?),
        grazing: at_grazing.flatten().collect(),
        folds: follow(Test::Fold, |ends| ends.fold.as_ref())?,
        flips: follow(Test::Flip, |ends| ends.flip.as_ref())?,
    })
}

/// Amplitude of the free mass over eta.
fn response(scene: &Scene) -> Vec<(f64, f64)> {
    let etas = (0..=2400).map(|index| RANGE.0 + (RANGE.1 - RANGE.0) * f64::from(index) / 2400.0);
    etas.map(|eta| (eta, free_amplitude(scene, eta))).collect()
}

/// As much as can be followed of the curve through a special point.
fn piece(machine: &Ratios, special: (SpecialKind, &BranchPoint), region: &Region) -> Vec<Figures> {
    let machine = machine.at_frequency(special.1.parameter);
    let described = |at: &CurvePoint| {
        let [eta, clearance] = at.parameters;
        let state = Vector2::new(at.position, at.velocity);
        describe(&machine.at_clearance(clearance), eta, state, &at.impacts).ok()
    };
    let found = curves::critical(&machine, special, region);
    let points = found.map(|curve| curve.points).unwrap_or_default();
    points.iter().filter_map(described).collect()
}

/// The clearance of the highest velocity at the fold, and that velocity, by golden section between the
/// neighbours of the best of those given.
pub fn optimum(machine: &Ratios, ends: &[Ends]) -> Option<(f64, f64)> {
    let folds = ends.iter().enumerate();
    let folds = folds.filter_map(|(index, end)| Some((index, end.fold.as_ref()?.1[2])));
    let (best, _) = folds.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let velocity = |clearance: f64| {
        let scene = machine.at_clearance(clearance).scene().ok();
        let zone = scene.and_then(|scene| hysteresis(&scene).ok());
        zone.map_or(f64::NEG_INFINITY, |zone| zone.velocity_sn)
    };
    let low = ends.get(best.wrapping_sub(1))?.clearance;
    let high = ends.get(best + 1)?.clearance;
    Some(highest(low, high, WIDTH, velocity))
}

/// The curves as a table.
pub fn table(boundaries: &Boundaries) -> Result<Vec<u8>> {
    let named = |name: &'static str| move |point: &Figures| (name, *point);
    let grazing = boundaries.grazing.iter().map(named("z = 1 at g0"));
    let folds = boundaries.folds.iter().flatten().map(named("s_SN"));
    let flips = boundaries.flips.iter().flatten().map(named("s_PD"));
    let columns = "boundary,eta,max_position,before_impact_velocity";
    figure::table(columns, grazing.chain(folds).chain(flips))
}
