//! Periodic motions: shooting on the exact map, multipliers, stability.

mod all_single_impact_orbits;
mod contact_passage;
mod deflation;
mod error;
mod find_hardest_single_impact;
mod find_periodic;
mod fixed_point_search;
mod free_frequency;
mod impact_guesses;
mod impact_lattice;
mod impact_pattern;
mod lyapunov_exponents;
mod monodromy;
mod multi_segment_shooting;
mod newton_fixed_point;
mod orbit_of_segments;
mod periodic_orbit;
pub(crate) mod recurrence;
pub(crate) mod regime;
mod search_harder_single_impact;
mod single_impact_search;
mod smallest_period;
mod stroboscopic_map;
mod trial_motions;

pub(crate) use all_single_impact_orbits::{
    single_impact_orbits_about_frequency, single_impact_orbits_near_impact,
};
pub use error::OrbitError;
pub use find_hardest_single_impact::{find, find_with_monitor};
pub(crate) use find_hardest_single_impact::{find_batch, find_with_known_orbits};
pub use impact_pattern::{ImpactCount, ImpactPattern};
pub(crate) use lyapunov_exponents::LYAPUNOV_BATCH_PERIODS;
pub use lyapunov_exponents::LyapunovExponents;
pub use monodromy::{Monodromy, multipliers};
pub use newton_fixed_point::find_fixed_point;
pub use periodic_orbit::Orbit;
pub use regime::Regime;
pub(crate) use search_harder_single_impact::harder_single_impact_orbit;
pub(crate) use smallest_period::smallest_period;
pub use stroboscopic_map::{MapApplication, StroboscopicMap};

/// An impact of a motion: its time in s since time 0 and its before-impact velocity in m/s.
pub(crate) type TimedImpact = (f64, f64);
