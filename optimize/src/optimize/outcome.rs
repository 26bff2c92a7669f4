//! What came of a search, and what was looked at of the design beside it.

use softstop_dynamics::basin::ErosionProfile;
use softstop_dynamics::run_up::RunUp;

use crate::design::Design;
use crate::design::front::Front;
use crate::design::judge::Met;

/// Places of the erosion profile, and starts at each.
pub(super) const PLACES: usize = 25;
pub(super) const EROSION_STARTS: usize = 2048;
/// Drive angles at which the drive is switched on.
pub(super) const ANGLES: usize = 64;

/// What came of a search.
#[derive(Debug)]
pub struct Outcome {
    /// The best design.
    pub design: Design,
    /// Its point of the unit cube.
    pub unit: Vec<f64>,
    /// Others nearly as good, far from it.
    pub rivals: Vec<Design>,
    /// What was required, and what the design has of it.
    pub met: Vec<Met>,
    /// Zones that were computed.
    pub evaluations: u64,
    /// The basin along the zone, for the report.
    pub erosion: Option<ErosionProfile>,
    /// Ways to run the machine up, for the report.
    pub run_up: Option<RunUp>,
    /// What more of one good costs of another, for the report.
    pub fronts: Vec<Front>,
}
