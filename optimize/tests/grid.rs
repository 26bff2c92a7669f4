//! All designs of a grid over the ranges of a problem and the places of each zone: what no search may fall behind.

use rayon::prelude::*;
use softstop::{Machine, Parameter};
use softstop_dynamics::{Zone, zone};
use softstop_optimize::design::judge::RequirementValue;
use softstop_optimize::design::space::Interval;
use softstop_optimize::design::{Design, Problem};

/// So many numbers from 0 to 1, both among them.
pub fn shares(count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(move |index| index as f64 / (count - 1) as f64)
}

/// What is asked of the designs at so many shares of the range of a problem, and at so many places in each zone within its
/// margin and the bounds of its frequency, those whose motions are stable and as required.
pub fn of_designs<T: Send>(
    problem: &Problem,
    (values, places): (usize, usize),
    asked: impl Fn(&Design) -> Option<T> + Sync,
) -> Vec<T> {
    let row = |share: f64| {
        let at: Vec<f64> = problem.axes.iter().map(|it| it.range.at(share)).collect();
        let machine = problem.machine_at(&at);
        let zone = zone::hysteresis(&machine.scene).ok();
        let design = |zone: &Zone| {
            let bounds = problem.frequency;
            let window = Interval::new(
                problem.margin.max(zone.place_of(bounds.low)),
                (1.0 - problem.margin).min(zone.place_of(bounds.high)),
            );
            let designs = shares(places).map(|it| design(problem, &machine, zone, window.at(it)));
            designs.filter_map(|it| asked(&it?)).collect::<Vec<T>>()
        };
        zone.as_ref().map(design).unwrap_or_default()
    };
    let rows: Vec<f64> = shares(values).collect();
    rows.into_par_iter().flat_map_iter(row).collect()
}

fn design(problem: &Problem, machine: &Machine, zone: &Zone, place: f64) -> Option<Design> {
    let mut design = Design {
        machine: machine.clone(),
        place,
        zone: zone.clone(),
        orbit: zone.orbit_at(place).ok().filter(|it| it.is_stable())?,
        value: f64::NAN,
        cases: Vec::new(),
    };
    Parameter::Frequency.set(&mut design.machine.scene, zone.frequency_at(place));
    let motion = design.judged().ok()?;
    let met = problem.met(&motion);
    let value = problem.sought(&motion)?;
    design.value = value;
    met.iter().all(RequirementValue::is_met).then_some(design)
}
