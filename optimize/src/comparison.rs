//! A design beside its references: one table, a record for each quantity.

use softstop::{Dimension, Machine, Parameter, UnitSystem};
use softstop_console::record::Record;
use softstop_dynamics::Orbit;

use crate::design::figure::Figure;
use crate::design::{Design, Problem};
use crate::optimize::reference::Reference;

/// The table while it is made.
struct Table<'a> {
    problem: &'a Problem,
    /// The design's machine, in whose units all is stated.
    machine: &'a Machine,
    /// The machines and their motions by their names, the design first.
    all: Vec<(&'static str, Machine, &'a Orbit)>,
    records: Vec<Record>,
}

/// The figures and all parameters of a design, in its machine's own units, with those of its references.
pub(crate) fn comparison(
    problem: &Problem,
    design: &Design,
    references: &[Reference],
) -> Vec<Record> {
    let own = ("design", design.machine.clone(), &design.orbit);
    let others = references.iter().map(|it| {
        let machine = stated_like(&design.machine, &it.machine);
        (it.name, machine, &it.orbit)
    });
    let mut table = Table {
        problem,
        machine: &design.machine,
        all: [own].into_iter().chain(others).collect(),
        records: Vec::new(),
    };
    table.add_figures(design.before_impact_velocity());
    for parameter in design.machine.parameters() {
        table.add_parameter(parameter);
    }
    table.records
}

impl Table<'_> {
    /// A quantity by its name, symbol and unit, and how it was chosen.
    fn add(
        &mut self,
        [name, symbol, unit]: [&str; 3],
        chosen: String,
        value: &dyn Fn(&Machine, &Orbit) -> Option<f64>,
    ) {
        let head = Record::default().with("quantity", "", name);
        let head = match self.machine.unit_system {
            UnitSystem::Ratios => head.with("symbol", "", symbol).hidden("unit", unit),
            _ => head.hidden("symbol", "").with("unit", "", unit),
        };
        let mut record = head.with("chosen", "", chosen);
        for (name, machine, orbit) in &self.all {
            record = record.with(name, "", value(machine, orbit));
        }
        self.records.push(record);
    }

    /// A figure of the motions in SI units.
    fn add_figure(
        &mut self,
        [name, symbol]: [&str; 2],
        dimension: Dimension,
        is_sought: bool,
        value: &dyn Fn(&Orbit) -> Option<f64>,
    ) {
        let unit = self.machine.unit(dimension);
        let chosen = if is_sought { "sought" } else { "" };
        self.add(
            [name, symbol, unit],
            chosen.to_owned(),
            &|machine, orbit| Some(machine.to_own(dimension, value(orbit)?)),
        );
    }

    /// What is sought, and what the motions do beside a design of this velocity.
    fn add_figures(&mut self, velocity: f64) {
        let problem = self.problem;
        let sought = problem.objective.figure;
        let by_velocity = sought == Figure::Velocity;
        let cost = problem.cost.as_ref().map(|_| Figure::Cost);
        let cost = cost.filter(|it| *it != sought);
        for figure in [sought].into_iter().chain(cost) {
            if figure != Figure::Velocity && figure.is_of_motion() {
                let (name, dimension) = (figure.meaning(), figure.dimension());
                self.add_figure([name, ""], dimension, figure == sought, &|orbit| {
                    problem.value_of_motion(figure, orbit)
                });
            }
        }
        let [number, length, speed] = [Dimension::Number, Dimension::Length, Dimension::Velocity];
        let impact = ["before-impact velocity", "X′₋"];
        self.add_figure(impact, speed, by_velocity, &|orbit| {
            Some(orbit.before_impact_velocity())
        });
        let design = self.all[0].2;
        let gain = ["velocity, design over this one", ""];
        self.add_figure(gain, number, false, &|orbit| {
            let is_other = !std::ptr::eq(orbit, design);
            is_other.then(|| velocity / orbit.before_impact_velocity())
        });
        self.add_figure(["greatest position", ""], length, false, &|orbit| {
            Some(orbit.max_position)
        });
        self.add_figure(["position at time 0", ""], length, false, &|orbit| {
            Some(orbit.position)
        });
        self.add_figure(["velocity at time 0", ""], speed, false, &|orbit| {
            Some(orbit.velocity)
        });
        self.add_figure(["largest multiplier |μ|", ""], number, false, &|orbit| {
            let moduli = orbit.monodromy.multipliers().map(|it| it.norm());
            moduli.into_iter().reduce(f64::max)
        });
    }

    /// A parameter as the design's machine states it; a preload that is stated as a deflection as a force, too.
    fn add_parameter(&mut self, parameter: Parameter) {
        let machine = self.machine;
        let (name, symbol) = machine.meaning_of(parameter);
        let chosen = chosen(self.problem, parameter);
        let label = [name, symbol, machine.unit_of(parameter)];
        self.add(label, chosen, &|machine, _| machine.value(parameter));
        if parameter == Parameter::Preload && machine.preload_deflection.is_some() {
            let (about, unit) = (parameter.about(), machine.unit(Dimension::Force));
            let label = [about.meaning, about.symbol, unit];
            self.add(label, String::new(), &|machine, _| {
                Some(machine.to_own(Dimension::Force, parameter.get(&machine.scene)?))
            });
        }
    }
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
