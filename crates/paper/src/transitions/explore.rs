//! From a few values of the parameter to all transitions.

use rayon::prelude::*;

use super::departure::is_doubled;
use super::explorer::{Explorer, Gathering, Window};
use super::{Cause, Transition};
use softstop::Start;
use softstop_dynamics::attractors::find_attractors;
use softstop_dynamics::monitor::recall_or_compute;
use softstop_dynamics::motion_kind::MotionKind;
use softstop_dynamics::orbit::{Orbit, OrbitError};

/// A periodic motion to follow: where it was met, and its orbit.
type Met = (f64, Orbit);
/// Chaos to follow: where it was met, and states on it.
type Seed = (f64, Vec<Start>);

/// What is known so far.
#[derive(Default)]
struct KnownMotions {
    windows: Vec<Window>,
    /// Values over which chaos has been followed.
    chaos: Vec<(f64, f64)>,
    transitions: Vec<Transition>,
}

/// Rounds of new motions after which no more are followed.
const MAX_ROUNDS: usize = 6;
/// Distance of an end of chaos from that of a window, as a share of the parameter, at which they are one.
const SAME_CHAOS_END: f64 = 1e-4;

impl Explorer<'_> {
    /// All transitions of the motions found at `values`, and of those to which they lead, in rising order
    /// of the parameter.
    ///
    /// # Errors
    /// [`OrbitError`] if a scene cannot be, or the monitor stopped it.
    pub fn explore(&self, values: &[f64]) -> Result<Vec<Transition>, OrbitError> {
        let mut atlas = KnownMotions::default();
        let (mut met, mut seeds) = (Vec::new(), Vec::new());
        for value in values {
            self.survey(*value, &mut met, &mut seeds)?;
        }
        for _ in 0..MAX_ROUNDS {
            if met.is_empty() && seeds.is_empty() {
                break;
            }
            let departures = self.follow(&mut atlas, std::mem::take(&mut met))?;
            for (transition, gathering) in departures {
                if let Some(orbit) = gathering.orbit {
                    met.push((transition.seen_at(), orbit));
                } else if transition.to() == &MotionKind::Chaos {
                    seeds.push((transition.seen_at(), gathering.states));
                }
                atlas.transitions.push(transition);
            }
            for seed in std::mem::take(&mut seeds) {
                self.follow_chaos(&mut atlas, &seed, &mut met)?;
            }
        }
        let mut transitions = atlas.transitions;
        transitions.sort_by(|a, b| a.value.total_cmp(&b.value));
        Ok(transitions)
    }

    /// The motions at one value.
    fn survey(
        &self,
        value: f64,
        met: &mut Vec<Met>,
        seeds: &mut Vec<Seed>,
    ) -> Result<(), OrbitError> {
        let scene = self.family.scene([value])?;
        let found: (Vec<Met>, Vec<Seed>) =
            recall_or_compute(self.kept, &("survey", &scene), || {
                let survey = find_attractors(&scene, &self.rules.survey, self.monitor)?;
                let (mut met, mut seeds) = (Vec::new(), Vec::new());
                for attractor in survey.attractors {
                    if attractor.motion.is_chaotic() {
                        seeds.push((value, vec![attractor.state]));
                    }
                    met.extend(attractor.orbit.map(|orbit| (value, *orbit)));
                }
                Ok::<_, OrbitError>((met, seeds))
            })?;
        met.extend(found.0);
        seeds.extend(found.1);
        Ok(())
    }

    /// Follows new motions to their ends and beyond.
    fn follow(
        &self,
        atlas: &mut KnownMotions,
        met: Vec<Met>,
    ) -> Result<Vec<(Transition, Gathering)>, OrbitError> {
        let mut fresh = Vec::new();
        for (value, orbit) in met {
            let motion = MotionKind::of(&orbit);
            let known = |window: &Window| window.motion == motion && window.contains(value);
            if atlas.windows.iter().chain(&fresh).any(known) {
                continue;
            }
            // An orbit so near an end of its window that it cannot be followed is met again elsewhere.
            if let Ok(window) = self.window(value, &orbit) {
                fresh.push(window);
            }
        }
        let ends = fresh
            .par_iter()
            .flat_map_iter(|window| [(window, false), (window, true)]);
        let departures = ends.filter_map(|(window, upper)| self.depart(window, upper).transpose());
        let departures = departures.collect::<Result<_, _>>();
        atlas.windows.extend(fresh);
        departures
    }

    /// Follows chaos both ways.
    fn follow_chaos(
        &self,
        atlas: &mut KnownMotions,
        (value, states): &Seed,
        met: &mut Vec<Met>,
    ) -> Result<(), OrbitError> {
        let mut followed = atlas.chaos.iter();
        if followed.any(|(low, high)| (*low..=*high).contains(value)) {
            return Ok(());
        }
        let Some(states) = self.lasting(*value, states)?.wandering else {
            return Ok(());
        };
        let mut ends = [*value; 2];
        for rising in [false, true] {
            let (last, end) = self.end_of_chaos(*value, &states, rising)?;
            ends[usize::from(rising)] = last;
            let Some(end) = end else { continue };
            let Gathering { motion, orbit, .. } = &end.gathering;
            let Some((target, orbit)) = motion.as_ref().zip(orbit.as_ref()) else {
                continue;
            };
            met.push((end.after, orbit.clone()));
            let window = self.window(end.after, orbit);
            let hysteresis = window.is_ok_and(|window| window.contains(end.before));
            if !atlas.has_reverse(target, end.value) {
                atlas.transitions.push(Transition {
                    value: end.value,
                    doubled_until: None,
                    settled_at: None,
                    settled_within: 0.0,
                    from: MotionKind::Chaos,
                    state: None,
                    path: vec![target.clone()],
                    causes: vec![Cause::OutOfChaos],
                    rising,
                    hysteresis,
                    beyond: (end.after - end.value).abs(),
                });
            }
        }
        atlas.chaos.push((ends[0], ends[1]));
        Ok(())
    }
}

impl KnownMotions {
    /// True if chaos is known to follow on a motion, or on one of which it is doubled, near a value, without
    /// hysteresis.
    fn has_reverse(&self, motion: &MotionKind, value: f64) -> bool {
        self.transitions.iter().any(|known| {
            !known.hysteresis
                && known.to() == &MotionKind::Chaos
                && (&known.from == motion || is_doubled(&known.from, motion))
                && (known.value - value).abs() <= SAME_CHAOS_END * value.abs()
        })
    }
}
