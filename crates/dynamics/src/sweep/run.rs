//! Sweeps side by side in the lanes.

use std::convert::Infallible;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::settle::Step;
use super::{Chain, Plan};
use crate::ensemble::{Ensemble, Member};
use crate::monitor::{Kept, Monitor, PIECE, piece};
use crate::settled::SettledMotion;
use softstop::internals::budget::{self, Fork};
use softstop::{MotionError, Parameter, Scene};
use softstop_lanes::Machine;

/// What a chain comes to in a piece of work.
#[derive(Serialize, Deserialize)]
struct Made {
    steps: Vec<Step>,
    error: Option<String>,
}

impl Plan {
    /// Carries all chains on to their ends, from wherever they are, unless the monitor says stop: it is told of the
    /// steps that are done of all. True if all came to their ends.
    pub fn run(&self, chains: &mut [Chain], monitor: Monitor<'_>) -> bool {
        self.run_for(Duration::MAX, chains, monitor)
    }

    /// Carries all chains on for about so long, to the ends of the steps that are under way then.
    fn run_for(&self, time: Duration, chains: &mut [Chain], monitor: Monitor<'_>) -> bool {
        let begin = Instant::now();
        let all = (self.steps * chains.len()) as u64;
        let groups = chains.len().div_ceil(Self::TOGETHER).max(1);
        let size = chains.len().div_ceil(groups).max(1);
        let stopped = AtomicBool::new(false);
        let done = chains.iter().map(|chain| chain.steps.len() as u64);
        let done = AtomicU64::new(done.sum());
        let fork = Fork::default();
        let run = |group: &mut [Chain]| {
            while !stopped.load(Ordering::Relaxed) {
                let ask = |_, _| monitor(done.load(Ordering::Relaxed), all);
                let Some(steps) = self.step(group, &ask) else {
                    stopped.store(true, Ordering::Relaxed);
                    break;
                };
                if steps == 0 {
                    break;
                }
                done.fetch_add(steps, Ordering::Relaxed);
                if ask(0, 0).is_break() || begin.elapsed() >= time || budget::is_spent() {
                    stopped.store(true, Ordering::Relaxed);
                }
            }
        };
        let groups = chains.par_chunks_mut(size);
        groups.for_each(|group| fork.run_part(|| run(group)));
        fork.charge_parts();
        chains.iter().all(|chain| self.is_complete(chain))
    }

    /// What its chains come to follows from this.
    pub fn identity(&self, chains: &[Chain]) -> impl Serialize + use<> {
        let chains = chains.iter();
        let chains = chains.map(
            |Chain {
                 machine, direction, ..
             }| {
                // What a value of the parameter means to the machine.
                let follow = Parameter::ALL.map(|it| machine.expression(it).map(str::to_owned));
                let name = machine.name(self.parameter);
                let meant = (name, machine.preload_deflection, follow);
                (machine.scene.clone(), meant, direction.name())
            },
        );
        let looks = (self.tolerance, self.heights);
        let plan = (self.range, self.steps, self.periods, looks);
        let chains: Vec<_> = chains.collect();
        (self.parameter.name(), plan, self.start, chains)
    }

    /// [`Plan::run`], piece by piece: what is known of them is recalled, and what they come to is kept.
    pub fn run_kept(&self, chains: &mut [Chain], monitor: Monitor<'_>, kept: Kept<'_>) -> bool {
        if kept.is_none() {
            return self.run(chains, monitor);
        }
        let all = (self.steps * chains.len()) as u64;
        let of = self.identity(chains);
        loop {
            let before: Vec<usize> = chains.iter().map(|chain| chain.steps.len()).collect();
            let Ok(made) = piece(kept, &("sweep", &of, &before), || {
                self.run_for(PIECE, chains, monitor);
                let made = chains.iter().zip(&before);
                let made = made.map(|(chain, before)| Made {
                    steps: chain.steps[*before..].to_vec(),
                    error: chain.error.clone(),
                });
                Ok::<Vec<Made>, Infallible>(made.collect())
            });
            for ((chain, before), made) in chains.iter_mut().zip(before).zip(made) {
                chain.steps.truncate(before);
                chain.steps.extend(made.steps);
                chain.error = made.error;
            }
            if chains.iter().all(|chain| self.is_complete(chain)) {
                return true;
            }
            let done = chains.iter().map(|chain| chain.steps.len() as u64);
            if monitor(done.sum(), all).is_break() || budget::is_spent() {
                return false;
            }
        }
    }

    fn is_complete(&self, chain: &Chain) -> bool {
        chain.steps.len() >= self.steps || chain.error.is_some()
    }

    /// Makes the next step of those chains of a group that are the farthest behind; how many there are. None is made
    /// where it is stopped.
    fn step(&self, group: &mut [Chain], monitor: Monitor<'_>) -> Option<u64> {
        let afloat = group.iter().filter(|chain| !self.is_complete(chain));
        let Some(step) = afloat.map(|chain| chain.steps.len()).min() else {
            return Some(0);
        };
        let (mut moved, mut machines, mut members) = (Vec::new(), Vec::new(), Vec::new());
        for (index, chain) in group.iter_mut().enumerate() {
            if self.is_complete(chain) || chain.steps.len() != step {
                continue;
            }
            match self.lowered(chain) {
                Ok((scene, machine)) => {
                    let state = chain.steps.last().map_or(self.start, |step| step.end);
                    members.push(Member::new(machines.len(), state));
                    machines.push(machine);
                    moved.push((index, scene));
                }
                Err(error) => chain.error = Some(error.to_string()),
            }
        }
        let count = moved.len() as u64;
        let ensemble = Ensemble::new(machines, monitor);
        let mut open: Vec<&mut Member> = members.iter_mut().collect();
        let observed = ensemble.observe(&mut open, self.periods, self.watched());
        observed.ok()?;
        for ((index, scene), member) in moved.into_iter().zip(members) {
            let chain = &mut group[index];
            let value = self.value(step, chain.direction);
            let made = match member.error {
                Some(error) => Err(error),
                None => {
                    let seen = SettledMotion::of(&scene, &member, self.tolerance, self.periods);
                    Step::new(value, &scene, seen, self.heights)
                }
            };
            match made {
                Ok(step) => chain.steps.push(step),
                Err(error) => chain.error = Some(error.to_string()),
            }
        }
        // A group of failures alone has moved as well.
        Some(count.max(1))
    }

    /// The machine at the next step of a chain.
    fn lowered(&self, chain: &Chain) -> Result<(Scene, Machine), MotionError> {
        let mut machine = chain.machine.clone();
        let value = self.value(chain.steps.len(), chain.direction);
        machine.set(self.parameter, value);
        machine.validate()?;
        let lowered = Machine::new(&machine.scene)?;
        Ok((machine.scene, lowered))
    }
}
