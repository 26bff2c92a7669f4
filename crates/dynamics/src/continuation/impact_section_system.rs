//! Special orbits seen from a surface: grazing orbits, and folds and flips with their slowest impact as the section.
//!
//! In the state at a fixed drive angle a weak impact has a square root: near grazing the map over whole periods has a
//! derivative without bounds (saltation with 1/v), and a curve of folds or flips that comes near to grazing asks for ever
//! shorter steps. In the drive angle and the before-impact velocity v of that impact the orbit, taken back to the surface as if
//! it were not there, is smooth down to v = 0, and so is v tr M, whose limit vanishes at resonant grazing alone: where grazing
//! meets folds and flips (Nordmark 2001; Simpson and Ghosh, arXiv 2602.22797). The orbit that just touches solves a regular
//! system, too: from rest at the surface at a drive angle, over whole periods back to it. (Arclength and Newton near
//! grazing: arXiv 2506.18379, arXiv 2510.16218.)

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector, Matrix2, Vector2};

use super::end_derivatives::end_derivatives;
use super::equations::{CurveNode, Equations, Evaluation};
use super::impact_section_orbit::{ImpactSectionOrbit, NO_CROSSING};
use super::newton_corrector::correct;
use super::period_map::{advance_over_periods, half_way_instant, state_after_periods};
use super::stroboscopic_shooting::residual_rounding;
use super::symmetric_orbits::is_symmetric;
use super::{Family, GrazingTouch, LastArc, SwitchingSurface, TestFunction};
use crate::orbit::{Monodromy, OrbitError};
use crate::record_trajectory::record_trajectory;
use softstop::internals::Phase;
use softstop::{CheckedScene, Clock, CrossingKind, MotionError, Scene, Trajectory};

/// What an orbit does at its impact section, and what vanishes on it besides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SectionCondition {
    /// It touches the surface: a grazing orbit.
    Touch,
    /// It touches the surface, and the mass comes back to it at all velocities alike, so that a weak impact has no bearing on
    /// the next: in the linear machine at frequencies 2 `omega_d` n / k.
    ResonantTouch,
    /// It hits the surface, with its slowest impact, and a test vanishes.
    Impact(TestFunction),
}

/// Orbits of a family that fulfil a condition at an impact section, the surface at which they begin and end, in unknowns: drive
/// angle there, scaled velocity of an impact, scaled parameters.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ImpactSectionSystem<'a, const N: usize> {
    pub family: &'a dyn Family<N>,
    pub periods: u64,
    /// Crossings of an orbit between its begin and its last arc, a touch left out.
    crossings: usize,
    /// The surface.
    pub surface: SwitchingSurface,
    /// True of orbits that are their own mirror images: they come back to the mirror image of the surface after half of their
    /// periods.
    is_symmetric: bool,
    pub condition: SectionCondition,
}

