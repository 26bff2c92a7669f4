//! Random tasks, the same of a seed on every run.

use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};
use softstop::{Machine, Parameter};
use softstop_optimize::design::Problem;
use softstop_optimize::design::figure::{Figure, Sense};
use softstop_optimize::design::problem::{Link, Objective, Tolerance, Width};
use softstop_optimize::design::requirement::Requirement;
use softstop_optimize::design::search::{SearchSettings, Unmonitored, search};
use softstop_optimize::design::space::{Axis, Interval};

/// Numbers in [0, 1).
pub(super) struct Numbers(SplitMix64);

impl Numbers {
    pub(super) fn of_seed(seed: u64) -> Self {
        Self(SplitMix64::seed_from_u64(seed))
    }

    pub(super) fn next(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    pub(super) fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }
}

pub(crate) const PRESS: &str = "name = \"press\"\nmass = 120.0\nstiffness = 2.4e6\ndamping = 680.0\nclearance = 0.012\n\
                     contact.damping = 3060.0\n[excitation]\namplitude = 9000.0\nfrequency_hz = 27.0\n[stop]\n\
                     model = \"preloaded\"\nstiffness = 1.68e7\npreload_deflection = 0.01\n[piercing]\n\
                     stiffness = 4.8e6\nfriction = 2.4e6\nthickness = 0.002\ntravel = 0.001\n";
pub(super) const HAMMER: &str = include_str!("../tasks/hammer.toml");

fn machine(index: usize) -> Machine {
    match index {
        0 => Machine::named("unloaded").expect("the paper's machine"),
        1 => Machine::named("loaded").expect("the paper's machine"),
        2 => Machine::from_toml(PRESS).expect("a press"),
        _ => Machine::from_toml(HAMMER).expect("a hammer"),
    }
}

/// A task of a seed: three to five axes and the frequency, some of catalogues, a follower, tolerances in half of them; what is
/// required is held at some share of what the best design without it has.
pub(super) fn task(seed: u64) -> Problem {
    let mut numbers = Numbers::of_seed(seed);
    let machine = machine(numbers.below(4));
    let mut axes = Vec::new();
    let mut push = |numbers: &mut Numbers, parameter: Parameter, least: f64, most: f64| {
        let Some(value) = machine.value(parameter).filter(|value| *value > 0.0) else {
            return;
        };
        let low = value * numbers.within(least, 0.8);
        let high = value * numbers.within(1.25, most);
        axes.push(match numbers.below(4) {
            0 => {
                let count = 3 + numbers.below(5);
                let step = |index: usize| {
                    let share = index as f64 / (count - 1) as f64;
                    low * (high / low).powf(share)
                };
                Axis::of_catalogue(parameter, (0..count).map(step).collect())
            }
            _ => Axis::new(parameter, Interval { low, high }),
        });
    };
    push(&mut numbers, Parameter::Clearance, 0.2, 3.0);
    push(&mut numbers, Parameter::StopStiffness, 0.3, 3.0);
    for (parameter, most) in [
        (Parameter::Suspension, 1.5),
        (Parameter::Damping, 2.0),
        (Parameter::Preload, 1.6),
    ] {
        if numbers.next() < 0.4 {
            push(&mut numbers, parameter, 0.6, most);
        }
    }
    let follower = machine.value(Parameter::ContactDamping);
    let stop = machine.value(Parameter::StopStiffness);
    let link = follower.zip(stop).map(|(own, stop)| Link {
        parameter: Parameter::ContactDamping,
        follows: Parameter::StopStiffness,
        factor: own / stop,
        offset: 0.0,
    });
    let links = link.filter(|_| numbers.next() < 0.5).into_iter().collect();
    let tolerances = match numbers.next() < 0.5 {
        true => [
            (Parameter::Clearance, 0.01),
            (Parameter::StopStiffness, 0.03),
            (Parameter::Damping, 0.1),
            (Parameter::Frequency, 0.003),
        ]
        .map(|(parameter, share)| Tolerance::new(parameter, Width::Share(share)))
        .to_vec(),
        false => Vec::new(),
    };
    let figure = [Figure::Velocity, Figure::ImpactPower, Figure::ImpactEnergy][numbers.below(3)];
    let mut problem = Problem {
        margin: if tolerances.is_empty() { 0.1 } else { 0.0 },
        links,
        tolerances,
        objective: Objective::new(figure, Sense::Least),
        ..Problem::of(machine, axes)
    };
    let few = SearchSettings { evaluations: 200 };
    if let Ok(free) = search(&problem.relaxed(), few, &Unmonitored, None) {
        let motion = free.design.judged().expect("a motion");
        for figure in [Figure::StopForce, Figure::Stroke] {
            if numbers.next() < 0.6 {
                let bound = numbers.within(0.7, 0.95) * motion.value(figure);
                problem
                    .requirements
                    .push(Requirement::at_most(figure, bound));
            }
        }
    }
    problem
}
