//! A design beside other machines.

use softstop::Parameter;
use softstop_dynamics::Orbit;

use super::{label_of, velocity};
use crate::design::Design;
use crate::optimize::reference::Reference;
use crate::page::data::{Comparison, Label, Row};

/// All parameters of the design's machine and the figures of its motion beside those of others; the chosen ones are
/// those that the search has set.
pub fn comparison(design: &Design, chosen: &[Parameter], others: &[Reference]) -> Comparison {
    let all = || {
        let own = [(&design.machine, &design.orbit)];
        own.into_iter()
            .chain(others.iter().map(|it| (&it.machine, &it.orbit)))
    };
    let figure = |label: Label, value: fn(&Orbit) -> f64| Row {
        label,
        is_chosen: false,
        values: all().map(|(_, orbit)| Some(value(orbit))).collect(),
    };
    let parameters = design.machine.parameters().map(|parameter| Row {
        label: label_of(&design.machine, parameter),
        is_chosen: chosen.contains(&parameter),
        values: all().map(|(machine, _)| machine.value(parameter)).collect(),
    });
    let largest = |orbit: &Orbit| {
        let moduli = orbit.multipliers().map(|it| it.norm());
        moduli.into_iter().fold(0.0, f64::max)
    };
    let figures = [
        figure(velocity(&design.machine), Orbit::before_impact_velocity),
        figure(Label::new("largest multiplier", "|μ|", ""), largest),
    ];
    let names = others.iter().map(Reference::title);
    Comparison {
        machines: ["design".to_owned()].into_iter().chain(names).collect(),
        rows: figures.into_iter().chain(parameters).collect(),
    }
}
