//! Designs for several operating points, against what each of them has by plain calls.

mod tolerances;

use std::slice;

use approx::assert_relative_eq;
use softstop::{Machine, Parameter};
use softstop_dynamics::figure::{Figure, Sense};
use softstop_dynamics::zone::{ZoneKind, hysteresis};
use softstop_dynamics::{Orbit, Zone};
use softstop_optimize::design::case::Case;
use softstop_optimize::design::constraint::{ActiveLimit, Limit};
use softstop_optimize::design::judge::RequirementValue;
use softstop_optimize::design::requirement::Requirement;
use softstop_optimize::design::search::{
    SearchError, SearchResult, SearchSettings, Unmonitored, search,
};
use softstop_optimize::design::space::{Axis, Interval};
use softstop_optimize::design::{Design, Problem};
use softstop_testing::number;

use crate::Outcome;
use crate::report::{Written, design};

const SETTINGS: SearchSettings = SearchSettings { evaluations: 300 };
const MARGIN: f64 = 0.2;

/// The paper's machine with its stop, over the clearance.
fn drawing() -> Problem {
    let machine = Machine::named("unloaded").expect("the paper's machine");
    let clearance = Interval::new(2.0, 22.0);
    let axes = vec![
        Axis::new(Parameter::StopStiffness, Interval::held(7.0)),
        Axis::new(Parameter::Clearance, clearance),
    ];
    Problem {
        margin: MARGIN,
        ..Problem::of(machine, axes)
    }
}

/// A case in which a parameter is so many times the drawing's.
fn case(problem: &Problem, (parameter, factor): (Parameter, f64), weight: f64) -> Case {
    let value = problem.machine.value(parameter).expect("a value");
    Case {
        name: format!("{factor} times"),
        weight,
        changes: vec![(parameter, factor * value)],
    }
}

/// With 20 % more damping beside the drawing.
fn damped(weight: f64) -> Problem {
    let problem = drawing();
    let cases = vec![case(&problem, (Parameter::Damping, 1.2), weight)];
    Problem { cases, ..problem }
}

fn solve(problem: &Problem) -> Result<SearchResult, SearchError> {
    search(problem, SETTINGS, &Unmonitored, None)
}

#[test]
fn a_case_like_the_drawing_changes_nothing() -> Outcome {
    let alone = drawing();
    let cases = vec![case(&alone, (Parameter::Damping, 1.0), 0.5)];
    let both = Problem {
        cases,
        ..alone.clone()
    };
    let [one, other] = [solve(&alone)?.design, solve(&both)?.design];
    assert_relative_eq!(both.sought_of(&other), one.value, max_relative = 1e-9);
    assert_eq!(other.cases[0].value.to_bits(), other.value.to_bits());
    Ok(())
}

/// The mean is not above that of the best of each alone, and none of the designs that are best alone has a higher one.
#[test]
fn the_mean_is_the_best_mean() -> Outcome {
    for weight in [0.0, 0.5, 3.0] {
        let both = damped(weight);
        let design = solve(&both)?.design;
        let mut bound = solve(&drawing())?.design.value;
        let in_case = both.in_cases().remove(0);
        let machine = in_case.machine_at(&[7.0, 10.0]);
        let alone = Problem {
            machine,
            ..drawing()
        };
        bound = (bound + weight * solve(&alone)?.design.value) / (1.0 + weight);
        let mean = both.sought_of(&design);
        let own = (design.value + weight * design.cases[0].value) / (1.0 + weight);
        assert_relative_eq!(mean, own, max_relative = 1e-14);
        assert!(mean <= bound * (1.0 + 1e-9), "{mean} {bound}");
        let frequency = |it: &Design| it.orbit.scene.excitation.frequency;
        assert_relative_eq!(
            frequency(&design),
            frequency(&design.cases[0]),
            max_relative = 1e-14
        );
        for it in slice::from_ref(&design).iter().chain(&design.cases) {
            let inside = MARGIN - 1e-9..=1.0 - MARGIN + 1e-9;
            assert!(inside.contains(&it.place), "{}", it.place);
        }
    }
    Ok(())
}

