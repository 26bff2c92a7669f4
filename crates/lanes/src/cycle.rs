//! One cycle of a motion from impact to impact, linearised, and how far other motions may be from it.
//!
//! [`Cycle::linearise`] gathers the exact derivatives from crossing to crossing; `return_bounds` bounds what they leave out
//! for all motions that begin in a ball about the cycle.

use std::ops::Range;

use nalgebra::{Complex, Matrix2, RowVector2, Vector2};

use super::cycle_state::{CycleState, Derivatives, Forcing, GuardCrossing, Jet};
use super::cycle_windows::CycleWindows;
use super::lane_laws::{MIN_WINDOW_SHARE, PhaseConstants};
use softstop::internals::{Guard, Modes};

/// Most windows into which a cycle is divided for the proof.
const MAX_WINDOWS: usize = 4096;
/// Largest difference between the state at the end of an arc by its linear law and the recorded one, relative to the size of the
/// motion, with which the arc is used.
const MAX_ARC_MISMATCH: f64 = 1e-9;

/// An arc of a trial cycle and the crossing that ends it, linearised. A motion beside the cycle is compared with it at equal
/// times since their own crossings: it deviates by a state, and by a delay of its crossing, which turns the drive.
#[derive(Debug)]
pub(super) struct CycleArc {
    phase: usize,
    /// The cycle at its start and cos + i sin of the drive angle, its length in s, the guards at which it begins and ends.
    start: CycleState,
    angle: Complex<f64>,
    duration: f64,
    entry: Guard,
    exit: Guard,
    modes: Modes,
    /// Range of the windows of the arc among those of the cycle.
    pub windows: Range<usize>,
    /// 2 a and |b| of its law, the amplitudes of the force per mass and of the steady motion.
    pub damping: f64,
    pub stiffness: f64,
    pub force: f64,
    pub swing: f64,
    /// The cycle at its end, and the gradient of the exit over the rate at which the cycle passes it.
    pub end: Jet,
    /// What the state at the end may be off by.
    pub rounding: Vector2<f64>,
    pub gradient: RowVector2<f64>,
    /// Derivative of the state just after a motion's own crossing by that at the end.
    pub reset: Matrix2<f64>,
    /// Derivatives of the state at the end, and of the next return by that state.
    pub at_end: Derivatives,
    pub to_return: Matrix2<f64>,
    /// Derivatives of state and delay at the start by the return that the cycle begins with.
    state: Matrix2<f64>,
    pub delay: RowVector2<f64>,
}

/// A trial cycle from impact to impact, with its derivatives by the return that it begins with: velocity in units of the first
/// return's, drive angle.
#[derive(Debug, Default)]
pub(super) struct Cycle {
    pub arcs: Vec<CycleArc>,
    pub windows: CycleWindows,
    /// Derivative of the next return.
    pub map: Matrix2<f64>,
    /// The drive's frequency.
    pub frequency: f64,
}

impl Cycle {
    /// Linearises the cycle from the impact `from` through all `crossings`, velocities in units of `velocity`: sets the
    /// arcs and the derivative of the next return. None if a law is not linear or a crossing not transversal.
    pub fn linearise(
        &mut self,
        laws: &[PhaseConstants],
        drive: &Forcing,
        (from, crossings): (GuardCrossing, &[GuardCrossing]),
        velocity: f64,
    ) -> Option<()> {
        self.arcs.clear();
        self.windows.clear();
        self.frequency = drive.frequency;
        let mut at = from;
        let mut state = Matrix2::new(0.0, 0.0, velocity, 0.0);
        let mut delay = RowVector2::new(0.0, 1.0 / drive.frequency);
        let mut angle = drive.angle_at(at.offset);
        for crossing in crossings {
            let turned = drive.angle_at(crossing.offset);
            let between = [(&at, angle), (crossing, turned)];
            self.add_arc(&laws[at.phase], drive, between, (&state, &delay))?;
            let arc = self.arcs.last()?;
            angle = turned;
            state = arc.reset * arc.at_end.tangent;
            delay -= arc.gradient * arc.at_end.tangent;
            at = *crossing;
        }
        self.map = Matrix2::from_rows(&[state.row(1) / velocity, delay * drive.frequency]);
        let mut by_state = Matrix2::new(0.0, 1.0 / velocity, 0.0, 0.0);
        let mut by_delay = Vector2::new(0.0, drive.frequency);
        for arc in self.arcs.iter_mut().rev() {
            arc.to_return = by_state * arc.reset - by_delay * arc.gradient;
            by_state = arc.to_return * arc.at_end.transition;
            by_delay += arc.to_return * arc.at_end.response;
        }
        let is_finite = self.map.iter().all(|entry| entry.is_finite());
        (is_finite && !self.arcs.is_empty()).then_some(())
    }

