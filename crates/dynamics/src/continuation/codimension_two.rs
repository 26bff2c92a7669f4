//! Points of codimension two, and the systems on whose curves they lie.

use nalgebra::{DVector, Vector2};

use super::Family;
use super::arclength::{Equations, Node, correct};
use super::critical_impact::{CriticalImpact, CriticalPoint};
use super::grazing_orbit::{GrazingOrbit, GrazingPoint};
use super::normal_form::normal_form_coefficient;
use super::period_map::PeriodMap;
use super::point::Graze;
use super::sequence::Sequence;
use super::shooting::Critical;
use super::test::Test;
use crate::orbit::{Monodromy, OrbitError, StroboscopicMap};
use softstop::{MotionError, Scene};

/// A point of a curve of special points.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct CurvePoint {
    /// The parameters' values.
    pub parameters: [f64; 2],
    /// Position in m at time 0.
    pub position: f64,
    /// Velocity in m/s at time 0.
    pub velocity: f64,
    /// Before-impact velocities in m/s.
    pub impacts: Vec<f64>,
    /// Jacobian of the map over the periods from where it is computed: time 0, an impact or a touch, which is left out.
    pub monodromy: Monodromy,
}

impl CurvePoint {
    /// Position and velocity at time 0.
    pub fn state(&self) -> Vector2<f64> {
        Vector2::new(self.position, self.velocity)
    }

    /// The highest before-impact velocity in m/s; 0 without any impact.
    pub fn before_impact_velocity(&self) -> f64 {
        self.impacts.iter().copied().fold(0.0, f64::max)
    }
}

/// A bifurcation of codimension two.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum CodimensionTwo {
    /// Two curves of folds meet in a cusp (Kuznetsov 2004, section 9.2).
    Cusp,
    /// A flip whose normal form has no cubic term: supercritical on one side, subcritical on the other (Kuznetsov 2004, section
    /// 9.4).
    GeneralisedFlip,
    /// Curves of folds and flips end on a curve of grazing: a weak impact has no bearing on the next (Simpson and Ghosh,
    /// arXiv 2602.22797).
    ResonantGrazing(Graze),
}

impl CodimensionTwo {
    /// In one word: CP, GPD, RG.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Cusp => "CP",
            Self::GeneralisedFlip => "GPD",
            Self::ResonantGrazing(_) => "RG",
        }
    }

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cusp => "cusp",
            Self::GeneralisedFlip => "generalised flip",
            Self::ResonantGrazing(_) => "resonant grazing",
        }
    }
}

/// Part of a direction along the parameters that is none.
pub(super) const TURNING_BACK: f64 = 1e-6;

/// The part of a direction along the two parameters.
pub(super) fn along_parameters(direction: &DVector<f64>) -> DVector<f64> {
    direction.rows(direction.len() - 2, 2).into_owned()
}

/// A system whose solutions are special points in two parameters, its last two unknowns.
pub(super) trait Codimension: Equations {
    /// What vanishes on the curve; none on one of grazing.
    fn test(&self) -> Option<Test>;
    /// Drive periods of the orbits.
    fn periods(&self) -> u64;
    fn machine(&self, parameters: [f64; 2]) -> Result<Scene, MotionError>;
    fn parameters(&self, at: &DVector<f64>) -> [f64; 2];
    fn describe(&self, node: &Node<Self::Point>) -> Result<CurvePoint, OrbitError>;
    fn sequence(&self, point: &Self::Point) -> Sequence;

    /// A function that changes its sign where the curve has a point of codimension two, at a node where it has a direction;
    /// before, it had another one. Not a number where it cannot be computed. At a cusp both parameters turn back, at a
    /// generalised flip the coefficient of the normal form vanishes.
    fn degeneracy(
        &self,
        node: &Node<Self::Point>,
        [before, here]: [&DVector<f64>; 2],
    ) -> (CodimensionTwo, f64) {
        if self.test() != Some(Test::Flip) {
            let value = along_parameters(before).dot(&along_parameters(here));
            return (CodimensionTwo::Cusp, value);
        }
        let coefficient = self.describe(node).and_then(|point| {
            let scene = self.machine(point.parameters)?;
            normal_form_coefficient(&scene, self.periods(), Test::Flip, point.state())
        });
        let value = coefficient.ok().flatten().unwrap_or(f64::NAN);
        (CodimensionTwo::GeneralisedFlip, value)
    }

    /// The point of codimension two in which the curve ends within a step from a node, if it does.
    fn last(
        &self,
        node: &Node<Self::Point>,
        step: &DVector<f64>,
    ) -> Option<(CodimensionTwo, CurvePoint)> {
        let _ = (node, step);
        None
    }

