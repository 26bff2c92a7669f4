//! Work done along an arc: what the drive supplies and what is dissipated.

use crate::integrator::Arc;
use crate::phases::Law;

/// Nodes and weights of the eight-point Gauss rule on [-1, 1] (Abramowitz and Stegun, table 25.4),
/// positive half. Over one Taylor reach its error on the products below is under 1e-17.
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362_0),
    (0.525_532_409_916_329_0, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
];

/// Energies in J that crossed the machine's boundary.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Work {
    /// Work of the drive and the external force.
    pub supplied: f64,
    /// Work lost in dampers, in the strip and in friction.
    pub dissipated: f64,
}

impl std::ops::AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.supplied += other.supplied;
        self.dissipated += other.dissipated;
    }
}

/// Work between `from` and `to` seconds after the start of an arc of a machine with mass `mass`
/// and suspension `free`.
pub fn work(arc: &Arc<'_>, mass: f64, free: &Law, from: f64, to: f64) -> Work {
    let Some(phase) = arc.phase else {
        return Work::default();
    };
    let (course, flow) = (arc.course, &arc.course.flow);
    let panels = ((to - from) / flow.reach.min(flow.window)).ceil().max(1.0);
    let width = (to - from) / panels;
    let mut power_in = 0.0;
    let mut square = 0.0;
    let mut low = course.departure.position;
    if from > 0.0 {
        low = course.node(from).position;
    }
    let mut high = low;
    for panel in 0..panels as u64 {
        let start = from + panel as f64 * width;
        let node = if start == 0.0 {
            course.start()
        } else {
            course.node(start)
        };
        let taylor = course.expand(&node);
        let half = 0.5 * width;
        for (x, weight) in GAUSS {
            for s in [half - half * x, half + half * x] {
                let (_, velocity) = taylor.state(s);
                let push = taylor.push(s) - phase.law.force / mass;
                power_in += weight * half * push * velocity;
                square += weight * half * velocity * velocity;
            }
        }
        high = taylor.state(width).0;
    }
    let force = 0.5 * (phase.law.stiffness - free.stiffness) * (high + low) - phase.law.force;
    let stored = phase.stored_energy(high) - phase.stored_energy(low);
    Work {
        supplied: mass * power_in,
        dissipated: phase.law.damping * square + force * (high - low) - stored,
    }
}
