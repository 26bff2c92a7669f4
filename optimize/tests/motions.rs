//! `softstop motions` as users and scripts meet it: the coexisting motions of Peterka 2003, Figs. 8 and 9.

use approx::assert_abs_diff_eq;
use softstop_testing::tolerance::{MOTION, printed};

use serde_json::Value;
use softstop_testing::Program;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const MOTIONS: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop"),
    first: &["motions"],
};

/// The motions of a machine, few starts each.
fn found(arguments: &[&str]) -> Result<Vec<Value>, Box<dyn std::error::Error>> {
    let few = ["--starts", "96", "--patience", "300000", "--format", "json"];
    let output = MOTIONS.run(&[arguments, &few[..]].concat());
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {message}");
    assert!(
        message.is_empty(),
        "nothing is drawn on no terminal: {message}"
    );
    let report: Value = serde_json::from_slice(&output.stdout)?;
    assert_eq!(report["lost"], 0);
    Ok(report["motions"].as_array().ok_or("no list")?.clone())
}

/// The order of impacts of a periodic motion, or the kind of another one.
fn names(motions: &[Value]) -> Vec<&str> {
    let words = motions
        .iter()
        .map(|motion| motion["order"].as_str().or(motion["kind"].as_str()));
    let mut names: Vec<&str> = words.map(|word| word.unwrap_or("?")).collect();
    names.sort_unstable();
    names
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

#[test]
fn the_coexisting_motions_of_four_frequencies_are_found() -> Outcome {
    let cases: [(&str, &[&str]); 4] = [
        ("0.9526475", &["0", "transient_chaos"]),
        ("0.95365", &["1-0-0-0-0-0-0-0-0-0", "chaos"]),
        ("0.9875", &["1-1-0", "1-1-0-0", "chaos"]),
        // Of (2/4)A the z = 1/2 that it doubles from: its flip is at 0.9884970.
        ("0.9885", &["1-0", "1-1-0", "1-1-0-0"]),
    ];
    for (frequency, expected) in cases {
        let motions = found(&["--set", &format!("eta={frequency}")])?;
        assert_eq!(names(&motions), expected, "eta = {frequency}");
    }
    Ok(())
}

#[test]
fn point_a_has_its_figures() -> Outcome {
    let motions = found(&[])?;
    assert_eq!(names(&motions), ["0", "1"]);
    let one = motions.iter().find(|motion| motion["order"] == "1");
    let one = one.ok_or("no z = 1")?;
    assert_eq!(one["z"], "1");
    let near = |key: &str, expected: f64, width: f64| {
        let found = number(&one[key]);
        println!("{key}");
        assert_abs_diff_eq!(found, expected, epsilon = width);
    };
    near("position", 6.901_267_951_548, 1e-10);
    near("velocity", 9.516_655_745_459, 1e-10);
    near("max_position", 10.260_59, 5e-6);
    let velocity = number(&one["before_impact_velocities"][0]);
    assert_abs_diff_eq!(velocity, 6.494_627, epsilon = printed(6));
    let modulus = number(&one["multipliers"][0]["modulus"]);
    assert_abs_diff_eq!(modulus * modulus, 0.7858, epsilon = printed(4));
    // The exponent per drive period is the logarithm of the larger multiplier.
    let exponent = number(&one["exponents"]["per_period"][0]);
    assert_abs_diff_eq!(exponent, modulus.ln(), epsilon = MOTION);
    let shares: f64 = motions.iter().map(|motion| number(&motion["share"])).sum();
    assert_abs_diff_eq!(shares, 1.0, epsilon = MOTION);
    Ok(())
}

#[test]
fn chaos_that_fills_the_plane_is_one_motion() -> Outcome {
    // Its logs are too short to visit the same cells of any fine grid.
    let motions = found(&["--set", "clearance=-1", "--transient", "200"])?;
    assert_eq!(names(&motions), ["3", "chaos"]);
    Ok(())
}

#[test]
fn a_seed_gives_other_starts_and_the_same_motions() -> Outcome {
    let [one, other] = ["1", "2"].map(|seed| found(&["--set", "eta=0.9885", "--seed", seed]));
    let (one, other) = (one?, other?);
    assert_ne!(one, other);
    assert_eq!(names(&one), names(&other));
    Ok(())
}

#[test]
fn the_text_tells_regime_certainty_and_exponents() {
    let text = MOTIONS.text(&["--frequency", "0.9885", "--starts", "64"]);
    for words in [
        "z = 2/4",
        "1-1-0-0",
        "multipliers",
        "Lyapunov exponents",
        "returns to within",
    ] {
        assert!(text.contains(words), "{words} is not in {text}");
    }
}

#[test]
fn values_that_cannot_be_are_refused_by_name_value_and_range() {
    for (flag, value, told) in [
        ("--starts", "0", "starts = 0: must be 1 to 1000000"),
        ("--longest", "20000", "longest = 20000: must be 1 to 10000"),
        ("--transient", "0", "transient = 0: must be 1 to 1000000"),
        ("--frequency", "-1", "frequency"),
    ] {
        MOTIONS.refuses(&[flag, value], &[told]);
    }
}

/// `motions` and `basin` take starts from one box, which holds the machine's own motions and is told.
#[test]
fn one_box_of_starts_for_all_commands() -> Outcome {
    let folder = tempfile::tempdir()?;
    let basin = Program {
        first: &["basin"],
        ..MOTIONS
    };
    let scenes = format!("{}/../docs/scenes", env!("CARGO_MANIFEST_DIR"));
    for machine in [
        &["unloaded", "--clearance", "0.5"][..],
        &["loaded"],
        &["loaded", "--clearance", "1"],
        &["unloaded", "--stiffness", "1000"],
        &[&format!("{scenes}/rigid.toml")],
        &[&format!("{scenes}/kelvin-voigt.toml")],
    ] {
        let few = ["--starts", "8", "--seed", "3", "--transient", "700"];
        let report = MOTIONS.json(&[machine, &few].concat());
        let plane = basin.json_into(folder.path(), &[machine, &["--size", "10"]].concat());
        let (position, velocity) = (&report["region_position"], &report["region_velocity"]);
        assert_eq!(plane["grid"]["across"]["range"], *position, "{machine:?}");
        assert_eq!(plane["grid"]["up"]["range"], *velocity, "{machine:?}");
        assert!(
            plane["warning"].is_null(),
            "{machine:?}: {}",
            plane["warning"]
        );
        let holds = |range: &Value, value: &Value| {
            number(&range[0]) <= number(value) && number(value) <= number(&range[1])
        };
        for motion in report["motions"].as_array().ok_or("no list")? {
            let is_inside =
                holds(position, &motion["position"]) && holds(velocity, &motion["velocity"]);
            assert!(
                motion["position"].is_null() || is_inside,
                "{machine:?}: {motion}"
            );
        }
        let folder = folder.path().to_str().ok_or("path")?;
        let text = basin.text(&[machine, &["--size", "10", "--output", folder]].concat());
        let told = format!(
            "{:.4} <= x <= {:.4}",
            number(&position[0]),
            number(&position[1])
        );
        assert!(text.contains(&told), "{told} is not in {text}");
        assert!(MOTIONS.text(&[machine, &few].concat()).contains(&told));
    }
    Ok(())
}
