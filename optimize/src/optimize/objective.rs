//! What a task seeks: the table `[objective]`.

use serde::Deserialize;
use softstop::internals::{did_you_mean, nearest};
use softstop::{Machine, Parameter};
use softstop_console::failure::Failure;

use crate::design::figure::{Figure, Sense};
use crate::design::problem::Objective;
use crate::design::requirement::Scope;

/// What is sought if nothing is said.
const VELOCITY: &str = Figure::Velocity.name();

/// `[objective]`.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Goal {
    maximise: Option<String>,
    minimise: Option<String>,
    of: Option<Whose>,
}

/// Whose figure counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Whose {
    /// That of the drawing's machine.
    Drawing,
    /// That of the worst machine within the tolerances.
    Worst,
}

/// What is sought: the highest before-impact velocity, if nothing is said.
pub(super) fn objective(machine: &Machine, goal: &Goal) -> Result<Objective, Failure> {
    let (name, sense, says) = match (&goal.maximise, &goal.minimise) {
        (None, None) => (&VELOCITY.to_owned(), Sense::Least, "maximise"),
        (Some(name), None) => (name, Sense::Least, "maximise"),
        (None, Some(name)) => (name, Sense::Most, "minimise"),
        (Some(_), Some(_)) => {
            return Err(Failure::usage(
                "objective: only one of maximise and minimise can be given",
            ));
        }
    };
    let figure = known(&format!("objective.{says} = "), name)?;
    let is_sought = matches!(
        figure,
        Figure::Velocity
            | Figure::ImpactEnergy
            | Figure::ImpactPower
            | Figure::StrokeWork
            | Figure::DriveForce
            | Figure::DrivePower
            | Figure::StopForce
    );
    if !is_sought {
        return Err(Failure::usage(format!(
            "objective.{says} = {name}: must be velocity, impact_energy, impact_power, stroke_work, drive_force, \
             drive_power or stop_force; what else counts goes to [require]"
        )));
    }
    if let Some(lacks) = lacks(machine, figure) {
        return Err(Failure::usage(format!(
            "objective.{says} = {name}: this machine has no {lacks}"
        )));
    }
    let scope = match goal.of {
        Some(Whose::Worst) => Scope::Tolerances,
        Some(Whose::Drawing) | None => Scope::Drawing,
    };
    Ok(Objective {
        figure,
        sense,
        scope,
    })
}

pub(super) fn known(place: &str, name: &str) -> Result<Figure, Failure> {
    Figure::named(name).ok_or_else(|| {
        let names: Vec<&'static str> = Figure::ALL.iter().map(|it| it.name()).collect();
        let meant = did_you_mean(nearest(name, &names));
        Failure::usage(format!(
            "{place}{name}: unknown figure{meant}; known are {}",
            names.join(", ")
        ))
    })
}

/// What a machine would have to have for a figure.
pub(super) fn lacks(machine: &Machine, figure: Figure) -> Option<&'static str> {
    let scene = &machine.scene;
    match figure {
        Figure::CutThrough | Figure::MissingStrips | Figure::StrokeWork
            if scene.piercing.is_none() =>
        {
            Some("strip (piercing.thickness)")
        }
        Figure::RigidGap if scene.rigid.is_none() => Some("rigid stop behind (rigid.travel)"),
        Figure::DriveForce
            if Parameter::Amplitude.is_unit() && machine.value(Parameter::Amplitude).is_none() =>
        {
            Some("drive amplitude of its own: it speaks ratios, whose unit of force is F0")
        }
        _ => None,
    }
}
