//! Figures of one motion, and whether they are as a task requires.

use softstop::{Machine, MotionError, Parameter, Scene};
use softstop_dynamics::basin::Establishment;
use softstop_dynamics::continuation::{Direction, TestFunction};
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::zone::{find_end_along, free_amplitude, loss_of_stability};
use softstop_dynamics::{CycleMetrics, Orbit, ParameterFamily, Zone};

use super::cost::{value_of_motion, value_of_orbit};
use super::figure::Figure;
use super::problem::Problem;
use super::requirement::Requirement;

/// A z = 1 motion of a zone, to be judged.
#[derive(Debug, Clone, Copy)]
pub struct ZoneMotion<'a> {
    /// The machine, its drive at the motion's frequency.
    pub machine: &'a Machine,
    /// Its zone.
    pub zone: &'a Zone,
    /// Place in the zone.
    pub place: f64,
    /// The motion.
    pub orbit: &'a Orbit,
    /// What it does in a stroke.
    pub stroke: CycleMetrics,
}

impl<'a> ZoneMotion<'a> {
    /// A motion at a place of its zone.
    ///
    /// # Errors
    /// [`MotionError`] if the motion cannot be computed.
    pub fn new(
        machine: &'a Machine,
        zone: &'a Zone,
        place: f64,
        orbit: &'a Orbit,
    ) -> Result<Self, MotionError> {
        Ok(Self {
            machine,
            zone,
            place,
            orbit,
            stroke: CycleMetrics::of(orbit)?,
        })
    }

    /// The value of a figure in SI units; NaN if it has none or is a cost ([`Problem::value`]), infinite where nothing bounds the motion.
    pub fn value(&self, figure: Figure) -> f64 {
        if let Some(value) = figure.of_motion(self.orbit, &self.stroke) {
            return value;
        }
        let frequency = self.orbit.scene.excitation.frequency;
        match figure {
            Figure::Share => self.place.min(1.0 - self.place),
            Figure::FrequencyG0 => frequency - self.zone.frequency_g0,
            Figure::FrequencySn if self.ends_within_zone() => self.own_end() - frequency,
            Figure::FrequencySn | Figure::ClearanceSn
                if !self.ends_within_zone() && !self.zone.high.is_critical(TestFunction::Fold) =>
            {
                f64::INFINITY
            }
            Figure::FrequencySn => self.zone.high.frequency - frequency,
            Figure::ClearanceSn if self.is_at_fold() => 0.0,
            Figure::ClearanceSn => self.along(
                (Parameter::Clearance, WIDER),
                Direction::Up,
                TestFunction::Fold,
            ),
            // At the fold itself there is no way down the stable branch to a flip.
            Figure::FrequencyPd | Figure::ClearancePd if self.is_at_fold() => f64::NAN,
            Figure::FrequencyPd => {
                let below = self.above_flip(frequency);
                match self.zone.high.is_critical(TestFunction::Flip) {
                    true => below.min(self.zone.high.frequency - frequency),
                    false => below,
                }
            }
            Figure::ClearanceG0 => {
                let scene = &self.orbit.scene;
                scene.least_clearance() - free_amplitude(scene, frequency)
            }
            Figure::ClearancePd => self.along(
                (Parameter::Clearance, NARROWER),
                Direction::Down,
                TestFunction::Flip,
            ),
            _ => f64::NAN,
        }
    }

    /// True if the motion may end at a fold within the zone, whose branch folds back.
    pub(super) fn ends_within_zone(&self) -> bool {
        self.zone.ranges().len() > 1
    }

    /// The frequency in rad/s up to which the motion goes on; NaN if it is none of the zone.
    fn own_end(&self) -> f64 {
        let range = self.zone.range_holding(self.orbit);
        range.map_or(f64::NAN, |range| range.high.frequency)
    }

    /// Distance in rad/s from the flip below, infinite if there is none.
    fn above_flip(&self, frequency: f64) -> f64 {
        match loss_of_stability(self.orbit, Direction::Down, TestFunction::Flip) {
            Ok(Some(flip)) => frequency - flip.parameter,
            Ok(None) => f64::INFINITY,
            Err(_) => f64::NAN,
        }
    }

    /// True if the nearer flip is the upper end of the zone.
    pub(super) fn is_flip_above(&self) -> bool {
        let frequency = self.orbit.scene.excitation.frequency;
        self.zone.high.is_critical(TestFunction::Flip)
            && self.zone.high.frequency - frequency < self.above_flip(frequency)
    }

    fn is_at_fold(&self) -> bool {
        let is_at_end =
            self.zone.high.is_critical(TestFunction::Fold) && self.place > 1.0 - AT_FOLD;
        is_at_end || !self.orbit.is_stable()
    }

    /// Distance along a parameter, in SI units, to where the motion is lost, by this or by anything else; infinite if it
    /// is not within a factor `reach`, NaN if it cannot be followed.
    fn along(
        &self,
        (parameter, reach): (Parameter, f64),
        direction: Direction,
        test: TestFunction,
    ) -> f64 {
        let scene = &self.orbit.scene;
        let Some(from) = parameter.get(scene) else {
            return f64::NAN;
        };
        let family =
            ParameterFamily::new(Scene::clone(scene), [parameter]).map_err(OrbitError::from);
        let end = family
            .and_then(|family| find_end_along(&family, (from, reach), self.orbit, direction, test));
        match end {
            Ok(Some(lost)) => (lost - from).abs(),
            Ok(None) => f64::INFINITY,
            Err(_) => f64::NAN,
        }
    }
}

