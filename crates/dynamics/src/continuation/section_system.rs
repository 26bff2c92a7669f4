//! Special orbits seen from a surface: grazing orbits, and folds and flips with their slowest impact as the section.
//!
//! In the state at a fixed drive angle a weak impact has a square root: near grazing the map over whole periods has a
//! derivative without bounds (saltation with 1/v), and a curve of folds or flips that comes near to grazing asks for ever
//! shorter steps. In the drive angle and the before-impact velocity v of that impact the orbit, taken back to the surface as if
//! it were not there, is smooth down to v = 0, and so is v tr M, whose limit vanishes at resonant grazing alone: where grazing
//! meets folds and flips (Nordmark 2001; Simpson and Ghosh, arXiv 2602.22797). The orbit that just touches solves a regular
//! system, too: from rest at the surface at a drive angle, over whole periods back to it. (Arclength and Newton near
//! grazing: arXiv 2506.18379, arXiv 2510.16218.)

use nalgebra::{DMatrix, DVector, Matrix2, Vector2};

use super::Family;
use super::arclength::{Equations, Evaluation, Node, correct};
use super::face::Face;
use super::impact_section::{ImpactSection, LastArc, SectionPoint};
use super::period_map::carry_through;
use super::point::Graze;
use super::shooting::{end_derivatives, round_off};
use super::test_function::TestFunction;
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

/// Orbits of a family that fulfil a condition at an impact section, in unknowns: drive angle there, scaled velocity of an
/// impact, scaled parameters.
#[derive(Debug)]
pub(crate) struct SectionSystem<'a, const N: usize> {
    /// The surface, and the crossings of the orbit, a touch left out.
    pub section: ImpactSection<'a, N>,
    pub condition: SectionCondition,
}

impl<'a, const N: usize> SectionSystem<'a, N> {
    /// The grazing orbits of a family over a number of drive periods that touch as another one does.
    pub fn of_graze(graze: &Graze, orbits: (&'a dyn Family<N>, u64)) -> Self {
        Self {
            section: ImpactSection::of_graze(graze, orbits),
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
            carry_through(motion, end, kept)
        })?;
        let entries = motion.crossings().filter(|it| {
            let enters = matches!(it.kind, CrossingKind::Surface { forward: true, .. });
            enters || matches!(it.kind, CrossingKind::Rebound { .. })
        });
        let slowest = entries.min_by(|a, b| a.velocity.abs().total_cmp(&b.velocity.abs()));
        let Some(entry) = slowest.filter(|_| motion.rests().next().is_none()) else {
            return Ok(None);
        };
        let face = Face::at_position(&scene, entry.position);
        let Some(face) = face.filter(|face| face.is_steep(&scene)) else {
            return Ok(None);
        };
        let is_told = matches!(entry.kind, CrossingKind::Rebound { .. });
        let section = ImpactSection {
            family,
            periods,
            crossings: motion.crossings().count() - usize::from(!is_told),
            face,
            is_symmetric: false,
        };
        let time = motion.clock.time(entry.instant);
        let angle = scene.excitation.phase + scene.excitation.frequency * time;
        let [_, speed] = family.state_scales();
        let guess = section.scaled_unknowns(&[angle, entry.velocity.abs() / speed], parameters);
        let condition = SectionCondition::Impact(test);
        Ok(Some((Self { section, condition }, guess)))
    }

    /// The orbit with a weak impact of this velocity, in units of the family's scales, where these graze, but for symmetric
    /// ones, which have two.
    pub fn with_weak_impact(
        &self,
        touch: &DVector<f64>,
        test: TestFunction,
        velocity: f64,
    ) -> Result<(Self, Node<SectionPoint>), OrbitError> {
        if self.section.is_symmetric {
            return Err(OrbitError::NotIsolated);
        }
        let section = ImpactSection {
            crossings: self.section.crossings + 1,
            ..self.section
        };
        let condition = SectionCondition::Impact(test);
        let critical = Self { section, condition };
        let guess = touch.clone().insert_row(1, velocity);
        let given = DVector::from_fn(guess.len(), |row, _| f64::from(u8::from(row == 1)));
        let node = correct(&critical, &guess, Some(&given))?;
        Ok((critical, node))
    }

