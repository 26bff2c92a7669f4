//! The boundaries g0, s_SN and s_PD across the clearances.

use anyhow::{Context, Result};
use rayon::prelude::*;
use softstop::{Ratios, Scene};
use softstop_dynamics::continuation::{
    Along, BranchPoint, Curve, Family, Heading, Parameter, Region, SpecialKind, Test, curve,
};
use softstop_dynamics::internals::highest;
use softstop_dynamics::orbit::{Orbit, StroboscopicMap, find};
use softstop_dynamics::zone::{
    ZoneError, free_amplitude, grazing_frequencies, hysteresis, loss_of_stability,
};

use crate::figure;
use crate::figure6::chart::Boundaries;
use softstop_console::interrupt;
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

/// A special point of z = 1, and its eta, X_m, X'-.
pub(super) type Critical = (BranchPoint, [f64; 3]);

/// The ends of z = 1 of one machine.
pub(super) struct Ends {
    /// rho.
    pub clearance: f64,
    /// z = 1 at the upper grazing frequency g0: eta, X_m, X'-.
    pub grazing: [f64; 3],
    /// Its fold s_SN.
    pub fold: Option<Critical>,
    /// Its flip s_PD.
    pub flip: Option<Critical>,
}

/// The ends of z = 1 at each clearance.
pub(super) fn ends(machine: &Ratios, clearances: &[f64], progress: &Progress) -> Result<Vec<Ends>> {
    clearances
        .par_iter()
        .map(|clearance| {
            progress.step()?;
            let machine = machine.at_clearance(*clearance);
            ends_of(&machine).with_context(|| format!("rho = {clearance}"))
        })
        .collect()
}

fn ends_of(machine: &Ratios) -> Result<Ends> {
    let scene = machine.scene()?;
    let at_g0 = grazing(&scene)?;
    let described = |point: Option<BranchPoint>| -> Result<_> {
        let Some(point) = point else { return Ok(None) };
        let mut scene = scene.clone();
        scene.excitation.frequency = point.parameter;
        let found = describe(&scene, point.parameter, &point)?;
        Ok(Some((point, found)))
    };
    let fold = match hysteresis(&scene) {
        Ok(zone) => Some(zone.fold),
        Err(ZoneError::NoFold { .. } | ZoneError::Flip { .. }) => None,
        Err(error) => return Err(error.into()),
    };
    let flip = loss_of_stability(&at_g0, Heading::Down, Test::Flip)?;
    Ok(Ends {
        clearance: machine.clearance,
        grazing: figures(&at_g0),
        fold: described(fold)?,
        flip: described(flip.filter(|point| point.parameter > RANGE.0))?,
    })
}

/// z = 1 at g0.
fn grazing(scene: &Scene) -> Result<Orbit> {
    let mut scene = scene.clone();
    scene.excitation.frequency = grazing_frequencies(&scene)?.1;
    Ok(find(&scene)?)
}

/// eta, X_m, X'-.
fn figures(orbit: &Orbit) -> [f64; 3] {
    [
        orbit.scene.excitation.frequency,
        orbit.max_position,
        orbit.before_impact_velocity(),
    ]
}

fn describe(
    scene: &Scene,
    eta: f64,
    point: &BranchPoint,
) -> Result<[f64; 3], softstop::MotionError> {
    let highest = StroboscopicMap::new(scene, 1)?.max_position(point.state())?;
    Ok([eta, highest, point.before_impact_velocity()])
}

