//! Sweeps of many stops along the frequency, up and down.

use anyhow::Result;
use softstop_dynamics::continuation::Parameter;
use softstop_dynamics::motion::MotionKind;
use softstop_dynamics::orbit::Regime;
use softstop_dynamics::sweep::{Chain, Plan, Step};

use super::stops::{CLEARANCE, Law};
use crate::diagram;
use crate::hardening::chart::StopRegime;

/// The frequencies eta.
pub(super) const RANGE: (f64, f64) = (0.6, 1.6);

/// The way up and the way down of a stop, both in rising order of frequency.
pub(super) struct Swept {
    pub(super) law: Law,
    pub(super) up: Vec<Step>,
    pub(super) down: Vec<Step>,
}

/// Sweeps of stops: so many frequencies, and drive periods at each.
pub(super) fn sweep(laws: &[Law], steps: usize, periods: u64) -> Result<Vec<Swept>> {
    let plan = Plan::new(Parameter::Frequency, RANGE, steps, periods)?;
    let ways = |law: &Law| diagram::ways(&law.scene(RANGE.0, CLEARANCE));
    let mut job = [(plan, laws.iter().flat_map(ways).collect())];
    diagram::sweep(&mut job, "steps of the stops' sweeps")?;
    let [(_, chains)] = job;
    let rising = |chain: &Chain| chain.rising().into_iter().cloned().collect();
    let swept = laws.iter().zip(chains.chunks_exact(2));
    let swept = swept.map(|(law, pair)| Swept {
        law: *law,
        up: rising(&pair[0]),
        down: rising(&pair[1]),
    });
    Ok(swept.collect())
}

/// The kind of motion of a step.
pub(super) fn regime(step: &Step) -> StopRegime {
    if step.velocities.is_empty() {
        return StopRegime::None;
    }
    match step.motion.regime() {
        Some(Regime::ONE) => StopRegime::One,
        Some(Regime {
            impacts: 1,
            periods: 2,
        }) => StopRegime::Half,
        Some(regime) if regime.impacts == regime.periods => StopRegime::Split,
        None if step.motion == MotionKind::Chaos => StopRegime::Chaos,
        None if step.motion == MotionKind::Unsettled => StopRegime::Unsettled,
        _ => StopRegime::Other,
    }
}

impl Swept {
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
        use StopRegime::{Chaos, Half, Other, Split};
        let complex = |step: &&Step| matches!(regime(step), Split | Half | Other | Chaos);
        self.up.iter().filter(complex).count() as f64 / self.up.len().max(1) as f64
    }

    /// Share of the frequencies and ways at which two stops end in the same kind of motion.
    pub(super) fn likeness(&self, other: &Self) -> f64 {
        let ours = self.up.iter().chain(&self.down);
        agreement(ours.zip(other.up.iter().chain(&other.down)))
    }
}

/// Share of the pairs that are of the same kind, among those in which both have settled.
fn agreement<'a>(pairs: impl Iterator<Item = (&'a Step, &'a Step)>) -> f64 {
    let kinds = pairs.map(|(a, b)| (regime(a), regime(b)));
    let settled = kinds.filter(|(a, b)| *a != StopRegime::Unsettled && *b != StopRegime::Unsettled);
    let (same, all) = settled.fold((0u32, 0u32), |(same, all), (a, b)| {
        (same + u32::from(a == b), all + 1)
    });
    f64::from(same) / f64::from(all.max(1))
}
