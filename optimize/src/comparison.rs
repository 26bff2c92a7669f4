//! A design beside its references: one table, a record for each quantity.

use softstop::{Dimension, Machine, Parameter, UnitSystem};
use softstop_console::record::Record;
use softstop_dynamics::Orbit;

use crate::design::figure::Figure;
use crate::design::{Design, Problem};
use crate::optimize::reference::Reference;

/// A value of a machine and its motion, in the machine's own units.
type ComparedValue<'a> = &'a dyn Fn(&Machine, &Orbit) -> Option<f64>;
/// A value of a motion, in SI units.
type FigureOf<'a> = dyn Fn(&Orbit) -> Option<f64> + 'a;

/// The figures and all parameters of a design, in its machine's own units, with those of its references.
pub(crate) fn comparison(
    problem: &Problem,
    design: &Design,
    references: &[Reference],
) -> Vec<Record> {
    let machine = &design.machine;
    let own = ("design", machine.clone(), &design.orbit);
    let others = references
        .iter()
        .map(|it| (it.name, stated_like(machine, &it.machine), &it.orbit));
    let all: Vec<(&'static str, Machine, &Orbit)> = [own].into_iter().chain(others).collect();
    let record = |[name, symbol, unit]: [&str; 3], chosen: &str, value: ComparedValue<'_>| {
        let head = Record::default().with("quantity", "", name);
        let head = match machine.unit_system {
            UnitSystem::Ratios => head.with("symbol", "", symbol).hidden("unit", unit),
            _ => head.hidden("symbol", "").with("unit", "", unit),
        };
        let head = head.with("chosen", "", chosen.to_owned());
        all.iter().fold(head, |record, (name, machine, orbit)| {
            record.with(name, "", value(machine, orbit))
        })
    };
    let figure = |[name, symbol]: [&str; 2], dimension, chosen, value: &FigureOf<'_>| {
        let label = [name, symbol, machine.unit(dimension)];
        record(label, chosen, &|machine, orbit| {
            Some(machine.to_own(dimension, value(orbit)?))
        })
    };
    let sought = problem.objective.figure;
    let chosen_if = |is_sought| if is_sought { "sought" } else { "" };
    let cost = problem.cost.as_ref().map(|_| Figure::Cost);
    let figures = [sought].into_iter().chain(cost.filter(|it| *it != sought));
    let figures = figures.filter(|it| *it != Figure::Velocity && it.is_of_motion());
    let mut records = Vec::from_iter(figures.map(|it| {
        let (name, chosen) = (it.meaning(), chosen_if(it == sought));
        figure([name, ""], it.dimension(), chosen, &|orbit| {
            problem.value_of_motion(it, orbit)
        })
    }));
    let [number, length, speed] = [Dimension::Number, Dimension::Length, Dimension::Velocity];
    let by_velocity = chosen_if(sought == Figure::Velocity);
    let velocity = design.before_impact_velocity();
    let motion: [([&str; 2], Dimension, &str, &FigureOf<'_>); 6] = [
        (
            ["before-impact velocity", "X′₋"],
            speed,
            by_velocity,
            &|it| Some(it.before_impact_velocity()),
        ),
        (["velocity, design over this one", ""], number, "", &|it| {
            let is_other = !std::ptr::eq(it, &design.orbit);
            is_other.then(|| velocity / it.before_impact_velocity())
        }),
        (["greatest position", ""], length, "", &|it| {
            Some(it.max_position)
        }),
        (["position at time 0", ""], length, "", &|it| {
            Some(it.position)
        }),
        (["velocity at time 0", ""], speed, "", &|it| {
            Some(it.velocity)
        }),
        (["largest multiplier |μ|", ""], number, "", &|it| {
            let moduli = it.monodromy.multipliers().map(|it| it.norm());
            moduli.into_iter().reduce(f64::max)
        }),
    ];
    records.extend(
        motion.map(|(name, dimension, chosen, value)| figure(name, dimension, chosen, value)),
    );
    for parameter in machine.parameters() {
        let (name, symbol) = machine.meaning_of(parameter);
        let label = [name, symbol, machine.unit_of(parameter)];
        let value: ComparedValue<'_> = &|machine, _| machine.value(parameter);
        records.push(record(label, &chosen(problem, parameter), value));
        // A preload that is stated as a deflection as a force, too.
        if parameter == Parameter::Preload && machine.preload_deflection.is_some() {
            let about = parameter.about();
            records.push(figure(
                [about.meaning, about.symbol],
                Dimension::Force,
                "",
                &|it| parameter.get(&it.scene),
            ));
        }
    }
    records
}

/// A machine that states its preload as another one does, as a force or as a deflection.
fn stated_like(other: &Machine, machine: &Machine) -> Machine {
    let deflection = || {
        let preload = Parameter::Preload.get(&machine.scene)?;
        Some(preload / Parameter::StopStiffness.get(&machine.scene)?)
    };
    Machine {
        preload_deflection: other.preload_deflection.and_then(|_| deflection()),
        ..machine.clone()
    }
}

/// How the search has come to the value of a parameter; empty if it is as it was given.
fn chosen(problem: &Problem, parameter: Parameter) -> String {
    let machine = &problem.machine;
    let mut links = problem.links.iter();
    if let Some(link) = links.find(|link| link.parameter == parameter) {
        return format!("follows {}", machine.name(link.follows));
    }
    match problem.range_of(parameter) {
        Some(range) if !range.is_held() => "searched".to_owned(),
        _ => String::new(),
    }
}
