//! An observer that records the figures of a motion with their derivatives.

use nalgebra::Vector3;

use softstop::internals::{
    ParameterSensitivity, Phase, PhaseDerivatives, PhaseId, Phases, turning_points,
};
use softstop::{Arc, Clock, Crossing, CrossingKind, Observer, PhaseKind};

use super::differentiated_figure::DifferentiatedFigure;
use super::force_peaks::force_peaks;

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
    pub influence: ParameterSensitivity<'a>,
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
            influence: ParameterSensitivity::new(phases, by),
            watched: RecordedFigures::default(),
            phases,
            by,
            clock,
            phase: None,
            edge: None,
        }
    }

    /// A figure with its derivatives, and how the drive's frequency changes it where the drive angle is held.
    fn figure_row(&self, value: f64, mut by: Vec<f64>, with_time: f64) -> DifferentiatedFigure {
        for (part, by) in by.iter_mut().skip(2).zip(self.by) {
            *part += by.frequency * with_time;
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
        let (stiffness, damping) = contact_slopes(self.phases, phase, x, v);
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
        self.influence.columns().map(<[_]>::to_vec)
    }
}

/// d(contact force)/d(position) in N/m and d(contact force)/d(velocity) in N s/m.
pub(super) fn contact_slopes(phases: &Phases, phase: &Phase, x: f64, v: f64) -> (f64, f64) {
    let (stiffness, damping) = phase.slopes(x, v);
    let free = &phases[PhaseId::FREE].law;
    (stiffness - free.stiffness, damping - free.damping)
}

impl Observer for FigureRecorder<'_> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let along = (arc.course, arc.phase);
        let within = |recorder: &Self, elapsed: f64| {
            Some(recorder.influence.columns_along(along, elapsed)?.0)
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
            for (time, state) in force_peaks(self.phases, phase, arc, elapsed) {
                self.record_force(phase.id, state, |recorder| within(recorder, time), None);
            }
        }
        self.influence.arc(arc, elapsed);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        let (x, v, a) = (
            crossing.position,
            crossing.velocity,
            crossing.acceleration_before,
        );
        let delays = self.influence.crossing_delays(crossing);
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
            let times = self.figure_row(time, delays.clone(), -time);
            let side = 1f64.copysign(v);
            let change = |column: &Vector3<f64>, delay| side * (column.y + a * delay);
            let velocities = self.figure_row(v.abs(), each(&change), v.abs());
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
        self.influence.crossing(crossing);
        self.edge = Some((delays, crossing.acceleration_after));
    }
}