    /// The system of resonant grazing of orbits with an impact, and its unknowns near them.
    pub fn resonant_grazing_system(&self, at: &DVector<f64>) -> (Self, DVector<f64>) {
        let section = ImpactSection {
            crossings: self.section.crossings - 1,
            ..self.section
        };
        let condition = SectionCondition::ResonantTouch;
        (Self { section, condition }, at.clone().remove_row(1))
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
        let [_, speed] = self.section.family.state_scales();
        let impact = self.critical_test().map(|_| at[1] * speed);
        impact.map_or(0.0, |velocity| self.section.face.side_sign() * velocity)
    }

    /// The state of the orbit at time 0 of the family's scene.
    pub fn state(&self, at: &DVector<f64>) -> Result<Vector2<f64>, OrbitError> {
        self.section.state(at, self.velocity(at))
    }

    /// The touch of a grazing orbit, as of a crossing that dies.
    pub fn graze_at(&self, node: &Node<SectionPoint>) -> Graze {
        Graze {
            angle: node.at[0],
            impacts: node.here.point.impacts.len(),
            dies: true,
            face: self.section.face,
            crossings: match self.section.is_symmetric {
                true => 2 * self.section.crossings,
                false => self.section.crossings,
            },
            is_symmetric: self.section.is_symmetric,
        }
    }

    /// The orbit around from the section, how far it is off there, scaled, its scene, and where it begins.
    fn carry_around(
        &self,
        at: &DVector<f64>,
    ) -> Result<(Vector2<f64>, LastArc, CheckedScene, Vector2<f64>), OrbitError> {
        let (scene, position) = self.section.scene_at(at[0], self.section.parameters(at))?;
        let begin = Vector2::new(position, self.velocity(at));
        let (drift, around) = self.section.carry_around(&scene, begin)?;
        Ok((drift, around, scene, begin))
    }
}

impl<const N: usize> Equations for SectionSystem<'_, N> {
    type Point = SectionPoint;

    fn evaluate(&self, at: &DVector<f64>) -> Result<Evaluation<SectionPoint>, OrbitError> {
        let test = self.critical_test();
        if test.is_some() && at[1] <= 0.0 {
            let residual = f64::INFINITY;
            return Err(OrbitError::Diverged { residual });
        }
        let (drift, around, scene, begin) = self.carry_around(at)?;
        let tangent = around.motion.tangent();
        let entry = test.and_then(|_| entry_jump(&around.motion, &scene, begin));
        let is_impact = entry.is_some() && self.section.face.is_clearance();
        let told = around.motion.impacts();
        let told = told.map(|it| it.before_impact_velocity);
        let own = is_impact.then_some(begin.y.abs()).into_iter();
        let mut impacts: Vec<f64> = own.chain(told).collect();
        let mut factors = vec![
            (entry.unwrap_or_else(Matrix2::identity), 1.0),
            (tangent.matrix, tangent.determinant),
        ];
        if self.section.is_symmetric {
            // The way back is the mirror image of the way there.
            impacts.extend_from_within(..);
            factors.extend_from_within(..);
        }
        let sizes = self.section.family.state_scales();
        let orbit = Evaluation {
            residual: DVector::from_column_slice(drift.as_slice()),
            tolerance: round_off(&scene, &begin, &Monodromy::from(&tangent), sizes),
            point: SectionPoint {
                place: at.clone(),
                motion: around.motion.into(),
                monodromy: Monodromy::from_factors(&factors),
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

    fn slopes_along(&self, here: &Evaluation<SectionPoint>) -> Option<DMatrix<f64>> {
        if self.condition != SectionCondition::Touch {
            return None;
        }
        let SectionPoint { place, motion, .. } = &here.point;
        let scene_at = |place: &DVector<f64>| {
            let parameters = self.section.parameters(place);
            Some(self.section.scene_at(place[0], parameters).ok()?.0)
        };
        let position = self.section.face.face_position(&motion.scene)?;
        let orbit = (&**motion, Vector2::new(position, 0.0), true);
        let ends = end_derivatives(orbit, (place, 0..place.len()), scene_at)?;
        let drifts = ends
            .into_iter()
            .map(|(end, begin)| self.section.scaled_drift(Vector2::new(begin, 0.0), end));
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
    let first = motion.observed_arcs().find_map(|(arc, _)| arc.phase)?;
    let last = motion.observed_arcs().last()?.0.phase?;
    let jump = acceleration(first) - acceleration(last);
    Some(Matrix2::new(1.0, 0.0, jump / begin.y, 1.0))
}
