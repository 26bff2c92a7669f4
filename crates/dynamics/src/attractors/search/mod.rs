//! The search: from starts to motions.

mod report;
mod wander;

use std::collections::BTreeMap;
use std::ops::Range;

use super::catalogue::AttractorCatalogue;
use super::chaos::Chaos;
use super::lifetime::EscapeCounts;
use super::{Arrival, Attractor, Region, SearchOptions, Survey};
use crate::ensemble::{Ensemble, Member, Outcome};
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
    member: Member,
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
    if let Some(error) = &search.members[0].member.error {
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
    let arrival = |SearchMember { member, .. }: SearchMember| match member.error {
        Some(error) => Err(error.into()),
        None => Ok(Arrival {
            state: member.state,
            returns: returns(frequency, &member.states).is_some(),
            orbit: member.outcome.attractor().map(orbit),
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
            ensemble: Ensemble::of(scene, monitor)?,
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
        let members = self.members.iter().map(|it| &it.member);
        members.flat_map(|member| match member.outcome {
            Outcome::Arrived(orbit) => self.catalogue.orbits[orbit].states(),
            _ => &member.states,
        })
    }

    /// Lets motions settle from starts and looks at them.
    fn launch(&mut self, starts: Vec<Start>, counts: bool) -> Result<(), OrbitError> {
        let first = self.members.len();
        let members = starts.into_iter().map(|start| SearchMember {
            member: Member::new(0, start),
            group: None,
            counts,
        });
        self.members.extend(members);
        let all = first..self.members.len();
        let (transient, logged) = (self.options.transient, self.logged() as u64);
        let early = transient / FIRST_LOOK;
        if self.ensemble.leaps() && early < FIRST_LOOK * logged {
            return self.carry_on(all, transient + logged, self.logged());
        }
        self.carry_on(all.clone(), early + logged, self.logged())?;
        self.carry_on(all, (transient - early).max(logged), self.logged())
    }

    /// Carries on the motions that have not arrived and looks at so many of their last states.
    fn carry_on(
        &mut self,
        which: Range<usize>,
        periods: u64,
        logged: usize,
    ) -> Result<(), OrbitError> {
        let members = self.members[which].iter_mut().map(|it| &mut it.member);
        let mut open: Vec<&mut Member> = members.filter(|it| it.outcome.is_open()).collect();
        self.ensemble.advance(&mut open, periods, logged)?;
        for member in open {
            self.ensemble.note(0)?;
            if member.error.is_none() {
                member.outcome = self.catalogue.judge(&member.states)?;
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
            self.carry_on(0..self.members.len(), periods, self.logged())?;
            left -= periods * before.len() as u64;
            for index in before {
                let member = &self.members[index];
                let gone = !member.member.outcome.is_open();
                if let Some(group) = member.group.and_then(|group| self.groups.get_mut(&group)) {
                    group.escapes.note(periods, gone);
                }
            }
            periods *= BATCH_GROWTH;
        }
        self.look_far()
    }

    fn open(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.members.len()).filter(|index| self.members[*index].member.outcome.is_open())
    }
}
