//! Figures with their derivatives, and an observer that records those of a motion.

use nalgebra::Vector3;

use crate::tolerance::ROUNDING;
use softstop::internals::{
    ParameterSensitivity, Phase, PhaseDerivatives, PhaseId, Phases, narrow_root, turning_points,
};
use softstop::{Arc, Clock, Crossing, CrossingKind, Observer, PhaseKind};

/// The figures that were recorded, with derivatives by position and velocity at time 0, then by the parameters.
#[derive(Debug, Clone, Default)]
pub(super) struct RecordedFigures {
    /// Times and before-impact velocities of the impacts.
    pub impacts: Vec<[DifferentiatedFigure; 2]>,
    pub highest: Option<DifferentiatedFigure>,
    pub lowest: Option<DifferentiatedFigure>,
    pub force: Option<DifferentiatedFigure>,
}

/// An observer that records impacts, extremes of position and peak force of a motion with their derivatives.
pub(super) struct FigureRecorder<'a> {
    pub sensitivity: ParameterSensitivity<'a>,
    pub watched: RecordedFigures,
    phases: &'a Phases,
    by: &'a [PhaseDerivatives],
    clock: Clock,
    /// The phase of the last arc.
    phase: Option<PhaseId>,
    /// Delays of the last crossing by each unknown, and the acceleration in m/s^2 after it.
    edge: Option<(Vec<f64>, f64)>,
}

impl<'a> FigureRecorder<'a> {
    /// A recorder of the motions through some phases, by parameters with these derivatives of the phases.
    pub fn new(phases: &'a Phases, by: &'a [PhaseDerivatives], clock: Clock) -> Self {
        Self {
            sensitivity: ParameterSensitivity::new(phases, by),
            watched: RecordedFigures::default(),
            phases,
            by,
            clock,
            phase: None,
            edge: None,
        }
    }

    /// A figure with its derivatives: `by` has those at held drive angle, by position, velocity and each parameter; to those of
    /// parameters that change the drive's frequency the share of the frequency is added, `by_log_frequency` its derivative by
    /// the logarithm of that.
    fn add_frequency_change(
        &self,
        value: f64,
        mut by: Vec<f64>,
        by_log_frequency: f64,
    ) -> DifferentiatedFigure {
        for (part, by) in by.iter_mut().skip(2).zip(self.by) {
            *part += by.frequency * by_log_frequency;
        }
        DifferentiatedFigure { value, by }
    }

    /// Records a position if it is the highest or the lowest so far, with its derivatives.
    fn record_position(&mut self, value: f64, by: impl FnOnce(&Self) -> Option<Vec<f64>>) {
        let beats = |known: &Option<DifferentiatedFigure>, sign: f64| {
            known
                .as_ref()
                .is_none_or(|known| sign * (value - known.value) > 0.0)
        };
        let (high, low) = (
            beats(&self.watched.highest, 1.0),
            beats(&self.watched.lowest, -1.0),
        );
        if !(high || low) {
            return;
        }
        let by = by(self).unwrap_or_else(|| vec![f64::NAN; 2 + self.by.len()]);
        let row = DifferentiatedFigure { value, by };
        if high {
            self.watched.highest = Some(row.clone());
        }
        if low {
            self.watched.lowest = Some(row);
        }
    }

    /// Records the contact force in a phase at (position, velocity, acceleration), if it is the largest so far.
    fn record_force(
        &mut self,
        phase: PhaseId,
        [x, v, a]: [f64; 3],
        columns: impl FnOnce(&Self) -> Option<Vec<Vector3<f64>>>,
        delays: Option<&[f64]>,
    ) {
        let phase = &self.phases[phase];
        let value = phase.side * phase.contact_force(x, v);
        let known = self.watched.force.as_ref();
        if known.is_some_and(|known| known.value >= value) {
            return;
        }
        let (stiffness, damping) = phase.contact_derivatives(x, v);
        let missing = || vec![Vector3::repeat(f64::NAN); 2 + self.by.len()];
        let columns = columns(self).unwrap_or_else(missing);
        let parts = columns.iter().enumerate().map(|(index, column)| {
            let delay = delays.map_or(0.0, |delays| delays[index]);
            let own = index
                .checked_sub(2)
                .map_or(0.0, |index| self.by[index].contact_force(phase, x, v));
            let change =
                stiffness * (column.x + v * delay) + damping * (column.y + a * delay) + own;
            phase.side * change
        });
        let row = DifferentiatedFigure {
            value,
            by: parts.collect(),
        };
        self.watched.force = Some(row);
    }

    /// The columns of the sensitivity matrix at present, if they are known.
    fn sensitivity_columns(&self) -> Option<Vec<Vector3<f64>>> {
        self.sensitivity.columns().map(<[_]>::to_vec)
    }
}

