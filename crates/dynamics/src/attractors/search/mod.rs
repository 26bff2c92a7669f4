//! The search: from starts to motions.

mod report;
mod wander;

use std::collections::BTreeMap;

use super::chaos::Chaos;
use super::fleet::{Fleet, Voyage};
use super::known::{Book, Standing};
use super::lifetime::Looks;
use super::{Arrival, Attractor, Options, Region, Survey, SurveyError};
use crate::orbit::Exponents;
use crate::watch::{Watcher, unwatched};
use softstop::{Scene, Start};

/// Starts of the pilot.
const PILOT: usize = 64;
/// How much less a motion is watched that costs more.
const DEAR: u64 = 20;
/// How many times longer motions are watched from one look to the next.
const GROWTH: u64 = 2;
/// Share of the transient after which motions that cost more are looked at for the first time: those that have
/// arrived by then need not be carried on.
const FIRST_LOOK: u64 = 4;

/// A motion of the search.
struct Member {
    voyage: Voyage,
    standing: Standing,
    /// Its group, if it wanders.
    group: Option<usize>,
    /// It started in the region.
    counts: bool,
}

/// Motions that wander over the same places.
struct Group {
    exponents: Option<Exponents>,
    chaos: Option<Chaos>,
    /// How long its motions were watched, and which had settled elsewhere then.
    looks: Looks,
    /// Starts of the region that came here.
    entered: usize,
}

struct Search<'a> {
    scene: &'a Scene,
    options: Options,
    fleet: Fleet<'a>,
    book: Book<'a>,
    members: Vec<Member>,
    groups: BTreeMap<usize, Group>,
}

pub(super) fn survey(
    scene: &Scene,
    options: &Options,
    watcher: Watcher<'_>,
) -> Result<Survey, SurveyError> {
    let mut search = Search::new(scene, options, watcher)?;
    let run = options.transient + search.logged() as u64;
    search.fleet.planned = run * (options.starts + PILOT) as u64 + search.patience();
    search.launch(Region::far(scene).starts(PILOT, options.seed), false)?;
    let stays = search.members.iter().flat_map(|member| &member.voyage.log);
    let region = options.region.or_else(|| Region::about(scene, stays));
    let region = region.unwrap_or_else(|| Region::far(scene));
    search.launch(region.starts(options.starts, options.seed), true)?;
    search.watch()?;
    search.report(region)
}

pub(super) fn classify(
    scene: &Scene,
    start: Start,
    options: &Options,
) -> Result<Attractor, SurveyError> {
    let mut search = Search::new(scene, options, &unwatched)?;
    start.validate()?;
    search.launch(vec![start], true)?;
    if let Some(error) = &search.members[0].voyage.error {
        return Err(error.clone().into());
    }
    search.watch()?;
    let region = Region::far(scene);
    let mut found = search.report(region)?.attractors;
    found.sort_by_key(|attractor| std::cmp::Reverse(attractor.starts));
    found.into_iter().next().ok_or(SurveyError::Stopped)
}

/// Where motions from several starts are after the transient: see [`super::settle`].
pub(super) fn settle(
    scene: &Scene,
    starts: &[Start],
    options: &Options,
    watcher: Watcher<'_>,
) -> Result<Vec<Arrival>, SurveyError> {
    let mut search = Search::new(scene, options, watcher)?;
    search.launch(starts.to_vec(), true)?;
    let Search { members, book, .. } = search;
    let arrival = |member: Member| match (member.voyage.error, member.standing) {
        (Some(error), _) => Err(error.into()),
        (None, Standing::Arrived(at) | Standing::Approaching(at)) => Ok(Arrival {
            state: member.voyage.state,
            orbit: Some(book.orbits[at].orbit.clone()),
        }),
        (None, Standing::AtRest | Standing::Wandering) => Ok(Arrival {
            state: member.voyage.state,
            orbit: None,
        }),
    };
    members.into_iter().map(arrival).collect()
}

impl<'a> Search<'a> {
    fn new(scene: &'a Scene, options: &Options, watcher: Watcher<'a>) -> Result<Self, SurveyError> {
        Ok(Self {
            scene,
            options: *options,
            fleet: Fleet::new(scene, watcher)?,
            book: Book::new(scene),
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
        if self.fleet.is_fast() {
            self.options.patience
        } else {
            self.options.patience / DEAR
        }
    }

    /// Lets motions settle from starts and looks at them.
    fn launch(&mut self, starts: Vec<Start>, counts: bool) -> Result<(), SurveyError> {
        let first = self.members.len();
        self.members.extend(starts.into_iter().map(|start| Member {
            voyage: Voyage::new(start),
            standing: Standing::Wandering,
            group: None,
            counts,
        }));
        let (transient, logged) = (self.options.transient, self.logged() as u64);
        if self.fleet.is_fast() {
            return self.carry_on(first.., transient + logged);
        }
        let early = transient / FIRST_LOOK;
        self.carry_on(first.., early + logged)?;
        self.carry_on(first.., (transient - early).max(logged))
    }

    /// Carries on the motions that have not arrived and looks at them.
    fn carry_on(
        &mut self,
        which: std::ops::RangeFrom<usize>,
        periods: u64,
    ) -> Result<(), SurveyError> {
        let logged = self.logged();
        let mut afloat: Vec<&mut Member> = self.members[which]
            .iter_mut()
            .filter(|member| member.is_afloat())
            .collect();
        let mut voyages: Vec<&mut Voyage> =
            afloat.iter_mut().map(|member| &mut member.voyage).collect();
        self.fleet.sail(&mut voyages, periods, logged)?;
        for member in afloat {
            if member.voyage.error.is_none() {
                member.standing = self.book.judge(&member.voyage.log)?;
            }
        }
        Ok(())
    }

    /// Watches the motions that have not arrived until patience ends.
    fn watch(&mut self) -> Result<(), SurveyError> {
        self.gather()?;
        let mut left = self.patience();
        let mut periods = self.options.transient.max(self.logged() as u64);
        loop {
            let before: Vec<usize> = self.afloat().collect();
            let most = left / before.len().max(1) as u64;
            periods = periods.min(most);
            if before.is_empty() || periods < self.logged() as u64 {
                break;
            }
            self.carry_on(0.., periods)?;
            left -= periods * before.len() as u64;
            for index in before {
                let member = &self.members[index];
                let gone = !member.is_afloat();
                if let Some(group) = member.group.and_then(|group| self.groups.get_mut(&group)) {
                    group.looks.note(periods, gone);
                }
            }
            periods *= GROWTH;
        }
        self.look_far()
    }

    fn afloat(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.members.len()).filter(|index| self.members[*index].is_afloat())
    }
}

impl Member {
    fn is_afloat(&self) -> bool {
        let settled = matches!(self.standing, Standing::Arrived(_) | Standing::AtRest);
        self.voyage.error.is_none() && !settled
    }

    fn wanders(&self) -> bool {
        self.voyage.error.is_none() && self.standing == Standing::Wandering
    }
}