impl<'a, const N: usize> ImpactSectionSystem<'a, N> {
    /// The grazing orbits of a family over a number of drive periods that touch as another one does.
    pub fn of_graze(graze: &GrazingTouch, (family, periods): (&'a dyn Family<N>, u64)) -> Self {
        Self {
            family,
            periods,
            crossings: match graze.is_symmetric {
                true => graze.crossings / 2,
                false => graze.crossings,
            },
            surface: graze.surface,
            is_symmetric: graze.is_symmetric,
            condition: SectionCondition::Touch,
        }
    }

    /// The system of a test and its unknowns at an orbit; none if its slowest entry is none into a rigid or preloaded stop.
    pub fn at_orbit(
        (family, periods): (&'a dyn Family<N>, u64),
        test: TestFunction,
        state: Vector2<f64>,
        parameters: [f64; N],
    ) -> Result<Option<(Self, DVector<f64>)>, MotionError> {
        let scene = family.scene(parameters)?;
        let end = Clock::at_cycle(periods);
        let motion = record_trajectory(&scene, state, |motion, kept| {
            advance_over_periods(motion, end, kept)
        })?;
        let entries = motion.crossings().filter(|it| {
            let enters = matches!(it.kind, CrossingKind::Surface { forward: true, .. });
            enters || matches!(it.kind, CrossingKind::Rebound { .. })
        });
        let slowest = entries.min_by(|a, b| a.velocity.abs().total_cmp(&b.velocity.abs()));
        let Some(entry) = slowest.filter(|_| motion.rests().next().is_none()) else {
            return Ok(None);
        };
        let surface = SwitchingSurface::at_position(&scene, entry.position);
        let Some(surface) = surface.filter(|surface| surface.has_square_root(&scene)) else {
            return Ok(None);
        };
        let is_told = matches!(entry.kind, CrossingKind::Rebound { .. });
        let system = Self {
            family,
            periods,
            crossings: motion.crossings().count() - usize::from(!is_told),
            surface,
            is_symmetric: false,
            condition: SectionCondition::Impact(test),
        };
        let time = motion.clock.time(entry.instant);
        let angle = scene.excitation.reduced_phase() + scene.excitation.frequency * time;
        let [_, speed] = family.state_scales();
        let guess = system.scaled_unknowns(&[angle, entry.velocity.abs() / speed], parameters);
        Ok(Some((system, guess)))
    }

    /// The system of the orbits with one crossing more and a vanishing `test`, and its node at an impact of this velocity, in
    /// units of the family's scales: what a grazing orbit, at `touch`, becomes beyond the grazing.
    ///
    /// # Errors
    /// [`OrbitError::NotIsolated`] for symmetric orbits, which gain two impacts.
    pub fn with_weak_impact(
        &self,
        touch: &DVector<f64>,
        test: TestFunction,
        velocity: f64,
    ) -> Result<(Self, CurveNode<ImpactSectionOrbit>), OrbitError> {
        if self.is_symmetric {
            return Err(OrbitError::NotIsolated);
        }
        let critical = Self {
            crossings: self.crossings + 1,
            condition: SectionCondition::Impact(test),
            ..*self
        };
        let guess = touch.clone().insert_row(1, velocity);
        let given = DVector::from_fn(guess.len(), |row, _| f64::from(u8::from(row == 1)));
        let node = correct(&critical, &guess, Some(&given))?;
        Ok((critical, node))
    }

    /// The system of the resonant grazing, where the weak impact of orbits with a vanishing test becomes a touch, and a guess of its
    /// unknowns from those of such an orbit.
    pub fn resonant_grazing_system(&self, at: &DVector<f64>) -> (Self, DVector<f64>) {
        let system = Self {
            crossings: self.crossings - 1,
            condition: SectionCondition::ResonantTouch,
            ..*self
        };
        (system, at.clone().remove_row(1))
    }

    /// The test that vanishes on orbits with an impact.
    pub fn critical_test(&self) -> Option<TestFunction> {
        match self.condition {
            SectionCondition::Impact(test) => Some(test),
            SectionCondition::Touch | SectionCondition::ResonantTouch => None,
        }
    }

    /// Velocity in m/s at the section, upwards; 0 of a touch.
    fn velocity(&self, at: &DVector<f64>) -> f64 {
        let [_, speed] = self.family.state_scales();
        match (self.critical_test(), self.surface) {
            (None, _) => 0.0,
            (_, SwitchingSurface::Below) => -at[1] * speed,
            _ => at[1] * speed,
        }
    }

    /// Unknowns of an orbit at the section: its drive angle and what else it has there, then the parameters, scaled.
    pub fn scaled_unknowns(&self, places: &[f64], parameters: [f64; N]) -> DVector<f64> {
        let scaled = self.family.scaled_parameters(parameters);
        DVector::from_iterator(places.len() + N, places.iter().copied().chain(scaled))
    }

    /// The parameters of these unknowns of the system, which are the last of them.
    pub fn parameters(&self, at: &DVector<f64>) -> [f64; N] {
        self.family.unscaled_parameters(at.as_slice())
    }

    /// The scene with time 0 at the section, where the drive has this angle, and the position of the surface.
    pub fn scene_at(
        &self,
        angle: f64,
        parameters: [f64; N],
    ) -> Result<(CheckedScene, f64), OrbitError> {
        let scene = self.family.scene(parameters)?.at_phase(angle)?;
        if self.is_symmetric && !is_symmetric(&scene) {
            return Err(OrbitError::NotAlike);
        }
        let position = self.surface.surface_position(&scene).ok_or(NO_CROSSING)?;
        Ok((scene, position))
    }

    /// The state of the orbit at time 0 of the family's scene.
    pub fn state(&self, at: &DVector<f64>) -> Result<Vector2<f64>, OrbitError> {
        let (angle, parameters) = (at[0], self.parameters(at));
        let phase = self.family.scene(parameters)?.excitation.reduced_phase();
        let (scene, position) = self.scene_at(angle, parameters)?;
        let gone = ((angle - phase) / TAU).rem_euclid(self.periods as f64);
        let begin = Vector2::new(position, self.velocity(at));
        let (left, half) = (self.periods as f64 - gone, 0.5 * self.periods as f64);
        Ok(match self.is_symmetric && left > half {
            true => -state_after_periods(&scene, begin, left - half)?,
            false => state_after_periods(&scene, begin, left)?,
        })
    }

    /// How far the end of the way around is from its start, or from the mirror image of that, scaled; of changes of both as well.
    pub fn scaled_drift(&self, start: Vector2<f64>, end: Vector2<f64>) -> Vector2<f64> {
        let side = if self.is_symmetric { -1.0 } else { 1.0 };
        let scales = Vector2::from(self.family.state_scales());
        (side * end - start).component_div(&scales)
    }

    /// The grazing touch of the orbit at a node: drive angle, surface, numbers of impacts and crossings. Its crossing is taken for
    /// one that dies beyond the grazing.
    pub fn grazing_touch_at(&self, node: &CurveNode<ImpactSectionOrbit>) -> GrazingTouch {
        GrazingTouch {
            angle: node.at[0],
            impacts: node.here.point.impacts.len(),
            dies: true,
            surface: self.surface,
            crossings: match self.is_symmetric {
                true => 2 * self.crossings,
                false => self.crossings,
            },
            is_symmetric: self.is_symmetric,
        }
    }

    /// The orbit around from the section, how far it is off when it comes back, scaled, its scene, and where it begins.
    fn carry_to_section(
        &self,
        at: &DVector<f64>,
    ) -> Result<(Vector2<f64>, LastArc, CheckedScene, Vector2<f64>), OrbitError> {
        let (scene, position) = self.scene_at(at[0], self.parameters(at))?;
        let begin = Vector2::new(position, self.velocity(at));
        let until = match self.is_symmetric {
            true => half_way_instant(&scene, self.periods),
            false => Clock::at_cycle(self.periods),
        };
        let around = LastArc::carry_past(&scene, begin, (self.crossings, until))?;
        let drift = self.scaled_drift(begin, around.motion.end.into());
        Ok((drift, around, scene, begin))
    }
}

impl<const N: usize> Equations for ImpactSectionSystem<'_, N> {
    type Point = ImpactSectionOrbit;

    fn evaluate(&self, at: &DVector<f64>) -> Result<Evaluation<ImpactSectionOrbit>, OrbitError> {
        let test = self.critical_test();
        if test.is_some() && at[1] <= 0.0 {
            let residual = f64::INFINITY;
            return Err(OrbitError::Diverged { residual });
        }
        let (drift, around, scene, begin) = self.carry_to_section(at)?;
        let tangent = around.motion.tangent();
        let entry = test.and_then(|_| entry_jump(&around.motion, &scene, begin));
        let is_impact = entry.is_some() && self.surface.is_clearance();
        let told = around.motion.impacts();
        let told = told.map(|it| it.before_impact_velocity);
        let own = is_impact.then_some(begin.y.abs()).into_iter();
        let mut impacts: Vec<f64> = own.chain(told).collect();
        let mut parts = vec![
            Monodromy::with_determinant(entry.unwrap_or_else(Matrix2::identity), 1.0),
            Monodromy::from(&tangent),
        ];
        if self.is_symmetric {
            // The way back is the mirror image of the way there.
            impacts.extend_from_within(..);
            parts.extend_from_within(..);
        }
        let sizes = self.family.state_scales();
        let orbit = Evaluation {
            residual: DVector::from_column_slice(drift.as_slice()),
            tolerance: residual_rounding(&scene, &begin, &Monodromy::from(&tangent), sizes),
            point: ImpactSectionOrbit {
                place: at.clone(),
                motion: around.motion.into(),
                monodromy: Monodromy::product(&parts),
                impacts,
                response: tangent.matrix.m12 * sizes[1] / sizes[0],
                is_cut: around.is_cut,
            },
        };
        let value = match self.condition {
            SectionCondition::Touch => return Ok(orbit),
            SectionCondition::ResonantTouch => orbit.point.response,
            SectionCondition::Impact(test) => test.weighted_value(&orbit.point.monodromy, at[1]),
        };
        Ok(orbit.with_test(value))
    }

    fn variational_columns(&self, here: &Evaluation<ImpactSectionOrbit>) -> Option<DMatrix<f64>> {
        if self.condition != SectionCondition::Touch {
            return None;
        }
        let ImpactSectionOrbit { place, motion, .. } = &here.point;
        let scene_at = |place: &DVector<f64>| {
            let parameters = self.parameters(place);
            Some(self.scene_at(place[0], parameters).ok()?.0)
        };
        let position = self.surface.surface_position(&motion.scene)?;
        let orbit = (&**motion, Vector2::new(position, 0.0), true);
        let ends = end_derivatives(orbit, (place, 0..place.len()), scene_at)?;
        let drifts = ends
            .into_iter()
            .map(|(end, begin)| self.scaled_drift(Vector2::new(begin, 0.0), end));
        let drifts: Vec<_> = drifts.collect();
        Some(DMatrix::from_fn(2, drifts.len(), |row, column| {
            drifts[column][row]
        }))
    }
}

/// The saltation matrix of the entry from the last law of a motion that is taken on to where it began into the first,
/// which the motion does not tell; none at a rigid stop, whose rebound it tells. Both have the drive's force, so that
/// plays no part in the jump.
fn entry_jump(motion: &Trajectory, scene: &Scene, begin: Vector2<f64>) -> Option<Matrix2<f64>> {
    let (lowest, highest) = scene.reach();
    if begin.x == lowest || begin.x == highest {
        return None;
    }
    let acceleration = |phase: &Phase| phase.acceleration(begin.x, begin.y, 0.0, scene.mass);
    let first = motion.arc_views().find_map(|(arc, _)| arc.phase)?;
    let last = motion.arc_views().last()?.0.phase?;
    let jump = acceleration(first) - acceleration(last);
    Some(Matrix2::new(1.0, 0.0, jump / begin.y, 1.0))
}
