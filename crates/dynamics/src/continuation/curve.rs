//! Special points followed in two parameters.

use std::ops::ControlFlow;

use nalgebra::DVector;

use super::Family;
use super::arclength::{Equations, Node, correct};
use super::follow::WIDTH;
use super::grazing_orbit::{GrazingOrbit, GrazingPoint};
use super::locate::{along_chord, locate};
use super::period_map::PeriodMap;
use super::point::{BranchPoint, Graze, SpecialKind};
use super::sequence::Sequence;
use super::shooting::{Critical, Shooting};
use super::stepper::Stepper;
use crate::orbit::{Monodromy, OrbitError};

/// The part of the plane of two parameters in which a curve is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveLimits {
    /// Lowest and highest values.
    pub ranges: [(f64, f64); 2],
    /// Points in each direction.
    pub points: usize,
    /// Largest step, in units of the family's scales.
    pub step: f64,
}

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
    /// Jacobian of the map, a touch left out.
    pub monodromy: Monodromy,
}

impl CurvePoint {
    /// The highest before-impact velocity in m/s; 0 without any impact.
    pub fn before_impact_velocity(&self) -> f64 {
        self.impacts.iter().copied().fold(0.0, f64::max)
    }
}

/// Why a curve ends.
#[derive(Debug, Clone)]
pub enum CurveEnd {
    /// A parameter reaches the end of its range; the last point is there.
    Range,
    /// There are as many points as asked for.
    Points,
    /// It comes back to its start.
    Closed,
    /// Beyond its last point the orbit would cross surfaces in another order: it grazes there.
    Grazing,
    /// The watcher asked for it.
    Stopped,
    /// It cannot be followed even with the smallest step.
    Lost(OrbitError),
}

/// A curve of special points of one kind in two parameters.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Curve {
    /// What they are.
    pub kind: SpecialKind,
    /// Points, in order of arclength.
    pub points: Vec<CurvePoint>,
    /// Why it ends at its first point and at its last.
    pub ends: (CurveEnd, CurveEnd),
}

/// Follows a special point of a branch in both directions. `parameters` are its own: that of the branch
/// and the value of the second; `watch` sees each point as it comes.
///
/// # Errors
/// [`OrbitError`] if the point is not a special one of this family.
pub fn curve<F: Family<2>>(
    family: &F,
    periods: u64,
    (kind, point): (SpecialKind, &BranchPoint),
    parameters: [f64; 2],
    region: &CurveLimits,
    mut watch: impl FnMut(&CurvePoint) -> ControlFlow<()>,
) -> Result<Curve, OrbitError> {
    match kind {
        SpecialKind::Critical(test) => {
            let shooting = Shooting::new(family, periods);
            let guess = shooting.scaled(point.state(), parameters);
            let critical = Critical { shooting, test };
            follow(&critical, kind, &guess, region, &mut watch)
        }
        SpecialKind::Grazing(Graze {
            angle,
            crossings,
            face,
            ..
        }) => {
            let touching = GrazingOrbit {
                family,
                periods,
                crossings,
                face,
            };
            let guess = touching.scaled(angle, parameters);
            follow(&touching, kind, &guess, region, &mut watch)
        }
    }
}

/// A system whose solutions are special points in two parameters.
trait Codimension: Equations {
    fn parameters(&self, at: &DVector<f64>) -> [f64; 2];
    fn describe(&self, node: &Node<Self::Point>) -> Result<CurvePoint, OrbitError>;
    fn sequence(&self, point: &Self::Point) -> Sequence;
}

impl<F: Family<2>> Codimension for Critical<'_, F, 2> {
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

impl<F: Family<2>> Codimension for GrazingOrbit<'_, F, 2> {
    fn parameters(&self, at: &DVector<f64>) -> [f64; 2] {
        GrazingOrbit::parameters(self, at)
    }

    fn describe(&self, node: &Node<GrazingPoint>) -> Result<CurvePoint, OrbitError> {
        let state = self.state(node)?;
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
}

