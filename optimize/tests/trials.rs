//! Requirements that take many motions: the answer is the best design that meets them of all that a search has met.

use softstop::{Machine, Parameter};
use softstop_optimize::design::Problem;
use softstop_optimize::design::conflict::stated;
use softstop_optimize::design::coordinates::Candidate;
use softstop_optimize::design::figure::Figure;
use softstop_optimize::design::front::front;
use softstop_optimize::design::problem::{Tolerance, Width};
use softstop_optimize::design::requirement::Requirement;
use softstop_optimize::design::search::{
    SearchError, SearchResult, SearchSettings, Unmonitored, search,
};
use softstop_optimize::design::space::{Axis, Interval};

use crate::Outcome;

const SETTINGS: SearchSettings = SearchSettings { evaluations: 200 };
const CLEARANCE: Axis = Axis::new(Parameter::Clearance, Interval::new(5.0, 15.0));

fn problem(axes: Vec<Axis>, certainty: f64) -> Problem {
    let machine = Machine::named("unloaded").expect("the paper's machine");
    Problem {
        margin: 0.25,
        requirements: vec![Requirement::at_least(Figure::Certainty, certainty)],
        ..Problem::of(machine, axes)
    }
}

fn solve(problem: &Problem) -> Result<SearchResult, SearchError> {
    search(problem, SETTINGS, &Unmonitored, None)
}

fn candidate(found: &SearchResult) -> Candidate {
    Candidate {
        unit: found.unit.clone(),
        design: found.design.clone(),
    }
}

/// The ascent from a design that passes leads to one that fails, from whose place a better one was sought before.
#[test]
fn what_passes_is_kept_where_the_top_fails() -> Outcome {
    let problems = [0.4, 0.5, 0.6].map(|share| problem(vec![CLEARANCE], share));
    let [best, better, good] = [0, 1, 2].map(|index| solve(&problems[index]));
    let (best, better, mut found) = (best?, better?, good?);
    assert!(best.resolution.is_some(), "the best motion fails its trial");
    let before = found.design.value;
    assert!(better.design.value > before);
    found.sought_from.clone_from(&best.sought_from);
    assert!(found.go_on_from(&problems[0], &candidate(&better)));
    assert!(found.design.value >= better.design.value);
    assert!(found.tried.iter().all(|it| it.is_met()));
    Ok(())
}

/// Of designs that fail their trials the place is told at which the values lie that are told: within tolerances not that of the
/// best motion.
#[test]
fn what_fails_its_trials_is_told_with_its_own_place() -> Outcome {
    let mut problem = problem(vec![CLEARANCE], 1.0);
    // The fold comes down to this frequency at a clearance of 12.6.
    (problem.margin, problem.frequency) = (0.0, Interval::held(1.3));
    problem.tolerances = vec![Tolerance::new(Parameter::Clearance, Width::Own(0.3))];
    let Err(SearchError::NoDesign { place, reason, .. }) = solve(&problem) else {
        return Err("no design is certain".into());
    };
    assert!(reason.contains("certainty = "), "{reason}");
    let top = solve(&problem.relaxed())?;
    problem.requirements.clear();
    let places = [solve(&problem)?, top].map(|found| {
        let clearance = found.design.machine.value(Parameter::Clearance);
        let clearance = clearance.expect("a clearance");
        format!(
            ", at {}",
            stated(&problem.machine, Parameter::Clearance, clearance)
        )
    });
    assert_eq!(place, places[0]);
    assert_ne!(place, places[1]);
    Ok(())
}

