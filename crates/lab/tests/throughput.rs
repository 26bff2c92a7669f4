//! `softstop-lab throughput` as users and scripts meet it. Times are not looked at.

use softstop_console::machine::PaperMachine;
use softstop_lab::throughput::batch::Range;
use softstop_lab::throughput::measure::narrower;
use softstop_lanes::{InstructionLimit, run_with};
use softstop_testing::Program;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const PROGRAM: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop-lab"),
    first: &["throughput"],
};

#[test]
fn the_report_holds_what_scripts_look_for() -> Outcome {
    let report = PROGRAM.json(&["--repeats", "1", "--zones", "15"]);
    for key in ["cpu", "cores", "os"] {
        assert!(!report["machine"][key].is_null(), "{key}");
    }
    assert_eq!(report["scene"]["motions"], 1000);
    assert_eq!(report["scene"]["periods"], 200);
    let registers = InstructionLimit::Widest.registers();
    assert_eq!(report["batch"]["lanes"], registers.lanes);
    assert_eq!(report["batch"]["instructions"], registers.name);
    let mut engines = vec!["safe", "scalar", "batch", "each_impact"];
    for set in narrower() {
        let name = if set == InstructionLimit::Avx2 {
            "avx2"
        } else {
            "portable"
        };
        assert_eq!(report[name]["lanes"], set.registers().lanes);
        engines.push(name);
    }
    for engine in engines {
        let rate = &report[engine]["periods_per_second_per_core"];
        assert!(rate.as_f64().ok_or("rate")? > 0.0, "{engine}");
    }
    let leapt = |engine: &str| report[engine]["leapt"].as_u64();
    assert!(leapt("batch") > leapt("each_impact"));
    let cores = &report["both_cores"];
    assert!(cores["threads"].as_u64().ok_or("threads")? >= 1);
    assert!(cores["periods_per_second"].is_f64() && cores["factor"].is_f64());
    let zones = &report["zones"];
    assert_eq!(zones["grid"]["edge"], 4);
    assert!(zones["found"].as_u64().ok_or("found")? >= 8);
    assert!(zones["zones_per_second_per_core"].is_f64());
    Ok(())
}

#[test]
fn the_table_is_for_people() {
    let text = PROGRAM.text(&["loaded", "--repeats", "1", "--zones", "4"]);
    let name = InstructionLimit::Widest.registers().name;
    assert!(text.contains("scalar") && text.contains(&format!("batch, {name}")));
    assert!(text.contains("The loaded machine at 1000 frequencies"));
}

#[test]
fn engines_agree_on_the_motions_that_are_timed() -> Outcome {
    let range = Range {
        machine: PaperMachine::Unloaded,
        frequencies: (1.1, 1.4),
        motions: 20,
        periods: 30,
        start: (0.0, 14.0),
    };
    let batch = range.batch()?;
    let safe = batch.safe()?.impacts;
    assert!(safe > 100);
    for set in [
        InstructionLimit::Widest,
        InstructionLimit::Avx2,
        InstructionLimit::Portable,
    ] {
        let count = batch.follow(|it, jobs| run_with(set, it, jobs, &mut ()))?;
        assert_eq!(count.impacts, safe);
    }
    assert_eq!(batch.parallel(3)?.impacts, 3 * safe);
    Ok(())
}
