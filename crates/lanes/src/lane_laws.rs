//! The law of a phase as the lanes hold it: constants of the equation of motion, of its ends and of error bounds.

use pulp::Simd;

use super::lanes::{Lanes, Mask, Pair};

/// Length of a scan window times the fastest rate of the motion, in rad.
pub(super) const WINDOW_ANGLE: f64 = 1.2;
/// Least share of a window that is decided, after halvings: then the safe engine takes the lane, or a cycle is not proven.
pub(super) const MIN_WINDOW_SHARE: f64 = 1.0 / 512.0;
/// Terms of the power series of the free motion over half a window at most: the first one left out is 0.6^16 / 16! < 2e-17.
pub(super) const FREE_TERMS: usize = 15;

macro_rules! law {
    ($($(#[$doc:meta])* $field:ident,)*) => {
        /// The law of one phase of one machine as numbers: its equation of motion, ends and error bounds.
        #[derive(Debug, Clone, Copy, Default, PartialEq)]
        pub(super) struct PhaseConstants {
            $($(#[$doc])* pub $field: f64,)*
            /// The free motion from (0, 1): position over window as polynomial of time over window, from the linear term on.
            pub response: [f64; FREE_TERMS],
        }

        /// The law of one phase in every lane: [`PhaseConstants`] of the machine of each.
        #[derive(Debug, Clone, Copy)]
        pub(super) struct Laws<S: Simd, const N: usize> {
            $(pub $field: Lanes<S, N>,)*
            pub response: [Lanes<S, N>; FREE_TERMS],
        }

        impl<S: Simd, const N: usize> Laws<S, N> {
            #[inline(always)]
            pub fn new(simd: S) -> Self {
                let none = Lanes::splat(simd, 0.0);
                Self { $($field: none,)* response: [none; FREE_TERMS] }
            }

            #[inline(always)]
            pub fn set(&mut self, lane: usize, constants: &PhaseConstants) {
                $(self.$field.set(lane, constants.$field);)*
                for (lanes, term) in self.response.iter_mut().zip(constants.response) {
                    lanes.set(lane, term);
                }
            }
        }
    };
}

law! {
    /// x'' = damping x' + stiffness (x - static deflection) + drive: minus the damping over the mass, -2 a.
    damping,
    /// Minus the stiffness over the mass, -b.
    stiffness,
    /// Particular solution: offset + side (cosine cos + sine sin); its velocity: side (cosine_rate cos + sine_rate sin).
    offset,
    cosine,
    sine,
    cosine_rate,
    sine_rate,
    /// cos and sin of the drive angle from position and velocity of that solution.
    cosine_of_position,
    cosine_of_velocity,
    sine_of_position,
    sine_of_velocity,
    /// Free motion over one window, and the drive's turn.
    xx,
    xv,
    vx,
    vv,
    turn,
    turn_by_velocity,
    turn_by_position,
    /// Length of a window, and 1/3 and the reciprocal of it.
    window,
    third,
    per_window,
    /// 1 for a phase that not one position alone ends.
    guarded,
    /// The guard of a phase that only one position ends: side (x - offset) rising through edge.
    side,
    edge,
    /// Bound on |x''''| window^4 / 384: steady + |fourth_x y + fourth_v y'| + |fifth_x y + fifth_v y'|.
    steady,
    fourth_x,
    fourth_v,
    fifth_x,
    fifth_v,
    /// The free motion is at most |y| + longest |y'| in the free phase and in one that one position ends, the steady one swing.
    longest,
    swing,
    /// Parts of the bound on |v''''|: rate_steady + |fifth_x y + ...| times bounds + ...
    rate_steady,
    rate_fifth_x,
    rate_fifth_v,
    rate_sixth_x,
    rate_sixth_v,
    /// The phase holds between these positions.
    low,
    high,
    /// A further guard: by_position x + by_velocity v - level rising through zero.
    by_position,
    by_velocity,
    level,
    /// Size of that guard against a position's.
    guard_scale,
    /// Phases beyond the positions high and low and beyond the further guard.
    beyond_high,
    beyond_low,
    beyond_guard,
    /// v+ = bounce v- at high and low: 1, or minus the restitution.
    bounce,
    bounce_low,
    /// 1 where passing high, or low, is an impact.
    impact,
    impact_low,
    /// The one end of a phase that only one position ends: where it is, what lies beyond, and how velocity and impacts change.
    end,
    beyond_end,
    end_bounce,
    end_impact,
    /// The power law beyond the one end: kappa and kappa lambda per mass, the exponent, the velocity below which it does not
    /// grip, and the drive's amplitude and the constant forcing there per mass, away from the end as the velocity. None where the
    /// law is linear.
    press,
    exponent,
    grip,
    slip,
    amplitude,
    forcing,
    /// Positions closer than this to a guard are not decided here, nor velocities below `slow`.
    ambiguity,
    slow,
}

impl<S: Simd, const N: usize> Laws<S, N> {
    /// True where the phase ends as the velocity passes zero, under dry friction: the further guard is the velocity.
    #[inline(always)]
    pub fn ends_at_reversal(&self) -> Mask<S, N> {
        let zero = self.level.like(0.0);
        self.by_position.equals(zero) & self.level.equals(zero)
    }

    /// Value and rate of the phase's further guard (friction, release of contact) at a position, velocity and acceleration.
    #[inline(always)]
    pub fn further_guard(&self, [x, v, a]: [Lanes<S, N>; 3]) -> Pair<S, N> {
        let by_position = self.by_position.mul_add(x, -self.level);
        (
            self.by_velocity.mul_add(v, by_position),
            self.by_velocity.mul_add(a, self.by_position * v),
        )
    }

    /// Upper and lower end of the phase, as side (x - offset); the lower one at minus infinity if one position alone ends it.
    #[inline(always)]
    pub fn edges<const HAS_OTHER_ENDS: bool>(&self) -> Pair<S, N> {
        if HAS_OTHER_ENDS {
            (self.high + self.edge, self.low + self.edge)
        } else {
            (self.edge, self.edge.like(f64::NEG_INFINITY))
        }
    }
}
