//! Running sweeps side by side in the lanes.

use std::convert::Infallible;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::sweep_step::SweepStep;
use super::{Chain, Plan};
use crate::ensemble::{Ensemble, Member};
use crate::monitor::{Monitor, OptionalMemory, PIECE_DURATION, recall_or_compute};
use crate::parallel;
use crate::settled::SettledMotion;
use softstop::internals::budget;
use softstop::{Parameter, Scene, SceneError, Start};
use softstop_lanes::LoweredMachine;

/// The steps that sweeps make in one stored piece of work.
#[derive(Serialize, Deserialize)]
struct ChainProgress {
    steps: Vec<SweepStep>,
    error: Option<String>,
}

impl Plan {
    /// Runs sweeps from where they are to their ends; false if the monitor, which is told of all steps done, ends the work.
    pub fn run_chains(&self, chains: &mut [Chain], monitor: Monitor<'_>) -> bool {
        self.run_chains_for(Duration::MAX, chains, monitor)
    }

    /// Runs sweeps for about this computing time and ends the steps under way then; false if the monitor ends the work.
    fn run_chains_for(&self, time: Duration, chains: &mut [Chain], monitor: Monitor<'_>) -> bool {
        let begin = Instant::now();
        let all = (self.steps * chains.len()) as u64;
        let groups = chains.len().div_ceil(Self::MAX_CHAINS_TOGETHER).max(1);
        let size = chains.len().div_ceil(groups).max(1);
        let stopped = AtomicBool::new(false);
        let done = chains.iter().map(|chain| chain.steps.len() as u64);
        let done = AtomicU64::new(done.sum());
        let run = |group: &mut [Chain]| {
            while !stopped.load(Ordering::Relaxed) {
                let ask = |_, _| monitor(done.load(Ordering::Relaxed), all);
                let Some(steps) = self.step_chains(group, &ask) else {
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
            Ok::<_, Infallible>(())
        };
        let Ok(()) = parallel::try_change_chunks(chains, size, run);
        chains.iter().all(|chain| self.is_complete(chain))
    }

    /// The key under which pieces of these sweeps are stored: all from which their steps follow.
    pub fn plan_identity(&self, chains: &[Chain]) -> impl Serialize + use<> {
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

    /// Runs sweeps as [`Plan::run_chains`] does, piece by piece; stored pieces are recalled and new ones stored.
    pub fn run_chains_with_memory(
        &self,
        chains: &mut [Chain],
        monitor: Monitor<'_>,
        kept: OptionalMemory<'_>,
    ) -> bool {
        if kept.is_none() {
            return self.run_chains(chains, monitor);
        }
        let all = (self.steps * chains.len()) as u64;
        let of = self.plan_identity(chains);
        loop {
            let before: Vec<usize> = chains.iter().map(|chain| chain.steps.len()).collect();
            let Ok(made) = recall_or_compute(kept, &("sweep", &of, &before), || {
                self.run_chains_for(PIECE_DURATION, chains, monitor);
                let made = chains.iter().zip(&before);
                let made = made.map(|(chain, before)| ChainProgress {
                    steps: chain.steps[*before..].to_vec(),
                    error: chain.error.clone(),
                });
                Ok::<Vec<ChainProgress>, Infallible>(made.collect())
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

    /// True if a sweep has made all steps, or cannot go on.
    fn is_complete(&self, chain: &Chain) -> bool {
        chain.steps.len() >= self.steps || chain.error.is_some()
    }

    /// Makes the next step of those sweeps of a group that have made fewest, and returns how many; none if the monitor stops it.
    fn step_chains(&self, group: &mut [Chain], monitor: Monitor<'_>) -> Option<u64> {
        let afloat = group.iter().filter(|chain| !self.is_complete(chain));
        let Some(step) = afloat.map(|chain| chain.steps.len()).min() else {
            return Some(0);
        };
        let (mut moved, mut machines, mut members) = (Vec::new(), Vec::new(), Vec::new());
        for (index, chain) in group.iter_mut().enumerate() {
            if self.is_complete(chain) || chain.steps.len() != step {
                continue;
            }
            match self.lower_next_step(chain) {
                Ok(machine) => {
                    let state = chain.steps.last().map_or(self.start, |step| step.end);
                    let (start, is_put) = put_within_walls(machine.scene(), state);
                    members.push(Member::new(machines.len(), start));
                    machines.push(machine);
                    moved.push((index, is_put));
                }
                Err(error) => chain.error = Some(error.to_string()),
            }
        }
        let count = moved.len() as u64;
        let ensemble = Ensemble::new(machines, monitor);
        let mut open: Vec<&mut Member> = members.iter_mut().collect();
        let observed = ensemble.record_run(&mut open, self.periods, self.watched_periods());
        observed.ok()?;
        for ((index, is_put), member) in moved.into_iter().zip(members) {
            let scene = ensemble.machines[member.machine].scene();
            let chain = &mut group[index];
            let value = self.value_at(step, chain.direction);
            let made = match member.error {
                Some(error) => Err(error),
                None => {
                    let seen = SettledMotion::of(scene, &member, self.tolerance, self.periods);
                    SweepStep::new(value, scene, seen, self.heights)
                }
            };
            match made {
                Ok(step) => chain.steps.push(SweepStep {
                    is_put_on_wall: is_put,
                    ..step
                }),
                Err(error) => chain.error = Some(error.to_string()),
            }
        }
        // A group of failures alone has moved as well.
        Some(count.max(1))
    }

    /// The machine at the next step of a sweep, lowered for the lanes.
    fn lower_next_step(&self, chain: &Chain) -> Result<LoweredMachine, SceneError> {
        let mut machine = chain.machine.clone();
        let value = self.value_at(chain.steps.len(), chain.direction);
        machine.set(self.parameter, value);
        Ok(LoweredMachine::new(&machine.check(None)?))
    }
}

/// A state of a scene, and false; or where it lies beyond a rigid stop, the state of rest on that stop, and true.
fn put_within_walls(scene: &Scene, state: Start) -> (Start, bool) {
    let (low, high) = scene.reach();
    match state.position.max(low).min(high) {
        position if position == state.position => (state, false),
        position => (Start::new(position, 0.0), true),
    }
}
