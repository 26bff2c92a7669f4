//! No grid over clearance and place in the zone beats the optimum, whatever the machine and its units, and whatever is
//! required of it.

use softstop::{Machine, Parameter};
use softstop_optimize::design::Problem;
use softstop_optimize::design::figure::Figure;
use softstop_optimize::design::requirement::Requirement;
use softstop_optimize::design::search::{SearchSettings, Unmonitored, search};
use softstop_optimize::design::space::{Axis, Interval};
use softstop_testing::docs;

use crate::Outcome;
use crate::grid::of_designs;

/// Clearances, and places in the zone of each.
type Size = (usize, usize);

/// Of the daily tests.
const COARSE: Size = (48, 33);
/// Of the long run.
const DENSE: Size = (480, 401);

/// What is sought over the clearance and the place in the zone.
struct ActiveLimits {
    name: &'static str,
    problem: Problem,
}

impl ActiveLimits {
    fn new(
        name: &'static str,
        machine: Machine,
        range: Interval,
        margin: f64,
        requirements: &[Requirement],
    ) -> Self {
        let axes = vec![Axis::new(Parameter::Clearance, range)];
        let problem = Problem {
            margin,
            requirements: requirements.to_vec(),
            ..Problem::of(machine, axes)
        };
        Self { name, problem }
    }

    /// No point of a grid is better than the optimum, and the best of them comes near.
    #[track_caller]
    fn holds(&self, size: Size) -> Outcome {
        let settings = SearchSettings { evaluations: 300 };
        let found = search(&self.problem, settings, &Unmonitored, None)?;
        let (name, value) = (self.name, found.design.value);
        let grid = of_designs(&self.problem, size, |it| Some(it.value));
        let grid = grid.into_iter().fold(f64::NEG_INFINITY, f64::max);
        println!(
            "{name}: optimum {value}, best of {size:?} points {grid}, {:e} less",
            1.0 - grid / value
        );
        assert!(
            grid <= value * (1.0 + 1e-6),
            "{name}: a grid point has {grid}, the optimum {value}"
        );
        assert!(
            value - grid <= 0.1 * value,
            "{name}: the grid has {grid} only, the optimum {value}"
        );
        Ok(())
    }
}

fn stop_force(most: f64) -> Requirement {
    Requirement::at_most(Figure::StopForce, most)
}

fn margin_sn(least: f64) -> Requirement {
    Requirement::at_least(Figure::FrequencySn, least)
}

fn ratios() -> Outcome<Vec<ActiveLimits>> {
    let range = Interval::new(4.0, 20.0);
    let mut all = Vec::new();
    for name in ["unloaded", "loaded"] {
        let machine = Machine::named(name).ok_or("the paper's machine")?;
        let required = [margin_sn(0.05), stop_force(85.0)];
        all.push(ActiveLimits::new(name, machine.clone(), range, 0.25, &[]));
        all.push(ActiveLimits::new(name, machine, range, 0.0, &required));
    }
    Ok(all)
}

fn stops() -> Outcome<Vec<ActiveLimits>> {
    let range = Interval::new(4.0, 20.0);
    let stops: [&[(&str, &'static str)]; 3] = [
        &[("stop.model", "kelvinVoigt"), ("stop.stiffness", "20")],
        &[("stop.model", "rigid"), ("stop.restitution", "0.6")],
        &[
            ("stop.model", "hertz"),
            ("stop.stiffness", "100"),
            ("stop.exponent", "2"),
        ],
    ];
    let held = stops.into_iter().map(|stop| {
        let mut machine = Machine::named("unloaded").ok_or("the paper's machine")?;
        machine.apply(stop.iter().copied())?;
        Ok(ActiveLimits::new(
            stop[0].1,
            machine,
            range,
            0.0,
            &[margin_sn(0.05)],
        ))
    });
    held.collect()
}

fn press() -> Outcome<ActiveLimits> {
    let range = Interval::new(0.006, 0.04);
    let requirements = [margin_sn(3.0), stop_force(4.8e5)];
    let machine = Machine::from_toml(&std::fs::read_to_string(docs("press/press.toml"))?)?;
    Ok(ActiveLimits::new(
        "press",
        machine,
        range,
        0.0,
        &requirements,
    ))
}

#[test]
fn ratios_loaded_and_unloaded() -> Outcome {
    ratios()?.iter().try_for_each(|held| held.holds(COARSE))
}

#[test]
fn other_stops() -> Outcome {
    stops()?.iter().try_for_each(|held| held.holds(COARSE))
}

#[test]
fn a_press_in_si_units() -> Outcome {
    press()?.holds(COARSE)
}

#[test]
#[ignore = "minutes: 190,000 motions of each"]
fn dense_grids() -> Outcome {
    let all = ratios()?.into_iter().chain(stops()?).chain([press()?]);
    all.into_iter().try_for_each(|held| held.holds(DENSE))
}
