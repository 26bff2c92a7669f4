//! A chaotic attractor: its exponents, impacts and lifetime.

use std::convert::Infallible;

use crate::ensemble::Ensemble;
use crate::extremes::extremes;
use crate::orbit::{LyapunovExponents, OrbitError, StroboscopicMap};
use softstop::internals::narrow_root;
use softstop::{CheckedScene, Crossing, Observer, Start};

/// Exponents, impacts and lifetime of a chaotic motion: one that never repeats as far as it was watched.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Chaos {
    /// A state of it at drive angle phi.
    pub state: Start,
    /// Its Lyapunov exponents.
    pub exponents: LyapunovExponents,
    /// Mean number of drive periods before it ends, if it is transient.
    pub lifetime: Option<f64>,
    /// Starts of the region that came to it; those that it has let go count where they ended.
    pub entered: usize,
    /// Mean number of impacts per drive period.
    pub impacts_per_period: f64,
    /// Least and largest before-impact velocity in m/s seen; none without impacts.
    pub velocities: Option<[f64; 2]>,
    /// Drive periods for which motions on it were watched, all together. Without an escape, its mean lifetime exceeds a third of
    /// this with 95 % confidence.
    pub watched: u64,
}

/// Observer that records the before-impact velocities of a motion in m/s.
#[derive(Default)]
struct ImpactVelocities(Vec<f64>);

impl Observer for ImpactVelocities {
    fn crossing(&mut self, crossing: &Crossing) {
        self.0.extend(crossing.impact_velocity());
    }
}

/// Most drive periods over which the impacts of a chaotic motion are counted.
const MAX_COUNTED_PERIODS: u64 = 4096;

impl Chaos {
    /// Measures the impacts of a chaotic motion from the state `begin` on; `state`: that after measuring its `exponents`.
    pub(super) fn of_motion(
        scene: &CheckedScene,
        ensemble: &Ensemble<'_>,
        (begin, state): (Start, Start),
        exponents: LyapunovExponents,
    ) -> Result<Self, OrbitError> {
        let counted = MAX_COUNTED_PERIODS.min(exponents.periods);
        let map = StroboscopicMap::new(scene, counted);
        let mut impacts = ImpactVelocities::default();
        map.image_with_observer(begin.into(), &mut impacts)?;
        let ImpactVelocities(velocities) = impacts;
        ensemble.count_work(counted)?;
        Ok(Self {
            state,
            exponents,
            lifetime: None,
            entered: 0,
            impacts_per_period: velocities.len() as f64 / counted as f64,
            velocities: extremes(velocities),
            watched: 0,
        })
    }
}

/// Numbers of motions in a chaotic set that stayed in it and that escaped, by the time for which they were watched.
#[derive(Debug, Clone, Default)]
pub(super) struct EscapeCounts(Vec<EscapeCount>);

/// Numbers of motions in one chaotic set, watched for the same number of drive periods, that stayed in it and that escaped.
#[derive(Debug, Clone, Copy)]
struct EscapeCount {
    periods: u64,
    stayed: u64,
    gone: u64,
}

/// Range in which the logarithm of the escape rate per drive period is searched.
const LN_RATE_RANGE: (f64, f64) = (-40.0, 5.0);

impl EscapeCounts {
    /// Counts a motion in the chaotic set that was watched for some drive periods, and has escaped by then or not.
    pub fn record_watch(&mut self, periods: u64, is_gone: bool) {
        let (stayed, gone) = (u64::from(!is_gone), u64::from(is_gone));
        match self.0.iter_mut().find(|watch| watch.periods == periods) {
            Some(watch) => {
                watch.stayed += stayed;
                watch.gone += gone;
            }
            None => self.0.push(EscapeCount {
                periods,
                stayed,
                gone,
            }),
        }
    }

    /// Drive periods for which motions in the chaotic set were watched, all together.
    pub fn watched_periods(&self) -> u64 {
        let watched = |watch: &EscapeCount| watch.periods * (watch.stayed + watch.gone);
        self.0.iter().map(watched).sum()
    }

