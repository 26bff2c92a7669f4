#![allow(missing_docs)]
use softstop::methods::{Exact, Integrator};
use softstop_optimize::precision::case;
use std::time::Instant;
fn main() {
    let name = std::env::args().nth(1).unwrap();
    for case in case::cases(&name, None).unwrap() {
        let mut best = [f64::INFINITY; 3];
        for _ in 0..200 {
            let t = Instant::now();
            for _ in 0..10 {
                std::hint::black_box(Exact.integrate(&case.task).unwrap());
            }
            best[0] = best[0].min(t.elapsed().as_secs_f64() / 10.0);
            let t = Instant::now();
            for _ in 0..10 {
                std::hint::black_box(case.task.scene.motion(case.task.start).unwrap());
            }
            best[1] = best[1].min(t.elapsed().as_secs_f64() / 10.0);
            let t = Instant::now();
            for _ in 0..10 {
                let mut m = case.task.scene.motion(case.task.start).unwrap();
                let cycles = case.task.periods.floor();
                let offset = (case.task.periods - cycles) * m.clock().period();
                m.advance(softstop::Instant { cycles, offset }, &mut ())
                    .unwrap();
                std::hint::black_box(m.state());
            }
            best[2] = best[2].min(t.elapsed().as_secs_f64() / 10.0);
        }
        println!(
            "{:10} exact {:.2} us, motion() {:.2} us, unobserved {:.2} us",
            case.name,
            best[0] * 1e6,
            best[1] * 1e6,
            best[2] * 1e6
        );
    }
}
