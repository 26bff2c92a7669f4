//! The report of `optimize` for people.

use softstop::{Dimension, Machine, Parameter};
use softstop_console::table::{Row, heading, number, row, table};
use softstop_dynamics::orbit::Orbit;

use super::DesignReport;
use crate::design::{Design, Problem};
use crate::optimize::reference::Reference;

/// The design beside its references, then what holds it back.
#[must_use]
pub fn optimize(
    found: &DesignReport,
    problem: &Problem,
    design: &Design,
    references: &[Reference],
) -> String {
    let margin = problem.margin;
    let name = problem.machine.name.as_deref().unwrap_or("given");
    let title = format!(
        "Hardest impact of the {name} machine, margin M = {margin} from both ends of the zone"
    );
    let mut text = heading(&title) + &table(&comparison(problem, design, references));
    text += &format!(
        "\nZone of the design: g0 = {} to s_SN = {}; the design stands at s = {} of it.\n",
        number(found.frequency_g0),
        number(found.frequency_sn),
        number(found.s),
    );
    if !found.at_limits.is_empty() {
        text += &format!("Held back by: {}.\n", found.at_limits.join(", "));
    }
    text
}

fn comparison(problem: &Problem, design: &Design, references: &[Reference]) -> Vec<Row> {
    let machine = &design.machine;
    let mut columns = vec![(machine, &design.orbit)];
    columns.extend(references.iter().map(|it| (&it.machine, &it.orbit)));
    let line = |label: &str, value: &dyn Fn(&Machine, &Orbit) -> f64| {
        let cells = columns.iter().map(|(machine, orbit)| value(machine, orbit));
        row(label, cells.map(number))
    };
    let parameter = |it: Parameter| {
        line(&machine.label_of(it), &|machine: &Machine, _: &Orbit| {
            machine.value(it).unwrap_or(f64::NAN)
        })
    };
    let velocity = |what, symbol| machine.label(what, symbol, Dimension::Velocity);
    let length = |what, symbol| machine.label(what, symbol, Dimension::Length);
    let names = references
        .iter()
        .map(|it| match it.machine.name.as_deref() {
            Some(name) if name != it.name => format!("{} ({name})", it.name),
            _ => it.name.to_owned(),
        });
    let best = design.before_impact_velocity();
    let gains = references
        .iter()
        .map(|it| format!("{:.4} x", best / it.orbit.before_impact_velocity()));
    let mut rows = vec![
        row("", ["design".to_owned()].into_iter().chain(names)),
        line(&velocity("before-impact velocity", "X'-"), &|_, orbit| {
            orbit.before_impact_velocity()
        }),
        row(
            "  design over this one",
            [String::new()].into_iter().chain(gains),
        ),
    ];
    let searched = problem.axes.iter().map(|axis| axis.parameter);
    rows.extend(searched.map(parameter));
    let preload = machine
        .value(Parameter::Preload)
        .map(|_| Parameter::Preload);
    rows.extend(
        preload
            .into_iter()
            .chain([Parameter::Frequency])
            .map(parameter),
    );
    rows.extend([
        line(&length("greatest position", "X_m"), &|_, orbit| {
            orbit.max_position
        }),
        line(&length("position at drive angle 0", "X"), &|_, orbit| {
            orbit.position
        }),
        line(&velocity("velocity at drive angle 0", "X'"), &|_, orbit| {
            orbit.velocity
        }),
        line("largest multiplier |mu|", &|_, orbit| largest(orbit)),
    ]);
    rows
}

fn largest(orbit: &Orbit) -> f64 {
    let moduli = orbit.multipliers().map(|multiplier| multiplier.norm());
    moduli.into_iter().fold(0.0, f64::max)
}