impl Observer for FigureRecorder<'_> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let along = (arc.course, arc.phase);
        let within = |recorder: &Self, elapsed: f64| {
            Some(recorder.sensitivity.columns_along(along, elapsed)?.0)
        };
        let back = arc.course.departure.velocity > 0.0;
        for turn in turning_points(arc.course, elapsed, back) {
            self.record_position(turn.position, |recorder| {
                let columns = within(recorder, turn.elapsed)?;
                Some(columns.iter().map(|column| column.x).collect())
            });
        }
        let edge = self.edge.take();
        self.phase = arc.phase.map(|phase| phase.id);
        if let Some(phase) = arc.phase.filter(|phase| phase.kind != PhaseKind::Free) {
            if let Some((delays, a)) = &edge {
                let from = &arc.course.departure;
                let state = [from.position, from.velocity, *a];
                self.record_force(phase.id, state, Self::sensitivity_columns, Some(delays));
            }
            for (time, state) in contact_force_peaks(self.phases, phase, arc, elapsed) {
                self.record_force(phase.id, state, |recorder| within(recorder, time), None);
            }
        }
        self.sensitivity.arc(arc, elapsed);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        let (x, v, a) = (
            crossing.position,
            crossing.velocity,
            crossing.acceleration_before,
        );
        let delays = self.sensitivity.crossing_delays(crossing);
        let columns = self.sensitivity_columns();
        let each = |part: &dyn Fn(&Vector3<f64>, f64) -> f64| match &columns {
            Some(columns) => columns
                .iter()
                .zip(&delays)
                .map(|(c, d)| part(c, *d))
                .collect(),
            None => vec![f64::NAN; delays.len()],
        };
        if crossing.kind.is_impact() {
            let time = self.clock.time(crossing.instant);
            let times = self.add_frequency_change(time, delays.clone(), -time);
            let side = 1f64.copysign(v);
            let change = |column: &Vector3<f64>, delay| side * (column.y + a * delay);
            let velocities = self.add_frequency_change(v.abs(), each(&change), v.abs());
            self.watched.impacts.push([times, velocities]);
        }
        let turns = match crossing.kind {
            CrossingKind::Rebound { .. } | CrossingKind::Reversal => true,
            CrossingKind::Surface { .. } => crossing.velocity_after == 0.0,
            CrossingKind::Switch | CrossingKind::Rest | CrossingKind::Release => false,
        };
        if turns {
            let by = each(&|column, delay| column.x + v * delay);
            self.record_position(x, |_| Some(by));
        }
        if let Some(phase) = self.phase.take().filter(|phase| *phase != PhaseId::FREE) {
            let known = columns.clone();
            self.record_force(phase, [x, v, a], |_| known, Some(&delays));
        }
        self.sensitivity.crossing(crossing);
        self.edge = Some((delays, crossing.acceleration_after));
    }
}

/// Pieces of an arc in which force peaks are looked for: for each rad of the fastest rate, at least and at most.
const PEAK_PIECES: (f64, f64, f64) = (2.0, 4.0, 4096.0);

/// The peaks of the contact force on an arc: times in s since its start, with position, velocity and acceleration.
pub(super) fn contact_force_peaks<'a>(
    phases: &'a Phases,
    phase: &'a Phase,
    arc: &'a Arc<'_>,
    elapsed: f64,
) -> impl Iterator<Item = (f64, [f64; 3])> + 'a {
    let state = move |time: f64| {
        let at = arc.at(time);
        let forcing = phases.amplitude * arc.drive(time).cos;
        let (x, v) = (at.position, at.velocity);
        [x, v, phases.acceleration(phase.id, x, v, forcing)]
    };
    let rate = move |time: f64| {
        let [x, v, a] = state(time);
        let (stiffness, damping) = phase.contact_derivatives(x, v);
        phase.side * (stiffness * v + damping * a)
    };
    let (each, least, most) = PEAK_PIECES;
    let fastest = phase.flow.modes.fastest_rate().max(phases.frequency);
    let pieces = (each * fastest * elapsed).ceil().clamp(least, most);
    let piece = elapsed / pieces;
    let mut before = rate(0.0);
    (1..=pieces as u32).filter_map(move |index| {
        let time = piece * f64::from(index);
        let here = rate(time);
        let last = std::mem::replace(&mut before, here);
        if !(last > 0.0 && here <= 0.0) {
            return None;
        }
        let ends = ((time - piece, last), (time, here));
        let found = narrow_root(ends.0, ends.1, ROUNDING * piece, |time| {
            Ok::<_, ()>(rate(time))
        });
        let (low, high) = found.ok()?;
        let time = low.midpoint(high);
        Some((time, state(time)))
    })
}

/// A figure of a motion with its derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct DifferentiatedFigure {
    /// The figure.
    pub value: f64,
    /// Its derivatives in SI units, in the order of [`OrbitDerivatives::parameters`](super::OrbitDerivatives).
    pub by: Vec<f64>,
}

/// An impact of a motion, time and velocity with their derivatives.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DifferentiatedImpact {
    /// Time in s.
    pub time: DifferentiatedFigure,
    /// Before-impact velocity in m/s.
    pub velocity: DifferentiatedFigure,
}