    /// The mean lifetime of transient chaos in drive periods; none if no motion has escaped.
    ///
    /// Lifetimes on chaos that ends are exponential (Grebogi, Ott and Yorke 1983). Of a motion that has gone it is known only
    /// that it went between two checks. The rate r of greatest likelihood solves sum gone P / (e^(r P) - 1) = sum stayed P.
    pub fn mean_lifetime(&self) -> Option<f64> {
        if self.0.iter().all(|watch| watch.gone == 0) {
            return None;
        }
        let stayed = self.0.iter().map(|watch| watch.periods * watch.stayed);
        let stayed: f64 = stayed.map(|periods| periods as f64).sum();
        // Where none has stayed, half a motion is taken to have.
        let least = self.0.iter().map(|watch| watch.periods).min().unwrap_or(1);
        let stayed = stayed.max(0.5 * least as f64);
        let excess = |rate: f64| {
            let share = |watch: &EscapeCount| {
                let periods = watch.periods as f64;
                watch.gone as f64 * periods / (rate * periods).exp_m1()
            };
            self.0.iter().map(share).sum::<f64>() - stayed
        };
        let at = |rate: f64| excess(rate.exp());
        let [low, high] = [LN_RATE_RANGE.0, LN_RATE_RANGE.1].map(|rate| (rate, at(rate)));
        let Ok((low, high)) = narrow_root(low, high, 64.0 * f64::EPSILON, |rate| {
            Ok::<f64, Infallible>(at(rate))
        });
        Some((-low.midpoint(high)).exp())
    }
}

/// A group of wandering motions that visit the same places: chaos, if the exponent of one of them is positive.
#[derive(Default)]
pub(super) struct ChaosCandidate {
    pub exponents: Option<LyapunovExponents>,
    pub chaos: Option<Chaos>,
    /// Counts of the drive periods for which its motions were watched, and which had settled elsewhere then.
    pub escapes: EscapeCounts,
    /// Starts of the region that came to the group.
    pub entered: usize,
}

impl ChaosCandidate {
    /// Keeps the given exponents of a motion of the group if the first one is larger than that of the kept ones.
    pub fn keep_largest_exponents(&mut self, exponents: LyapunovExponents) {
        let first = |of: &LyapunovExponents| of.per_period[0];
        if self
            .exponents
            .as_ref()
            .is_none_or(|best| first(best).is_nan() || first(&exponents) > first(best))
        {
            self.exponents = Some(exponents);
        }
    }

    /// The chaos of the group, with its lifetime by the counted escapes; none if the group is not chaotic.
    pub fn chaos_with_escapes(&self) -> Option<Chaos> {
        Some(Chaos {
            watched: self.escapes.watched_periods(),
            lifetime: self.escapes.mean_lifetime(),
            entered: self.entered,
            ..self.chaos?
        })
    }
}

#[cfg(test)]
mod tests {
    use super::EscapeCounts;
    use approx::assert_abs_diff_eq;
    use softstop_testing::tolerance::DIFFERENCED;

    /// Exponential lifetimes at their quantiles, looked at after 500, 1000, 2000, ... drive periods.
    #[test]
    fn a_mean_life_is_found_however_rarely_it_is_looked_at() {
        let (mean, motions) = (12_810.0, 4000);
        let mut escapes = EscapeCounts::default();
        for motion in 0..motions {
            let share = (f64::from(motion) + 0.5) / f64::from(motions);
            let life = -mean * (1.0 - share).ln();
            let (mut begin, mut periods) = (0.0, 500);
            loop {
                let end = begin + periods as f64;
                escapes.record_watch(periods, life <= end);
                if life <= end {
                    break;
                }
                (begin, periods) = (end, 2 * periods);
            }
        }
        let found = escapes.mean_lifetime().expect("all have gone");
        assert_abs_diff_eq!(found / mean, 1.0, epsilon = 0.02);
    }

    #[test]
    fn what_nothing_leaves_has_no_lifetime() {
        let mut escapes = EscapeCounts::default();
        escapes.record_watch(1000, false);
        assert_eq!(escapes.mean_lifetime(), None);
        assert_eq!(escapes.watched_periods(), 1000);
        escapes.record_watch(1000, true);
        assert_abs_diff_eq!(
            escapes.mean_lifetime().expect("one has gone"),
            1000.0 / 2_f64.ln(),
            epsilon = DIFFERENCED
        );
    }
}