/// The zone of a machine with its clearance, and its velocity at a frequency.
fn zone(machine: &Machine, clearance: f64) -> Option<Zone> {
    let mut scene = machine.scene.clone();
    scene.clearance = clearance;
    hysteresis(&scene).ok()
}

fn velocity(zone: &Zone, frequency: f64) -> Option<f64> {
    let orbit = zone.orbit_at(zone.place_of(frequency)).ok();
    let orbit = orbit.filter(Orbit::is_stable)?;
    Some(orbit.before_impact_velocity())
}

/// The highest mean at a clearance, with frequencies from a grid over what the margins of all zones leave.
fn on_grid(machines: &[(Machine, f64)], clearance: f64, places: usize) -> Option<f64> {
    let zones = machines.iter().map(|(machine, _)| zone(machine, clearance));
    let zones: Vec<Zone> = zones.collect::<Option<_>>()?;
    let ends = |share: f64| zones.iter().map(move |it| it.frequency_at(share));
    let low = ends(MARGIN).fold(0.0, f64::max);
    let high = ends(1.0 - MARGIN).fold(f64::INFINITY, f64::min);
    let sum: f64 = machines.iter().map(|it| it.1).sum();
    let mean = |index: usize| {
        let frequency = low + (high - low) * index as f64 / (places - 1) as f64;
        let parts = zones.iter().zip(machines);
        let parts = parts.map(|(zone, (_, weight))| Some(weight * velocity(zone, frequency)?));
        Some(parts.sum::<Option<f64>>()? / sum)
    };
    (0..places)
        .filter(|_| low <= high)
        .filter_map(mean)
        .reduce(f64::max)
}

/// Over clearance and frequency, all over the range and closely about the optimum.
#[test]
fn no_point_of_a_grid_is_better() -> Outcome {
    let problem = Problem {
        cases: vec![
            case(&drawing(), (Parameter::Damping, 1.2), 0.5),
            case(&drawing(), (Parameter::Preload, 0.9), 2.0),
        ],
        ..drawing()
    };
    let design = solve(&problem)?.design;
    let found = problem.sought_of(&design);
    let machines = [&problem].into_iter().cloned().chain(problem.in_cases());
    let machines = machines.map(|it| it.machine_at(&[7.0, 10.0]));
    let machines: Vec<(Machine, f64)> = machines.zip([1.0, 0.5, 2.0]).collect();
    let best = |low: f64, high: f64, count: usize, places: usize| {
        let clearances = (0..=count).map(|it| low + (high - low) * it as f64 / count as f64);
        let best = clearances.filter_map(|it| on_grid(&machines, it, places));
        best.fold(f64::NEG_INFINITY, f64::max)
    };
    let coarse = best(2.0, 22.0, 100, 7);
    assert!(coarse <= found * (1.0 + 1e-9), "{coarse} {found}");
    let near = design.machine.scene.clearance;
    let fine = best(near - 0.02, near + 0.02, 80, 21);
    assert!(fine <= found * (1.0 + 1e-9), "{fine} {found}");
    assert!(fine >= found * (1.0 - 1e-6), "{fine} {found}");
    Ok(())
}

/// A bound of the force that the drawing alone keeps unasked holds the design back in the case with less damping.
#[test]
fn what_binds_in_a_case_alone_binds() -> Outcome {
    let unasked = solve(&drawing())?.design;
    let figure = Figure::StopForce;
    let most = drawing().value(&unasked.judged()?, figure);
    let problem = Problem {
        requirements: vec![Requirement::at_most(figure, most)],
        cases: vec![case(&drawing(), (Parameter::Damping, 0.8), 0.0)],
        ..drawing()
    };
    let found = solve(&problem)?;
    let case = &problem.in_cases()[0];
    let force = |problem: &Problem, design: &Design| -> Outcome<f64> {
        Ok(problem.value(&design.judged()?, figure))
    };
    assert_relative_eq!(
        force(case, &found.design.cases[0])?,
        most,
        max_relative = 1e-6
    );
    assert!(force(&problem, &found.design)? < 0.999 * most);
    assert!(found.design.value < 0.999 * unasked.value);
    let limit = ActiveLimit {
        limit: Limit::Required(figure, Sense::Most),
        case: Some(0),
    };
    assert!(found.limits.contains(&limit), "{:?}", found.limits);
    Ok(())
}