/// The curves across the clearances, from the points at some of them; `step` as in [`Region`].
pub(super) fn across(
    machine: &Ratios,
    ends: &[Ends],
    step: f64,
    progress: &Progress,
) -> Result<Boundaries> {
    let follow = |test: Test, pick: fn(&Ends) -> Option<&Critical>| {
        let found = ends
            .iter()
            .filter_map(|end| Some((end.clearance, &pick(end)?.0)));
        let found: Vec<(f64, &BranchPoint)> = found.collect();
        let pieces = (0..found.len()).into_par_iter().map(|index| {
            progress.step()?;
            let (clearance, point) = found[index];
            let half_way = |other: &(f64, &BranchPoint)| f64::midpoint(clearance, other.0);
            let before = index.checked_sub(1).map(|before| half_way(&found[before]));
            let after = found.get(index + 1).map(half_way);
            let range = (
                before.unwrap_or(CLEARANCES.0),
                after.unwrap_or(CLEARANCES.1),
            );
            Ok(piece(machine, clearance, (test, point), range, step))
        });
        pieces.collect::<Result<Vec<_>>>()
    };
    let count = ((CLEARANCES.1 - CLEARANCES.0) / SPACING) as usize;
    let clearances = (0..=count).map(|index| CLEARANCES.0 + SPACING * index as f64);
    let at_grazing = clearances
        .collect::<Vec<f64>>()
        .into_par_iter()
        .map(|clearance| {
            let machine = Ratios {
                clearance,
                ..*machine
            };
            Some(figures(&grazing(&machine.scene().ok()?).ok()?))
        });
    Ok(Boundaries {
        response: machine.scene().map_or(Vec::new(), |scene| response(&scene)),
        grazing: at_grazing.flatten().collect(),
        folds: follow(Test::Fold, |ends| ends.fold.as_ref())?,
        flips: follow(Test::Flip, |ends| ends.flip.as_ref())?,
    })
}

/// The curve through a special point, within a range of clearances.
fn piece(
    machine: &Ratios,
    clearance: f64,
    (test, point): (Test, &BranchPoint),
    range: (f64, f64),
    step: f64,
) -> Vec<[f64; 3]> {
    let machine = Ratios {
        clearance,
        frequency: point.parameter,
        ..*machine
    };
    let region = Region {
        ranges: [RANGE, range],
        points: CURVE_POINTS,
        step,
    };
    let parameters = [Parameter::Frequency, Parameter::Clearance];
    let family = machine
        .scene()
        .and_then(|scene| Along::new(scene, parameters));
    let Ok(family) = family else {
        return Vec::new();
    };
    let start = (SpecialKind::Critical(test), point);
    let parameters = [point.parameter, clearance];
    let found = curve(&family, 1, start, parameters, &region, |_| {
        interrupt::go_on()
    });
    let described = |curve: Curve| {
        let points = curve.points.iter().filter_map(|at| {
            let scene = family.scene(at.parameters).ok()?;
            let point = BranchPoint {
                parameter: at.parameters[0],
                position: at.position,
                velocity: at.velocity,
                impacts: at.impacts.clone(),
                monodromy: at.monodromy,
            };
            describe(&scene, at.parameters[0], &point).ok()
        });
        points.collect()
    };
    found.map(described).unwrap_or_default()
}

/// Amplitude of the free mass over eta.
fn response(scene: &Scene) -> Vec<(f64, f64)> {
    let etas = (0..=2400).map(|index| RANGE.0 + (RANGE.1 - RANGE.0) * f64::from(index) / 2400.0);
    etas.map(|eta| (eta, free_amplitude(scene, eta))).collect()
}

/// The clearance of the highest velocity at the fold, and that velocity, by golden section between the
/// neighbours of the best of those given.
pub(super) fn optimum(machine: &Ratios, ends: &[Ends]) -> Option<(f64, f64)> {
    let best = ends
        .iter()
        .enumerate()
        .filter_map(|(index, end)| Some((index, end.fold.as_ref()?.1[2])))
        .max_by(|a, b| a.1.total_cmp(&b.1))?
        .0;
    let velocity = |clearance: f64| {
        let machine = machine.at_clearance(clearance);
        let zone = machine
            .scene()
            .ok()
            .and_then(|scene| hysteresis(&scene).ok());
        zone.map_or(f64::NEG_INFINITY, |zone| zone.velocity_sn)
    };
    let low = ends.get(best.wrapping_sub(1))?.clearance;
    let high = ends.get(best + 1)?.clearance;
    Some(highest(low, high, WIDTH, velocity))
}

/// The curves as a table.
pub(super) fn table(boundaries: &Boundaries) -> Result<Vec<u8>> {
    let columns = "boundary,eta,max_position,before_impact_velocity";
    let named = |name: &'static str, points: &[[f64; 3]]| {
        let rows = points
            .iter()
            .map(move |[eta, highest, velocity]| (name, *eta, *highest, *velocity));
        rows.collect::<Vec<_>>()
    };
    let mut rows = named("z = 1 at g0", &boundaries.grazing);
    for piece in &boundaries.folds {
        rows.extend(named("s_SN", piece));
    }
    for piece in &boundaries.flips {
        rows.extend(named("s_PD", piece));
    }
    figure::table(columns, rows)
}
