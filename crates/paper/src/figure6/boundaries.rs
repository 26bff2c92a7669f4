//! Where z = 1 ends at each clearance, and the boundaries g0, s_SN and s_PD across them.

use anyhow::{Context, Result};
use nalgebra::Vector2;
use rayon::prelude::*;
use softstop::Ratios;
use softstop::internals::highest_point;
use softstop_dynamics::continuation::{CurvePoint, Direction, TestFunction};
use softstop_dynamics::orbit::find;
use softstop_dynamics::zone::{ZoneError, grazing_frequencies, hysteresis, loss_of_stability};
use softstop_dynamics::{Orbit, StroboscopicMap};

use crate::boundaries::Boundaries;

/// The frequency above which z = 1 is followed to its flip.
const LEAST: f64 = 0.7;
/// Clearances of g0, and from one of its points to the next.
const CLEARANCES: (f64, f64) = (1.0, 24.5);
const SPACING: f64 = 0.5;
/// Width to which the best clearance is found.
const WIDTH: f64 = 1e-3;

/// eta, X_m, X'-.
pub(super) type Figures = [f64; 3];

/// The ends of z = 1 of one machine.
pub(super) struct Ends {
    /// rho.
    pub(super) clearance: f64,
    /// z = 1 at the upper grazing frequency g0.
    pub(super) grazing: Figures,
    /// Its fold s_SN.
    pub(super) fold: Option<Figures>,
    /// Its flip s_PD.
    pub(super) flip: Option<Figures>,
}

/// The ends of z = 1 at each clearance.
pub(super) fn ends(machine: &Ratios, clearances: &[f64]) -> Result<Vec<Ends>> {
    let ends = clearances.par_iter().map(|clearance| {
        let ends = ends_of(&machine.at_clearance(*clearance));
        ends.with_context(|| format!("rho = {clearance}"))
    });
    ends.collect()
}

fn ends_of(machine: &Ratios) -> Result<Ends> {
    let at_g0 = grazing(machine)?;
    let fold = match hysteresis(&machine.scene()?) {
        Ok(zone) => Some(zone.high.point),
        Err(ZoneError::NoFold { .. } | ZoneError::Flip { .. }) => None,
        Err(error) => return Err(error.into()),
    };
    let flip = loss_of_stability(&at_g0, Direction::Down, TestFunction::Flip)?;
    let flip = flip.filter(|point| point.parameter > LEAST);
    let [fold, flip] = [fold, flip].map(|point| {
        let point = point.as_ref();
        point.map(|at| describe(machine, at.parameter, at.state(), &at.impacts))
    });
    Ok(Ends {
        clearance: machine.clearance,
        grazing: figures(&at_g0),
        fold: fold.transpose()?,
        flip: flip.transpose()?,
    })
}

/// z = 1 at g0.
fn grazing(machine: &Ratios) -> Result<Orbit> {
    let scene = machine.scene()?;
    let (_, above) = grazing_frequencies(&scene)?;
    Ok(find(&scene.at_frequency(above))?)
}

/// Those of a motion.
pub(super) fn figures(orbit: &Orbit) -> Figures {
    let eta = orbit.scene.excitation.frequency;
    [eta, orbit.max_position, orbit.before_impact_velocity()]
}

/// Those of z = 1 at a frequency, by a state and the impacts of it.
fn describe(machine: &Ratios, eta: f64, state: Vector2<f64>, impacts: &[f64]) -> Result<Figures> {
    let map = StroboscopicMap::new(&machine.at_frequency(eta).scene()?.check()?, 1);
    let velocity = impacts.iter().copied().fold(0.0, f64::max);
    Ok([eta, map.max_position(state)?, velocity])
}

/// The boundaries across the clearances: names and curves.
pub(super) fn across(machine: &Ratios) -> Result<Vec<(&'static str, Vec<Figures>)>> {
    let count = ((CLEARANCES.1 - CLEARANCES.0) / SPACING) as usize;
    let at_grazing = (0..=count).into_par_iter().map(|index| {
        let machine = machine.at_clearance(CLEARANCES.0 + SPACING * index as f64);
        Some(figures(&grazing(&machine).ok()?))
    });
    let mut curves = vec![("z = 1 at g0", at_grazing.flatten().collect())];
    let described = |at: &CurvePoint| {
        let ([eta, clearance], state) = (at.parameters, Vector2::new(at.position, at.velocity));
        describe(&machine.at_clearance(clearance), eta, state, &at.impacts).ok()
    };
    let boundaries = Boundaries::of(machine)?;
    for (name, _, curve) in &boundaries.curves {
        let points = curve.points.par_iter().filter_map(described);
        curves.push((*name, points.collect()));
    }
    Ok(curves)
}

/// The clearance of the highest velocity at the fold, and that velocity, by golden section between the
/// neighbours of the best of those given.
pub(super) fn optimum(machine: &Ratios, ends: &[Ends]) -> Option<(f64, f64)> {
    let folds = ends.iter().enumerate();
    let folds = folds.filter_map(|(index, end)| Some((index, end.fold?[2])));
    let (best, _) = folds.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let velocity = |clearance: f64| {
        let scene = machine.at_clearance(clearance).scene().ok();
        let zone = scene.and_then(|scene| hysteresis(&scene).ok());
        zone.map_or(f64::NEG_INFINITY, |zone| {
            zone.high.point.before_impact_velocity()
        })
    };
    let low = ends.get(best.wrapping_sub(1))?.clearance;
    let high = ends.get(best + 1)?.clearance;
    Some(highest_point(low, high, WIDTH, velocity))
}
