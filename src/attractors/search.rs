//! The search: from starts to motions.

use std::collections::BTreeMap;

use super::chaos::Chaos;
use super::fleet::{Fleet, Voyage};
use super::group::groups;
use super::known::{Book, Known, Standing};
use super::{Arrival, Attractor, Kind, Options, Region, Survey, SurveyError, Watcher};
use crate::error::MotionError;
use crate::integrator::Start;
use crate::orbit::Exponents;
use crate::scene::Scene;

/// Starts of the pilot.
const PILOT: usize = 64;
/// How much less a motion is watched that costs more.
const DEAR: u64 = 20;
/// Drive periods in each of the 32 batches of an exponent: at first, and at most.
const BATCH: (u64, u64) = (100, 1600);
/// Relative error of an exponent that is small enough.
const SHARP: f64 = 0.05;
/// Motions of a group whose exponent is tried before it is given up.
const TRIES: usize = 6;
/// Longest period looked for at last, in units of the usual one.
const LAST_LOOK: usize = 8;
/// Share of a time step by which the next one is longer.
const GROWTH: u64 = 2;

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
    /// Drive periods watched and motions that have settled elsewhere meanwhile.
    watched: u64,
    escaped: usize,
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
) -> Result<Kind, SurveyError> {
    let mut search = Search::new(scene, options, &|_, _| true)?;
    start.validate()?;
    search.launch(vec![start], true)?;
    if let Some(error) = &search.members[0].voyage.error {
        return Err(error.clone().into());
    }
    search.watch()?;
    let region = Region::far(scene);
    let mut found = search.report(region)?.attractors;
    found.sort_by_key(|attractor| std::cmp::Reverse(attractor.starts));
    let first = found.into_iter().next();
    first
        .map(|attractor| attractor.kind)
        .ok_or(SurveyError::Stopped)
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
        let periods = self.options.transient + self.logged() as u64;
        self.carry_on(first.., periods)
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
                    group.watched += periods;
                    group.escaped += usize::from(gone);
                }
            }
            periods *= GROWTH;
        }
        self.look_far()
    }

    fn afloat(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.members.len()).filter(|index| self.members[*index].is_afloat())
    }

    /// Groups the wandering motions and asks for their exponents.
    fn gather(&mut self) -> Result<(), SurveyError> {
        let wandering: Vec<usize> = self
            .afloat()
            .filter(|index| self.members[*index].standing == Standing::Wandering)
            .collect();
        let logs: Vec<&[Start]> = wandering
            .iter()
            .map(|index| self.members[*index].voyage.log.as_slice())
            .collect();
        let numbers = groups(&logs);
        let mut of_group: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (index, number) in wandering.into_iter().zip(numbers) {
            self.members[index].group = Some(number);
            of_group.entry(number).or_default().push(index);
        }
        for (number, indices) in of_group {
            let group = self.measure(&indices)?;
            self.groups.insert(number, group);
        }
        Ok(())
    }

    /// The exponents of a group: of the first of its motions with a positive one that does not settle
    /// meanwhile.
    fn measure(&mut self, indices: &[usize]) -> Result<Group, SurveyError> {
        let mut group = Group {
            exponents: None,
            chaos: None,
            watched: 0,
            escaped: 0,
            entered: indices
                .iter()
                .filter(|index| self.members[**index].counts)
                .count(),
        };
        for &index in indices.iter().take(TRIES) {
            let state = self.members[index].voyage.state;
            let (exponents, end, wanders) = self.exponents(state)?;
            let larger = |best: &Exponents| exponents.per_period[0] > best.per_period[0];
            if group.exponents.as_ref().is_none_or(larger) {
                group.exponents = Some(exponents);
            }
            if wanders && exponents.is_positive() {
                group.chaos = Some(Chaos::of(self.scene, &self.fleet, end, exponents)?);
                break;
            }
        }
        Ok(group)
    }

    /// The exponents along the motion from a state, over ever longer times until they are sharp, or the
    /// motion settles; the state then, and whether the motion still wandered.
    fn exponents(&mut self, state: Start) -> Result<(Exponents, Start, bool), SurveyError> {
        let mut batch = BATCH.0;
        let mut best = None;
        loop {
            let (exponents, end) = Exponents::along(self.scene, state.into(), batch)?;
            self.fleet.note(exponents.periods)?;
            let mut after = Voyage::new(end.into());
            let logged = self.logged();
            self.fleet.sail(&mut [&mut after], logged as u64, logged)?;
            let wanders = self.book.judge(&after.log)? == Standing::Wandering;
            let found = (exponents, after.state, wanders);
            if !wanders {
                return Ok(best.unwrap_or(found));
            }
            let largest = exponents.per_period[0];
            let sharp = exponents.error < SHARP * largest;
            let hopeless = largest <= exponents.error;
            batch *= GROWTH;
            if sharp || hopeless || batch > BATCH.1 {
                return Ok(found);
            }
            best = exponents.is_positive().then_some(found).or(best);
        }
    }

    /// A last look at motions without a positive exponent: do they return after very many periods?
    fn look_far(&mut self) -> Result<(), SurveyError> {
        let logged = LAST_LOOK * self.logged();
        let unsettled: Vec<usize> = self
            .afloat()
            .filter(|index| !self.is_chaotic(*index))
            .collect();
        for index in unsettled {
            let voyage = &mut self.members[index].voyage;
            self.fleet.sail(&mut [voyage], logged as u64, logged)?;
            let standing = self.book.judge(&self.members[index].voyage.log)?;
            self.members[index].standing = standing;
        }
        Ok(())
    }

    fn is_chaotic(&self, index: usize) -> bool {
        let group = self.members[index]
            .group
            .and_then(|group| self.groups.get(&group));
        group.is_some_and(|group| group.chaos.is_some())
    }

    fn report(mut self, region: Region) -> Result<Survey, SurveyError> {
        let counted = self.members.iter().filter(|member| member.counts).count();
        let mut attractors = self.periodic(counted);
        attractors.extend(self.resting(counted));
        attractors.extend(self.wandering(counted));
        attractors.sort_by_key(|attractor| std::cmp::Reverse(attractor.starts));
        let errors = self
            .members
            .iter_mut()
            .filter_map(|member| member.voyage.error.take());
        let errors: Vec<MotionError> = errors.collect();
        Ok(Survey {
            attractors,
            region,
            starts: counted,
            lost: errors.first().map(|first| (errors.len(), first.clone())),
            periods: self.fleet.done(),
        })
    }

    fn periodic(&self, counted: usize) -> Vec<Attractor> {
        let known = self.book.orbits.iter().enumerate();
        let attractor = |(index, known): (usize, &Known)| {
            let here = |member: &&Member| match member.standing {
                Standing::Arrived(at) | Standing::Approaching(at) => member.counts && at == index,
                Standing::AtRest | Standing::Wandering => false,
            };
            let starts = self.members.iter().filter(here).count();
            let kind = Kind::Periodic {
                orbit: Box::new(known.orbit.clone()),
                certainty: known.certainty,
            };
            Attractor::new(kind, starts, counted)
        };
        known.map(attractor).collect()
    }

    /// Chaos, chaos that ends, and what has not settled.
    fn wandering(&self, counted: usize) -> Vec<Attractor> {
        let attractor = |(number, group): (&usize, &Group)| {
            let wanders = |member: &&Member| member.group == Some(*number) && member.wanders();
            let left: Vec<&Member> = self.members.iter().filter(wanders).collect();
            let starts = left.iter().filter(|member| member.counts).count();
            let kind = match (group.chaos.clone(), left.first()) {
                (Some(chaos), _) => group.chaotic(chaos),
                (None, Some(member)) => Kind::Unsettled {
                    state: member.voyage.state,
                    exponents: group.exponents?,
                },
                (None, None) => return None,
            };
            Some(Attractor::new(kind, starts, counted))
        };
        self.groups.iter().filter_map(attractor).collect()
    }

    /// Rest, if some motions end there.
    fn resting(&self, counted: usize) -> Option<Attractor> {
        let rests = |member: &&Member| member.standing == Standing::AtRest;
        let members: Vec<&Member> = self.members.iter().filter(rests).collect();
        let positions = || members.iter().map(|member| member.voyage.state.position);
        let positions = [positions().reduce(f64::min)?, positions().reduce(f64::max)?];
        let starts = members.iter().filter(|member| member.counts).count();
        Some(Attractor::new(Kind::AtRest { positions }, starts, counted))
    }
}

impl Group {
    fn chaotic(&self, chaos: Chaos) -> Kind {
        let chaos = Chaos {
            watched: self.watched,
            ..chaos
        };
        if self.escaped == 0 {
            return Kind::Chaotic(chaos);
        }
        Kind::TransientChaos {
            chaos,
            lifetime: self.watched as f64 / self.escaped as f64,
            entered: self.entered,
        }
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

impl Attractor {
    fn new(kind: Kind, starts: usize, counted: usize) -> Self {
        Self {
            kind,
            starts,
            share: starts as f64 / counted.max(1) as f64,
        }
    }
}