/// A catalogue of dampings, and the one of its values that passes: it is found, with a design as hard as where it alone is allowed,
/// and with the fineness of the search from better values where there was one from each.
fn finds_the_damping_that_passes(catalogue: Vec<f64>, passing: f64, is_resolved: bool) -> Outcome {
    let designs = [catalogue, vec![passing]].map(|damping| {
        let axis = Axis::of_catalogue(Parameter::Damping, damping);
        let mut problem = problem(vec![axis, CLEARANCE], 0.2);
        problem.machine.set(Parameter::ContactDamping, 0.0);
        solve(&problem)
    });
    let [listed, held] = designs;
    let (listed, held) = (listed?, held?.design);
    assert_eq!(listed.resolution.is_some(), is_resolved);
    let listed = listed.design;
    assert_eq!(listed.machine.value(Parameter::Damping), Some(passing));
    assert!(listed.value >= (1.0 - 1e-9) * held.value, "{listed:?}");
    Ok(())
}

/// Without damping no motion is established, and the mass strikes the hardest.
#[test]
fn values_of_catalogues_are_tried() -> Outcome {
    finds_the_damping_that_passes(vec![0.0, 0.02], 0.02, true)
}

/// Of more choices than are all looked at, values far from those of the best designs are tried where these fail their trials, and
/// then those between.
#[test]
fn far_values_of_catalogues_are_tried() -> Outcome {
    let slow = (0..70).map(|step| f64::from(step) * 1e-6);
    finds_the_damping_that_passes(slow.chain([0.018, 0.02]).collect(), 0.018, false)
}

/// With hardly any damping the starts of many designs are not counted: where the best design has little, certainty is traded
/// among those that have more.
#[test]
fn certainty_is_traded_among_motions_that_settle_fast() -> Outcome {
    let range = Interval::new(1e-5, 0.05);
    let mut problem = problem(vec![Axis::new(Parameter::Damping, range)], 0.0);
    problem.requirements.clear();
    problem.machine.set(Parameter::ContactDamping, 0.0);
    let found = solve(&problem)?;
    let damping = found.design.machine.value(Parameter::Damping);
    assert!(damping < Some(1e-4), "{damping:?}");
    let (front, _) =
        front(&problem, &found, Figure::Certainty).map_err(|why| format!("{why:?}"))?;
    let points = &front.points;
    assert!(points.len() > 1, "{points:?}");
    assert!(
        points.is_sorted_by(|a, b| a.0 < b.0 && a.1 > b.1),
        "{points:?}"
    );
    assert!(points[points.len() - 1].0 > 0.6, "{points:?}");
    Ok(())
}

/// Where all designs have hardly any damping, the trade-off with certainty is left out with its reason, no other.
#[test]
fn certainty_is_not_traded_where_motions_settle_slowly() -> Outcome {
    let traded = [1e-5, 0.02].map(|damping| -> Outcome<Vec<Figure>> {
        let mut problem = problem(vec![CLEARANCE], 0.0);
        problem.requirements.clear();
        problem.machine.set(Parameter::Damping, damping);
        problem.machine.set(Parameter::ContactDamping, 0.0);
        let found = solve(&problem)?;
        let figures = [Figure::Certainty, Figure::StopForce].into_iter();
        let traded = figures.filter(|it| match front(&problem, &found, *it) {
            Ok(_) => true,
            Err(why) => !why.is_some_and(|why| why.contains("settle so slowly")),
        });
        Ok(traded.collect())
    });
    let [slow, usual] = traded;
    assert_eq!(slow?, [Figure::StopForce]);
    assert_eq!(usual?, [Figure::Certainty, Figure::StopForce]);
    Ok(())
}

/// A design is sought but once from a place: its first answer is kept, and is no worse than one that is sought anew from within
/// what counts as that place, as far as counted shares have an accuracy.
#[test]
fn seeking_once_from_a_place_loses_nothing() -> Outcome {
    let problem = problem(vec![CLEARANCE], 0.5);
    let found = solve(&problem)?;
    let [(unit, place)] = &found.sought_from[..] else {
        return Err("sought from one place".into());
    };
    for shift in [-9e-6, 0.0, 9e-6] {
        let mut start = candidate(&found);
        start.unit = unit.iter().map(|at| (at - shift).clamp(0.0, 1.0)).collect();
        start.design.place = place - shift;
        let mut once = found.clone();
        once.go_on_from(&problem, &start);
        assert!(once.design.value >= found.design.value);
        let mut anew = found.clone();
        anew.sought_from.clear();
        anew.go_on_from(&problem, &start);
        assert!(once.design.value >= (1.0 - 1e-3) * anew.design.value);
    }
    Ok(())
}

