//! What a search has found.

use super::super::chaos::Chaos;
use super::super::known::{Known, Standing};
use super::super::{Attractor, Kind, Region, Survey, SurveyError};
use super::{Group, Member, Search};
use softstop::error::MotionError;

impl Search<'_> {
    pub(super) fn report(mut self, region: Region) -> Result<Survey, SurveyError> {
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
            watched: self.looks.watched(),
            ..chaos
        };
        match self.looks.lifetime() {
            None => Kind::Chaotic(chaos),
            Some(lifetime) => Kind::TransientChaos {
                chaos,
                lifetime,
                entered: self.entered,
            },
        }
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
