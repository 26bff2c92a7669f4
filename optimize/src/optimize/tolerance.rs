//! What of a design cannot be made exactly: the table `[tolerance]`, and what a task may ask of machines within it.

use serde::Deserialize;
use softstop::internals::plain_number;
use softstop::{Machine, Parameter};
use softstop_console::failure::Failure;
use softstop_dynamics::basin::wilson_interval;
use toml::{Table, Value};

use super::require::{RESERVE, SHARE};
use super::toml_leaves::{free_parameter, leaves, number, percent, read_words};
use crate::design::Problem;
use crate::design::conflict::short;
use crate::design::problem::{Objective, Tolerance, Width};
use crate::design::requirement::Scope;
use crate::design::space::Axis;
use crate::robust::{Distribution, normal_quantile};

/// Standard deviations in the half-width of a tolerance for each 1 of the process capability Cpk, of a centred process.
const DEVIATIONS: f64 = 3.0;

/// `{ half_width = 1e-4, distribution = "normal", cpk = 1.33 }` or `{ sigma = 3e-5 }`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ToleranceTable {
    half_width: Option<Value>,
    sigma: Option<Value>,
    distribution: Option<Shape>,
    cpk: Option<f64>,
}

/// How values lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Shape {
    /// Anywhere within the tolerance.
    Box,
    /// Normally.
    Normal,
}

impl ToleranceTable {
    /// The width as it is stated, and what it is the half of.
    fn read(self) -> Option<(Value, Distribution)> {
        let shape = self.distribution;
        match (self.half_width, self.sigma, self.cpk) {
            (None, Some(sigma), None) if shape != Some(Shape::Box) => {
                Some((sigma, Distribution::Normal(1.0)))
            }
            (Some(half_width), None, cpk) if shape == Some(Shape::Normal) => {
                let cpk = Some(cpk.unwrap_or(1.0)).filter(|cpk| (0.1..=10.0).contains(cpk))?;
                Some((half_width, Distribution::Normal(DEVIATIONS * cpk)))
            }
            (Some(half_width), None, None) => Some((half_width, Distribution::Box)),
            _ => None,
        }
    }
}

/// `[tolerance]`: half-widths in the machine's own units, or shares of the value such as `"2 %"`, of boxes or of normal
/// distributions.
pub(super) fn tolerances(machine: &Machine, table: &Table) -> Result<Vec<Tolerance>, Failure> {
    let mut found: Vec<Tolerance> = Vec::new();
    for (name, value) in leaves(table) {
        let (parameter, unit) = free_parameter(machine, "tolerance", &name)?;
        let said = number(value).map_or_else(|| value.to_string(), plain_number);
        let wrong = |what: &str| Failure::usage(format!("tolerance.{name} = {said}: {what}"));
        let (stated, distribution) = match value {
            Value::Table(words) => {
                let stated: Option<ToleranceTable> =
                    read_words(&format!("tolerance.{name}"), words)?;
                stated.and_then(ToleranceTable::read).ok_or_else(|| {
                    wrong(
                        "must be { half_width = NUMBER, distribution = \"normal\", cpk = NUMBER }, Cpk from 0.1 to 10 and 1 \
                         if it is not stated, { half_width = NUMBER } or { sigma = NUMBER }",
                    )
                })?
            }
            value => (value.clone(), Distribution::Box),
        };
        let share = percent(&stated).map(Width::Share);
        let width = share.or_else(|| Some(Width::Own(number(&stated)? * unit)));
        let width = width.filter(Width::is_allowed).ok_or_else(|| {
            wrong("must be a half-width, finite and >= 0, or a share such as \"2 %\", below 100 %")
        })?;
        if found.iter().any(|other| other.parameter == parameter) {
            return Err(Failure::usage(format!("tolerance.{name}: is given twice")));
        }
        found.push(Tolerance {
            parameter,
            width,
            distribution,
        });
    }
    Ok(found)
}

/// Refuses what asks for machines within tolerances where there are none.
pub(super) fn has_tolerances(
    is_exact: bool,
    objective: &Objective,
    require: &Table,
) -> Result<(), Failure> {
    let stated = [
        ("objective.of", objective.scope == Scope::Tolerances),
        ("require.tolerance_reserve", require.contains_key(RESERVE)),
    ];
    match stated.iter().find(|(_, is_stated)| is_exact && *is_stated) {
        Some((key, _)) => Err(Failure::usage(format!(
            "{key}: plays no part without [tolerance]"
        ))),
        None => Ok(()),
    }
}