/// A half of a box has no better design than the box, and a narrow part has one where others have none: the borders of what
/// passes, and of the machines that have a zone, run across the axes here.
#[test]
fn a_box_is_searched_across_its_axes() -> Outcome {
    let best = |damping: [f64; 2], clearance| -> Result<f64, SearchError> {
        let [least, most] = damping;
        let axes = vec![
            Axis::new(Parameter::Clearance, Interval::new(2.0, clearance)),
            Axis::new(Parameter::Damping, Interval::new(least, most)),
        ];
        let problem = Problem {
            machine: Machine::named("loaded").expect("the paper's machine"),
            ..problem(axes, 0.7)
        };
        Ok(solve(&problem)?.design.value)
    };
    let whole = best([0.02, 0.2], 22.0)?;
    let half = best([0.11, 0.2], 12.0)?;
    assert!(whole > half, "{whole} {half}");
    assert!(best([0.09, 0.1], 12.0)? > half);
    Ok(())
}

/// Where a flip goes, a zone is there at once, and its designs pass in a strip beside that border, a thousandth of the range wide: it
/// is found.
#[test]
fn a_strip_beside_the_border_of_the_zones_is_found() -> Outcome {
    let clearance = Axis::new(Parameter::Clearance, Interval::new(2.0, 22.0));
    let mut machine = Machine::from_toml(include_str!("../../docs/scenes/loaded.toml"))?;
    machine.set(Parameter::Damping, 0.075);
    let problem = Problem {
        machine,
        ..problem(vec![clearance], 0.7)
    };
    let best = solve(&problem)?.design;
    assert!(best.value > 4.05, "{}", best.value);
    Ok(())
}

/// The value of a catalogue with the best motion that passes its trials need not be that with the best motion.
#[test]
fn each_value_of_a_catalogue_is_looked_at() -> Outcome {
    let best = |stiffness: &[f64]| -> Result<f64, Box<dyn std::error::Error>> {
        let axis = Axis::of_catalogue(Parameter::StopStiffness, stiffness.to_vec());
        let mut machine = Machine::named("loaded").ok_or("the paper's machine")?;
        machine.set(Parameter::Clearance, 8.0);
        let problem = Problem {
            machine,
            margin: 0.1,
            ..problem(vec![axis], 0.5)
        };
        Ok(solve(&problem)?.design.value)
    };
    let (soft, hard, both) = (best(&[3.0])?, best(&[7.0])?, best(&[3.0, 7.0])?);
    assert!(soft > 1.05 * hard, "{soft} {hard}");
    assert!(both > (1.0 - 1e-3) * soft, "{both} {soft}");
    Ok(())
}

/// Axes in another order are searched in another order: steps that had shrunk on a ridge ended 0.3 % below its top.
#[test]
fn a_ridge_is_climbed_in_any_order_of_axes() -> Outcome {
    let axes = [
        CLEARANCE,
        Axis::new(Parameter::StopStiffness, Interval::new(2.0, 20.0)),
    ];
    let best = [[0, 1], [1, 0]].map(|order| {
        let problem = Problem {
            margin: 0.0,
            ..problem(order.map(|index| axes[index].clone()).to_vec(), 0.7)
        };
        solve(&problem).map(|found| found.design.value)
    });
    let [one, other] = best;
    let (one, other) = (one?, other?);
    assert!((one / other - 1.0).abs() < 1e-3, "{one} {other}");
    Ok(())
}
