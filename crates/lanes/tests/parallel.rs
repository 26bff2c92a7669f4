//! A batch on all threads: the same result for any number of them, and watchers hear of the right jobs and may end it.

use std::ops::ControlFlow;

use rayon::ThreadPoolBuilder;
use softstop::{Ratios, Scene, Start};
use softstop_lanes::{BatchObserver, Job, LoweredMachine, Outcome, run, run_parallel};
use softstop_testing::tolerance::SOLVED;
use softstop_testing::{assert_near, hertz};

const JOBS: usize = 600;
const PERIODS: u64 = 12;

fn fleet() -> (Vec<LoweredMachine>, Vec<Job>) {
    let machine = |number: usize| {
        let frequency = 0.95 + 0.05 * number as f64;
        let ratios = Ratios {
            frequency,
            ..Ratios::unloaded()
        };
        LoweredMachine::new(&ratios.scene().expect("valid").check().expect("valid"))
    };
    let job = |number: usize| Job {
        machine: number % 9,
        start: Start {
            position: -8.0 + 0.02 * number as f64,
            velocity: 14.0 - 0.03 * number as f64,
        },
        periods: PERIODS,
    };
    ((0..9).map(machine).collect(), (0..JOBS).map(job).collect())
}

/// Counts the impacts of each job that it hears of.
struct Heard(Vec<(usize, f64)>);

impl BatchObserver for Heard {
    fn observed(&self) -> (bool, bool) {
        (true, false)
    }

    fn impact(&mut self, job: usize, _: u64, _: f64, velocity: f64) {
        self.0.push((job, velocity));
    }
}

fn on(threads: usize) -> (Vec<Outcome>, Vec<(usize, f64)>) {
    let (machines, jobs) = fleet();
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    let (outcomes, watches) = pool.expect("threads").install(|| {
        run_parallel(&machines, &jobs, |range| {
            assert!(!range.is_empty() && range.end <= JOBS);
            Heard(Vec::new())
        })
    });
    let heard = watches.into_iter().flat_map(|watch| watch.0);
    (outcomes, heard.collect())
}

/// Ends its batch.
struct Ends;

impl BatchObserver for Ends {
    fn goes_on(&mut self) -> ControlFlow<()> {
        ControlFlow::Break(())
    }
}

/// In the lanes, and where the safe engine follows; it would be hours until the ends of these jobs.
#[test]
fn a_batch_ends_where_its_watcher_says_so() {
    let (mut machines, mut jobs) = fleet();
    let linear = machines[0].clone();
    let rough = Scene {
        stop: hertz(30.0, 1.2, 0.0),
        ..Ratios::unloaded().scene().expect("valid")
    };
    let slow = LoweredMachine::new(&rough.check().expect("valid"));
    assert!(linear.is_for_lanes() && !slow.is_for_lanes());
    for machine in [linear, slow] {
        machines.fill(machine);
        for job in &mut jobs {
            job.periods = 1 << 40;
            job.start.position = job.start.position.min(-1.0);
        }
        let outcomes = run(&machines, &jobs, &mut Ends);
        assert!(outcomes.iter().all(|outcome| outcome.error.is_none()));
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, on(5));
}

#[test]
fn each_job_has_its_own_outcome_and_impacts() {
    let (machines, jobs) = fleet();
    let (outcomes, heard) = on(2);
    let expected = run(&machines, &jobs, &mut ());
    assert_eq!(outcomes.len(), JOBS);
    let mut counts = [0; JOBS];
    for (job, velocity) in heard {
        assert!(velocity > 0.0);
        counts[job] += 1;
    }
    assert!(counts.iter().sum::<u64>() > 2000);
    for (job, (outcome, expected)) in outcomes.iter().zip(&expected).enumerate() {
        assert_eq!(outcome.impacts, counts[job], "{job}");
        assert_eq!(outcome.impacts, expected.impacts, "{job}");
        assert_near(outcome.end.position, expected.end.position, 10.0 * SOLVED);
    }
}
