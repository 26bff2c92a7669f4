//! Where starts lie.

use serde::{Deserialize, Serialize};

use crate::extremes::extremes;
use crate::points::scramble;
use softstop::internals::Scales;
use softstop::{Dimension, Machine, Scene, Start};

/// A rectangle of states at drive angle phi.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Least and largest position in m.
    pub position: [f64; 2],
    /// Least and largest velocity in m/s.
    pub velocity: [f64; 2],
}

/// Half-size of the pilot's region, in units of the motion's length (and of w times it).
const FAR: f64 = 3.0;
/// What is added on each side of the region in which motions stay, as a share of it.
const MARGIN: f64 = 0.5;
/// Least half-size of a region, in units of the motion's length.
const LEAST_HALF_SIZE: f64 = 0.1;
/// Half-size of the box of all starts, at least, in units of the motion's length (and of w times it).
const WIDE: f64 = 2.0;
/// How much wider it is than the motions in it.
const ROOM: f64 = 1.5;
/// 1/g and 1/g^2 with g^3 = g + 1: of all pairs the one whose multiples fill a square most evenly
/// (Roberts 2018).
const SEQUENCE_STEPS: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_3];

impl Region {
    /// Far and wide about the origin.
    pub(super) fn far(scene: &Scene) -> Self {
        let Scales { length, rate } = scene.motion_scales();
        let (x, v) = (FAR * length, FAR * rate * length);
        Self {
            position: [-x, x],
            velocity: [-v, v],
        }
        .before(scene)
    }

    /// About all these states; none if there is none.
    pub(super) fn about<'a>(
        scene: &Scene,
        states: impl Iterator<Item = &'a Start> + Clone,
    ) -> Option<Self> {
        let position = extremes(states.clone().map(|state| state.position))?;
        let velocity = extremes(states.map(|state| state.velocity))?;
        let Scales { length, rate } = scene.motion_scales();
        let widen = |[low, high]: [f64; 2], least: f64| {
            let margin = (MARGIN * (high - low)).max(least);
            [low - margin, high + margin]
        };
        let region = Self {
            position: widen(position, LEAST_HALF_SIZE * length),
            velocity: widen(velocity, LEAST_HALF_SIZE * rate * length),
        };
        position[0].is_finite().then(|| region.before(scene))
    }

    /// The box that commands take starts from: twice the motion's length both ways, and more where these states need
    /// more.
    pub(crate) fn box_with(scene: &Scene, states: impl IntoIterator<Item = Start>) -> Self {
        let Scales { length, rate } = scene.motion_scales();
        let length = WIDE * length;
        let half = states
            .into_iter()
            .fold((length, length * rate), |(x, v), state| {
                let (far, fast) = (state.position.abs(), state.velocity.abs());
                match (far + fast).is_finite() {
                    true => (x.max(ROOM * far), v.max(ROOM * fast)),
                    false => (x, v),
                }
            });
        Self {
            position: [-half.0, half.0],
            velocity: [-half.1, half.1],
        }
        .before(scene)
    }

    /// The box, and if states lie outside it a wider one that holds them with the same room.
    pub(crate) fn holding(&self, scene: &Scene, states: &[Start]) -> Self {
        match states.iter().all(|state| self.holds(state)) {
            true => *self,
            false => self.with(&Self::box_with(scene, states.iter().copied())),
        }
    }

    /// Whether a state lies in it.
    fn holds(&self, state: &Start) -> bool {
        let within = |[low, high]: [f64; 2], value: f64| (low..=high).contains(&value);
        within(self.position, state.position) && within(self.velocity, state.velocity)
    }

    /// The smallest that holds both.
    pub fn with(&self, other: &Self) -> Self {
        let both = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        Self {
            position: both(self.position, other.position),
            velocity: both(self.velocity, other.velocity),
        }
    }

    /// In words, in a machine's own units.
    pub fn told(&self, machine: &Machine) -> String {
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

    /// The part before rigid stops; the region moved there if no part of it is.
    pub fn before(mut self, scene: &Scene) -> Self {
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

    /// Quasi-random starts.
    pub(crate) fn starts(&self, count: usize, seed: u64) -> Vec<Start> {
        let shifts = [share(seed), share(!seed)];
        let within = |[low, high]: [f64; 2], share: f64| low + share * (high - low);
        let start = |index| {
            let [across, up] = evenly(shifts, index);
            Start::new(within(self.position, across), within(self.velocity, up))
        };
        (0..count).map(start).collect()
    }
}

/// Places in the unit square, counted from 0: however many there are, they fill it evenly.
pub fn evenly(shifts: [f64; 2], index: usize) -> [f64; 2] {
    std::array::from_fn(|axis| (shifts[axis] + SEQUENCE_STEPS[axis] * (index + 1) as f64).fract())
}

/// A number in 0..1 from a seed.
fn share(seed: u64) -> f64 {
    (scramble(seed) >> 11) as f64 / (1u64 << 53) as f64
}
