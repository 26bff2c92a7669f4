//! `softstop-lab throughput` as users and scripts meet it. Times are not looked at.

use softstop::{Ratios, Scene, Start};
use softstop_console::machine::Regime;
use softstop_lab::throughput::check::{Plan, check};
use softstop_lab::throughput::doubt::judge;
use softstop_lab::throughput::fleet::Range;
use softstop_lab::throughput::measure::narrower;
use softstop_lab::throughput::random_machines::{Draw, Kind};
use softstop_lanes::Instructions;
use softstop_testing::Program;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const PROGRAM: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop-lab"),
    first: &["throughput"],
};

#[test]
fn the_report_holds_what_scripts_look_for() -> Outcome {
    let report = PROGRAM.json(&["--repeats", "1", "--check", "300", "--zones", "15"]);
    for key in ["cpu", "cores", "os"] {
        assert!(!report["machine"][key].is_null(), "{key}");
    }
    assert_eq!(report["scene"]["motions"], 1000);
    assert_eq!(report["scene"]["periods"], 200);
    let registers = Instructions::Widest.registers();
    assert_eq!(report["batch"]["lanes"], registers.lanes);
    assert_eq!(report["batch"]["instructions"], registers.name);
    let mut engines = vec!["safe", "scalar", "batch", "each_impact"];
    for set in narrower() {
        let name = if set == Instructions::Avx2 {
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
    let check = &report["check"];
    assert_eq!(check["trajectories"], 300);
    assert_eq!(check["different"], 0);
    assert!(check["chaotic"].is_u64() && check["handed_over"].is_u64());
    Ok(())
}

#[test]
fn the_table_is_for_people_and_the_check_can_be_left_out() {
    let text = PROGRAM.text(&["loaded", "--repeats", "1", "--check", "0", "--zones", "4"]);
    let name = Instructions::Widest.registers().name;
    assert!(text.contains("scalar") && text.contains(&format!("batch, {name}")));
    assert!(!text.contains("random motions"));
    assert!(text.contains("The loaded machine at 1000 frequencies"));
}

#[test]
fn both_engines_count_the_same_impacts_on_random_machines() -> Outcome {
    let plan = Plan {
        trajectories: 2000,
        periods: 20,
        seed: 7,
        aimed: false,
    };
    let check = check(plan).map_err(|failure| failure.to_string())?;
    let tally = check.tally;
    assert_eq!((tally.trajectories, tally.different), (2000, 0));
    assert!(tally.chaotic < 20, "{} left out", tally.chaotic);
    assert!(tally.impacts > 5000, "{} impacts", tally.impacts);
    Ok(())
}

/// Faces beside turning points of settled motions, frequencies beside changes: the million is in CONTRIBUTING.md.
#[test]
fn both_engines_end_in_the_same_states_where_machines_are_aimed_at_trouble() -> Outcome {
    let plan = Plan {
        trajectories: 512,
        periods: 600,
        seed: 37,
        aimed: true,
    };
    let tally = check(plan).map_err(|failure| failure.to_string())?.tally;
    assert_eq!(
        (tally.trajectories, tally.different),
        (512, 0),
        "{:#?}",
        tally.first
    );
    assert!(tally.leapt > 250, "{} leapt over", tally.leapt);
    Ok(())
}

#[test]
fn engines_agree_on_the_motions_that_are_timed() -> Outcome {
    let range = Range {
        machine: Regime::Unloaded,
        frequencies: (1.1, 1.4),
        motions: 20,
        periods: 30,
        start: (0.0, 14.0),
    };
    let fleet = range.fleet()?;
    let safe = fleet.safe()?.impacts;
    assert!(safe > 100);
    for set in [
        Instructions::Widest,
        Instructions::Avx2,
        Instructions::Portable,
    ] {
        assert_eq!(fleet.batch(set)?.impacts, safe);
    }
    assert_eq!(fleet.parallel(3)?.impacts, 3 * safe);
    Ok(())
}

#[test]
fn draws_repeat_themselves_and_are_of_all_kinds() -> Outcome {
    let mut kinds = [0; 4];
    let (mut one, mut same, mut other) = (Draw::new(3, 0), Draw::new(3, 0), Draw::new(3, 1));
    for _ in 0..90 {
        let drawn = one.machine()?;
        assert_eq!(drawn, same.machine()?);
        assert_ne!(drawn.1, other.machine()?.1);
        let all = [Kind::Unloaded, Kind::Loaded, Kind::Other, Kind::Power];
        let kind = all.iter().position(|kind| *kind == drawn.0);
        kinds[kind.ok_or("not aimed")?] += 1;
    }
    assert!(kinds.iter().all(|count| *count > 10), "{kinds:?}");
    Ok(())
}

/// A motion without drive that swings to a height: it turns there.
fn swing(clearance: f64) -> Result<Scene, Box<dyn std::error::Error>> {
    let mut scene = Ratios {
        clearance,
        damping: 0.0,
        ..Ratios::unloaded()
    }
    .scene()?;
    scene.excitation.amplitude = 0.0;
    Ok(scene)
}

#[test]
fn only_what_rounding_can_change_is_left_out() -> Outcome {
    let from = Start::new(-5.0, 0.0);
    for (clearance, impacts, doubtful) in [
        (5.0 + 1e-12, 0, true),
        (5.0 - 1e-12, 1, true),
        (5.0 + 1e-6, 0, false),
        (5.0 - 1e-4, 1, false),
        (6.0, 0, false),
        (4.0, 1, false),
    ] {
        let verdict = judge(&swing(clearance)?, from, 1)?;
        assert_eq!(verdict.doubtful, doubtful, "{clearance}");
        assert!(doubtful || verdict.impacts == impacts, "{clearance}");
    }
    let chaotic = Ratios {
        frequency: 0.9875,
        ..Ratios::unloaded()
    }
    .scene()?;
    let from = Start::new(0.0, 14.0);
    assert!(!judge(&chaotic, from, 5)?.doubtful);
    assert!(judge(&chaotic, from, 400)?.doubtful);
    Ok(())
}
