//! Lanes in contact under a power law, from step to step up to where they leave it.
//!
//! For n = 3/2 a contact takes 12 steps of degree 25, each of 3.5 products of series: in 16 lanes 2,100 multiplications of
//! registers in 3,900 cycles, while 11.5 of the lanes are in contact.
//!
//! Microseconds of a drive period on one core, in lanes and in the safe engine (k = 150, eta 1.15, clearance 10, 50 periods with
//! 0.24 to 0.27 contacts each; with a linear stop 0.025 and 0.25):
//!
//! | n | lambda = 0 | lambda = 0.05 |
//! |---|---|---|
//! | 3/2 | 0.32, 2.65 | 0.54, 3.31 |
//! | 2 | 0.43, 1.24 | 0.66, 1.60 |
//! | 5/2 | 0.45, 3.35 | 0.71, 3.81 |

use pulp::Simd;

use super::contact_series::ContactSeries;
use super::contact_state::ContactState;
use super::engine::Engine;
use super::lane_laws::Laws;
use super::lanes::{Lanes, Mask};
use super::move_lanes::LaneEnd;

/// How many eighths of the busy lanes have to be in power-law contact before these are moved; until then they wait.
const MIN_EIGHTHS_IN_CONTACT: usize = 7;
/// Most rounds over all phases for which lanes in contact wait for others.
const MAX_ROUNDS_WAITED: usize = 6;
/// Most Taylor steps with which a contact is followed in one round over all phases; contacts of which these steps cover less than
/// a sixteenth of a drive period go to the safe engine.
const MAX_STEPS_PER_ROUND: usize = 64;

/// Where the lanes have come to in one power-law contact, and which of them go on, have left contact, have arrived at the end of
/// their time, or are left to the safe engine.
struct ContactPath<S: Simd, const N: usize> {
    place: ContactState<S, N>,
    /// Length of the last step, in the regularised time sigma.
    step: Lanes<S, N>,
    going: Mask<S, N>,
    left: Mask<S, N>,
    arrived: Mask<S, N>,
    doubtful: Mask<S, N>,
}

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// Follows the lanes of `active` that are in power-law contact through it, once most busy lanes are in contact; returns the
    /// lanes of `active` that are not in contact.
    #[inline(always)]
    pub fn advance_contacts(&mut self, phase: usize, active: Mask<S, N>) -> Mask<S, N> {
        let press = self.laws[phase].press;
        let pressed = active & press.like(0.0).below(press);
        let count = pressed.count();
        if count == 0 {
            return active;
        }
        if 8 * count >= MIN_EIGHTHS_IN_CONTACT * self.state.busy_lanes().count()
            || self.waited >= MAX_ROUNDS_WAITED
        {
            self.waited = 0;
            let (ended, doubtful) = self.step_through_contact(phase, pressed, self.time_to_stop());
            if (ended | doubtful).any() {
                self.serve_lanes(ended, doubtful);
            }
        } else {
            self.waited += 1;
        }
        active.and_not(pressed)
    }

    /// Moves the lanes `active`, which are in contact, to its end or for the time `due`. Returns the lanes that came to the end
    /// of their job, and those that the safe engine has to take.
    #[inline(always)]
    fn step_through_contact(
        &mut self,
        phase: usize,
        active: Mask<S, N>,
        due: Lanes<S, N>,
    ) -> (Mask<S, N>, Mask<S, N>) {
        let Some(power) = &mut self.power else {
            return (active, active);
        };
        let law = &self.laws[phase];
        let frequency = self.state.drive.frequency;
        let period = self.state.drive.period;
        let zero = due.like(0.0);
        let root = (law.side * (self.state.x - law.end))
            .max(zero)
            .square_root();
        let place = ContactState {
            root,
            velocity: law.side * self.state.v,
            angle: self.state.angle,
            time: zero,
        };
        let moves = zero.below(root) | zero.below(place.velocity);
        let mut path = ContactPath {
            place,
            step: place.longest_step(law),
            going: active & moves,
            left: active.and_not(active),
            arrived: active.and_not(active),
            doubtful: active.and_not(moves),
        };
        let mut steps = 0;
        while path.going.any() && steps < MAX_STEPS_PER_ROUND {
            power.expand(law, frequency, &path.place);
            path.step(law, power, due, period * due.like(1e-12));
            steps += 1;
        }
        let slow = path.going & path.place.time.below(period * due.like(1.0 / 16.0));
        let (left, arrived) = (path.left, path.arrived);
        let doubtful = path.doubtful | slow;
        let place = path.place;
        let x = (law.side * place.root).mul_add(place.root, law.end);
        let v = law.side * place.velocity;
        let end = LaneEnd {
            x: left.choose(law.end, x),
            v,
            beyond: law.beyond_end,
            impact: zero,
            before: v,
        };
        let moved = active & zero.below(place.time);
        self.move_lanes((moved, left), &end, place.angle, place.time);
        (self.end_periods(arrived), doubtful)
    }
}

impl<S: Simd, const N: usize> ContactPath<S, N> {
    /// Makes one Taylor step of the lanes that go on, cut at the release or at the time `due`; a release within `bridged` of
    /// `due` is too close to tell which comes first.
    #[inline(always)]
    fn step(
        &mut self,
        law: &Laws<S, N>,
        power: &ContactSeries<S, N>,
        due: Lanes<S, N>,
        bridged: Lanes<S, N>,
    ) {
        let zero = due.like(0.0);
        let (reach, of) = power.step_length(self.step, self.going);
        self.step = reach;
        let sigma = reach.min(self.place.longest_step(law));
        let release = power.find_release(sigma, of);
        let mut next = power.state_at(&self.place, release.sigma);
        self.doubtful = self.doubtful | of.and_not(release.decided);
        if zero.below(law.grip).any() {
            let slips = of.and_not(power.stays_faster(law.slip, release.sigma));
            self.doubtful = self.doubtful | slips;
        }
        let mut leaves = release.leaves;
        let late = of & release.decided & next.time.below(due).not();
        let near = leaves & (next.time - due).abs().below(bridged);
        self.doubtful = self.doubtful | near;
        let late = late.and_not(near);
        if late.any() {
            let (rest, whole) = (due - self.place.time, next.time - self.place.time);
            let (sigma, found) = power.sigma_at_time(rest, (release.sigma, whole), late);
            let mut there = power.state_at(&self.place, sigma);
            there.time = due;
            next = ContactState::choose(late, &there, &next);
            self.doubtful = self.doubtful | late.and_not(found);
            self.arrived = self.arrived | (late & found);
            leaves = leaves.and_not(late);
        }
        let moved = (of & release.decided).and_not(self.doubtful);
        self.left = self.left | (leaves & moved);
        self.place = ContactState::choose(moved, &next, &self.place);
        self.going = self.going.and_not(self.left | self.arrived | self.doubtful);
    }
}
