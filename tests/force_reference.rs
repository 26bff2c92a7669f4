//! Motions under polynomial forces against independent 40-digit integrations (tests/reference/force.py).

use serde_json::Value;
use softstop::{PhaseKind, Simulation, Start};
use softstop_testing::is_near;
use softstop_testing::reference::{FORCE, list, number};
use softstop_testing::scenes::scene;
use softstop_testing::tolerance::MOTION;

/// Rounding errors, in units of 2^-53 times the growth of a perturbation, that a motion may show.
const ALLOWED: f64 = 600.0;

/// Seconds after an impact at which it is looked at.
const AFTER: f64 = 1e-9;

/// What there is to compare at a time.
enum Mark<'a> {
    Sample(&'a Value),
    Impact(&'a Value),
    /// The middle of a rest.
    Rest(f64),
}

/// All there is to compare, in order of time.
fn marks(case: &Value) -> Vec<(f64, Mark<'_>)> {
    let samples = list(case, "samples").iter();
    let mut marks: Vec<_> = samples
        .map(|sample| (number(sample, "time"), Mark::Sample(sample)))
        .collect();
    let last = marks.last().expect("samples").0;
    let impacts = list(case, "impacts").iter();
    marks.extend(impacts.map(|impact| (number(impact, "time") + AFTER, Mark::Impact(impact))));
    marks.extend(list(case, "rests").iter().filter_map(|rest| {
        let from = number(rest, "from");
        let to = if rest["to"].is_null() {
            last
        } else {
            number(rest, "to")
        };
        let middle = 0.5 * (from + to);
        (to - from > 1e-6 && middle < last).then(|| (middle, Mark::Rest(number(rest, "position"))))
    }));
    marks.sort_by(|a, b| a.0.total_cmp(&b.0));
    marks.retain(|mark| mark.0 <= last);
    marks
}

struct Check<'a> {
    name: &'a Value,
    machine: Simulation,
    growth: f64,
    stored: f64,
    worst: f64,
}

impl Check<'_> {
    /// Takes up a deviation, in units of what is allowed.
    fn note(&mut self, what: &str, deviation: f64, scale: f64) {
        let allowed = ALLOWED * 0.5 * f64::EPSILON * (1.0 + self.growth) * scale;
        let ratio = deviation.abs() / allowed;
        assert!(
            ratio <= 1.0,
            "{}: {what} at {} s is {deviation:e} off, {ratio:.2} times what is allowed",
            self.name,
            self.machine.time()
        );
        self.worst = self.worst.max(ratio);
    }

    fn sample(&mut self, expected: &Value) {
        self.growth = self.growth.max(number(expected, "growth"));
        let (x, v) = (number(expected, "position"), number(expected, "velocity"));
        let sample = self.machine.sample();
        let scale = 1.0 + x.abs() + v.abs();
        self.note("position", sample.position - x, scale);
        self.note("velocity", sample.velocity - v, scale);
        let energy = self.machine.energy();
        let defect = energy.supplied - energy.dissipated - (energy.mechanical - self.stored);
        let turnover = energy.supplied.abs() + energy.dissipated + energy.mechanical;
        assert!(
            is_near(defect, 0.0, 10.0 * MOTION * turnover.max(1.0)),
            "{}: energy defect {defect:e}",
            self.name
        );
    }

    fn impact(&mut self, expected: &Value) {
        let (time, velocity) = (number(expected, "time"), number(expected, "velocity"));
        let found = self.machine.last_impact().expect("an impact");
        // A slow touch is known the less in time, and both hang on the growth up to here, which is
        // noted at samples only.
        let scale = 10.0 * (10.0 + time + velocity) / velocity.min(1.0);
        self.note("time of impact", found.time - time, scale);
        self.note("velocity of impact", found.velocity - velocity, scale);
    }
}

#[test]
fn motions_under_polynomial_forces_agree_with_forty_digits() {
    let cases = list(&FORCE, "cases");
    assert!(cases.len() >= 30);
    for case in cases {
        let scene = scene(&case["scene"]);
        let start = Start::new(number(case, "position"), number(case, "velocity"));
        let force: Vec<f64> = list(&case["scene"], "force")
            .iter()
            .map(|derivative| derivative.as_f64().expect("a derivative"))
            .collect();
        let mut machine = Simulation::new(&scene, start).expect("valid");
        machine.set_force(&force).expect("finite");
        let mut check = Check {
            name: &case["name"],
            stored: machine.energy().mechanical,
            machine,
            growth: 1.0,
            worst: 0.0,
        };
        for (time, mark) in marks(case) {
            check.machine.advance(time).expect("bounded");
            match mark {
                Mark::Sample(sample) => check.sample(sample),
                Mark::Impact(impact) => check.impact(impact),
                Mark::Rest(position) => {
                    let sample = check.machine.sample();
                    let rests = matches!(sample.phase, PhaseKind::Resting | PhaseKind::Stuck);
                    assert!(rests, "{}: {:?} at {time} s", check.name, sample.phase);
                    check.note("rest", sample.position - position, 1.0 + position.abs());
                }
            }
        }
        println!("{}: {:.3} of what is allowed", check.name, check.worst);
    }
}
