//! The search: from starts to motions.

mod report;
mod wander;

use std::collections::BTreeMap;

use super::catalogue::{AttractorCatalogue, Status};
use super::chaos::Chaos;
use super::ensemble::{Ensemble, EnsembleMember};
use super::lifetime::EscapeCounts;
use super::{Arrival, Attractor, Region, SearchOptions, Survey};
use crate::monitor::{Monitor, stop_if, unmonitored};
use crate::orbit::recurrence::returns;
use crate::orbit::{self, Exponents, OrbitError};
use softstop::{Scene, Start};

/// Starts of the pilot.
const PILOT: usize = 64;
/// How much less a motion is watched that costs more.
const DEAR: u64 = 20;
/// How many times longer motions are watched from one look to the next.
const BATCH_GROWTH: u64 = 2;
/// Share of the transient after which motions that cost more, or take long, are looked at for the first time: those
/// that have arrived by then need not be carried on.
const FIRST_LOOK: u64 = 4;

/// A motion of the search.
struct SearchMember {
    trajectory: EnsembleMember,
    status: Status,
    /// Its group, if it wanders.
    group: Option<usize>,
    /// It started in the region.
    counts: bool,
}

/// Motions that wander over the same places.
#[derive(Default)]
struct Group {
    exponents: Option<Exponents>,
    chaos: Option<Chaos>,
    /// How long its motions were watched, and which had settled elsewhere then.
    escapes: EscapeCounts,
    /// Starts of the region that came here.
    entered: usize,
}

struct Search<'a> {
    scene: &'a Scene,
    options: SearchOptions,
    ensemble: Ensemble<'a>,
    catalogue: AttractorCatalogue<'a>,
    members: Vec<SearchMember>,
    groups: BTreeMap<usize, Group>,
}

/// All motions on which a scene settles. The result depends on scene and options alone, not on the number of
/// threads. The monitor is told of the drive periods.
///
/// ```
/// use softstop::Ratios;
/// use softstop_dynamics::attractors::{SearchOptions, attractors};
/// use softstop_dynamics::monitor::unmonitored;
///
/// let options = SearchOptions { starts: 64, ..SearchOptions::default() };
/// let survey = attractors(&Ratios::unloaded().scene()?, &options, &unmonitored)?;
/// // Point A: with impacts and without, by turns of the start.
/// assert_eq!(survey.attractors.len(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`OrbitError::Motion`] if the scene is invalid; [`OrbitError::Stopped`].
pub fn attractors(
    scene: &Scene,
    options: &SearchOptions,
    monitor: Monitor<'_>,
) -> Result<Survey, OrbitError> {
    let mut search = Search::new(scene, options, monitor)?;
    let run = options.transient + search.logged() as u64;
    search.ensemble.planned = run * (options.starts + PILOT) as u64 + search.patience();
    search.launch(Region::far(scene).starts(PILOT, options.seed), false)?;
    let region = options
        .region
        .or_else(|| Region::about(scene, search.stays()));
    let region = region.unwrap_or_else(|| Region::far(scene));
    search.launch(region.starts(options.starts, options.seed), true)?;
    search.watch()?;
    search.report(region)
}

/// The box of initial states that commands take starts from unless they are told another: twice the clearance (or the
/// amplitude of a free mass, if that is larger) both ways, the same times the drive frequency, and half as much
/// again as any motion needs that [`orbit::find`] or 64 starts from far and wide come to. It depends on the scene alone.
///
/// # Errors
/// As [`attractors`].
pub fn starting_box(scene: &Scene, monitor: Monitor<'_>) -> Result<Region, OrbitError> {
    Ok(Region::box_with(scene, stays(scene, monitor)?))
}

/// States of the motions that [`orbit::find`] or 64 starts from far and wide come to.
pub(crate) fn stays(scene: &Scene, monitor: Monitor<'_>) -> Result<Vec<Start>, OrbitError> {
    let options = SearchOptions::default();
    let mut search = Search::new(scene, &options, monitor)?;
    search.ensemble.planned = (options.transient + search.logged() as u64) * PILOT as u64;
    search.launch(Region::far(scene).starts(PILOT, options.seed), false)?;
    let go_on = |_, _| stop_if(search.ensemble.note(0).is_err());
    let own = orbit::find_with_monitor(scene, &go_on).ok();
    search.ensemble.note(0)?;
    let own = own.map(|orbit| Start::new(orbit.position, orbit.velocity));
    Ok(search.stays().copied().chain(own).collect())
}

/// What the motion from one start settles on.
///
/// # Errors
/// [`OrbitError::Motion`] if the scene is invalid or the motion cannot be computed.
pub fn classify(
    scene: &Scene,
    start: Start,
    options: &SearchOptions,
) -> Result<Attractor, OrbitError> {
    let mut search = Search::new(scene, options, &unmonitored)?;
    start.validate()?;
    search.launch(vec![start], true)?;
    if let Some(error) = &search.members[0].trajectory.error {
        return Err(error.clone().into());
    }
    search.watch()?;
    let found = search.report(Region::far(scene))?.attractors;
    found.into_iter().next().ok_or(OrbitError::Stopped)
}