    /// How far the orbits of a fold are from where they are half their drive periods later, in units of the machine's motion;
    /// none if that number is odd. It vanishes where the curve ends on one of flips.
    fn half_period_gap(&self, point: &CurvePoint) -> Option<Vector2<f64>> {
        let periods = self.periods();
        if self.test() != Some(Test::Fold) || !periods.is_multiple_of(2) {
            return None;
        }
        let scene = self.machine(point.parameters).ok()?;
        let map = StroboscopicMap::new(&scene, periods / 2).ok()?;
        let gap = map.apply(point.state()).ok()?.end - point.state();
        let scales = scene.motion_scales();
        Some(Vector2::new(gap.x / scales.length, gap.y / scales.speed()))
    }
}

impl<F: Family<2>> Codimension for Critical<'_, F, 2> {
    fn test(&self) -> Option<Test> {
        Some(self.test)
    }

    fn periods(&self) -> u64 {
        self.shooting.periods
    }

    fn machine(&self, parameters: [f64; 2]) -> Result<Scene, MotionError> {
        self.shooting.family.scene(parameters)
    }

    fn parameters(&self, at: &DVector<f64>) -> [f64; 2] {
        self.shooting.parameters(at)
    }

    fn describe(&self, node: &Node<PeriodMap>) -> Result<CurvePoint, OrbitError> {
        let state = self.shooting.state(&node.at);
        let round = &node.here.point;
        Ok(CurvePoint {
            parameters: self.parameters(&node.at),
            position: state.x,
            velocity: state.y,
            impacts: round.impacts.clone(),
            monodromy: round.monodromy,
        })
    }

    fn sequence(&self, point: &PeriodMap) -> Sequence {
        point.sequence
    }
}

impl<F: Family<2>> Codimension for CriticalImpact<'_, F, 2> {
    fn test(&self) -> Option<Test> {
        Some(self.test)
    }

    fn periods(&self) -> u64 {
        self.section.periods
    }

    fn machine(&self, parameters: [f64; 2]) -> Result<Scene, MotionError> {
        self.section.family.scene(parameters)
    }

    fn parameters(&self, at: &DVector<f64>) -> [f64; 2] {
        CriticalImpact::parameters(self, at)
    }

    fn describe(&self, node: &Node<CriticalPoint>) -> Result<CurvePoint, OrbitError> {
        let state = self.state(&node.at)?;
        let CriticalPoint {
            monodromy, impacts, ..
        } = node.here.point.clone();
        Ok(CurvePoint {
            parameters: CriticalImpact::parameters(self, &node.at),
            position: state.x,
            velocity: state.y,
            impacts,
            monodromy,
        })
    }

    fn sequence(&self, point: &CriticalPoint) -> Sequence {
        Sequence {
            impacts: point.impacts.len(),
            surfaces: usize::from(point.is_cut),
            ..Sequence::default()
        }
    }

    fn last(
        &self,
        node: &Node<CriticalPoint>,
        step: &DVector<f64>,
    ) -> Option<(CodimensionTwo, CurvePoint)> {
        let (velocity, change) = (node.at[1], step[1]);
        if velocity + change > 0.0 {
            return None;
        }
        let (resonant, guess) = self.resonant_grazing(&(&node.at - step * (velocity / change)));
        let found = correct(&resonant, &guess, None).ok()?;
        let is_near = (&found.at - node.at.clone().remove_row(1)).norm() <= step.norm();
        let kind = CodimensionTwo::ResonantGrazing(resonant.0.graze(&found));
        let point = is_near.then(|| resonant.0.describe(&found).ok());
        Some((kind, point.flatten()?))
    }
}

impl<F: Family<2>> Codimension for GrazingOrbit<'_, F, 2> {
    fn test(&self) -> Option<Test> {
        None
    }

    fn periods(&self) -> u64 {
        self.section.periods
    }

    fn machine(&self, parameters: [f64; 2]) -> Result<Scene, MotionError> {
        self.section.family.scene(parameters)
    }

    fn parameters(&self, at: &DVector<f64>) -> [f64; 2] {
        GrazingOrbit::parameters(self, at)
    }

    fn describe(&self, node: &Node<GrazingPoint>) -> Result<CurvePoint, OrbitError> {
        let state = self.state(&node.at)?;
        let contact = &node.here.point;
        Ok(CurvePoint {
            parameters: GrazingOrbit::parameters(self, &node.at),
            position: state.x,
            velocity: state.y,
            impacts: contact.impacts.clone(),
            monodromy: contact.monodromy,
        })
    }

    fn sequence(&self, point: &GrazingPoint) -> Sequence {
        Sequence {
            impacts: point.impacts.len(),
            ..Sequence::default()
        }
    }

    fn degeneracy(
        &self,
        node: &Node<GrazingPoint>,
        _: [&DVector<f64>; 2],
    ) -> (CodimensionTwo, f64) {
        let scene = self
            .section
            .scene(0.0, GrazingOrbit::parameters(self, &node.at));
        let is_hard = scene.is_ok_and(|(scene, _)| self.section.face.is_steep(&scene));
        let value = self.recurrence(&node.here.point);
        let kind = CodimensionTwo::ResonantGrazing(self.graze(node));
        (kind, if is_hard { value } else { 0.0 })
    }
}