    /// Adds the arc between two crossings, each with cos + i sin of the drive angle then, and the derivatives of state and delay
    /// at its start; none if its law is not linear or the crossing that ends it not transversal.
    fn add_arc(
        &mut self,
        law: &PhaseConstants,
        drive: &Forcing,
        [(from, angle), (to, turned)]: [(&GuardCrossing, Complex<f64>); 2],
        (state, delay): (&Matrix2<f64>, &RowVector2<f64>),
    ) -> Option<()> {
        let duration = (from.left - to.left) * drive.period + (to.offset - from.offset);
        if law.has_power_law() || duration <= 0.0 {
            return None;
        }
        let (kept, velocity) = match to.position {
            x if x == law.high => (law.bounce, to.velocity),
            x if x == law.low => (law.bounce_low, to.velocity),
            _ => (1.0, to.velocity_after),
        };
        let start = law.state_at(drive, (from.position, from.velocity_after), angle);
        let end = law.state_at(drive, (to.position, velocity), turned);
        let modes = Modes::new(-0.5 * law.damping, -law.stiffness);
        let transition = modes.transition(duration);
        let off = (transition * start.free - end.free).abs();
        let size = law.swing + law.offset.abs() + to.position.abs();
        let [_, v, a, _] = end.jet;
        let exit = law.crossed_guard(to);
        let rate = exit.position * v + exit.velocity * a;
        if off.x + off.y * law.window > MAX_ARC_MISMATCH * size || rate <= 0.0 {
            return None;
        }
        let gradient = RowVector2::new(exit.position, exit.velocity) / rate;
        let onto = Matrix2::identity() - Vector2::new(v, a) * gradient;
        let mut arc = CycleArc {
            phase: from.phase,
            start,
            angle,
            duration,
            modes,
            entry: law.crossed_guard(from),
            exit,
            windows: 0..0,
            damping: law.damping.abs(),
            stiffness: law.stiffness.abs(),
            force: law.drive_acceleration(drive.frequency),
            swing: law.swing,
            end: end.jet,
            rounding: off + state_rounding(law, &end, drive.period),
            gradient,
            reset: Matrix2::new(1.0, 0.0, 0.0, kept) * onto,
            at_end: Derivatives::default(),
            to_return: Matrix2::zeros(),
            state: *state,
            delay: *delay,
        };
        arc.at_end = arc.derivatives_at(transition, &end);
        self.arcs.push(arc);
        Some(())
    }

    /// Divides the arcs into windows that show how far other motions may deviate from the cycle without meeting another guard;
    /// none if that takes too many windows.
    pub fn divide_into_windows(&mut self, laws: &[PhaseConstants], drive: &Forcing) -> Option<()> {
        for arc in &mut self.arcs {
            let first = self.windows.all.len();
            arc.divide_arc(&laws[arc.phase], drive, &mut self.windows)?;
            arc.windows = first..self.windows.all.len();
        }
        Some(())
    }
}

/// Bound on the rounding of position and velocity of a cycle: one unit in the last place of each of their terms and of the time.
fn state_rounding(law: &PhaseConstants, place: &CycleState, period: f64) -> Vector2<f64> {
    let [x, v, a, _] = place.jet.map(f64::abs);
    let free = place.free.abs();
    let steady = Vector2::new(law.swing + law.offset.abs(), place.steady_rate.x.abs());
    (Vector2::new(x + v * period, v + a * period) + free + steady) * f64::EPSILON
}

impl CycleArc {
    /// The derivatives of the state at an instant of the arc, by the transition matrix of the free motion up to it.
    fn derivatives_at(&self, transition: Matrix2<f64>, place: &CycleState) -> Derivatives {
        let response = place.steady_rate - transition * self.start.steady_rate;
        Derivatives {
            transition,
            response,
            tangent: transition * self.state + response * self.delay,
        }
    }

    /// Adds the windows of the arc, halved where the cycle is not proven clear of other guards; none if too short or too many.
    fn divide_arc(
        &self,
        law: &PhaseConstants,
        drive: &Forcing,
        windows: &mut CycleWindows,
    ) -> Option<()> {
        // In windows of the scan: longer ones where the spring draws the mass back.
        let longest = if law.stiffness < 0.0 { 2.0 } else { 1.0 };
        let count = (self.duration * law.per_window / longest).ceil();
        let whole = self.duration / count.max(1.0);
        let (mut here, mut transition) = (self.start, Matrix2::identity());
        let (mut angle, mut elapsed, mut step) = (self.angle, 0.0, whole);
        let mut over = self.step_propagators(drive, step);
        while elapsed < self.duration {
            let (free, turn) = over;
            let turned = turn * angle;
            let there = law.state_of(drive, free * here.free, law.steady_state_at(turned));
            let is_last = elapsed + 1.5 * step > self.duration;
            let at_start = self.derivatives_at(transition, &here);
            let entry = (elapsed == 0.0).then_some(self.entry);
            let ends = (entry, is_last.then_some(self.exit));
            if !windows.add_window(law, (&here, &there), step, ends, at_start) {
                step *= 0.5;
                if step < whole * MIN_WINDOW_SHARE {
                    return None;
                }
                over = self.step_propagators(drive, step);
                continue;
            }
            if windows.all.len() > MAX_WINDOWS {
                return None;
            }
            (here, transition, angle) = (there, free * transition, turned);
            elapsed = if is_last {
                self.duration
            } else {
                elapsed + step
            };
        }
        Some(())
    }

    /// Transition matrix of the free motion over a step, and cos + i sin of the angle by which the drive turns in it.
    fn step_propagators(&self, drive: &Forcing, step: f64) -> (Matrix2<f64>, Complex<f64>) {
        let turn = Complex::cis(drive.frequency * step);
        (self.modes.transition(step), turn)
    }
}