/// Where the frequency is held a case may run at another one; among all motions of z = 1 too.
#[test]
fn a_case_has_a_frequency_of_its_own() -> Outcome {
    for kind in [
        ZoneKind::Hysteresis,
        ZoneKind::SingleImpact {
            between: (1.15, 1.15),
        },
    ] {
        let mut problem = Problem {
            zone: kind,
            frequency: Interval::held(1.15),
            ..drawing()
        };
        problem.cases = vec![Case {
            name: "slow".to_owned(),
            weight: 1.0,
            changes: vec![(Parameter::Frequency, 1.12)],
        }];
        let found = solve(&problem)?.design;
        let case = &found.cases[0];
        assert_relative_eq!(case.frequency(), 1.12, max_relative = 1e-12);
        assert_relative_eq!(found.frequency(), 1.15, max_relative = 1e-12);
        let zone = zone(&case.machine, case.machine.scene.clearance).ok_or("a zone")?;
        let alone = velocity(&zone, case.orbit.scene.excitation.frequency).ok_or("a motion")?;
        assert_relative_eq!(alone, case.before_impact_velocity(), max_relative = 1e-9);
    }
    Ok(())
}

/// Trials are made in every case, and told with it.
#[test]
fn trials_are_made_in_every_case() -> Outcome {
    let mut problem = damped(1.0);
    problem.requirements = vec![Requirement::at_least(Figure::Certainty, 0.5)];
    let found = solve(&problem)?;
    let cases: Vec<Option<usize>> = found.tried.iter().map(|it| it.case).collect();
    assert_eq!(cases, [None, Some(0)]);
    assert!(found.tried.iter().all(RequirementValue::is_met));
    Ok(())
}

/// What a user reads of them, in every form; without them there is none of it.
#[test]
fn reports_tell_every_case() -> Outcome {
    let task = "machine = \"unloaded\"\n[vary]\nstop.stiffness = 7\nclearance = [2, 22]\n[tolerance]\nclearance = 0.02\n\
                [require]\nstop_force = 150\n[objective]\nof = \"worst\"\n[[case]]\nname = \"more <damping>\"\nweight = 0.5\ndamping = 0.06\n\
                [[case]]\nweight = 0\nstop.preload = 80\n";
    let file = tempfile::NamedTempFile::with_suffix(".toml")?;
    std::fs::write(&file, task)?;
    let Written { text, page, report } = design(&format!(
        "--evaluations 100 --samples 4096 --config {}",
        file.path().display()
    ))?;
    for told in [
        "Highest before-impact velocity of the worst machine, weighted mean of 2 operating points",
        "In each case",
        "more <damping>",
        "in any case           0",
    ] {
        assert!(text.contains(told), "{told}: {text}");
    }
    let cases = report.list("cases");
    let names: Vec<&str> = cases.iter().filter_map(|it| it["case"].as_str()).collect();
    assert_eq!(names, ["drawing", "more <damping>", "2"]);
    let [drawing, damped] = [0, 1].map(|index: usize| number(&cases[index], "value"));
    for it in &cases[..2] {
        let [worst, value] = ["worst", "value"].map(|key| number(it, key));
        assert_relative_eq!(worst, value, max_relative = 1e-9);
    }
    let mean = (drawing + 0.5 * damped) / 1.5;
    assert_relative_eq!(report.number("objective/value"), mean, max_relative = 1e-14);
    let requirements = report.list("requirements");
    assert_eq!(requirements.len(), 3);
    for it in requirements {
        assert_eq!((&it["met"], &it["violating"]), (&true.into(), &0.0.into()));
    }
    assert_eq!(report.at("tolerances/machines/rejected"), 0);
    assert!(report.text("cases.csv").starts_with("case,changes,weight"));
    assert!(report.text("requirements.csv").starts_with("case,name,"));
    assert!(page.contains("more &lt;damping&gt;") && page.contains("id=\"cases\""));
    Ok(())
}
