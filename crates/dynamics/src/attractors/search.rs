//! The search of attractors: from starts to motions.

mod group_wandering;
mod reported_attractors;

use std::collections::BTreeMap;
use std::ops::Range;

use super::catalogue::AttractorCatalogue;
use super::chaos::ChaosCandidate;
use super::{Arrival, Attractor, Region, SearchOptions, Survey};
use crate::ensemble::{Ensemble, Member, MemberStatus};
use crate::monitor::{Monitor, unmonitored};
use crate::orbit::recurrence::find_recurrence;
use crate::orbit::{Orbit, OrbitError};
use softstop::{CheckedScene, Scene, Start};
use softstop_lanes::LoweredMachine;

/// Number of pilot starts, from far and wide, which show where motions stay.
pub(super) const PILOTS: usize = 64;
/// Divisor of the drive periods for which wandering motions are watched where they do not run in lanes and cost more.
const SLOW_WATCH_DIVISOR: u64 = 20;
/// Factor by which the time grows for which wandering motions are watched between two checks.
const BATCH_GROWTH: u64 = 2;
/// Divisor of the transient after which motions that do not run in lanes are first classified: some have arrived by then.
const FIRST_CHECK_DIVISOR: u64 = 4;

/// A motion of a search of attractors.
struct SearchMember {
    member: Member,
    /// The number of its group, if it wanders.
    group: Option<usize>,
    /// True if it started in the region whose shares are counted.
    counts: bool,
}

/// A search of the attractors of a scene, under way: motions, known orbits, and groups of wandering motions.
pub(super) struct Search<'a> {
    pub(super) scene: CheckedScene,
    options: SearchOptions,
    pub(super) ensemble: Ensemble<'a>,
    pub(super) catalogue: AttractorCatalogue,
    members: Vec<SearchMember>,
    groups: BTreeMap<usize, ChaosCandidate>,
}

/// Finds the attractors of a scene, motions from many starts settle on them. The result depends on scene and options alone, not
/// on the number of threads. The monitor is told of the drive periods.
///
/// ```
/// use softstop::Ratios;
/// use softstop_dynamics::attractors::{SearchOptions, find_attractors};
/// use softstop_dynamics::monitor::unmonitored;
///
/// let options = SearchOptions { starts: 64, ..SearchOptions::default() };
/// let survey = find_attractors(&Ratios::unloaded().scene()?, &options, &unmonitored)?;
/// // Point A: with impacts and without, by turns of the start.
/// assert_eq!(survey.attractors.len(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`OrbitError::Motion`] if the scene is invalid; [`OrbitError::Stopped`].
pub fn find_attractors(
    scene: &Scene,
    options: &SearchOptions,
    monitor: Monitor<'_>,
) -> Result<Survey, OrbitError> {
    find_attractors_until(scene, options, |_| false, monitor)
}

/// Finds the attractors of a scene, but ends the search once a stable orbit is met of which `is_enough` is true. That is asked
/// after the pilot starts, which count in no share, and each time wandering motions have been watched.
///
/// # Errors
/// As [`find_attractors`].
pub fn find_attractors_until(
    scene: &Scene,
    options: &SearchOptions,
    is_enough: impl Fn(&Orbit) -> bool,
    monitor: Monitor<'_>,
) -> Result<Survey, OrbitError> {
    let mut search = Search::new(scene, options, monitor)?;
    let run = options.transient + search.log_length() as u64;
    search.ensemble.planned = run * (options.starts + PILOTS) as u64 + search.watch_periods();
    let pilot = Region::pilot(scene);
    search.launch_starts(pilot.starts(PILOTS, options.seed), false)?;
    if search.knows_orbit(&is_enough) {
        return search.into_survey(pilot);
    }
    let region = options
        .region
        .or_else(|| Region::about_states(scene, search.end_states()));
    let region = region.unwrap_or(pilot);
    search.launch_starts(region.starts(options.starts, options.seed), true)?;
    if !search.knows_orbit(&is_enough) {
        search.watch_wandering(&is_enough)?;
    }
    search.into_survey(region)
}

/// The attractor that the motion from one start settles on, however long that takes.
///
/// # Errors
/// [`OrbitError::Motion`] if the scene is invalid or the motion cannot be computed.
pub fn classify_start(
    scene: &Scene,
    start: Start,
    options: &SearchOptions,
) -> Result<Attractor, OrbitError> {
    let mut search = Search::new(scene, options, &unmonitored)?;
    start.validate()?;
    search.launch_starts(vec![start], true)?;
    if let Some(error) = &search.members[0].member.error {
        return Err(error.clone().into());
    }
    search.watch_wandering(&|_| false)?;
    let found = search.into_survey(Region::pilot(scene))?.attractors;
    found.into_iter().next().ok_or(OrbitError::Stopped)
}

