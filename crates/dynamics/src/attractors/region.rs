//! The region of the plane of states from which motions start, and quasi-random starts in it.

use serde::{Deserialize, Serialize};

use crate::extremes::extremes;
use crate::spread_points::{evenly_spread_point, uniform_from_seed};
use softstop::internals::Scales;
use softstop::{Dimension, Machine, Scene, Start};

/// A rectangle in the plane of states at drive angle phi, from which motions start.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Least and largest position in m.
    pub position: [f64; 2],
    /// Least and largest velocity in m/s.
    pub velocity: [f64; 2],
}

/// Margin on each side of the states that a region of starts holds, as a share of their range.
pub(super) const REGION_MARGIN: f64 = 0.5;

impl Region {
    /// The region of the first starts of a search, the pilot: three times the length of [`Scene::motion_scales`] about the origin.
    pub(super) fn pilot(scene: &Scene) -> Self {
        let Scales { length, rate } = scene.motion_scales();
        let (x, v) = (3.0 * length, 3.0 * rate * length);
        Self {
            position: [-x, x],
            velocity: [-v, v],
        }
        .clipped_at_stops(scene)
    }

    /// The region about some states, with a margin; none if there are no states or one is not finite.
    pub(super) fn about_states<'a>(
        scene: &Scene,
        states: impl Iterator<Item = &'a Start> + Clone,
    ) -> Option<Self> {
        let position = extremes(states.clone().map(|state| state.position))?;
        let velocity = extremes(states.map(|state| state.velocity))?;
        let Scales { length, rate } = scene.motion_scales();
        let widen = |[low, high]: [f64; 2], least: f64| {
            let margin = (REGION_MARGIN * (high - low)).max(least);
            [low - margin, high + margin]
        };
        let region = Self {
            position: widen(position, 0.1 * length),
            velocity: widen(velocity, 0.1 * rate * length),
        };
        position[0]
            .is_finite()
            .then(|| region.clipped_at_stops(scene))
    }

    /// True if a state lies in the region.
    pub(super) fn contains(&self, state: &Start) -> bool {
        let within = |[low, high]: [f64; 2], value: f64| (low..=high).contains(&value);
        within(self.position, state.position) && within(self.velocity, state.velocity)
    }

    /// The smallest region that holds both regions.
    pub fn smallest_union(&self, other: &Self) -> Self {
        let both = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        Self {
            position: both(self.position, other.position),
            velocity: both(self.velocity, other.velocity),
        }
    }

    /// The region as text, in a machine's own units.
    pub fn describe(&self, machine: &Machine) -> String {
        let range = |[low, high]: [f64; 2], dimension, name: &str| {
            let own = |value| machine.to_own(dimension, value);
            let text = format!("{:.6} <= {name} <= {:.6}", own(low), own(high));
            match machine.unit(dimension) {
                "" => text,
                unit => format!("{text} {unit}"),
            }
        };
        let position = range(self.position, Dimension::Length, "x");
        let velocity = range(self.velocity, Dimension::Velocity, "x'");
        format!("{position} and {velocity} at drive angle phi")
    }

    /// The part of the region before rigid stops; where all of it lies beyond them, the region is moved before them.
    pub fn clipped_at_stops(mut self, scene: &Scene) -> Self {
        let (lowest, highest) = scene.reach();
        let width = self.position[1] - self.position[0];
        self.position[1] = self.position[1].min(highest);
        if self.position[0] >= highest {
            self.position[0] = highest - width;
        }
        self.position[0] = self.position[0].max(lowest);
        if self.position[1] <= lowest {
            self.position[1] = highest.min(lowest + width);
        }
        self
    }

    /// `count` quasi-random starts, spread evenly over the region and shifted by the seed.
    pub(crate) fn starts(&self, count: usize, seed: u64) -> Vec<Start> {
        let shifts = [uniform_from_seed(seed), uniform_from_seed(!seed)];
        let within = |[low, high]: [f64; 2], share: f64| low + share * (high - low);
        let start = |index| {
            let [across, up] = evenly_spread_point(shifts, index);
            Start::new(within(self.position, across), within(self.velocity, up))
        };
        (0..count).map(start).collect()
    }
}
