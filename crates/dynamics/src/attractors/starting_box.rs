//! The box of initial states that commands take starts from unless they are told another.

use super::search::{PILOTS, Search};
use super::{Region, SearchOptions};
use crate::monitor::{Monitor, stop_if};
use crate::orbit::{self, Orbit, OrbitError, Regime, harder_single_impact_orbit};
use crate::tolerance::SAME;
use softstop::{Scene, Start};

/// The box of initial states that commands take starts from unless they are told another: twice the clearance (or the amplitude
/// of a free mass, if that is larger) both ways, the same times the drive frequency, and half as much again as any motion needs
/// that 64 starts from far and wide come to, or that [`orbit::find`] or a lattice of impacts shows. It depends on the scene
/// alone.
///
/// # Errors
/// As [`find_attractors`](super::find_attractors).
pub fn starting_box(scene: &Scene, monitor: Monitor<'_>) -> Result<Region, OrbitError> {
    Ok(Region::starting_box_holding(
        scene,
        states_for_starting_box(scene, monitor)?,
    ))
}

/// States of the motions that the pilot starts settle on, and of the hardest stable z = 1 motion: that of [`orbit::find`], or
/// where starts come to one, any harder one that a lattice of impacts shows.
pub(crate) fn states_for_starting_box(
    scene: &Scene,
    monitor: Monitor<'_>,
) -> Result<Vec<Start>, OrbitError> {
    let options = SearchOptions::default();
    let mut search = Search::new(scene, &options, monitor)?;
    search.ensemble.planned = (options.transient + search.log_length() as u64) * PILOTS as u64;
    search.launch_starts(Region::pilot(scene).starts(PILOTS, options.seed), false)?;
    let go_on = |_, _| stop_if(search.ensemble.count_work(0).is_err());
    let met = search.catalogue.orbits.iter().map(|known| &known.orbit);
    let met = met.filter(|orbit| orbit.regime() == Regime::ONE);
    let hardest = match met.map(Orbit::before_impact_velocity).reduce(f64::max) {
        Some(met) => harder_single_impact_orbit(&search.scene, (1.0 + SAME) * met, &go_on)?,
        None => orbit::find_with_monitor(scene, &go_on).ok(),
    };
    search.ensemble.count_work(0)?;
    let hardest = hardest.map(|orbit| orbit.state().into());
    Ok(search.end_states().copied().chain(hardest).collect())
}
