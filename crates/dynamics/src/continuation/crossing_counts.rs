//! The sequence of crossings of an orbit: what it crosses, and how often.

use super::switching_surface::NearGrazing;
use super::{BorderCollision, SwitchingSurface};
use softstop::{Crossing, CrossingKind, Scene, Trajectory};

/// Largest ratio of the speeds at which a mass comes back to a stop and at which it left it, of bounces of one row.
const MAX_BOUNCE_RATIO: f64 = 10.0;

/// Counts of what an orbit crosses; they change only where it grazes something.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct CrossingCounts {
    /// Impacts; each row of bounces that ends in rest counts as one.
    pub impacts: usize,
    /// Crossings of surfaces, impacts on a rigid stop among them.
    pub surface_crossings: usize,
    /// Crossings of each [`SwitchingSurface`], in the order of [`SwitchingSurface::ALL`].
    pub by_surface: [usize; SwitchingSurface::ALL.len()],
    /// Turns under dry friction.
    pub reversals: usize,
    /// Rows of bounces that end in rest.
    pub rests: usize,
    /// Crossings of other kinds: ends of rest, contacts that cease or begin to press.
    pub others: usize,
    /// How often the mass is held, by dry friction or at a surface.
    pub holds: usize,
    /// Crossings of surfaces and turns at which the force does not jump: an orbit gains and loses them smoothly.
    pub continuous: [usize; 2],
}

impl CrossingCounts {
    /// True if two sequences differ in no crossing with a jump of the force.
    pub fn has_same_jumps(&self, other: &Self) -> bool {
        self.jump_counts() == other.jump_counts() && self.rests == other.rests
    }

    /// True if a sequence of crossings continues another: no other jumps of the force, and as many impacts.
    pub fn continues(&self, other: &Self) -> bool {
        self.impacts == other.impacts && self.has_same_jumps(other)
    }

    /// The border collision between orbits of two sequences of crossings.
    pub fn border_to(&self, other: &Self) -> Option<BorderCollision> {
        let ([surfaces, turns], [others, other_turns]) = (self.jump_counts(), other.jump_counts());
        if (self.holds, self.rests) != (other.holds, other.rests) {
            Some(BorderCollision::Rest)
        } else if surfaces != others {
            Some(BorderCollision::Surface)
        } else {
            (turns != other_turns).then_some(BorderCollision::Turn)
        }
    }

    /// Crossings of surfaces, and turns, at which the force jumps.
    fn jump_counts(&self) -> [usize; 2] {
        [
            self.surface_crossings - self.continuous[0],
            self.reversals - self.continuous[1],
        ]
    }

    /// What happens how often, whether the force jumps there or not: at the end of a range a jump may vanish.
    pub fn event_counts(&self) -> [usize; 4] {
        [
            self.impacts,
            self.surface_crossings,
            self.reversals,
            self.rests,
        ]
    }

    /// Number of crossings of all kinds.
    pub fn crossing_count(&self) -> usize {
        self.surface_crossings + self.reversals + self.others
    }
}

/// The crossings of a motion that count, each with the surface that it passes: of a row of ever weaker bounces that ends in
/// rest the first alone, as how many of them are told one by one is the simulation's choice.
pub(crate) struct CountedCrossings<'a> {
    trajectory: &'a Trajectory,
    all: Vec<(&'a Crossing, Option<SwitchingSurface>)>,
}

impl<'a> CountedCrossings<'a> {
    /// The counted crossings of a motion of a scene.
    pub fn of_motion(scene: &Scene, trajectory: &'a Trajectory) -> Self {
        let mut all: Vec<(&Crossing, Option<SwitchingSurface>)> = Vec::new();
        // Which one is the first of the present row of bounces, and how fast the next can be at most.
        let mut row: Option<(usize, f64)> = None;
        for crossing in trajectory.crossings() {
            if crossing.kind == CrossingKind::Rest
                && let Some((first, _)) = row.take()
            {
                all.truncate(first + 1);
            }
            let (position, speed) = (crossing.position, crossing.velocity.abs());
            let is_rebound = matches!(crossing.kind, CrossingKind::Rebound { .. });
            if is_rebound || crossing.kind.is_impact() {
                let goes_on =
                    row.filter(|(first, most)| all[*first].0.position == position && speed < *most);
                let first = goes_on.map_or(all.len(), |(first, _)| first);
                let left = MAX_BOUNCE_RATIO * crossing.velocity_after.abs();
                row = Some((first, speed.min(left)));
            }
            let surface =
                passes_surface(crossing).then(|| SwitchingSurface::at_position(scene, position));
            all.push((crossing, surface.flatten()));
        }
        Self { trajectory, all }
    }

