//! Settled motions: many motions, each of its own machine, are followed in the lanes, then watched and classified.
//!
//! ```
//! use softstop::{Ratios, Start};
//! use softstop_dynamics::settled::Settling;
//! use softstop_dynamics::monitor::unmonitored;
//!
//! let scene = Ratios::unloaded().scene()?;
//! let starts = [Start::REST, Start::new(0.0, 14.0)];
//! let seen = Settling::default().follow_motions(&starts.map(|start| (&scene, start)), &unmonitored);
//! let seen = seen.unwrap_or_default();
//! let regimes = seen.iter().map(|seen| Some(seen.as_ref().ok()?.regime()?.to_string()));
//! assert_eq!(regimes.collect::<Vec<_>>(), [Some("0".to_owned()), Some("1".to_owned())]);
//! # Ok::<(), softstop::SceneError>(())
//! ```

mod settled_motion;

pub use settled_motion::{SettledMotion, classify_wandering};

use serde::{Deserialize, Serialize};

use crate::attractors::Region;
use crate::ensemble::{Ensemble, Member, MemberStatus};
use crate::monitor::Monitor;
use crate::orbit::Regime;
use crate::orbit::recurrence::RECURRENCE_DISTANCE;
use softstop::{MotionError, Scene, Start};
use softstop_lanes::LoweredMachine;

/// Settings for following motions until they have settled: how long they run, and how they are watched then.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Settling {
    /// Drive periods for which motions are followed, all together.
    pub periods: u64,
    /// The last of these drive periods, in which motions are watched: a period of up to half as many is told.
    pub watched: u64,
    /// Most drive periods: what has not returned is followed on to twice as many, again and again, up to these.
    pub longest: u64,
    /// Distance within which a state has returned, in units of the motion's size; then its orbit has to be confirmed.
    pub tolerance: f64,
}

impl Default for Settling {
    fn default() -> Self {
        Self {
            periods: 500,
            watched: 64,
            longest: 8000,
            tolerance: RECURRENCE_DISTANCE,
        }
    }
}

impl Settling {
    /// Follows a motion of each scene from its start until it settles, and returns what it has settled on; an error where scene,
    /// start or motion cannot be computed. None if the monitor, which is not told how much is done, ends the work.
    pub fn follow_motions(
        &self,
        motions: &[(&Scene, Start)],
        monitor: Monitor<'_>,
    ) -> Option<Vec<Result<SettledMotion, MotionError>>> {
        let mut machines = Vec::new();
        let members = motions.iter().map(|(scene, start)| {
            let mut member = Member::new(machines.len(), *start);
            let lowered = start
                .validate()
                .and_then(|()| Ok(LoweredMachine::new(&scene.check()?)));
            match lowered {
                Ok(machine) => machines.push(machine),
                Err(error) => member.mark_lost(error),
            }
            member
        });
        let members = members.collect();
        self.settle_members(machines, members, monitor)
    }

    /// Follows motions of lowered machines until they settle, and returns what each has settled on.
    fn settle_members(
        &self,
        machines: Vec<LoweredMachine>,
        mut members: Vec<Member>,
        monitor: Monitor<'_>,
    ) -> Option<Vec<Result<SettledMotion, MotionError>>> {
        let quiet = |_, _| monitor(0, 0);
        let ensemble = Ensemble::new(machines, &quiet);
        // What each was seen to have come to last.
        let mut seen: Vec<Option<SettledMotion>> = vec![None; members.len()];
        let (mut followed, mut next) = (0, self.periods);
        while next >= self.watched {
            let pairs = members.iter_mut().zip(&mut seen);
            let open = pairs.filter(|(member, _)| member.status.is_open());
            let (mut open, seen): (Vec<_>, Vec<_>) = open.unzip();
            if open.is_empty() {
                break;
            }
            ensemble.record_run(&mut open, next, self.watched).ok()?;
            followed += next;
            for (member, seen) in open.into_iter().zip(seen) {
                if member.error.is_some() {
                    continue;
                }
                let scene = ensemble.machines[member.machine].scene();
                let now = SettledMotion::confirmed(scene, member, self.tolerance, followed);
                if now.periods.is_some() {
                    member.status = MemberStatus::Arrived(0);
                }
                *seen = Some(now);
            }
            next = followed.min(self.longest.saturating_sub(followed));
        }
        let ends = members.into_iter().zip(seen);
        let settled = ends.map(|(member, seen)| match member.error {
            Some(error) => Some(Err(error)),
            None => seen.map(Ok),
        });
        settled.collect()
    }

    /// The share of so many starts, spread evenly over a region or else over the box of the scene's size, whose motions settle on
    /// z = 1: its certainty. None if the scene is invalid, or the monitor ends the work.
    pub fn single_impact_certainty(
        &self,
        scene: &Scene,
        starts: usize,
        region: Option<Region>,
        monitor: Monitor<'_>,
    ) -> Option<f64> {
        let machine = vec![LoweredMachine::new(&scene.check().ok()?)];
        let region = region.unwrap_or_else(|| Region::starting_box_holding(scene, []));
        let starts = region.starts(starts, 0).into_iter();
        let members = starts.map(|start| Member::new(0, start)).collect();
        let seen = self.settle_members(machine, members, monitor)?;
        let regimes = seen.iter().flatten().map(SettledMotion::regime);
        let come = regimes.filter(|regime| *regime == Some(Regime::ONE));
        Some(come.count() as f64 / seen.len() as f64)
    }
}