/// Largest factors of the clearance, up and down, within which it is looked where a motion is lost.
const WIDER: f64 = 32.0;
const NARROWER: f64 = 4.0;
/// Share of the zone within which the fold is too near to follow the stable branch away from it.
const AT_FOLD: f64 = 1e-6;

/// A requirement and what a motion has of it, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct RequirementValue {
    /// What is required.
    pub requirement: Requirement,
    /// The index of the case in which it is, if it is one.
    pub case: Option<usize>,
    /// What the motion has.
    pub value: f64,
    /// The starts that tell it, if it takes many.
    pub starts: Option<Establishment>,
    /// What the worst machine within the tolerances has, if they count; of a share that is counted, the lower end of its interval.
    pub worst: Option<f64>,
    /// Share of the machines within the tolerances that violate it, if they were looked at.
    pub violating: Option<f64>,
    /// The 95 % interval of that share, if the machines are drawn from normal tolerances.
    pub interval: Option<[f64; 2]>,
}

impl RequirementValue {
    /// A requirement of which nothing is known.
    pub(super) fn of(requirement: Requirement) -> Self {
        Self {
            requirement,
            case: None,
            value: f64::NAN,
            starts: None,
            worst: None,
            violating: None,
            interval: None,
        }
    }

    /// By what it is judged: of a share that is counted, the lower end of its interval.
    pub fn judged(&self) -> f64 {
        match (&self.starts, self.requirement.figure) {
            (Some(starts), Figure::Certainty) => starts.interval[0],
            _ => self.value,
        }
    }

    /// Distance to the nearer bound in SI units, of the worst machine within the tolerances if they count; negative beyond it.
    pub fn margin(&self) -> f64 {
        let own = self.requirement.margin(self.judged());
        match self.worst.map(|worst| self.requirement.margin(worst)) {
            // NaN stays.
            Some(within) if within.is_nan() || within < own => within,
            _ => own,
        }
    }

    /// Whether it is met.
    pub fn is_met(&self) -> bool {
        self.margin() >= 0.0
    }

    /// What else is to be known of the value: why it is none, or from which starts it was counted; may be empty.
    pub fn note(&self, machine: &Machine) -> String {
        if self.value.is_infinite() {
            return self.requirement.figure.unbounded_reason().to_owned();
        }
        if let Some([low, high]) = self.interval {
            return format!("share that violates it: 95 % interval {low:.3e} to {high:.3e}");
        }
        let Some(of) = &self.starts else {
            return String::new();
        };
        let [low, high] = of.interval;
        let interval = match self.requirement.figure {
            Figure::Certainty => format!("95 % interval {low:.3} to {high:.3}, "),
            _ => String::new(),
        };
        format!(
            "{interval}{} starts in {}",
            of.starts,
            of.region.describe(machine)
        )
    }
}

impl Problem {
    /// The value of a figure of a motion, as [`ZoneMotion::value`], or its cost.
    pub fn value(&self, motion: &ZoneMotion<'_>, figure: Figure) -> f64 {
        match figure {
            Figure::Cost => {
                let cost = self.cost.as_ref();
                let value = value_of_motion((figure, cost), motion.orbit, &motion.stroke);
                value.unwrap_or(f64::NAN)
            }
            _ => motion.value(figure),
        }
    }

    /// What is sought of a motion, in SI units; none if it has no such figure.
    pub fn sought(&self, motion: &ZoneMotion<'_>) -> Option<f64> {
        let value = self.value(motion, self.objective.figure);
        let score = self.objective.score(value);
        (score > 0.0 && score.is_finite()).then_some(value)
    }

    /// The value of a figure that a motion tells by itself, or of its cost, in SI units; none if there is none.
    pub fn value_of_motion(&self, figure: Figure, orbit: &Orbit) -> Option<f64> {
        value_of_orbit((figure, self.cost.as_ref()), orbit)
    }

    /// The requirements that one motion tells, and what it has of them.
    pub fn met(&self, motion: &ZoneMotion<'_>) -> Vec<RequirementValue> {
        let all = self.single().map(|requirement| RequirementValue {
            value: self.value(motion, requirement.figure),
            ..RequirementValue::of(*requirement)
        });
        all.collect()
    }

    /// The margin M and what the motion has of it; none if none is asked for.
    pub fn share(&self, motion: &ZoneMotion<'_>) -> Option<RequirementValue> {
        let value = motion.value(Figure::Share);
        let is_at_bound = (value - self.margin).abs() < ROUNDING;
        (self.margin > 0.0).then_some(RequirementValue {
            value: if is_at_bound { self.margin } else { value },
            ..RequirementValue::of(Requirement::at_least(Figure::Share, self.margin))
        })
    }
}

/// What rounding may do to a place.
const ROUNDING: f64 = 1e-9;

/// How far a motion is from what is required of it, in units of the bounds; 0 if all is met.
pub fn violation(met: &[RequirementValue]) -> f64 {
    met.iter()
        .map(|it| it.requirement.violation(it.value))
        .sum()
}
