//! What a design costs: the formula `objective.cost`.

use softstop::Machine;
use softstop::internals::{Expression, did_you_mean, nearest_name};
use softstop_console::failure::Failure;

use crate::design::cost::{Cost, Term};
use crate::design::figure::Figure;

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
