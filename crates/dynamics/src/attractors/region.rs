//! The region of the plane of states from which motions start, and quasi-random starts in it.

use serde::{Deserialize, Serialize};

use crate::extremes::extremes;
use crate::points::scramble_bits;
use softstop::internals::Scales;
use softstop::{Dimension, Machine, Scene, Start};

/// A region of starts: a rectangle of states at drive angle phi.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Least and largest position in m.
    pub position: [f64; 2],
    /// Least and largest velocity in m/s.
    pub velocity: [f64; 2],
}

/// Half-size of the region of the pilot's starts, in units of the motion's length (and of w times it).
const PILOT_HALF_SIZE: f64 = 3.0;
/// Margin on each side of the region in which motions stay, as a share of it.
const REGION_MARGIN: f64 = 0.5;
/// Least half-size of a region of starts, in units of the motion's length.
const LEAST_HALF_SIZE: f64 = 0.1;
/// Least half-size of the box of all starts, in units of the motion's length (and of w times it).
const BOX_HALF_SIZE: f64 = 2.0;
/// 1/g and 1/g^2 with g^3 = g + 1: of all pairs the one whose multiples fill a square most evenly (Roberts 2018).
const SEQUENCE_STEPS: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_3];

impl Region {
    /// The region of the pilot's starts: far and wide about the origin.
    pub(super) fn pilot(scene: &Scene) -> Self {
        let Scales { length, rate } = scene.motion_scales();
        let (x, v) = (PILOT_HALF_SIZE * length, PILOT_HALF_SIZE * rate * length);
        Self {
            position: [-x, x],
            velocity: [-v, v],
        }
        .clipped_at_stops(scene)
    }

    /// The region about all these states, with a margin; none if there is none.
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
            position: widen(position, LEAST_HALF_SIZE * length),
            velocity: widen(velocity, LEAST_HALF_SIZE * rate * length),
        };
        position[0]
            .is_finite()
            .then(|| region.clipped_at_stops(scene))
    }

    /// The box that commands take starts from: twice the motion's length both ways, or wider where states need it.
    pub(crate) fn start_box(scene: &Scene, states: impl IntoIterator<Item = Start>) -> Self {
        let Scales { length, rate } = scene.motion_scales();
        let (length, room) = (BOX_HALF_SIZE * length, 1.0 + REGION_MARGIN);
        let half = states
            .into_iter()
            .fold((length, length * rate), |(x, v), state| {
                let (far, fast) = (state.position.abs(), state.velocity.abs());
                match (far + fast).is_finite() {
                    true => (x.max(room * far), v.max(room * fast)),
                    false => (x, v),
                }
            });
        Self {
            position: [-half.0, half.0],
            velocity: [-half.1, half.1],
        }
        .clipped_at_stops(scene)
    }

    /// The region, and if states lie outside it a wider one that holds them with the same room.
    pub(crate) fn widened_to_hold(&self, scene: &Scene, states: &[Start]) -> Self {
        match states.iter().all(|state| self.contains(state)) {
            true => *self,
            false => self.smallest_union(&Self::start_box(scene, states.iter().copied())),
        }
    }

    /// True if a state lies in the region.
    fn contains(&self, state: &Start) -> bool {
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

    /// The region in words, in a machine's own units.
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

    /// The part of the region before rigid stops; the region moved there if no part of it is.
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

    /// So many quasi-random starts, spread evenly over the region.
    pub(crate) fn starts(&self, count: usize, seed: u64) -> Vec<Start> {
        let shifts = [seeded_share(seed), seeded_share(!seed)];
        let within = |[low, high]: [f64; 2], share: f64| low + share * (high - low);
        let start = |index| {
            let [across, up] = evenly_spread_point(shifts, index);
            Start::new(within(self.position, across), within(self.velocity, up))
        };
        (0..count).map(start).collect()
    }
}

/// The point of a quasi-random sequence with this index from 0 on, which fills the unit square evenly.
pub fn evenly_spread_point(shifts: [f64; 2], index: usize) -> [f64; 2] {
    std::array::from_fn(|axis| (shifts[axis] + SEQUENCE_STEPS[axis] * (index + 1) as f64).fract())
}

/// A number between 0 and 1 from a seed.
fn seeded_share(seed: u64) -> f64 {
    (scramble_bits(seed) >> 11) as f64 / (1u64 << 53) as f64
}
