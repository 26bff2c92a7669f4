//! What motions have come to, each of a machine of its own: many are followed together in the lanes, first unwatched,
//! then watched, and looked at after that.
//!
//! ```
//! use softstop::{Ratios, Start};
//! use softstop_dynamics::settled::Settling;
//! use softstop_dynamics::monitor::unmonitored;
//!
//! let scene = Ratios::unloaded().scene()?;
//! let starts = [Start::REST, Start::new(0.0, 14.0)];
//! let seen = Settling::default().follow(&starts.map(|start| (&scene, start)), &unmonitored);
//! let seen = seen.unwrap_or_default();
//! let regimes = seen.iter().map(|seen| Some(seen.as_ref().ok()?.regime()?.to_string()));
//! assert_eq!(regimes.collect::<Vec<_>>(), [Some("0".to_owned()), Some("1".to_owned())]);
//! # Ok::<(), softstop::SceneError>(())
//! ```

mod record;
mod settled_motion;

pub(crate) use record::watched;
pub use settled_motion::{SettledMotion, wanders};

use serde::{Deserialize, Serialize};

use crate::attractors::Region;
use crate::monitor::Monitor;
use crate::orbit::Regime;
use crate::orbit::recurrence::RETURN;
use softstop::{MotionError, Scene, Start};
use softstop_lanes::Machine;

/// How motions are followed, and looked at.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Settling {
    /// Drive periods, all together.
    pub periods: u64,
    /// The last of them, in which they are looked at: a period of up to half as many is told.
    pub watched: u64,
    /// Drive periods at most: what has not returned is followed on to twice as many, again and again, up to these.
    pub longest: u64,
    /// Distance within which a state has returned, in units of the motion's size.
    pub tolerance: f64,
}

impl Default for Settling {
    fn default() -> Self {
        Self {
            periods: 500,
            watched: 64,
            longest: 8000,
            tolerance: RETURN,
        }
    }
}

impl Settling {
    /// Follows a motion of each scene from its start; an error where the scene or the start cannot be, or the motion
    /// cannot be computed. Nothing if the monitor, which is not told how much is done, wants to stop.
    pub fn follow(
        &self,
        motions: &[(&Scene, Start)],
        monitor: Monitor<'_>,
    ) -> Option<Vec<Result<SettledMotion, MotionError>>> {
        let (mut machines, mut scenes, mut starts) = (Vec::new(), Vec::new(), Vec::new());
        let lowered: Vec<Result<(), MotionError>> = motions
            .iter()
            .map(|(scene, start)| {
                start.validate()?;
                let machine = Machine::new(scene)?;
                starts.push((machines.len(), *start));
                machines.push(machine);
                scenes.push(*scene);
                Ok(())
            })
            .collect();
        let mut seen = self
            .seen((&machines, &scenes), starts, monitor)?
            .into_iter();
        let all = lowered.into_iter();
        Some(
            all.filter_map(|lowered| {
                lowered.map_or_else(|error| Some(Err(error)), |()| seen.next())
            })
            .collect(),
        )
    }

    /// What motions come to, each of the machine, and the scene, of this number from a state.
    fn seen(
        &self,
        (machines, scenes): (&[Machine], &[&Scene]),
        mut starts: Vec<(usize, Start)>,
        monitor: Monitor<'_>,
    ) -> Option<Vec<Result<SettledMotion, MotionError>>> {
        let mut all: Vec<Option<Result<SettledMotion, MotionError>>> = vec![None; starts.len()];
        let mut open: Vec<usize> = (0..starts.len()).collect();
        let (mut followed, mut next) = (0, self.periods);
        while !open.is_empty() && next >= self.watched {
            let settling = next - self.watched;
            let records = watched(machines, &starts, settling, self.watched, || monitor(0, 0))?;
            followed += next;
            let mut further = Vec::new();
            for ((index, start), record) in open.iter().zip(&mut starts).zip(records) {
                let scene = scenes[start.0];
                let seen =
                    record.map(|record| SettledMotion::of(scene, record, self.tolerance, followed));
                if let Ok(SettledMotion {
                    periods: None, end, ..
                }) = seen
                {
                    further.push((*index, (start.0, end)));
                }
                all[*index] = Some(seen);
            }
            (open, starts) = further.into_iter().unzip();
            next = followed.min(self.longest.saturating_sub(followed));
        }
        all.into_iter().collect()
    }

    /// The share of so many starts, spread evenly over a region, that lead to z = 1; what cannot be computed does not.
    /// Without a region it is the box of the scene's own size that commands take starts from. Nothing if the scene is
    /// invalid, or the monitor wants to stop.
    pub fn certainty(
        &self,
        scene: &Scene,
        starts: usize,
        region: Option<Region>,
        monitor: Monitor<'_>,
    ) -> Option<f64> {
        let machine = [Machine::new(scene).ok()?];
        let region = region.unwrap_or_else(|| Region::box_with(scene, []));
        let starts = region.starts(starts, 0).into_iter();
        let starts: Vec<(usize, Start)> = starts.map(|start| (0, start)).collect();
        let count = starts.len() as f64;
        let seen = self.seen((&machine, &[scene]), starts, monitor)?;
        let regimes = seen.iter().flatten().map(SettledMotion::regime);
        let come = regimes.filter(|regime| *regime == Some(Regime::ONE));
        Some(come.count() as f64 / count)
    }
}