    /// Before-impact velocities of the motion in m/s, in order of time.
    pub fn impact_velocities(&self) -> impl Iterator<Item = f64> {
        self.all.iter().filter_map(|(it, _)| it.impact_velocity())
    }

    /// The slowest crossing of a surface since the mass was at rest.
    pub fn slowest_crossing(&self) -> Option<NearGrazing> {
        let is_rest = |(it, _): &(&Crossing, _)| it.kind == CrossingKind::Rest;
        let rest = self.all.iter().rposition(is_rest);
        let since = self.all[rest.map_or(0, |rest| rest + 1)..].iter();
        let touches = since.filter_map(|(crossing, surface)| {
            Some(NearGrazing {
                time: self.trajectory.clock.time(crossing.instant),
                amount: crossing.velocity.abs(),
                surface: (*surface)?,
                reverses: false,
            })
        });
        touches.min_by(|a, b| a.amount.total_cmp(&b.amount))
    }

    /// Counts impacts, crossings of each surface, reversals, rests and holds of the motion; `scene` tells at which surfaces the
    /// force does not jump.
    pub fn count_by_kind(&self, scene: &Scene) -> CrossingCounts {
        let held = self.trajectory.arcs.iter().map(|arc| arc.course.is_held());
        let before = std::iter::once(false).chain(held.clone());
        let mut counts = CrossingCounts {
            holds: held.zip(before).filter(|(is, was)| *is && !was).count(),
            ..CrossingCounts::default()
        };
        // Where a surface without a jump of the force was passed forward last, and whether the mass has turned since.
        let mut touched = None;
        for (crossing, surface) in &self.all {
            counts.impacts += usize::from(crossing.kind.is_impact());
            match crossing.kind {
                CrossingKind::Surface { .. } | CrossingKind::Rebound { .. } => {
                    counts.surface_crossings += 1;
                    if let Some(surface) = surface {
                        counts.by_surface[*surface as usize] += 1;
                    }
                    let continuous =
                        surface.is_none_or(|surface| surface.is_force_continuous(scene));
                    touched = counts.count_passage(crossing, continuous, touched);
                }
                CrossingKind::Reversal => {
                    counts.reversals += 1;
                    touched = touched.map(|(position, _)| (position, true));
                }
                CrossingKind::Rest => counts.rests += 1,
                CrossingKind::Switch | CrossingKind::Release => counts.others += 1,
            }
        }
        counts
    }
}

impl CrossingCounts {
    /// Counts a surface that is passed with or without a jump of the force: what is touched from there on.
    fn count_passage(
        &mut self,
        crossing: &Crossing,
        continuous: bool,
        touched: Option<(f64, bool)>,
    ) -> Option<(f64, bool)> {
        if !continuous {
            return None;
        }
        self.continuous[0] += 1;
        // Turning back in between comes and goes with the touch.
        if touched == Some((crossing.position, true)) {
            self.continuous[1] += 1;
            return None;
        }
        let is_back = matches!(crossing.kind, CrossingKind::Surface { forward: false, .. });
        let is_onward = crossing.velocity != 0.0 && !is_back;
        is_onward.then_some((crossing.position, false))
    }
}

/// True if a crossing passes a surface or hits a rigid stop.
fn passes_surface(crossing: &Crossing) -> bool {
    matches!(
        crossing.kind,
        CrossingKind::Surface { .. } | CrossingKind::Rebound { .. }
    )
}

/// How many crossings die with one at a time in s: a rebound with the rest after it, or all up to the way back.
pub(super) fn crossings_dying_with(motion: &Trajectory, time: f64) -> usize {
    let all: Vec<&Crossing> = motion.crossings().collect();
    let is_it = |one: &&Crossing| motion.clock.time(one.instant) == time;
    let Some(index) = all.iter().position(is_it) else {
        return 0;
    };
    let Crossing { kind, position, .. } = *all[index];
    let (before, after) = (&all[..index], &all[index + 1..]);
    if matches!(kind, CrossingKind::Rebound { .. }) {
        let rests = |kind| matches!(kind, CrossingKind::Rest | CrossingKind::Release);
        return 1 + after.iter().take_while(|one| rests(one.kind)).count();
    }
    let same = |one: &&Crossing| one.position == position;
    let ways = [
        after.iter().position(same),
        before.iter().rev().position(same),
    ];
    let between = ways.into_iter().flatten().min();
    between.map_or(1, |between| between + 2)
}
