//! Folds and flips with their slowest impact as the section: regular down to grazing.
//!
//! In the state at a fixed drive angle a weak impact has a square root, so a curve of folds or flips that comes near to
//! grazing asks for ever shorter steps. In the drive angle and the before-impact velocity v of that impact the orbit, taken
//! back to the surface as if it were not there, is smooth down to v = 0, and so is v tr M, whose limit vanishes at resonant
//! grazing alone: where grazing meets folds and flips (Nordmark 2001; Simpson and Ghosh, arXiv 2602.22797).

use nalgebra::{DVector, Matrix2, Vector2};

use super::Family;
use super::arclength::{Equations, Evaluation, Node, correct};
use super::face::Face;
use super::grazing_orbit::GrazingOrbit;
use super::impact_section::{ImpactSection, SectionPoint};
use super::period_map::carry_through;
use super::shooting::round_off;
use super::test::Test;
use crate::orbit::{Monodromy, OrbitError};
use crate::period::PeriodTrajectory;
use softstop::internals::Phase;
use softstop::{Clock, CrossingKind, MotionError, Scene};

/// Orbits on which a test vanishes, in scaled unknowns: angle and velocity of the slowest impact, parameters.
#[derive(Debug)]
pub(crate) struct CriticalImpact<'a, F, const N: usize> {
    pub section: ImpactSection<'a, F, N>,
    pub test: Test,
}

impl<'a, F: Family<N>, const N: usize> CriticalImpact<'a, F, N> {
    /// The system and its unknowns at an orbit; none if its slowest entry is none into a rigid or preloaded stop.
    pub fn at_orbit(
        (family, periods): (&'a F, u64),
        test: Test,
        state: Vector2<f64>,
        parameters: [f64; N],
    ) -> Result<Option<(Self, DVector<f64>)>, MotionError> {
        let scene = family.scene(parameters)?;
        scene.validate()?;
        let machine = (scene.phases().into(), scene.clock());
        let end = Clock::at_cycle(periods);
        let over = |motion: &mut _, kept: &mut PeriodTrajectory| carry_through(motion, end, kept);
        let motion = PeriodTrajectory::record(machine, state, over)?;
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
        };
        let time = motion.clock.time(entry.instant);
        let angle = scene.excitation.phase + scene.excitation.frequency * time;
        let [_, speed] = family.state_scales();
        let guess = section.scaled_unknowns(&[angle, entry.velocity.abs() / speed], parameters);
        Ok(Some((Self { section, test }, guess)))
    }

    /// The orbit with a weak impact of this velocity, in units of the family's scales, where another one grazes.
    pub fn with_weak_impact(
        grazing: &GrazingOrbit<'a, F, N>,
        touch: &DVector<f64>,
        test: Test,
        velocity: f64,
    ) -> Result<(Self, Node<SectionPoint>), OrbitError> {
        let section = ImpactSection {
            crossings: grazing.section.crossings + 1,
            ..grazing.section
        };
        let critical = Self { section, test };
        let guess = touch.clone().insert_row(1, velocity);
        let given = DVector::from_fn(guess.len(), |row, _| f64::from(u8::from(row == 1)));
        let node = correct(&critical, &guess, Some(&given))?;
        Ok((critical, node))
    }

    /// Velocity in m/s of the impact at the section, towards the surface.
    fn impact_velocity(&self, at: &DVector<f64>) -> f64 {
        let [_, speed] = self.section.family.state_scales();
        at[1] * speed
    }

    /// The state of the orbit at time 0 of the family's scene.
    pub fn state(&self, at: &DVector<f64>) -> Result<Vector2<f64>, OrbitError> {
        let velocity = self.section.face.side_sign() * self.impact_velocity(at);
        self.section.state(at, velocity)
    }

    /// The system of resonant grazing of these orbits, and its unknowns near them.
    pub fn resonant_grazing(&self, at: &DVector<f64>) -> (ResonantGrazing<'a, F, N>, DVector<f64>) {
        let section = ImpactSection {
            crossings: self.section.crossings - 1,
            ..self.section
        };
        (
            ResonantGrazing(GrazingOrbit { section }),
            at.clone().remove_row(1),
        )
    }
}

impl<F: Family<N>, const N: usize> Equations for CriticalImpact<'_, F, N> {
    type Point = SectionPoint;

    fn evaluate(&self, at: &DVector<f64>) -> Result<Evaluation<SectionPoint>, OrbitError> {
        let velocity = self.impact_velocity(at);
        if velocity <= 0.0 {
            let residual = f64::INFINITY;
            return Err(OrbitError::Diverged { residual });
        }
        let (scene, position) = self.section.scene_at(at[0], self.section.parameters(at))?;
        let begin = Vector2::new(position, self.section.face.side_sign() * velocity);
        let (drift, around) = self.section.carry_around(&scene, begin)?;
        let entry = entry_jump(&around.motion, &scene, begin);
        let tangent = around.motion.tangent();
        let is_impact = entry.is_some() && self.section.face.is_clearance();
        let told = around.motion.impacts();
        let told = told.map(|it| it.before_impact_velocity);
        let impacts = is_impact
            .then_some(velocity)
            .into_iter()
            .chain(told)
            .collect();
        let entered = (entry.unwrap_or_else(Matrix2::identity), 1.0);
        let monodromy = Monodromy::from_factors(&[entered, (tangent.matrix, tangent.determinant)]);
        let value = self.test.weighted_value(&monodromy, at[1]);
        let sizes = self.section.family.state_scales();
        let tolerance = round_off(&scene, &begin, &Monodromy::from(&tangent), sizes);
        let orbit = Evaluation {
            residual: DVector::from_column_slice(drift.as_slice()),
            tolerance,
            point: SectionPoint {
                monodromy,
                impacts,
                is_cut: around.is_cut,
            },
        };
        Ok(orbit.with_test(value))
    }
}

/// The saltation matrix of the entry from the last law of a motion that is taken on to where it began into the first,
/// which the motion does not tell; none at a rigid stop, whose rebound it tells. Both have the drive's force, so that
/// plays no part in the jump.
fn entry_jump(
    motion: &PeriodTrajectory,
    scene: &Scene,
    begin: Vector2<f64>,
) -> Option<Matrix2<f64>> {
    let (lowest, highest) = scene.reach();
    if begin.x == lowest || begin.x == highest {
        return None;
    }
    let acceleration = |phase: &Phase| phase.acceleration(begin.x, begin.y, 0.0, scene.mass);
    let first = motion.arcs().find_map(|(arc, _)| arc.phase)?;
    let last = motion.arcs().last()?.0.phase?;
    let jump = acceleration(first) - acceleration(last);
    Some(Matrix2::new(1.0, 0.0, jump / begin.y, 1.0))
}

/// Grazing orbits between whose touches the mass comes back to the surface at all velocities alike, so that a weak impact
/// has no bearing on the next: in the linear machine at frequencies 2 `omega_d` n / k.
#[derive(Debug)]
pub(crate) struct ResonantGrazing<'a, F, const N: usize>(pub GrazingOrbit<'a, F, N>);

impl<F: Family<N>, const N: usize> Equations for ResonantGrazing<'_, F, N> {
    type Point = SectionPoint;

    fn evaluate(&self, at: &DVector<f64>) -> Result<Evaluation<SectionPoint>, OrbitError> {
        let orbit = self.0.evaluate(at)?;
        let value = self.0.touch_response(&orbit.point);
        Ok(orbit.with_test(value))
    }
}
