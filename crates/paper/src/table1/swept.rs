//! What a sweep makes of a transition: it loses a motion later than it ends, and comes to the next later still.

use crate::transitions::Transition;
use softstop::{Parameter, Ratios};
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::{Chain, Direction, MotionKind, Plan, SweepStep};

/// A sweep over the end of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SweptEnd {
    /// Change of eta from step to step.
    pub step: f64,
    /// The first value in which the motion is no longer the first.
    pub lost: f64,
    /// The first value in which it is the last, and not lost again at once; none if that does not repeat.
    pub arrived: Option<f64>,
}

/// Drive periods of a step.
pub const PERIODS: u64 = 50;
/// Steps before the end at which the sweep begins, and steps after it.
const AROUND: (usize, usize) = (20, 60);
/// Distance within which a state has returned, in units of the motion's size: near enough not to be lost, and to
/// have arrived.
const RETURN: (f64, f64) = (1e-2, 1e-3);

impl SweptEnd {
    /// The sweep whose steps are the power of ten below this size, in the direction of the transition. None if the first
    /// motion does not repeat or is not lost on the way.
    pub fn over(transition: &Transition, size: f64) -> Option<Self> {
        let step = 10_f64.powf(size.abs().log10().floor());
        let seen = sweep(transition, step, RETURN.0)?;
        let first = seen.iter().position(|it| is(&transition.from, it))?;
        let mut rest = seen[first..].iter();
        let lost = first + rest.position(|it| !is(&transition.from, it))?;
        let settled = sweep(transition, step, RETURN.1)?;
        let arrived = settled[lost..].windows(2).find(|pair| {
            let mut pair = pair.iter();
            pair.all(|it| is(transition.to(), it))
        });
        Some(Self {
            step,
            lost: seen[lost].value,
            arrived: arrived.map(|pair| pair[0].value),
        })
    }
}

/// The steps of a sweep over the end of a motion, on whole steps, as a run by hand would go.
fn sweep(transition: &Transition, step: f64, tolerance: f64) -> Option<Vec<SweepStep>> {
    let (before, after) = AROUND;
    let (way, below, above) = match transition.rising {
        true => (Direction::Up, before, after),
        false => (Direction::Down, after, before),
    };
    let nearest = (transition.value / step).round();
    let from = (nearest - below as f64) * step;
    let range = (from, (nearest + above as f64) * step);
    let plan = Plan::new(Parameter::Frequency, range, before + after + 1, PERIODS).ok()?;
    let plan = Plan {
        start: transition.state?,
        tolerance,
        heights: false,
        ..plan
    };
    let mut chain = [Chain::new(Ratios::unloaded().scene().ok()?, way)];
    let is_done = plan.run_chains(&mut chain, &unmonitored);
    let [chain] = chain;
    is_done.then_some(chain.steps)
}

fn is(motion: &MotionKind, step: &SweepStep) -> bool {
    match motion {
        MotionKind::Chaos => step.motion == MotionKind::Chaos,
        _ => motion.regime().is_some() && motion.regime() == step.motion.regime(),
    }
}
