//! The survey that a search of attractors reports.

use super::super::catalogue::KnownOrbit;
use super::super::chaos::ChaosCandidate;
use super::super::{Attractor, Region, Survey};
use super::{Search, SearchMember};
use crate::ensemble::MemberStatus;
use crate::extremes::extremes;
use crate::motion_kind::MotionKind;
use crate::orbit::{LyapunovExponents, OrbitError};
use softstop::MotionError;

impl Search<'_> {
    /// The survey that the search reports, of all its attractors; `region`: of the starts that count.
    pub(super) fn into_survey(mut self, region: Region) -> Result<Survey, OrbitError> {
        let counted = self.members.iter().filter(|member| member.counts).count();
        let mut attractors = self.periodic_attractors(counted);
        attractors.extend(self.rest_attractor(counted));
        attractors.extend(self.wandering_attractors(counted));
        attractors.sort_by_key(|attractor| std::cmp::Reverse(attractor.starts));
        let members = self.members.iter_mut();
        let errors = members.filter_map(|member| member.member.error.take());
        let errors: Vec<MotionError> = errors.collect();
        Ok(Survey {
            attractors,
            region,
            starts: counted,
            lost: errors.first().map(|first| (errors.len(), first.clone())),
            periods: self.ensemble.work_done(),
        })
    }

    /// The stable orbits that the search has found, as attractors; `counted`: number of starts that count in the shares.
    fn periodic_attractors(&self, counted: usize) -> Vec<Attractor> {
        let known = self.catalogue.orbits.iter().enumerate();
        let attractor = |(index, known): (usize, &KnownOrbit)| {
            let here =
                |it: &&SearchMember| it.counts && it.member.status.attractor() == Some(index);
            let starts = self.members.iter().filter(here).count();
            Attractor {
                residuals: Some(known.residuals),
                exponents: Some(LyapunovExponents::of(&known.orbit)),
                ..Attractor::from_orbit(&known.orbit, (starts, counted))
            }
        };
        known.map(attractor).collect()
    }

    /// The attractors of wandering motions: chaos, transient chaos, and unsettled ones; `counted`: starts that count in shares.
    fn wandering_attractors(&self, counted: usize) -> Vec<Attractor> {
        let attractor = |(number, group): (&usize, &ChaosCandidate)| {
            let wanders = |it: &&SearchMember| {
                it.group == Some(*number) && it.member.status == MemberStatus::Wandering
            };
            let left: Vec<&SearchMember> = self.members.iter().filter(wanders).collect();
            let starts = left.iter().filter(|member| member.counts).count();
            let chaos = group.chaos_with_escapes();
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

    /// The attractor of the motions that end at rest, if some do; `counted`: number of starts that count in the shares.
    fn rest_attractor(&self, counted: usize) -> Option<Attractor> {
        let rests = |it: &&SearchMember| it.member.status == MemberStatus::AtRest;
        let members: Vec<&SearchMember> = self.members.iter().filter(rests).collect();
        let positions = extremes(members.iter().map(|it| it.member.state.position))?;
        let starts = members.iter().filter(|member| member.counts).count();
        Some(Attractor {
            positions: Some(positions),
            ..Attractor::new(MotionKind::Rest, members[0].member.state, (starts, counted))
        })
    }
}
