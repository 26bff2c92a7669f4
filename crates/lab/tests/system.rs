//! `softstop-lab system`: the coupling converges as it should, strips that fail leave z = 1 alone, and the fold of the
//! zone is where a motor jumps.

use serde_json::Value;
use softstop_testing::Program;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const PROGRAM: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop-lab"),
    first: &["system"],
};

fn draft(study: &str) -> Result<Value, Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let found = PROGRAM.json_into(folder.path(), &[study, "--draft"]);
    for kind in ["svg", "csv"] {
        let file = folder.path().join(format!("{study}.{kind}"));
        assert!(std::fs::read_to_string(file)?.len() > 200);
    }
    Ok(found)
}

fn rows<'a>(found: &'a Value, name: &str) -> &'a [Value] {
    found[name].as_array().map_or(&[], Vec::as_slice)
}

#[test]
fn plain_steps_are_of_order_one_the_others_of_order_two() -> Outcome {
    let found = draft("order")?;
    let orders = rows(&found, "orders").iter();
    let orders: Vec<f64> = orders.filter_map(|it| it[1].as_f64()).collect();
    for (seen, expected) in orders.iter().zip([1.0, 2.0, 2.0]) {
        assert!((seen - expected).abs() < 0.15, "{orders:?}");
    }
    assert_eq!(orders.len(), 3);
    Ok(())
}

/// As the paper says of its machine (Peterka 2003, section 5), and on a motor as well: not near the fold.
#[test]
fn strips_that_fail_cost_no_stroke_away_from_the_fold() -> Outcome {
    let found = draft("strips")?;
    let runs = rows(&found, "runs");
    let lowest = runs.iter().filter_map(|it| it["frequency"].as_f64());
    let lowest = lowest.fold(f64::INFINITY, f64::min);
    let own: Vec<&Value> = runs.iter().filter(|it| it["frequency"] == lowest).collect();
    assert!(own.len() > 20);
    for run in own {
        assert_eq!(
            (&run["fate"], &run["missed"]),
            (&"kept".into(), &0.into()),
            "{run}"
        );
    }
    Ok(())
}

/// A fast rise of the voltage passes the resonance without impacts, a slow one lands in z = 1. A soft motor climbs with
/// impacts up to a fold and comes down without (Sommerfeld 1902).
#[test]
fn only_a_slow_run_up_lands_in_z_1_and_a_motor_jumps() -> Outcome {
    let found = draft("run-up")?;
    for run in rows(&found, "run_ups") {
        let rise = run["rise"].as_f64().ok_or("rise")?;
        let expected = if rise < 100.0 { "passes" } else { "lands" };
        assert_eq!(run["end"], expected, "{run}");
    }
    let is_rated = |it: &&Value| {
        it["voltage"]
            .as_f64()
            .is_some_and(|it| (it - 1.0).abs() < 1e-9)
    };
    let at_rated = rows(&found, "plateaus").iter().filter(is_rated);
    let speeds: Vec<f64> = at_rated.filter_map(|it| it["speed"].as_f64()).collect();
    let [up, down] = speeds[..] else {
        return Err(format!("{speeds:?}").into());
    };
    assert!((up - 1.15).abs() < 5e-3 && down > 1.5, "{speeds:?}");
    Ok(())
}
