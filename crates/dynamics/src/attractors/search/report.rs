//! What a search has found.

use super::super::catalogue::KnownOrbit;
use super::super::chaos::Chaos;
use super::super::{Attractor, Region, Survey};
use super::{Group, Search, SearchMember};
use crate::ensemble::Outcome;
use crate::extremes::extremes;
use crate::motion::MotionKind;
use crate::orbit::{Exponents, OrbitError};
use softstop::MotionError;

impl Search<'_> {
    pub(super) fn report(mut self, region: Region) -> Result<Survey, OrbitError> {
        let counted = self.members.iter().filter(|member| member.counts).count();
        let mut attractors = self.periodic(counted);
        attractors.extend(self.resting(counted));
        attractors.extend(self.wandering(counted));
        attractors.sort_by_key(|attractor| std::cmp::Reverse(attractor.starts));
        let members = self.members.iter_mut();
        let errors = members.filter_map(|member| member.member.error.take());
        let errors: Vec<MotionError> = errors.collect();
        Ok(Survey {
            attractors,
            region,
            starts: counted,
            lost: errors.first().map(|first| (errors.len(), first.clone())),
            periods: self.ensemble.done(),
        })
    }

    fn periodic(&self, counted: usize) -> Vec<Attractor> {
        let known = self.catalogue.orbits.iter().enumerate();
        let attractor = |(index, known): (usize, &KnownOrbit)| {
            let here =
                |it: &&SearchMember| it.counts && it.member.outcome.attractor() == Some(index);
            let starts = self.members.iter().filter(here).count();
            Attractor {
                certainty: Some(known.certainty),
                exponents: Some(Exponents::of(&known.orbit)),
                ..Attractor::repeating(&known.orbit, (starts, counted))
            }
        };
        known.map(attractor).collect()
    }

    /// Chaos, chaos that ends, and what has not settled.
    fn wandering(&self, counted: usize) -> Vec<Attractor> {
        let attractor = |(number, group): (&usize, &Group)| {
            let wanders = |it: &&SearchMember| {
                it.group == Some(*number) && it.member.outcome == Outcome::Wandering
            };
            let left: Vec<&SearchMember> = self.members.iter().filter(wanders).collect();
            let starts = left.iter().filter(|member| member.counts).count();
            let chaos = group.chaos();
            let (motion, state, exponents) = match chaos {
                Some(chaos) => {
                    let motion = match chaos.lifetime {
                        Some(_) => MotionKind::TransientChaos,
                        None => MotionKind::Chaos,
                    };
                    (motion, chaos.state, chaos.exponents)
                }
                None => {
                    let state = left.first()?.member.state;
                    (MotionKind::Unsettled, state, group.exponents?)
                }
            };
            Some(Attractor {
                exponents: Some(exponents),
                chaos,
                ..Attractor::new(motion, state, (starts, counted))
            })
        };
        self.groups.iter().filter_map(attractor).collect()
    }

    /// Rest, if some motions end there.
    fn resting(&self, counted: usize) -> Option<Attractor> {
        let rests = |it: &&SearchMember| it.member.outcome == Outcome::AtRest;
        let members: Vec<&SearchMember> = self.members.iter().filter(rests).collect();
        let positions = extremes(members.iter().map(|it| it.member.state.position))?;
        let starts = members.iter().filter(|member| member.counts).count();
        Some(Attractor {
            positions: Some(positions),
            ..Attractor::new(MotionKind::Rest, members[0].member.state, (starts, counted))
        })
    }
}

impl Group {
    /// Its chaos with what was seen of it, if it is any.
    fn chaos(&self) -> Option<Chaos> {
        Some(Chaos {
            watched: self.escapes.watched(),
            lifetime: self.escapes.lifetime(),
            entered: self.entered,
            ..self.chaos?
        })
    }
}
