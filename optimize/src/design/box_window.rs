//! The frequencies at which a whole box of tolerances stays inside the zone: each end of the zone is taken at the corner of
//! the box that brings it nearest, which the signs of its normal name (Moennigmann and Marquardt 2002). What else is lost
//! within the box, [`robustify`](super::robustify) looks for.

use crate::order::sort_rising;
use crate::spread::{critical_normal, free_normal};
use softstop::{Dimension, Machine, Parameter};
use softstop_dynamics::continuation::TestFunction;
use softstop_dynamics::derivatives::Border;
use softstop_dynamics::zone::{Loss, grazing_frequencies};
use softstop_dynamics::{BranchPoint, Zone};

use super::Infeasible;
use super::problem::{Problem, Width};
use crate::robust::Tolerances;

/// An end of the zone of a corner of the box.
#[derive(Debug, Clone)]
pub(super) struct CornerZoneEnd {
    /// The corner, in coordinates of the box.
    pub corner: Vec<f64>,
    /// The fold there; none at g0.
    pub fold: Option<BranchPoint>,
    /// Where the drive of the nominal machine has to stay below it, or above g0, in rad/s.
    pub frequency: f64,
}

/// Tolerances of which both sides are looked at, at most, and the share of the normal from which one is sure.
const DOUBTFUL: usize = 2;
const SMALL: f64 = 0.1;
/// How often a corner is chosen anew by the normal there.
const CORNERS: usize = 3;

/// Both ends.
#[derive(Debug, Clone)]
pub(super) struct BoxWindow {
    /// g0, which moves one way with each parameter, if the zone begins there. What else it begins with, and a fold at the lower end
    /// of a range, is not known here.
    pub low: Option<CornerZoneEnd>,
    /// `s_SN`, if the zone ends there, at each corner where it can be the nearest: on both sides of the tolerances along which its normal is small.
    /// Always as many, so that the constraints of a search stay the same.
    pub high: [Option<CornerZoneEnd>; 1 << DOUBTFUL],
}

impl BoxWindow {
    /// Of a machine with this zone; none if all of it is exact.
    ///
    /// # Errors
    /// [`Infeasible`] if a corner has no zone.
    pub(super) fn of(
        problem: &Problem,
        machine: &Machine,
        zone: &Zone,
    ) -> Result<Option<Self>, Infeasible> {
        let Some(spread) = problem.spread(machine) else {
            return Ok(None);
        };
        let corners = Corners {
            problem,
            machine,
            spread,
        };
        Ok(Some(Self {
            low: match zone.low.loss {
                Loss::FreeGrazing => Some(corners.low()?),
                _ => None,
            },
            high: corners.high(zone)?,
        }))
    }

    /// The nearest of the upper end, in rad/s.
    pub(super) fn highest(&self) -> f64 {
        let edges = self.high.iter().flatten().map(|edge| edge.frequency);
        edges.fold(f64::INFINITY, f64::min)
    }
}

/// The fold at which a zone ends, if that is what ends it.
fn fold_of(zone: &Zone) -> Option<BranchPoint> {
    let is_fold = zone.high.is_critical(TestFunction::Fold);
    is_fold.then(|| zone.high.point.clone())
}

struct Corners<'a> {
    problem: &'a Problem,
    machine: &'a Machine,
    spread: Tolerances,
}

impl Corners<'_> {
    fn low(&self) -> Result<CornerZoneEnd, Infeasible> {
        let centre = vec![0.0; self.spread.dimensions()];
        let normal = free_normal(&self.spread, &centre).map_err(Infeasible::unknown)?;
        let corner: Vec<f64> = normal.iter().map(|part| -part.signum()).collect();
        let (_, above) =
            grazing_frequencies(&self.spread.scene(&corner)).map_err(Infeasible::unknown)?;
        Ok(CornerZoneEnd {
            corner,
            fold: None,
            frequency: self.without_width(above, -1.0),
        })
    }

    fn high(&self, zone: &Zone) -> Result<[Option<CornerZoneEnd>; 1 << DOUBTFUL], Infeasible> {
        let mut corner = vec![0.0; self.spread.dimensions()];
        let Some(mut fold) = fold_of(zone) else {
            return Ok(std::array::from_fn(|_| None));
        };
        let normal = |corner: &[f64], fold: &BranchPoint| {
            critical_normal(&self.spread, corner, (TestFunction::Fold, fold))
                .map_err(Infeasible::unknown)
        };
        let mut outwards = normal(&corner, &fold)?;
        for _ in 0..CORNERS {
            let towards: Vec<f64> = outwards.iter().map(|part| part.signum()).collect();
            if towards == corner {
                break;
            }
            let zone = self.problem.zone_of(&self.spread.machine(&towards));
            let zone = zone.map_err(|error| {
                Infeasible::unknown(format!(
                    "a machine within the tolerances has no zone: {error}"
                ))
            })?;
            let Some(there) = fold_of(&zone) else {
                break;
            };
            (corner, fold) = (towards, there);
            outwards = normal(&corner, &fold)?;
        }
        let doubtful = self.doubtful(&outwards);
        let edge = |set: usize| {
            if set >> doubtful.len() != 0 {
                return None;
            }
            let (mut corner, mut fold) = (corner.clone(), fold.clone());
            if set > 0 {
                let scene = self.spread.scene(&corner);
                let border =
                    Border::at_special(&scene, 1, (TestFunction::Fold, &fold), &[]).ok()?;
                for (bit, index) in doubtful.iter().enumerate() {
                    if set >> bit & 1 == 1 {
                        corner[*index] *= -1.0;
                    }
                }
                fold = border
                    .find_again(&self.spread.scene(&corner))
                    .ok()?
                    .point?
                    .0;
            }
            Some(CornerZoneEnd {
                frequency: self.without_width(fold.parameter, 1.0),
                fold: Some(fold),
                corner,
            })
        };
        Ok(std::array::from_fn(edge))
    }

    /// The coordinates along which a normal is small, the least first.
    fn doubtful(&self, normal: &[f64]) -> Vec<usize> {
        let all = self.spread.all().iter();
        let others = all.map(|it| it.parameter != Parameter::Frequency);
        let mut small: Vec<usize> = others
            .enumerate()
            .filter_map(|(index, is)| is.then_some(index))
            .collect();
        let sum: f64 = small.iter().map(|index| normal[*index].abs()).sum();
        small.retain(|index| normal[*index].abs() < SMALL * sum && normal[*index] != 0.0);
        sort_rising(&mut small, |index| normal[*index].abs());
        small.truncate(DOUBTFUL);
        small
    }

    /// Where the nominal drive is when one at its own bound, above or below it, has this frequency in rad/s.
    fn without_width(&self, frequency: f64, sign: f64) -> f64 {
        let mut tolerances = self.problem.tolerances.iter();
        let speed = tolerances.find(|it| it.parameter == Parameter::Frequency);
        let Some(speed) = speed else {
            return frequency;
        };
        let sign = sign * self.problem.widening(speed);
        match speed.width {
            Width::Own(width) => frequency - sign * self.machine.to_si(Dimension::Frequency, width),
            Width::Share(share) => frequency / (1.0 + sign * share),
        }
    }
}