/// Standard deviations of normal tolerances that a design keeps to begin with: so many that the share outside them may violate
/// requirements.
///
/// # Errors
/// [`Failure::Usage`] where a share is stated and nothing has a normal tolerance, or the machines are too few to show it.
pub(super) fn deviations(
    problem: &Problem,
    require: &Table,
    samples: usize,
) -> Result<f64, Failure> {
    let (is_normal, violating) = (problem.has_normal_tolerances(), problem.violating);
    if !is_normal && require.contains_key(SHARE) {
        let boxes = problem.tolerances.iter();
        let boxes = boxes.map(|it| format!("tolerance.{}", problem.machine.name(it.parameter)));
        return Err(Failure::usage(format!(
            "require.{SHARE}: plays no part without a normal tolerance; within boxes ({}) all machines are as required",
            boxes.collect::<Vec<_>>().join(", ")
        )));
    }
    if is_normal && wilson_interval(0, samples)[1] > violating {
        return Err(Failure::usage(format!(
            "--samples {samples}: are too few to show that a share of {} at most violates a requirement: {} machines are needed, of \
             which none does",
            plain_number(violating),
            plain_number(least_machines(violating))
        )));
    }
    Ok(normal_quantile(1.0 - 0.5 * violating))
}

/// The fewest machines of which none violates a requirement that show a share.
fn least_machines(share: f64) -> f64 {
    // The upper end of the interval of none of one is z^2 / (1 + z^2), of none of n z^2 / (n + z^2).
    let [_, one] = wilson_interval(0, 1);
    (one / (1.0 - one) * (1.0 - share) / share).ceil()
}

/// Refuses tolerances within which there are no machines even about the highest value that is searched, or that a case has.
///
/// # Errors
/// [`Failure::Usage`] naming the tolerance, and why there are none.
pub(super) fn refuse_too_wide(
    (machine, problem): (&Machine, &Problem),
    deviations: f64,
    axes: &[Axis],
) -> Result<(), Failure> {
    for tolerance in &problem.tolerances {
        let axis = axes.iter().find(|it| it.parameter == tolerance.parameter);
        let highest = axis.map(|it| it.range.high);
        let (_, factor) = tolerance.distribution.over(deviations);
        let widened = (tolerance, problem.reserve * factor);
        let cases = problem.cases.iter().filter_map(|case| {
            let value = case.value(tolerance.parameter)?;
            Some((Some(value), format!(" (case {})", case.name)))
        });
        for (value, place) in [(highest, String::new())].into_iter().chain(cases) {
            let left = leaves_machines(machine, widened, value);
            left.map_err(|words| Failure::usage(words + &place))?;
        }
    }
    Ok(())
}

/// Refuses a tolerance so many times as wide within which there are no machines even about the highest value that is searched.
fn leaves_machines(
    machine: &Machine,
    (tolerance, factor): (&Tolerance, f64),
    highest: Option<f64>,
) -> Result<(), String> {
    let (parameter, name) = (tolerance.parameter, machine.name(tolerance.parameter));
    let is_searched = highest.is_none() && parameter == Parameter::Frequency;
    let Some(value) = highest
        .or(machine.value(parameter))
        .filter(|_| !is_searched)
    else {
        return Ok(());
    };
    let stated = match tolerance.width {
        Width::Own(width) => plain_number(width),
        Width::Share(share) => format!("{} %", short(100.0 * share)),
    };
    let wider = match factor {
        1.0 => String::new(),
        factor => format!("the box is {} times as wide and ", short(factor)),
    };
    let width = factor * tolerance.width.around(value);
    if value > 0.0 && width >= value {
        let value = plain_number(value);
        return Err(format!(
            "tolerance.{name} = {stated}: {wider}is as large as the value, {value} at most, or larger"
        ));
    }
    let least = parameter.about().allowed.check(name, value - width);
    least.map(drop).map_err(|error| {
        let value = plain_number(value);
        format!("tolerance.{name} = {stated}: {wider}is too wide about {value}: {error}")
    })
}
