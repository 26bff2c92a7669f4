//! How a motion changes with its start and with any parameters of its machine: exact, also where surfaces and resets change.

use super::phase_derivatives::PhaseDerivatives;
use crate::flow::{ArcSolution, ForceBasis, StateAndSupply};
use crate::integrator::{Arc, Crossing, CrossingKind, Observer};
use crate::phases::{Phase, Phases};

/// The variational equation (Leine and Nijmeijer 2004, ch. 7). Watches a motion under its drive alone, with a strip fed, and gathers its derivatives at fixed drive angles: columns of
/// position in m, of velocity in m/s, as it were with the drive's frequency held, and of the energy in J that the drive
/// has supplied. The first two columns are those by position and velocity at the start, then come the parameters.
#[derive(Debug, Clone)]
pub struct ParameterSensitivity<'a> {
    phases: &'a Phases,
    drive: f64,
    by: &'a [PhaseDerivatives],
    columns: Vec<StateAndSupply>,
    /// Energy in J that the drive has supplied.
    pub supplied: f64,
    /// Cosine of the drive angle at the end of the last arc.
    cos: f64,
    is_known: bool,
}

impl<'a> ParameterSensitivity<'a> {
    /// The sensitivity at the start of a motion of `phases`.
    pub fn new(phases: &'a Phases, by: &'a [PhaseDerivatives]) -> Self {
        let mut columns = vec![StateAndSupply::zeros(); 2 + by.len()];
        (columns[0].x, columns[1].y) = (1.0, 1.0);
        Self {
            phases,
            drive: phases.amplitude * phases.mass,
            by,
            columns,
            supplied: 0.0,
            cos: 1.0,
            is_known: true,
        }
    }

    /// The sensitivity's columns after the arc or crossing told last; none where the motion has no derivatives.
    pub fn columns(&self) -> Option<&[StateAndSupply]> {
        let finite = |column: &StateAndSupply| column.iter().all(|part| part.is_finite());
        (self.is_known && self.columns.iter().all(finite)).then_some(&self.columns)
    }

    /// The columns `elapsed` seconds after the start of an arc that is not told yet, and the energy supplied meanwhile.
    pub fn columns_along(
        &self,
        (course, phase): (&ArcSolution, Option<&Phase>),
        elapsed: f64,
    ) -> Option<(Vec<StateAndSupply>, f64)> {
        let mass = self.phases.mass;
        let Some(phase) = phase else {
            let held = self
                .columns
                .iter()
                .map(|start| StateAndSupply::new(start.x, 0.0, start.z));
            return Some((held.collect(), 0.0));
        };
        let origin = match &phase.hertz {
            Some(hertz) => hertz.origin,
            None => course.departure.position,
        };
        let forces: Vec<_> = self
            .by
            .iter()
            .map(|by| by.sources(phase, mass, self.drive, origin))
            .collect();
        let logarithm = forces
            .iter()
            .any(|forces| forces[ForceBasis::Logarithm as usize] != 0.0);
        let answers = course.parameter_response(elapsed, logarithm)?;
        let columns = self.columns.iter().enumerate().map(|(index, start)| {
            // Energies are in J, answers in m.
            let from = StateAndSupply::new(start.x, start.y, 0.0);
            let mut end = match index.checked_sub(2) {
                None => answers.combined(&from, &[0.0; 9]),
                Some(index) => answers.combined(&from, &forces[index]),
            };
            end.z = start.z + self.drive * end.z;
            if let Some(by) = index.checked_sub(2).map(|index| &self.by[index]) {
                end.z += by.amplitude * answers.travel.0;
                end.z -= self.drive * by.angle * answers.travel.1;
            }
            end
        });
        Some((columns.collect(), self.drive * answers.travel.0))
    }

    /// How much later a crossing of a surface, or a turn under dry friction, happens, in s by each column, before it is told.
    pub fn crossing_delays(&self, crossing: &Crossing) -> Vec<f64> {
        let (v, a) = (crossing.velocity, crossing.acceleration_before);
        let places = self.surface_derivatives(crossing);
        let delay = |(column, (place, _)): (&StateAndSupply, (f64, f64))| match crossing.kind {
            CrossingKind::Surface { .. } | CrossingKind::Rebound { .. } => (place - column.x) / v,
            CrossingKind::Reversal => -column.y / a,
            CrossingKind::Switch | CrossingKind::Rest | CrossingKind::Release => 0.0,
        };
        self.columns.iter().zip(places).map(delay).collect()
    }

    /// Derivatives of position and restitution of the surface that is crossed, by each column.
    fn surface_derivatives(&self, crossing: &Crossing) -> Vec<(f64, f64)> {
        let change = |by: &PhaseDerivatives| by.surface_derivatives(self.phases, crossing.position);
        let starts = [(0.0, 0.0); 2].into_iter();
        starts.chain(self.by.iter().map(change)).collect()
    }
}

impl Observer for ParameterSensitivity<'_> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.cos = arc.drive(elapsed).cos;
        if arc.course.is_chattering() {
            // Known again at rest.
            self.is_known = false;
            return;
        }
        match self.columns_along((arc.course, arc.phase), elapsed) {
            Some((columns, supplied)) => {
                self.columns = columns;
                self.supplied += supplied;
            }
            None => self.columns.fill(StateAndSupply::repeat(f64::NAN)),
        }
    }

    fn crossing(&mut self, crossing: &Crossing) {
        let (v, a) = (crossing.velocity, crossing.acceleration_before);
        let (v_after, a_after) = (crossing.velocity_after, crossing.acceleration_after);
        let forcing = self.drive * self.cos;
        let is_held = v_after == 0.0 && a_after == 0.0;
        let delays = self.crossing_delays(crossing);
        let surfaces = self.surface_derivatives(crossing);
        let columns = self.columns.iter_mut().zip(delays).zip(surfaces);
        for ((column, delay), (place, restitution)) in columns {
            match crossing.kind {
                CrossingKind::Surface { .. }
                | CrossingKind::Rebound { .. }
                | CrossingKind::Rest
                    if is_held =>
                {
                    column.z += forcing * (place - column.x);
                    (column.x, column.y) = (place, 0.0);
                }
                CrossingKind::Surface { .. } => column.y += (a - a_after) * delay,
                CrossingKind::Rebound { .. } => {
                    let kept = v_after / v;
                    column.x += (v - v_after) * delay;
                    column.y = kept * (column.y + a * delay) - restitution * v - a_after * delay;
                    column.z += forcing * (v - v_after) * delay;
                }
                CrossingKind::Reversal => column.y += (a - a_after) * delay,
                CrossingKind::Rest => column.x = f64::NAN,
                CrossingKind::Switch | CrossingKind::Release => {}
            }
        }
        if crossing.kind == CrossingKind::Rest {
            self.is_known = is_held;
        }
    }
}
