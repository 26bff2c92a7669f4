//! The establishing certainty of z = 1 along the hysteresis zone.

use super::basin_survey::find_basins_of_scenes;
use super::{BasinBall, BasinOptions, Basins, Grid};
use crate::monitor::{Monitor, OptionalMemory};
use crate::orbit::Regime;
use crate::orbit::recurrence::state_distance;
use crate::tolerance::SIMILAR;
use crate::wilson_interval::wilson_interval;
use crate::zone::{Zone, ZoneError};
use softstop::{Scene, Start};

/// The establishing certainty of z = 1 at one place of a hysteresis zone, with the basins there.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct CertaintyAtPlace {
    /// Place s: 0 at g0, 1 at s_SN.
    pub place: f64,
    /// Frequency in rad/s.
    pub frequency: f64,
    /// Share of the cells that lead to the zone's z = 1 motion: the establishing certainty.
    pub certainty: f64,
    /// Wilson's 95 % interval of it.
    pub interval: [f64; 2],
    /// All basins there.
    pub basins: Basins,
    /// Index of the zone's motion among the classes of these basins; none if no cell leads to it.
    pub class: Option<usize>,
}

impl CertaintyAtPlace {
    /// The largest ball in the basin of the zone's motion; none if it has none.
    pub fn largest_ball(&self) -> Option<BasinBall> {
        self.class.and_then(|class| self.basins.largest_ball(class))
    }
}

/// The establishing certainty of z = 1 at places s of a hysteresis zone (Peterka 2003, section 3: it is said to rise from 0 at
/// s_SN to 1 at g0): the share of the initial states of a grid that lead to the zone's motion, of two that coexist to the one with
/// the harder impact ([`Zone::point_at`]). The monitor is told of the cells done at all places.
///
/// # Errors
/// [`ZoneError`] if a place lies outside the zone, its motion is lost, the basins cannot be computed or the monitor says stop.
pub fn establishing_certainties(
    zone: &Zone,
    places: &[f64],
    grid: &Grid,
    options: &BasinOptions,
    monitor: Monitor<'_>,
    kept: OptionalMemory<'_>,
) -> Result<Vec<CertaintyAtPlace>, ZoneError> {
    let states = places.iter().map(|place| zone.point_at(*place));
    let states = states.map(|point| Ok(point?.state().into()));
    let states: Vec<Start> = states.collect::<Result<_, ZoneError>>()?;
    let scenes: Vec<Scene> = places.iter().map(|place| zone.scene_at(*place)).collect();
    let all = find_basins_of_scenes(&scenes, grid, options, monitor, kept)?;
    let at = |(((place, state), scene), basins): (((&f64, &Start), &Scene), Basins)| {
        let class = class_of(state, scene, &basins);
        let own = class.map_or(0, |class| basins.classes[class].starts);
        let cells = basins.cells.len();
        CertaintyAtPlace {
            place: *place,
            frequency: scene.excitation.frequency,
            certainty: own as f64 / cells as f64,
            interval: wilson_interval(own, cells),
            basins,
            class,
        }
    };
    let places = places.iter().zip(&states).zip(&scenes);
    Ok(places.zip(all).map(at).collect())
}

/// Index of the z = 1 motion with this state at drive angle phi among the classes of basins; none if it is none of them.
fn class_of(state: &Start, scene: &Scene, basins: &Basins) -> Option<usize> {
    let frequency = scene.excitation.frequency;
    let size = (frequency * state.position).hypot(state.velocity);
    let reach = SIMILAR * size.max(scene.scales().speed());
    let classes = basins.classes.iter().enumerate();
    let single = classes.filter(|(_, class)| class.motion.regime() == Some(Regime::ONE));
    let gaps = single.map(|(index, class)| (index, state_distance(frequency, &class.state, state)));
    let nearest = gaps.min_by(|a, b| a.1.total_cmp(&b.1));
    nearest.and_then(|(index, gap)| (gap <= reach).then_some(index))
}