fn follow<E: Codimension>(
    equations: &E,
    kind: SpecialKind,
    guess: &DVector<f64>,
    region: &CurveLimits,
    watch: &mut impl FnMut(&CurvePoint) -> ControlFlow<()>,
) -> Result<Curve, OrbitError> {
    let unknowns = guess.len();
    let mut second = DVector::zeros(unknowns);
    second[unknowns - 1] = 1.0;
    let mut first = DVector::zeros(unknowns);
    first[unknowns - 2] = 1.0;
    let start = correct(equations, guess, Some(&second))
        .or_else(|_| correct(equations, guess, Some(&first)))?;
    let up = way(equations, start.clone(), &second, region, watch)?;
    let down = match up.1 {
        CurveEnd::Closed => (Vec::new(), CurveEnd::Closed),
        _ => way(equations, start.clone(), &-second, region, watch)?,
    };
    let mut points = down.0;
    points.reverse();
    points.push(equations.describe(&start)?);
    points.extend(up.0);
    Ok(Curve {
        kind,
        points,
        ends: (down.1, up.1),
    })
}

/// Points after which a curve may be found closed, and distance from its start, in units of the step.
pub(super) const SHORTEST_LOOP: usize = 8;
pub(super) const CLOSED: f64 = 0.05;

fn way<E: Codimension>(
    equations: &E,
    start: Node<E::Point>,
    along: &DVector<f64>,
    region: &CurveLimits,
    watch: &mut impl FnMut(&CurvePoint) -> ControlFlow<()>,
) -> Result<(Vec<CurvePoint>, CurveEnd), OrbitError> {
    let origin = start.at.clone();
    let sequence = equations.sequence(&start.here.point);
    let mut stepper = Stepper::new(equations, start, along, region.step)?;
    let mut points = Vec::new();
    while points.len() < region.points {
        let last = stepper.node.clone();
        let next = stepper.attempt().map_err(CurveEnd::Lost);
        let next = next.and_then(|step| {
            if equations.sequence(&step.node.here.point) != sequence {
                return Err(CurveEnd::Grazing);
            }
            let end = within(equations, (&last, &step.node), region);
            Ok((step, end.map_err(CurveEnd::Lost)?))
        });
        let (step, (node, leaves)) = match next {
            Ok(next) => next,
            Err(_) if stepper.shorten() => continue,
            Err(cause) => return Ok((points, cause)),
        };
        stepper.take(step);
        let step = &node.at - &last.at;
        let (share, off) = along_chord((&last.at, &step), &origin);
        let passes = (0.0..=1.0).contains(&share) && off < CLOSED * step.norm();
        let closed = points.len() >= SHORTEST_LOOP && passes;
        let point = equations.describe(&node)?;
        let stopped = watch(&point).is_break();
        points.push(point);
        if leaves {
            return Ok((points, CurveEnd::Range));
        }
        if closed {
            return Ok((points, CurveEnd::Closed));
        }
        if stopped {
            return Ok((points, CurveEnd::Stopped));
        }
    }
    Ok((points, CurveEnd::Points))
}

/// The end of a step, or the point on it where a parameter leaves its range.
fn within<E: Codimension>(
    equations: &E,
    (from, to): (&Node<E::Point>, &Node<E::Point>),
    region: &CurveLimits,
) -> Result<(Node<E::Point>, bool), OrbitError> {
    let mut end = (to.clone(), false);
    for (index, (low, high)) in region.ranges.into_iter().enumerate() {
        let value = |node: &Node<E::Point>| equations.parameters(&node.at)[index];
        let now = value(&end.0);
        let bound = now.clamp(low, high);
        if bound != now && value(from) != bound {
            let test = |node: &Node<E::Point>| value(node) - bound;
            let (node, _) = locate(equations, (from, &end.0), WIDTH, test)?;
            end = (node, true);
        }
    }
    Ok(end)
}
