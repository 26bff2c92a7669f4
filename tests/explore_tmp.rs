#![allow(missing_docs, dead_code)]
pub use softstop::{attractors, continuation, error, integrator, orbit, scene, Ratios as R2};
#[path = "../src/transitions/mod.rs"]
mod transitions;
use softstop::Ratios;
use softstop::attractors::*;
use softstop::continuation::{Along, Parameter};
use transitions::*;
use std::time::Instant;
#[test]
fn go() {
    let family = Along::new(Ratios::unloaded(), [Parameter::Frequency]).unwrap();
    let args: Vec<f64> = std::env::var("VALS")
        .unwrap()
        .split(',')
        .map(|x| x.parse().unwrap())
        .collect();
    let r: Vec<f64> = std::env::var("RANGE")
        .unwrap()
        .split(',')
        .map(|x| x.parse().unwrap())
        .collect();
    let rules = Rules::default();
    if std::env::var("WIN").is_ok() {
        for v in &args {
            let t = Instant::now();
            let mut m = Ratios::unloaded();
            m.frequency = *v;
            let s = attractors(&m.scene().unwrap(), &rules.survey).unwrap();
            println!("== {v} {:?}", t.elapsed());
            for a in s.attractors {
                match a.kind {
                    Kind::Periodic { orbit, .. } => {
                        let t = Instant::now();
                        let w = Window::of(&family, *v, &orbit, (r[0], r[1]), &rules);
                        match w {
                            Ok(w) => println!(
                                "{} {:.3} {:?} {:.10} {:?} {:.10} {:?}",
                                w.motion,
                                a.share,
                                w.ends[0].kind,
                                w.ends[0].point.parameter,
                                w.ends[1].kind,
                                w.ends[1].point.parameter,
                                t.elapsed()
                            ),
                            Err(e) => println!("{} {:.3} ERR {e}", orbit.regime(), a.share),
                        }
                    }
                    Kind::Chaotic(c) => {
                        println!("chaos {:.3} {:.4}", a.share, c.exponents.per_period[0])
                    }
                    Kind::TransientChaos { lifetime, .. } => {
                        println!("transient {:.3} {lifetime:.0}", a.share)
                    }
                    Kind::Unsettled { .. } => println!("unsettled {:.3}", a.share),
                    _ => println!("other"),
                }
            }
        }
        return;
    }
    let t = Instant::now();
    let ex = Explorer::new(&family, (r[0], r[1]), rules, &|| true);
    for it in ex.explore(&args).unwrap() {
        let p: Vec<String> = it.path.iter().map(|m| m.to_string()).collect();
        println!(
            "{:.10} {} {} -> {} [{}] {} beyond {:.1e}",
            it.value,
            if it.rising { "up" } else { "dn" },
            it.from,
            p.join(" -> "),
            it.symbols(),
            if it.hysteresis { "hyst" } else { "rev" },
            it.beyond
        );
    }
    println!("{:?}", t.elapsed());
}
