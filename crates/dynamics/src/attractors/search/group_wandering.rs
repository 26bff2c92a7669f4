//! Wandering motions of a search: which belong together, their exponents, and whether they return after all.

use std::collections::BTreeMap;

use super::super::chaos::{Chaos, ChaosCandidate};
use super::super::group_logs::group_logs;
use super::{BATCH_GROWTH, Search};
use crate::ensemble::{Member, MemberStatus};
use crate::orbit::{LYAPUNOV_BATCH_PERIODS, LyapunovExponents, OrbitError};
use softstop::Start;

/// Relative error below which the largest Lyapunov exponent of a motion is measured accurately enough.
const EXPONENT_ACCURACY: f64 = 0.05;
/// Number of motions of a group whose exponents are measured at most until one shows chaos.
const MAX_EXPONENT_TRIES: usize = 6;
/// Factor by which the longest period that wandering motions are searched for is larger at the end of a search.
const LAST_SEARCH_FACTOR: usize = 8;

impl Search<'_> {
    /// Groups the wandering motions of the search by the places that they visit, and measures the exponents of each group; groups
    /// that are not chaotic become one.
    pub(super) fn group_wandering(&mut self) -> Result<(), OrbitError> {
        let wandering: Vec<usize> = self
            .open_members()
            .filter(|index| self.members[*index].member.status == MemberStatus::Wandering)
            .collect();
        let log = |index: &usize| self.members[*index].member.states.as_slice();
        let logs: Vec<&[Start]> = wandering.iter().map(log).collect();
        let numbers = group_logs(&logs, || self.ensemble.count_work(0))?;
        let mut of_group: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (index, number) in wandering.into_iter().zip(numbers) {
            self.members[index].group = Some(number);
            of_group.entry(number).or_default().push(index);
        }
        let mut unsettled = None;
        for (own, indices) in of_group {
            let group = self.measure_group(&indices)?;
            let number = match group.chaos {
                Some(_) => own,
                None => *unsettled.get_or_insert(own),
            };
            for index in indices {
                self.members[index].group = Some(number);
            }
            let known = self.groups.entry(number).or_default();
            known.entered += group.entered;
            known.chaos = group.chaos.or(known.chaos);
            if let Some(own) = group.exponents {
                known.keep_largest_exponents(own);
            }
        }
        Ok(())
    }

    /// Computes the Lyapunov exponents of the motions of a group, those that wander over the same states, one after the other
    /// until one is chaotic: its exponent is positive, and it still wanders.
    fn measure_group(&mut self, indices: &[usize]) -> Result<ChaosCandidate, OrbitError> {
        let counts = |index: &&usize| self.members[**index].counts;
        let mut group = ChaosCandidate {
            entered: indices.iter().filter(counts).count(),
            ..ChaosCandidate::default()
        };
        for &index in indices.iter().take(MAX_EXPONENT_TRIES) {
            let state = self.members[index].member.state;
            let (exponents, end, wanders) = self.measure_exponents(state)?;
            group.keep_largest_exponents(exponents);
            if wanders && exponents.is_positive() {
                let chaos = Chaos::of_motion(&self.scene, &self.ensemble, (state, end), exponents)?;
                // Without impacts the motion is linear and damped: it settles, if slowly.
                if chaos.velocities.is_some() {
                    group.chaos = Some(chaos);
                    break;
                }
            }
        }
        Ok(group)
    }

    /// Measures the exponents along the motion from a state, over ever longer times until they are accurate or the motion
    /// settles; also returns its last state and whether it still wandered.
    fn measure_exponents(
        &mut self,
        state: Start,
    ) -> Result<(LyapunovExponents, Start, bool), OrbitError> {
        let mut batch = LYAPUNOV_BATCH_PERIODS.0;
        let mut best = None;
        loop {
            let ask = || self.ensemble.count_work(0);
            let along =
                LyapunovExponents::along_motion_with_monitor(&self.scene, state.into(), batch, ask);
            let (exponents, end) = along?;
            self.ensemble.count_work(exponents.periods)?;
            let mut after = Member::new(0, end.into());
            let logged = self.log_length();
            self.ensemble
                .advance(&mut [&mut after], logged as u64, logged)?;
            let wanders = self.catalogue.classify_log(&after.states)? == MemberStatus::Wandering;
            let found = (exponents, after.state, wanders);
            if !wanders {
                return Ok(best.unwrap_or(found));
            }
            let largest = exponents.per_period[0];
            let sharp = exponents.error < EXPONENT_ACCURACY * largest;
            let hopeless = largest <= exponents.error;
            batch *= BATCH_GROWTH;
            if sharp || hopeless || batch > LYAPUNOV_BATCH_PERIODS.1 {
                return Ok(found);
            }
            best = exponents.is_positive().then_some(found).or(best);
        }
    }

    /// Checks at the end of a search whether wandering motions that are not chaotic return after very many periods.
    pub(super) fn search_long_periods(&mut self) -> Result<(), OrbitError> {
        let logged = LAST_SEARCH_FACTOR * self.log_length();
        let unsettled: Vec<usize> = self
            .open_members()
            .filter(|index| !self.is_chaotic(*index))
            .collect();
        for index in unsettled {
            self.advance_open_members(index..index + 1, logged as u64, logged)?;
        }
        Ok(())
    }

    /// True if the group of a wandering motion is chaotic.
    fn is_chaotic(&self, index: usize) -> bool {
        let group = self.members[index]
            .group
            .and_then(|group| self.groups.get(&group));
        group.is_some_and(|group| group.chaos.is_some())
    }
}
