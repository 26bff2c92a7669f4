//! All stable z = 1: the pile driver of the guide, against a dense grid of orbits that knows no zones, and against the
//! hysteresis zone.

use softstop::{Dimension, Machine, Parameter};
use softstop_dynamics::Orbit;
use softstop_dynamics::orbit::find;
use softstop_dynamics::zone::ZoneKind;
use softstop_optimize::design::search::{SearchSettings, Unmonitored, search};
use softstop_optimize::design::space::{Axis, Interval};
use softstop_optimize::design::{Design, Problem};
use softstop_testing::assert_near;

use super::{Outcome, SOFTSTOP};

const FREQUENCIES: Interval = Interval::new(8.0, 25.0);

fn machine() -> Machine {
    let text = include_str!("../../docs/pile-driver.toml");
    Machine::from_toml(text).expect("a machine")
}

/// The pile driver over its clearance and frequency.
fn problem(zone: ZoneKind, clearance: Interval) -> Problem {
    let axes = vec![Axis::new(Parameter::Clearance, clearance)];
    Problem {
        zone,
        frequency: FREQUENCIES,
        ..Problem::of(machine(), axes)
    }
}

fn whole() -> ZoneKind {
    let si = |end| machine().to_si(Dimension::Frequency, end);
    ZoneKind::SingleImpact {
        between: (si(FREQUENCIES.low), si(FREQUENCIES.high)),
    }
}

fn solve(problem: &Problem) -> Design {
    let settings = SearchSettings { evaluations: 200 };
    let found = search(problem, settings, &Unmonitored, None);
    found.expect("a design").design
}

/// The velocity of the motion that Newton's method finds from a neighbour, or else from scratch; none without one.
fn velocity(clearance: f64, hertz: f64, near: &mut Option<Orbit>) -> Option<f64> {
    let mut machine = machine();
    machine.set(Parameter::Clearance, clearance);
    machine.set(Parameter::Frequency, hertz);
    let by_neighbour = near
        .as_ref()
        .map(|it| Orbit::find_near(&machine.scene, it.state()));
    let is_one = |orbit: &Orbit| orbit.is_stable() && orbit.impacts.len() == 1;
    let orbit = by_neighbour.and_then(Result::ok).filter(is_one);
    let orbit = orbit.or_else(|| find(&machine.scene).ok().filter(is_one))?;
    let velocity = orbit.before_impact_velocity();
    *near = Some(orbit);
    Some(velocity)
}

#[test]
fn the_optimum_is_that_of_a_dense_grid() {
    let clearances = Interval::new(0.004, 0.02);
    let design = solve(&problem(whole(), clearances));
    let own = design.before_impact_velocity();
    let mut best = (0.0, 0.0, 0.0);
    let mut look = |centre: (f64, f64), width: (f64, f64), count: i32| {
        for row in -count..=count {
            let mut near = None;
            for column in -count..=count {
                let part = |index: i32| f64::from(index) / f64::from(count);
                let clearance =
                    (centre.0 + width.0 * part(row)).clamp(clearances.low, clearances.high);
                let hertz =
                    (centre.1 + width.1 * part(column)).clamp(FREQUENCIES.low, FREQUENCIES.high);
                if let Some(velocity) = velocity(clearance, hertz, &mut near)
                    && velocity > best.0
                {
                    best = (velocity, clearance, hertz);
                }
            }
        }
        best
    };
    let mut width = (0.008, 8.5);
    let mut found = look((0.012, 16.5), width, 10);
    for _ in 0..4 {
        width = (0.3 * width.0, 0.3 * width.1);
        found = look((found.1, found.2), width, 5);
    }
    assert!(own >= found.0 * (1.0 - 1e-9), "{own} {found:?}");
    assert_near(own, found.0, 1e-4 * found.0);
    assert!(design.orbit.scene.excitation.frequency < design.zone.frequency_g0);
}

/// Every design of the hysteresis zone is one of all stable z = 1.
#[test]
fn it_is_no_worse_than_in_the_hysteresis_zone() {
    let clearances = Interval::new(0.012, 0.03);
    let [part, whole] =
        [ZoneKind::Hysteresis, whole()].map(|kind| solve(&problem(kind, clearances)));
    let [one, other] = [&part, &whole].map(Design::before_impact_velocity);
    assert!(other >= one, "{other} {one}");
    assert!(part.zone.is_hysteresis() && !whole.zone.is_hysteresis());
}

/// The task of the guide, as it stands there: the design strikes by itself, and is reached within the force on the way.
#[test]
fn the_task_of_the_guide_is_solved() -> Outcome {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/pile-driver.toml");
    let report = SOFTSTOP.report(&format!("optimize {file} --no-report"));
    assert_eq!(report.at("design/zone"), "z = 1");
    assert!(report.number("design/frequency") < report.number("design/frequency_g0"));
    let told = report.at("design/starting").as_str().ok_or("words")?;
    assert!(told.contains("no motion without impacts"), "{told}");
    let works = |it: &&serde_json::Value| it["reaches"] == true && it["allowed"] == true;
    let way = report.list("run_up").iter().find(works).ok_or("a way")?;
    let force = way["stop_force"].as_f64().ok_or("a force")?;
    assert!(force > 1e5 && force <= 8e5, "{force}");
    let all = report.list("requirements").iter();
    assert!(all.map(|it| &it["met"]).all(|met| met == true));
    Ok(())
}
