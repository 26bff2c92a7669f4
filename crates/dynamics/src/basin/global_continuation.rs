//! Global continuation: the basins at many values of a parameter, and which attractor at one value is which at the next
//! (Datseris, Rossi, Wagemakers, Chaos 33 (2023) 073151).
//!
//! An attractor goes on as the nearest orbit of its regime, or as one of another regime that lies near by: after a soft flip,
//! say. The motion from its state is followed at the next value, so that an attractor is found also if no cell leads to it.
//! One orbit continues one attractor; what continues none is new.

use super::basin_survey::find_basins_of_scenes;
use super::{BasinEntropy, BasinOptions, Basins, Grid};
use crate::attractors::{Attractor, SearchOptions, settle_starts};
use crate::monitor::{Monitor, OptionalMemory};
use crate::orbit::recurrence::{motion_size, state_distance};
use crate::orbit::{Orbit, OrbitError};
use crate::tolerance::{NEIGHBOUR, SAME};
use softstop::{Scene, Start};

/// The basins at one value of a parameter.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct BasinsAt {
    /// The parameter's value.
    pub value: f64,
    /// The basins; an attractor to which no cell leads has a basin without cells.
    pub basins: Basins,
    /// The number of the attractor of each basin, from 1, the same at all values.
    pub attractors: Vec<usize>,
    /// The basin entropy.
    pub entropy: BasinEntropy,
}

/// Follows attractors along a parameter: the basins of scenes, one for each value, in order; the grid is the same for all. The
/// monitor is told of the cells done at all values, and of each value whose attractors have been carried over.
///
/// # Errors
/// As [`find_basins`](super::find_basins).
pub fn follow_attractors(
    scenes: &[(f64, Scene)],
    grid: &Grid,
    options: &BasinOptions,
    monitor: Monitor<'_>,
    kept: OptionalMemory<'_>,
) -> Result<Vec<BasinsAt>, OrbitError> {
    let cells = (grid.cell_count() * scenes.len()) as u64;
    let planned = cells + scenes.len() as u64;
    let all = scenes.iter().map(|(_, scene)| scene);
    let before_carrying = |done, _| monitor(done, planned);
    let all = find_basins_of_scenes(all, grid, options, &before_carrying, kept)?;
    let mut found: Vec<BasinsAt> = Vec::with_capacity(scenes.len());
    let mut known = 0;
    for ((value, scene), mut basins) in scenes.iter().zip(all) {
        let mut surest = Vec::new();
        if let Some(last) = found.last() {
            let pause = |_, _| monitor(cells + found.len() as u64, planned);
            carry_over_orbits(last, scene, &mut basins, options, &pause)?;
            surest = find_claims(last, &basins)?;
        }
        let mut attractors = vec![None; basins.classes.len()];
        for claim in surest {
            if attractors[claim.class].is_none() && !attractors.contains(&Some(claim.attractor)) {
                attractors[claim.class] = Some(claim.attractor);
            }
        }
        let number = |attractor: Option<usize>| {
            attractor.unwrap_or_else(|| {
                known += 1;
                known
            })
        };
        found.push(BasinsAt {
            value: *value,
            attractors: attractors.into_iter().map(number).collect(),
            entropy: basins.basin_entropy(),
            basins,
        });
        OrbitError::ask_monitor(&|_, _| monitor(cells + found.len() as u64, planned))?;
    }
    Ok(found)
}

/// A claim that an attractor at the last value of the parameter goes on as the motion of a class at the next value.
struct Claim {
    attractor: usize,
    class: usize,
    is_same_kind: bool,
    gap: f64,
}

/// The claims of the attractors at the last value of the parameter to classes at the next value, the surest first.
fn find_claims(last: &BasinsAt, basins: &Basins) -> Result<Vec<Claim>, OrbitError> {
    let mut claims = Vec::new();
    for (old, attractor) in last.basins.classes.iter().zip(&last.attractors) {
        for (class, new) in basins.classes.iter().enumerate() {
            let is_same_kind = old.motion == new.motion;
            let gap = match (&old.orbit, &new.orbit) {
                (Some(old), Some(new)) => orbit_gap(old, new)?,
                // What does not repeat has one class of its kind.
                (None, None) if is_same_kind => 0.0,
                _ => continue,
            };
            if is_same_kind || gap < NEIGHBOUR {
                claims.push(Claim {
                    attractor: *attractor,
                    class,
                    is_same_kind,
                    gap,
                });
            }
        }
    }
    claims.sort_by(|a, b| {
        let kind = b.is_same_kind.cmp(&a.is_same_kind);
        kind.then(a.gap.total_cmp(&b.gap))
    });
    Ok(claims)
}

/// Enters in the basins at one value of the parameter the orbits to which states of the attractors at the last value lead.
fn carry_over_orbits(
    last: &BasinsAt,
    scene: &Scene,
    basins: &mut Basins,
    options: &BasinOptions,
    monitor: Monitor<'_>,
) -> Result<(), OrbitError> {
    let search = SearchOptions {
        transient: options.transient,
        longest: options.longest,
        ..SearchOptions::default()
    };
    let orbits = last
        .basins
        .classes
        .iter()
        .filter_map(|class| class.orbit.as_deref());
    let seeds: Vec<Start> = orbits.map(|orbit| orbit.state().into()).collect();
    for seed in seeds {
        let arrival = match settle_starts(scene, &[seed], &search, monitor) {
            Ok(arrivals) => arrivals.into_iter().next(),
            // A rigid stop may have come to stand before it, say.
            Err(OrbitError::Motion(_)) => None,
            Err(stopped) => return Err(stopped),
        };
        if let Some(orbit) = arrival.and_then(|it| it.orbit) {
            enter_orbit(basins, orbit)?;
        }
    }
    Ok(())
}

/// Enters in the basins an orbit that was carried over from the last value, as a class without cells, unless it is known.
fn enter_orbit(basins: &mut Basins, orbit: Orbit) -> Result<(), OrbitError> {
    for class in &basins.classes {
        if let Some(known) = class.orbit.as_deref()
            && known.periods == orbit.periods
            && orbit_gap(known, &orbit)? < SAME
        {
            return Ok(());
        }
    }
    let starts = (0, basins.cells.len());
    basins.classes.push(Attractor::from_orbit(&orbit, starts));
    Ok(())
}

/// Distance of two orbits, in units of their size: the largest of a state of one from the nearest state of the other.
fn orbit_gap(one: &Orbit, other: &Orbit) -> Result<f64, OrbitError> {
    let states = |orbit: &Orbit| -> Result<Vec<Start>, OrbitError> {
        Ok(orbit.states()?.into_iter().map(Start::from).collect())
    };
    let (a, b) = (states(one)?, states(other)?);
    let frequency = other.scene.excitation.frequency;
    let nearest = |state: &Start, states: &[Start]| {
        let gaps = states.iter().map(|it| state_distance(frequency, state, it));
        gaps.fold(f64::INFINITY, f64::min)
    };
    let apart = a
        .iter()
        .map(|it| nearest(it, &b))
        .chain(b.iter().map(|it| nearest(it, &a)));
    let apart = apart.fold(0.0, f64::max);
    let size = motion_size(frequency, a.iter().chain(&b));
    Ok(if size > 0.0 { apart / size } else { 0.0 })
}
