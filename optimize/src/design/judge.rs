//! Figures of one motion, and whether they are as a task requires.

use softstop::internals::plain;
use softstop::{Machine, MotionError, Parameter};
use softstop_dynamics::continuation::{Heading, Test};
use softstop_dynamics::zone::{free_amplitude, loss_along, loss_of_stability};
use softstop_dynamics::{Along, Orbit, Stroke, Zone};

use super::figure::Figure;
use super::problem::Problem;
use super::requirement::Requirement;

/// A z = 1 motion of a zone, to be judged.
#[derive(Debug, Clone, Copy)]
pub struct Judged<'a> {
    /// The machine, its drive at the motion's frequency.
    pub machine: &'a Machine,
    /// Its zone.
    pub zone: &'a Zone,
    /// Place in the zone.
    pub place: f64,
    /// The motion.
    pub orbit: &'a Orbit,
    /// What it does in a stroke.
    pub stroke: Stroke,
}

impl<'a> Judged<'a> {
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
            stroke: Stroke::of(orbit)?,
        })
    }

    /// The value of a figure in SI units; NaN if it has none, infinite where nothing bounds the motion.
    pub fn value(&self, figure: Figure) -> f64 {
        let stroke = &self.stroke;
        let frequency = self.orbit.scene.excitation.frequency;
        match figure {
            Figure::Velocity => stroke.impact_velocity,
            Figure::ImpactEnergy => stroke.impact_energy,
            Figure::ImpactPower => stroke.impact_power,
            Figure::StrokeWork => stroke.losses.strip,
            Figure::DriveForce => self.orbit.scene.excitation.amplitude,
            Figure::DrivePower => stroke.mean_power,
            Figure::MaxPosition => stroke.highest,
            Figure::Stroke => stroke.length,
            Figure::StopForce => stroke.stop_force,
            Figure::CutThrough => stroke.beyond_strip.unwrap_or(f64::NAN),
            Figure::RigidGap => stroke.before_wall.unwrap_or(f64::NAN),
            Figure::Multiplier => {
                let moduli = self.orbit.multipliers().map(|it| it.norm());
                moduli.into_iter().fold(0.0, f64::max)
            }
            Figure::Share => self.place.min(1.0 - self.place),
            Figure::FrequencyG0 => frequency - self.zone.frequency_g0,
            Figure::FrequencySn => self.zone.frequency_sn - frequency,
            Figure::FrequencyPd => {
                let flip = loss_of_stability(self.orbit, Heading::Down, Test::Flip);
                let flip = flip.ok().flatten().map(|point| frequency - point.parameter);
                flip.unwrap_or(f64::INFINITY)
            }
            Figure::ClearanceG0 => {
                let scene = &self.orbit.scene;
                scene.clearance - free_amplitude(scene, frequency)
            }
            Figure::ClearanceSn => self.along_clearance(Heading::Up, Test::Fold),
            Figure::ClearancePd => self.along_clearance(Heading::Down, Test::Flip),
            Figure::Certainty | Figure::RunUp | Figure::MissingStrips => f64::NAN,
        }
    }

    /// Distance in m along the clearance to where the motion is lost.
    fn along_clearance(&self, heading: Heading, test: Test) -> f64 {
        let from = self.orbit.scene.clearance;
        let family = Along::new(self.orbit.scene.clone(), [Parameter::Clearance]);
        let lost = family.ok().and_then(|family| {
            loss_along(&family, from, self.orbit, heading, test)
                .ok()
                .flatten()
        });
        lost.map_or(f64::INFINITY, |point| (point.parameter - from).abs())
    }
}

/// A requirement and what a motion has of it, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Met {
    /// What is required.
    pub requirement: Requirement,
    /// What the motion has.
    pub value: f64,
}

impl Met {
    /// Distance to the nearer bound in SI units; negative beyond it.
    pub fn margin(&self) -> f64 {
        self.requirement.margin(self.value)
    }

    /// Whether it is met.
    pub fn is_met(&self) -> bool {
        self.margin() >= 0.0
    }
}

impl Problem {
    /// What is sought of a motion, in SI units; none if it has no such figure.
    pub fn sought(&self, motion: &Judged<'_>) -> Option<f64> {
        let value = motion.value(self.objective.figure);
        let score = self.objective.score(value);
        (score > 0.0 && score.is_finite()).then_some(value)
    }

    /// The requirements that one motion tells, and what it has of them.
    pub fn met(&self, motion: &Judged<'_>) -> Vec<Met> {
        let all = self.requirements.iter().filter(|it| !it.figure.is_trial());
        all.map(|requirement| Met {
            requirement: *requirement,
            value: motion.value(requirement.figure),
        })
        .collect()
    }
}

/// How far a motion is from what is required of it, in units of the bounds; 0 if all is met.
pub fn violation(met: &[Met]) -> f64 {
    met.iter()
        .map(|it| it.requirement.violation(it.value))
        .sum()
}

/// Share of a bound within which a requirement holds a design back.
const AT_BOUND: f64 = 1e-4;

/// What is violated and by how much, and which bounds stand in the way, in the machine's own units.
pub fn conflict(machine: &Machine, met: &[Met]) -> String {
    let violated = met.iter().filter(|it| !it.is_met());
    let violated: Vec<String> = violated.map(|it| words(machine, it)).collect();
    let held = met.iter().filter(|it| {
        let bound = it.value - it.margin();
        it.is_met() && it.margin() <= AT_BOUND * bound.abs()
    });
    let held: Vec<&str> = held.map(|it| it.requirement.figure.name()).collect();
    match &held[..] {
        [] => violated.join("; "),
        held => format!(
            "{}; against it stands {}",
            violated.join("; "),
            held.join(", ")
        ),
    }
}

/// `velocity = 9.8 m/s: must be at least 10 m/s, 0.2 m/s are missing`.
fn words(machine: &Machine, met: &Met) -> String {
    let figure = met.requirement.figure;
    let unit = machine.unit(figure.dimension());
    let own = |value: f64| {
        let value = machine.to_own(figure.dimension(), value);
        format!("{} {unit}", short(value)).trim_end().to_owned()
    };
    let (bound, value, missing) = (bound(machine, &met.requirement), met.value, -met.margin());
    if value.is_nan() {
        return format!("{} has no value: must be {bound}", figure.name());
    }
    format!(
        "{} = {}: must be {bound}, by {}",
        figure.name(),
        own(value),
        own(missing)
    )
}

/// A number with seven digits, and no more of them than it has.
fn short(value: f64) -> String {
    plain(format!("{value:.6e}").parse().unwrap_or(value))
}

/// `at least 10 m/s`.
pub fn bound(machine: &Machine, requirement: &Requirement) -> String {
    let figure = requirement.figure;
    let unit = machine.unit(figure.dimension());
    let own = |value: f64| machine.to_own(figure.dimension(), value);
    let text = match (requirement.least, requirement.most) {
        (Some(least), Some(most)) => format!("from {} to {} {unit}", own(least), own(most)),
        (Some(least), None) => format!("at least {} {unit}", own(least)),
        (None, Some(most)) => format!("at most {} {unit}", own(most)),
        (None, None) => String::new(),
    };
    text.trim_end().to_owned()
}
