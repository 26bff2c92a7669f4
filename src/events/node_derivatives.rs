//! Derivatives at a scan node and the bounds that follow from them over the next window.

use super::guard::Guard;
use crate::flow::{ArcSolution, LinearLaw, ScanNode};

/// Time derivatives of position (of order 0 to 6) and forcing (0 to 4) at a scan node.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodeDerivatives {
    pub node: ScanNode,
    position: [f64; 7],
    forcing: [f64; 5],
    /// Amplitude of the drive on the mass, in m/s^2: none while it is held.
    drive: f64,
}

/// 1/n!.
const INVERSE_FACTORIALS: [f64; 6] = [1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0];

impl NodeDerivatives {
    #[inline(always)]
    pub fn new(course: &ArcSolution, node: ScanNode) -> Self {
        let flow = &course.flow;
        let (constant, ramp) = course.linear_forcing_at(node.elapsed);
        let (w, a) = (flow.frequency, flow.amplitude);
        let (cos, sin) = (a * node.drive.cos, a * w * node.drive.sin);
        let square = w * w;
        let forcing = [
            constant + cos,
            ramp - sin,
            -square * cos,
            square * sin,
            square * square * cos,
        ];
        let mut position = [node.position, node.velocity, 0.0, 0.0, 0.0, 0.0, 0.0];
        let held = course.is_held();
        if !held {
            let (twice_decay, b) = (2.0 * flow.modes.decay, flow.modes.stiffness);
            for n in 0..5 {
                let pull = b * position[n];
                position[n + 2] = (forcing[n] - pull) - twice_decay * position[n + 1];
                // From rest the arc starts with the acceleration that its phase was chosen by.
                if n == 0
                    && let Some(chosen) = course.departure.acceleration
                    && node.elapsed == 0.0
                {
                    position[2] = chosen;
                }
            }
        }
        Self {
            node,
            position,
            forcing,
            drive: if held { 0.0 } else { a },
        }
    }

    /// Taylor coefficients of the position about this node in m/s^n.
    pub fn position_series(&self) -> [f64; 6] {
        std::array::from_fn(|n| self.position[n] * INVERSE_FACTORIALS[n])
    }

    /// Taylor coefficients of a guard about this node, which does not depend on the forcing.
    pub fn guard_series(&self, guard: &Guard) -> [f64; 6] {
        let x = &self.position;
        let mut series: [f64; 6] = std::array::from_fn(|n| {
            (guard.position * x[n] + guard.velocity * x[n + 1]) * INVERSE_FACTORIALS[n]
        });
        series[0] -= guard.level;
        series
    }

    /// The rounding that g may carry at this node.
    pub fn guard_rounding(&self, guard: &Guard) -> f64 {
        guard.rounding_at(self.position[0], self.position[1], self.forcing[0])
    }

    /// Value and first time derivative of a guard at this node.
    #[inline(always)]
    pub fn guard_value_and_rate(&self, guard: &Guard) -> (f64, f64) {
        let (x, q) = (&self.position, &self.forcing);
        (
            guard.position * x[0] + guard.velocity * x[1] + guard.forcing * q[0] - guard.level,
            guard.position * x[1] + guard.velocity * x[2] + guard.forcing * q[1],
        )
    }

    /// Bound on the second derivative |g''| of a guard over `span` seconds from this node, `(c, s)` bounding the
    /// fundamental solutions C and S over it. Under heavy damping it is sharper than [`NodeDerivatives::bound_g4`]:
    /// high derivatives drown in the rounding of the damper's force.
    pub fn bound_g2(&self, flow: &LinearLaw, guard: &Guard, span: f64, (c, s): (f64, f64)) -> f64 {
        let x = &self.position;
        let square = flow.frequency * flow.frequency;
        let drive = self.drive * square;
        let second = x[2].abs() * c + x[3].abs() * s + drive * span * s;
        let third = x[3].abs() * c + x[4].abs() * s + drive * flow.frequency * span * s;
        guard.position.abs() * second
            + guard.velocity.abs() * third
            + guard.forcing.abs() * flow.amplitude * square
    }

    /// Bound on the fourth derivative |g''''| of a guard over `span` seconds from this node, `(c, s)` bounding the
    /// fundamental solutions C and S over it.
    ///
    /// The fourth derivative of the position obeys the phase's own equation under the fourth
    /// derivative of the forcing, which is at most A w^4: variation of constants with the bounds on
    /// the fundamental solutions gives |x''''| <= |x4| C + |x5| S + A w^4 span S.
    #[inline(always)]
    pub fn bound_g4(&self, flow: &LinearLaw, guard: &Guard, span: f64, (c, s): (f64, f64)) -> f64 {
        let x = &self.position;
        let square = flow.frequency * flow.frequency;
        let drive = self.drive * square * square;
        let fourth = x[4].abs() * c + x[5].abs() * s + drive * span * s;
        let mut bound =
            guard.position.abs() * fourth + guard.forcing.abs() * flow.amplitude * square * square;
        if guard.velocity != 0.0 {
            let fifth = x[5].abs() * c + x[6].abs() * s + drive * flow.frequency * span * s;
            bound += guard.velocity.abs() * fifth;
        }
        bound
    }

    /// True if the derivatives at this node prove g < 0 for the next `span` seconds, at most a scan window, but at the
    /// node itself if g = 0 there. The guard does not depend on the forcing.
    pub fn stays_below(&self, flow: &LinearLaw, guard: &Guard, span: f64) -> bool {
        let [value, rate, second, third, ..] = self.guard_series(guard);
        let fourth = self.bound_g4(flow, guard, span, flow.window_bounds) / 24.0;
        let bend = span * (second.max(0.0) + span * (third.max(0.0) + span * fourth));
        let steepest = rate + bend;
        if value == 0.0 {
            steepest < 0.0
        } else {
            value + span * steepest.max(0.0) < 0.0
        }
    }
}

/// True if the node derivatives at the departure alone prove that no guard rises up to `until`, at most a scan window later.
pub(crate) fn is_clear_by_start_derivatives(
    course: &ArcSolution,
    guards: &[Guard],
    until: f64,
) -> bool {
    if !course.is_bounded() {
        return false;
    }
    let jets = NodeDerivatives::new(course, course.start_node());
    let stays =
        |guard: &Guard| guard.forcing == 0.0 && jets.stays_below(&course.flow, guard, until);
    guards.iter().all(stays)
}
