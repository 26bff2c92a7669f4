//! What a task seeks: the table `[objective]`.

use std::slice;

use serde::Deserialize;
use softstop::internals::{Expression, did_you_mean, nearest_name};
use softstop::{Machine, Parameter, Stop};
use softstop_console::failure::Failure;

use crate::design::cost::{Cost, Term};
use crate::design::figure::{Figure, Sense};
use crate::design::problem::Objective;
use crate::design::requirement::Scope;

/// What is sought if nothing is said.
const VELOCITY: &str = Figure::Velocity.name();

/// `[objective]`.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Goal {
    maximise: Option<Names>,
    minimise: Option<Names>,
    of: Option<Whose>,
    /// The formula of [`Figure::Cost`].
    pub(super) cost: Option<String>,
}

/// One figure, or all that a front trades.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged, expecting = "expected a figure or a list of figures")]
enum Names {
    One(String),
    Several(Vec<String>),
}

impl Names {
    fn all(&self) -> &[String] {
        match self {
            Self::One(name) => slice::from_ref(name),
            Self::Several(names) => names,
        }
    }
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

/// Objectives of a front at most.
pub(super) const MAX_OBJECTIVES: usize = 5;

/// What is sought, the first to be maximised in front: the highest before-impact velocity, if nothing is said.
pub(super) fn objectives(machine: &Machine, goal: &Goal) -> Result<Vec<Objective>, Failure> {
    let usual = Names::One(VELOCITY.to_owned());
    let sides = match (&goal.maximise, &goal.minimise) {
        (None, None) => [(Some(&usual), Sense::Least), (None, Sense::Most)],
        (Some(Names::One(_)), Some(Names::One(_))) => {
            return Err(Failure::usage(
                "objective: only one of maximise and minimise can be given, or lists of figures for a front of designs",
            ));
        }
        (most, least) => [(most.as_ref(), Sense::Least), (least.as_ref(), Sense::Most)],
    };
    let named = sides.into_iter().flat_map(|(names, sense)| {
        let names = names.map_or(&[][..], Names::all).iter();
        names.map(move |name| (name, sense))
    });
    let named: Vec<(&String, Sense)> = named.collect();
    let is_front = named.len() > 1;
    let scope = match goal.of {
        Some(Whose::Worst) => Scope::Tolerances,
        Some(Whose::Drawing) | None => Scope::Drawing,
    };
    let mut all: Vec<Objective> = Vec::new();
    for (name, sense) in named {
        let figure = sought(machine, goal, (name, sense), is_front)?;
        if all.iter().any(|it| it.figure == figure) {
            return Err(Failure::usage(format!("objective: {name} is given twice")));
        }
        all.push(Objective {
            figure,
            sense,
            scope,
        });
    }
    match all.len() {
        0 => Err(Failure::usage("objective: the lists name no figure")),
        count if count > MAX_OBJECTIVES => Err(Failure::usage(format!(
            "objective: {count} figures are too many for a front: {MAX_OBJECTIVES} at most"
        ))),
        _ => Ok(all),
    }
}

/// A figure that can be sought, alone or in a front.
fn sought(
    machine: &Machine,
    goal: &Goal,
    (name, sense): (&str, Sense),
    is_front: bool,
) -> Result<Figure, Failure> {
    let says = match sense {
        Sense::Least => "maximise",
        Sense::Most => "minimise",
    };
    let figure = known(&format!("objective.{says} = "), name, &[])?;
    let wrong = |what: &str| Failure::usage(format!("objective.{says} = {name}: {what}"));
    match is_front {
        true if !is_traded(figure) => {
            return Err(wrong(
                "cannot be traded: it takes many motions, or is infinite where nothing bounds it; it goes to [require]",
            ));
        }
        true if figure == Figure::Share && sense == Sense::Most => {
            return Err(wrong("a margin can only be maximised"));
        }
        false if !SOUGHT.contains(&figure) && figure != Figure::Cost => {
            let further = match is_traded(figure) {
                true => ", or into lists of two figures or more: a front trades it",
                false => "",
            };
            let names = SOUGHT.map(Figure::name).join(", ");
            return Err(wrong(&format!(
                "must be {names} or cost; what else counts goes to [require]{further}"
            )));
        }
        _ => {}
    }
    match lacks(machine, goal, figure) {
        Some(lacks) => Err(wrong(&lacks)),
        None => Ok(figure),
    }
}

/// The figures that can be the only one that is sought, beside the cost.
const SOUGHT: [Figure; 7] = [
    Figure::Velocity,
    Figure::ImpactEnergy,
    Figure::ImpactPower,
    Figure::StrokeWork,
    Figure::DriveForce,
    Figure::DrivePower,
    Figure::StopForce,
];

/// Whether a figure can be one of those that a front trades: one motion and its zone tell it, and it is finite.
pub(super) const fn is_traded(figure: Figure) -> bool {
    let is_unbounded = matches!(
        figure,
        Figure::FrequencyPd | Figure::ClearanceSn | Figure::ClearancePd
    );
    !figure.is_trial() && !is_unbounded
}

/// The figure of a name, which may as well be one of others at its place.
pub(super) fn known(place: &str, name: &str, others: &[&'static str]) -> Result<Figure, Failure> {
    Figure::named(name).ok_or_else(|| {
        let names = Figure::ALL.iter().map(|it| it.name());
        let names: Vec<&str> = names.chain(others.iter().copied()).collect();
        let meant = did_you_mean(nearest_name(name, &names));
        Failure::usage(format!(
            "{place}{name}: unknown figure{meant}; known are {}",
            names.join(", ")
        ))
    })
}

/// What machine or task would have to have for a figure.
pub(super) fn lacks(machine: &Machine, goal: &Goal, figure: Figure) -> Option<String> {
    let scene = &machine.scene;
    let lacks = match figure {
        Figure::Cost if goal.cost.is_none() => {
            return Some("no formula states it: objective.cost = \"...\" does".to_owned());
        }
        Figure::CutThrough | Figure::MissingStrips | Figure::StrokeWork
            if scene.piercing.is_none() =>
        {
            Some("strip (piercing.thickness)")
        }
        Figure::StopForce | Figure::StopDeflection
            if matches!(scene.stop, Stop::None | Stop::Rigid { .. }) =>
        {
            Some("soft stop (stop.model)")
        }
        Figure::RigidGap if scene.rigid.is_none() => Some("rigid stop behind (rigid.travel)"),
        Figure::DriveForce
            if Parameter::Amplitude.is_unit() && machine.value(Parameter::Amplitude).is_none() =>
        {
            Some("drive amplitude of its own: it is stated in ratios, whose unit of force is F0")
        }
        _ => None,
    };
    lacks.map(|lacks| format!("this machine has no {lacks}"))
}

/// Reads a formula of parameters, in the machine's own units, and figures of its motion.
pub(super) fn cost(machine: &Machine, text: &str) -> Result<Cost, Failure> {
    let wrong = |what: String| Failure::usage(format!("objective.cost = {text:?}: {what}"));
    let expression = Expression::parse(text).map_err(wrong)?;
    let term =
        |name: &String| Term::named(machine, name).ok_or_else(|| wrong(unknown(machine, name)));
    let terms = expression.names().iter().map(term);
    let terms = terms.collect::<Result<Vec<_>, Failure>>()?;
    Ok(Cost::new(text, expression, terms))
}

/// Why a name stands for nothing, and what would.
fn unknown(machine: &Machine, name: &str) -> String {
    let figures = Figure::ALL
        .iter()
        .filter(|it| it.is_of_motion() && **it != Figure::Cost);
    let parameters = machine.parameters().map(|it| machine.name(it));
    let known: Vec<&str> = parameters.chain(figures.map(|it| it.name())).collect();
    let what = match Figure::named(name) {
        Some(Figure::Cost) => "cost cannot follow from itself".to_owned(),
        Some(_) => format!("{name} is not told by one motion"),
        None => format!(
            "{name} is no parameter of this machine and no figure{}",
            did_you_mean(nearest_name(name, &known))
        ),
    };
    format!("{what}; known are {}", known.join(", "))
}
