//! Sweeps of many stops along the frequency, up and down.

use anyhow::Result;
use softstop::Parameter;
use softstop_dynamics::monitor::OptionalMemory;
use softstop_dynamics::motion_kind::MotionClass;
use softstop_dynamics::{Chain, MotionKind, Plan, SweepStep};

use super::stops::{CLEARANCE, Law};
use crate::diagram::{self, dots};

/// The frequencies eta.
pub(super) const RANGE: (f64, f64) = (0.6, 1.6);

/// The way up and the way down of a stop, both in rising order of frequency.
pub(super) struct SweptStop {
    pub(super) law: Law,
    pub(super) up: Vec<SweepStep>,
    pub(super) down: Vec<SweepStep>,
}

/// Sweeps of stops: so many frequencies, and drive periods at each.
pub(super) fn sweep(
    laws: &[Law],
    (steps, periods): (usize, u64),
    kept: OptionalMemory<'_>,
) -> Result<Vec<SweptStop>> {
    let plan = Plan::new(Parameter::Frequency, RANGE, steps, periods)?;
    let ways = |law: &Law| diagram::ways(&law.scene(RANGE.0, CLEARANCE));
    let jobs = vec![(plan, laws.iter().flat_map(ways).collect())];
    let chains = diagram::sweep(jobs, "steps of the stops' sweeps", kept)?;
    let rising = |chain: &Chain| chain.rising_steps().into_iter().cloned().collect();
    let swept = laws.iter().zip(chains.chunks_exact(2));
    let swept = swept.map(|(law, pair)| SweptStop {
        law: *law,
        up: rising(&pair[0]),
        down: rising(&pair[1]),
    });
    Ok(swept.collect())
}

/// The kind of motion of a step; subharmonic ones but z = 1/2 are one kind.
pub(super) fn kind(step: &SweepStep) -> MotionClass {
    let regime = step.motion.regime().map(|it| (it.impacts, it.periods));
    match (regime, &step.motion) {
        _ if step.velocities.is_empty() => MotionClass::Zero,
        (Some((1, 1)), _) => MotionClass::One,
        (Some((1, 2)), _) => MotionClass::Half,
        (Some((impacts, periods)), _) if impacts == periods => MotionClass::Doubled,
        (None, MotionKind::Chaos) => MotionClass::Chaos,
        (None, MotionKind::Unsettled) => MotionClass::Unsettled,
        _ => MotionClass::Few,
    }
}

impl SweptStop {
    /// The before-impact velocities over the frequency on both ways.
    pub(super) fn points(&self) -> [Vec<(f64, f64)>; 2] {
        let hits = |step: &&SweepStep| !step.velocities.is_empty();
        [&self.up, &self.down].map(|steps| steps.iter().filter(hits).flat_map(dots).collect())
    }

    /// Share of the frequencies at which both ways end in the same kind of motion.
    pub(super) fn reversible(&self) -> f64 {
        agreement(self.up.iter().zip(&self.down))
    }

    /// The lowest frequency with impacts on the way down.
    pub(super) fn lowest_with_impacts(&self) -> Option<f64> {
        let lowest = self.down.iter().find(|step| !step.velocities.is_empty());
        lowest.map(|step| step.value)
    }

    /// Share of the frequencies at which the way up ends in a subharmonic motion or chaos.
    pub(super) fn complex(&self) -> f64 {
        use MotionClass::{Chaos, Doubled, Few, Half};
        let complex = |step: &&SweepStep| matches!(kind(step), Doubled | Half | Few | Chaos);
        self.up.iter().filter(complex).count() as f64 / self.up.len().max(1) as f64
    }

    /// Share of the frequencies and ways at which two stops end in the same kind of motion: of all, and of those
    /// at which either is neither z = 0 nor z = 1.
    pub(super) fn likeness(&self, other: &Self) -> [f64; 2] {
        let ours = self.up.iter().chain(&self.down);
        let pairs = ours.zip(other.up.iter().chain(&other.down));
        let is_other =
            |step: &SweepStep| !matches!(kind(step), MotionClass::Zero | MotionClass::One);
        let others = pairs.clone().filter(|(a, b)| is_other(a) || is_other(b));
        [agreement(pairs), agreement(others)]
    }
}

/// Share of the pairs that are of the same kind, among those in which both have settled.
fn agreement<'a>(pairs: impl Iterator<Item = (&'a SweepStep, &'a SweepStep)>) -> f64 {
    let kinds = pairs.map(|(a, b)| (kind(a), kind(b)));
    let settled =
        kinds.filter(|(a, b)| *a != MotionClass::Unsettled && *b != MotionClass::Unsettled);
    let (same, all) = settled.fold((0u32, 0u32), |(same, all), (a, b)| {
        (same + u32::from(a == b), all + 1)
    });
    f64::from(same) / f64::from(all.max(1))
}