/// What the motions from starts have come to after the transient, where they are left: cheaper than [`classify_start`].
///
/// # Errors
/// [`OrbitError::Motion`] if the scene is invalid or a motion cannot be computed; [`OrbitError::Stopped`].
pub fn settle_starts(
    scene: &Scene,
    starts: &[Start],
    options: &SearchOptions,
    monitor: Monitor<'_>,
) -> Result<Vec<Arrival>, OrbitError> {
    let mut search = Search::new(scene, options, monitor)?;
    search.launch_starts(starts.to_vec(), true)?;
    let Search {
        members, catalogue, ..
    } = search;
    let orbit = |at: usize| catalogue.orbits[at].orbit.clone();
    let frequency = scene.excitation.frequency;
    let arrival = |SearchMember { member, .. }: SearchMember| match member.error {
        Some(error) => Err(error.into()),
        None => Ok(Arrival {
            state: member.state,
            returns: find_recurrence(frequency, &member.states).is_some(),
            orbit: member.status.attractor().map(orbit),
        }),
    };
    members.into_iter().map(arrival).collect()
}

impl<'a> Search<'a> {
    /// A search without motions.
    pub(super) fn new(
        scene: &Scene,
        options: &SearchOptions,
        monitor: Monitor<'a>,
    ) -> Result<Self, OrbitError> {
        let scene = scene.check()?;
        Ok(Self {
            options: *options,
            ensemble: Ensemble::new(vec![LoweredMachine::new(&scene)], monitor),
            catalogue: AttractorCatalogue::new(&scene),
            scene,
            members: Vec::new(),
            groups: BTreeMap::new(),
        })
    }

    /// Number of last states that are recorded of a motion to classify it: its log.
    pub(super) fn log_length(&self) -> usize {
        2 * self.options.longest + 1
    }

    /// Drive periods for which the search may watch wandering motions, all together.
    fn watch_periods(&self) -> u64 {
        match self.ensemble.runs_in_lanes() {
            true => self.options.patience,
            false => self.options.patience / SLOW_WATCH_DIVISOR,
        }
    }

    /// True if a stable orbit that the search has found is enough.
    fn knows_orbit(&self, is_enough: impl Fn(&Orbit) -> bool) -> bool {
        let mut known = self.catalogue.orbits.iter();
        known.any(|known| is_enough(&known.orbit))
    }

    /// States where motions of the search have come to: those of the orbits reached, or the last ones of other motions.
    pub(super) fn end_states(&self) -> impl Iterator<Item = &Start> + Clone {
        let members = self.members.iter().map(|it| &it.member);
        members.flat_map(|member| match member.status {
            MemberStatus::Arrived(orbit) => &self.catalogue.orbits[orbit].states,
            _ => &member.states,
        })
    }

    /// Advances motions from starts over the transient and classifies them; `counts`: they count in the attractors' shares.
    pub(super) fn launch_starts(
        &mut self,
        starts: Vec<Start>,
        counts: bool,
    ) -> Result<(), OrbitError> {
        let first = self.members.len();
        let members = starts.into_iter().map(|start| SearchMember {
            member: Member::new(0, start),
            group: None,
            counts,
        });
        self.members.extend(members);
        let all = first..self.members.len();
        let (transient, logged) = (self.options.transient, self.log_length() as u64);
        let early = transient / FIRST_CHECK_DIVISOR;
        if self.ensemble.skips_periods() && early < FIRST_CHECK_DIVISOR * logged {
            return self.advance_open_members(all, transient + logged, self.log_length());
        }
        self.advance_open_members(all.clone(), early + logged, self.log_length())?;
        self.advance_open_members(all, (transient - early).max(logged), self.log_length())
    }

    /// Advances those of some motions that have not arrived, and classifies each by its `logged` last states.
    fn advance_open_members(
        &mut self,
        which: Range<usize>,
        periods: u64,
        logged: usize,
    ) -> Result<(), OrbitError> {
        let members = self.members[which].iter_mut().map(|it| &mut it.member);
        let mut open: Vec<&mut Member> = members.filter(|it| it.status.is_open()).collect();
        self.ensemble.advance(&mut open, periods, logged)?;
        for member in open {
            self.ensemble.count_work(0)?;
            if member.error.is_none() {
                member.status = self.catalogue.classify_log(&member.states)?;
            }
        }
        Ok(())
    }

    /// Watches the motions that have not arrived until their drive periods are used up, or an orbit is met that is enough.
    fn watch_wandering(&mut self, is_enough: &dyn Fn(&Orbit) -> bool) -> Result<(), OrbitError> {
        self.group_wandering()?;
        let mut left = self.watch_periods();
        let mut periods = self.options.transient.max(self.log_length() as u64);
        loop {
            let before: Vec<usize> = self.open_members().collect();
            let most = left / before.len().max(1) as u64;
            periods = periods.min(most);
            if before.is_empty() || periods < self.log_length() as u64 {
                break;
            }
            self.advance_open_members(0..self.members.len(), periods, self.log_length())?;
            left -= periods * before.len() as u64;
            for index in before {
                let member = &self.members[index];
                let gone = !member.member.status.is_open();
                if let Some(group) = member.group.and_then(|group| self.groups.get_mut(&group)) {
                    group.escapes.record_watch(periods, gone);
                }
            }
            periods *= BATCH_GROWTH;
            if self.knows_orbit(is_enough) {
                return Ok(());
            }
        }
        self.search_long_periods()
    }

    /// Indices of the motions of the search that have not arrived.
    fn open_members(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.members.len()).filter(|index| self.members[*index].member.status.is_open())
    }
}
