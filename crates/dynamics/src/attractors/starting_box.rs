//! The box of initial states that commands take starts from unless they are told another.

use super::region::REGION_MARGIN;
use super::search::{PILOTS, Search};
use super::{Region, SearchOptions};
use crate::monitor::{Monitor, stop_if};
use crate::orbit::{self, Orbit, OrbitError, Regime, harder_single_impact_orbit};
use crate::tolerance::SAME;
use softstop::internals::Scales;
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

impl Region {
    /// The box about the origin from which commands take starts: twice the length of [`Scene::motion_scales`] both ways, or wider
    /// to hold some states.
    pub(crate) fn starting_box_holding(
        scene: &Scene,
        states: impl IntoIterator<Item = Start>,
    ) -> Self {
        let Scales { length, rate } = scene.motion_scales();
        let (length, room) = (2.0 * length, 1.0 + REGION_MARGIN);
        let half = states
            .into_iter()
            .fold((length, length * rate), |(x, v), state| {
                let (far, fast) = (state.position.abs(), state.velocity.abs());
                match (far + fast).is_finite() {
                    true => (x.max(room * far), v.max(room * fast)),
                    false => (x, v),
                }
            });
        Self {
            position: [-half.0, half.0],
            velocity: [-half.1, half.1],
        }
        .clipped_at_stops(scene)
    }

    /// The region itself if it holds some states, else its union with the [`Region::starting_box_holding`] of these.
    pub(crate) fn widened_to_hold(&self, scene: &Scene, states: &[Start]) -> Self {
        match states.iter().all(|state| self.contains(state)) {
            true => *self,
            false => {
                self.smallest_union(&Self::starting_box_holding(scene, states.iter().copied()))
            }
        }
    }
}
