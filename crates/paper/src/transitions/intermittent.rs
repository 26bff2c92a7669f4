//! Intermittent chaos beside the end of a motion: long stretches of the motion as it was, between bursts.

use super::Stretches;
use super::explorer::Explorer;
use softstop::Start;
use softstop_dynamics::internals::{Ensemble, Member};
use softstop_dynamics::motion::MotionKind;
use softstop_dynamics::orbit::{Exponents, Orbit, OrbitError};
use softstop_lanes::Machine;

/// Drive periods for which a motion is followed, and those between two looks at whether it has settled.
const ENDURANCE: u64 = 400_000;
const PERIODS_BETWEEN_LOOKS: u64 = 10_000;
/// Bursts after which it counts as chaos.
const BURSTS: usize = 3;
/// Least difference of a motion from the orbit, in units of its size.
const LEAST_DIFFERENCE: f64 = 1e-9;

impl Explorer<'_> {
    /// True if a motion near an orbit that has lost stability leaves it, is thrown back to it and leaves it
    /// again, several times over: Pomeau and Manneville's intermittency (1980), which the paper's ISN names.
    pub(super) fn is_intermittent(
        &self,
        value: f64,
        states: &[Start],
        motion: &MotionKind,
    ) -> Result<bool, OrbitError> {
        let (Some(periods), Some(&start)) = (motion.periods(), states.first()) else {
            return Ok(false);
        };
        let scene = self.family.scene([value])?;
        let leaves_in_time = Orbit::find_periodic(&scene, start.into(), periods)
            .is_ok_and(|orbit| BURSTS as f64 * leaving(&orbit) < ENDURANCE as f64);
        if !leaves_in_time {
            return Ok(false);
        }
        let ensemble = Ensemble::new(vec![Machine::new(&scene)], self.monitor);
        let member = Member::new(0, start);
        let mut calm = Stretches::new(member, &scene, start, periods, |it| {
            has_bursts(it) || it.since > it.longest.max(it.calm)
        })?;
        for _ in 0..ENDURANCE / PERIODS_BETWEEN_LOOKS {
            ensemble.advance_batch::<true, true, _>(&mut [&mut calm], PERIODS_BETWEEN_LOOKS)?;
            if let Some(error) = calm.member.error {
                return Err(error.into());
            }
            // It may not have come back for longer than it ever stayed, too.
            if (calm.is_known)(&calm) {
                return Ok(has_bursts(&calm));
            }
            let arrivals = self.settle_at(value, &[calm.member.state], 0)?;
            if arrivals.iter().any(|arrival| arrival.orbit.is_some()) {
                return Ok(false);
            }
        }
        Ok(false)
    }
}

/// True if stretches have ended over and over.
fn has_bursts(stretches: &Stretches) -> bool {
    stretches.lengths.len() >= BURSTS
}

/// Drive periods that a difference takes to grow to the size of the motion, from [`LEAST_DIFFERENCE`] of it.
fn leaving(orbit: &Orbit) -> f64 {
    let growth = Exponents::of(orbit).per_period[0];
    match growth > 0.0 {
        true => -LEAST_DIFFERENCE.ln() / growth,
        false => f64::INFINITY,
    }
}