/// Where motions from several starts are after the transient, in their order: cheaper than
/// [`classify`], as a motion that has not settled then is not looked at any farther.
///
/// # Errors
/// [`OrbitError::Motion`] if the scene is invalid or a motion cannot be computed;
/// [`OrbitError::Stopped`].
pub fn settle(
    scene: &Scene,
    starts: &[Start],
    options: &SearchOptions,
    monitor: Monitor<'_>,
) -> Result<Vec<Arrival>, OrbitError> {
    let mut search = Search::new(scene, options, monitor)?;
    search.launch(starts.to_vec(), true)?;
    let Search {
        members, catalogue, ..
    } = search;
    let orbit = |at: usize| catalogue.orbits[at].orbit.clone();
    let frequency = scene.excitation.frequency;
    let arrival = |member: SearchMember| match member.trajectory.error {
        Some(error) => Err(error.into()),
        None => Ok(Arrival {
            state: member.trajectory.state,
            returns: returns(frequency, &member.trajectory.log).is_some(),
            orbit: member.status.orbit().map(orbit),
        }),
    };
    members.into_iter().map(arrival).collect()
}

impl<'a> Search<'a> {
    fn new(
        scene: &'a Scene,
        options: &SearchOptions,
        monitor: Monitor<'a>,
    ) -> Result<Self, OrbitError> {
        Ok(Self {
            scene,
            options: *options,
            ensemble: Ensemble::new(scene, monitor)?,
            catalogue: AttractorCatalogue::new(scene),
            members: Vec::new(),
            groups: BTreeMap::new(),
        })
    }

    /// States in a log.
    fn logged(&self) -> usize {
        2 * self.options.longest + 1
    }

    /// Drive periods for which motions may be watched.
    fn patience(&self) -> u64 {
        match self.ensemble.is_fast() {
            true => self.options.patience,
            false => self.options.patience / DEAR,
        }
    }

    /// Where motions stay: at the orbits at which they have arrived, or where they were last.
    fn stays(&self) -> impl Iterator<Item = &Start> + Clone {
        self.members.iter().flat_map(|member| match member.status {
            Status::Arrived(orbit) => self.catalogue.orbits[orbit].states(),
            _ => &member.trajectory.log,
        })
    }

    /// Lets motions settle from starts and looks at them.
    fn launch(&mut self, starts: Vec<Start>, counts: bool) -> Result<(), OrbitError> {
        let first = self.members.len();
        self.members
            .extend(starts.into_iter().map(|start| SearchMember {
                trajectory: EnsembleMember::new(start),
                status: Status::Wandering,
                group: None,
                counts,
            }));
        let (transient, logged) = (self.options.transient, self.logged() as u64);
        let early = transient / FIRST_LOOK;
        if self.ensemble.leaps() && early < FIRST_LOOK * logged {
            return self.carry_on(first.., transient + logged);
        }
        self.carry_on(first.., early + logged)?;
        self.carry_on(first.., (transient - early).max(logged))
    }

    /// Carries on the motions that have not arrived and looks at them.
    fn carry_on(
        &mut self,
        which: std::ops::RangeFrom<usize>,
        periods: u64,
    ) -> Result<(), OrbitError> {
        let logged = self.logged();
        let members = self.members[which].iter_mut();
        let mut open: Vec<&mut SearchMember> = members.filter(|member| member.is_open()).collect();
        let trajectories = open.iter_mut().map(|member| &mut member.trajectory);
        let mut trajectories: Vec<&mut EnsembleMember> = trajectories.collect();
        self.ensemble.advance(&mut trajectories, periods, logged)?;
        for member in open {
            self.ensemble.note(0)?;
            if member.trajectory.error.is_none() {
                member.status = self.catalogue.judge(&member.trajectory.log)?;
            }
        }
        Ok(())
    }

    /// Watches the motions that have not arrived until patience ends.
    fn watch(&mut self) -> Result<(), OrbitError> {
        self.gather()?;
        let mut left = self.patience();
        let mut periods = self.options.transient.max(self.logged() as u64);
        loop {
            let before: Vec<usize> = self.open().collect();
            let most = left / before.len().max(1) as u64;
            periods = periods.min(most);
            if before.is_empty() || periods < self.logged() as u64 {
                break;
            }
            self.carry_on(0.., periods)?;
            left -= periods * before.len() as u64;
            for index in before {
                let member = &self.members[index];
                let gone = !member.is_open();
                if let Some(group) = member.group.and_then(|group| self.groups.get_mut(&group)) {
                    group.escapes.note(periods, gone);
                }
            }
            periods *= BATCH_GROWTH;
        }
        self.look_far()
    }

    fn open(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.members.len()).filter(|index| self.members[*index].is_open())
    }
}

impl SearchMember {
    fn is_open(&self) -> bool {
        let settled = matches!(self.status, Status::Arrived(_) | Status::AtRest);
        self.trajectory.error.is_none() && !settled
    }

    fn wanders(&self) -> bool {
        self.trajectory.error.is_none() && self.status == Status::Wandering
    }
}
