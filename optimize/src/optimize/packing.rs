//! The design's machine as it is packed, and what no FMU could hold.

use softstop::{Dimension, Machine, Parameter, Start};
use softstop_console::failure::Failure;
use softstop_dynamics::zone::ZoneKind;
use softstop_fmu::{NotServed, StartValues};

use super::outcome::Outcome;
use crate::design::Problem;
use crate::design::space::Axis;
use crate::fmu::parameters;

/// A start that every machine with a clearance has.
const REST: Start = Start {
    position: 0.0,
    velocity: 0.0,
};

/// Refuses a machine whose design no FMU could hold, before it is searched, and what is searched beyond the range of an FMU
/// alone.
pub(super) fn can_be_packed(problem: &Problem) -> Result<(), Failure> {
    let mut machine = problem.machine.clone();
    let frequency = Axis::new(Parameter::Frequency, problem.frequency);
    for Axis {
        parameter, range, ..
    } in problem.axes.iter().chain([&frequency])
    {
        let refusal = |machine: &Machine| {
            let values = StartValues::from_scene(&machine.scene, REST);
            let is_own = |it: &NotServed| matches!(it, NotServed::OutOfRange { name, .. } if *name == parameter.name());
            values.err().filter(is_own)
        };
        let ends = [range.low, range.high]
            .into_iter()
            .filter(|it| it.is_finite());
        let ends: Vec<Machine> = ends
            .map(|end| {
                let mut changed = machine.clone();
                changed.set(*parameter, end);
                problem.link(&mut changed);
                changed
            })
            .collect();
        match (
            ends.iter().find(|it| refusal(it).is_none()),
            ends.first().and_then(refusal),
        ) {
            (Some(served), _) if refusal(&machine).is_some() => machine = served.clone(),
            (None, Some(error)) => {
                let name = machine.name(*parameter);
                return Err(Failure::usage(format!(
                    "vary.{name} = {range}: a design with {error}, as which each is packed"
                )));
            }
            _ => {}
        }
    }
    let design = Machine {
        name: Some(design_name(&machine)),
        description: None,
        ..machine.clone()
    };
    let packed = parameters(&design, machine.start);
    packed.map(drop).map_err(|error| {
        let name = machine.name.as_deref().unwrap_or_default();
        Failure::usage(format!("name = {name:?}: its design: {error:#}"))
    })
}

fn design_name(machine: &Machine) -> String {
    format!("{} design", machine.name.as_deref().unwrap_or("machine"))
}

/// The design's machine under the name of a design.
pub(super) fn named(problem: &Problem, outcome: &Outcome) -> Machine {
    let design = outcome.design();
    let interrupted = outcome.interrupted.map(|it| format!(" ({})", it.words()));
    let words = problem.words();
    let zone = match problem.zone {
        ZoneKind::Hysteresis => "inside its hysteresis zone",
        ZoneKind::SingleImpact { .. } => "of stable z = 1",
    };
    let machine = &design.machine;
    let own = |value: f64, dimension| {
        let value = format!("{value:.6} {}", machine.unit(dimension));
        value.trim_end().to_owned()
    };
    Machine {
        name: Some(design_name(machine)),
        description: Some(format!(
            "Design with the {words} {zone}: drive frequency {}, before-impact velocity {}{}",
            own(design.frequency(), Dimension::Frequency),
            own(design.before_impact_velocity(), Dimension::Velocity),
            interrupted.unwrap_or_default()
        )),
        ..machine.clone()
    }
}
