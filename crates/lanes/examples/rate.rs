//! How fast the lanes go on all cores: `rate MOTIONS PERIODS REPEATS` follows the paper's unloaded machine at so many
//! frequencies, each machine lowered first, and prints the seconds of each repeat after one that is not counted, and the
//! impacts. `benches/python.py` compares them with the Python package.

use std::time::Instant;

use rayon::prelude::*;
use softstop::{CheckedScene, Ratios, Start};
use softstop_lanes::{Job, LoweredMachine, run_parallel};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let numbers = std::env::args().skip(1).map(|word| word.parse());
    let numbers: Vec<u64> = numbers.collect::<Result<_, _>>()?;
    let [motions, periods, repeats] = numbers[..] else {
        return Err("usage: rate MOTIONS PERIODS REPEATS".into());
    };
    let step = (1.4 - 0.95) / (motions.max(2) - 1) as f64;
    let scene = |number| {
        let frequency = 0.95 + step * number as f64;
        Ratios::unloaded().at_frequency(frequency).scene()?.check()
    };
    let scenes: Vec<CheckedScene> = (0..motions).map(scene).collect::<Result<_, _>>()?;
    for repeat in 0..=repeats {
        let begin = Instant::now();
        let machines: Vec<LoweredMachine> = scenes.par_iter().map(LoweredMachine::new).collect();
        let job = |machine| Job {
            machine,
            start: Start::new(0.0, 14.0),
            periods,
        };
        let jobs: Vec<Job> = (0..machines.len()).map(job).collect();
        let (outcomes, _) = run_parallel(&machines, &jobs, |_| ());
        let impacts: u64 = outcomes.iter().map(|it| it.impacts).sum();
        if repeat > 0 {
            println!("{} {impacts}", begin.elapsed().as_secs_f64());
        }
    }
    Ok(())
}
