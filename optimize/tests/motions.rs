//! `softstop motions` as users and scripts meet it: the coexisting motions of Peterka 2003, Figs. 8 and 9.

use serde_json::Value;
use softstop_testing::report::at;
use softstop_testing::tolerance::{MOTION, printed};
use softstop_testing::{assert_near, has_near, number, words};

use crate::{Outcome, SOFTSTOP};

/// The motions of a machine, few starts each.
fn found(line: &str) -> Outcome<Vec<Value>> {
    let line = format!("motions --starts 96 --patience 300000 --format json {line}");
    let output = SOFTSTOP.run(&words(&line));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{line}: {message}");
    assert!(message.is_empty(), "drawn on no terminal: {message}");
    let report: Value = serde_json::from_slice(&output.stdout)?;
    assert_eq!(report["lost"], 0);
    Ok(report["motions"].as_array().ok_or("no list")?.clone())
}

/// The order of impacts of a periodic motion, or the kind of another one.
fn names(motions: &[Value]) -> Vec<&str> {
    let words = motions
        .iter()
        .map(|it| it["order"].as_str().or(it["kind"].as_str()));
    let mut names: Vec<&str> = words.map(|word| word.unwrap_or("?")).collect();
    names.sort_unstable();
    names
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
        let motions = found(&format!("--set eta={frequency}"))?;
        assert_eq!(names(&motions), expected, "eta = {frequency}");
    }
    Ok(())
}

#[test]
fn point_a_has_its_figures() -> Outcome {
    let motions = found("")?;
    assert_eq!(names(&motions), ["0", "1"]);
    let one = motions.iter().find(|motion| motion["order"] == "1");
    let one = one.ok_or("no z = 1")?;
    assert_eq!(one["z"], "1");
    // The exponent per drive period is the logarithm of the larger multiplier.
    let modulus = number(one, "multipliers/0/modulus");
    let figures = [
        ("position", 6.901_267_951_548, 1e-10),
        ("velocity", 9.516_655_745_459, 1e-10),
        ("max_position", 10.260_59, 5e-6),
        ("before_impact_velocities/0", 6.494_627, printed(6)),
        ("exponents/per_period/0", modulus.ln(), MOTION),
    ];
    has_near(one, &figures);
    assert_near(modulus * modulus, 0.7858, printed(4));
    let shares: f64 = motions.iter().map(|motion| number(motion, "share")).sum();
    assert_near(shares, 1.0, MOTION);
    Ok(())
}

#[test]
fn chaos_that_fills_the_plane_is_one_motion() -> Outcome {
    // Its logs are too short to visit the same cells of any fine grid.
    let motions = found("--set clearance=-1 --transient 200")?;
    assert_eq!(names(&motions), ["3", "chaos"]);
    Ok(())
}

#[test]
fn a_seed_gives_other_starts_and_the_same_motions() -> Outcome {
    let one = found("--set eta=0.9885 --seed 1")?;
    let other = found("--set eta=0.9885 --seed 2")?;
    assert_ne!(one, other);
    assert_eq!(names(&one), names(&other));
    Ok(())
}

#[test]
fn the_text_tells_regime_certainty_and_exponents() {
    let text = SOFTSTOP.text(&words("motions --set eta=0.9885 --starts 64"));
    let told = [
        "z = 2/4",
        "1-1-0-0",
        "multipliers",
        "Lyapunov exponents",
        "returns to within",
    ];
    for words in told {
        assert!(text.contains(words), "{words} is not in {text}");
    }
}

/// `motions` and `basin` take starts from one box, which holds the machine's own motions and is told.
#[test]
fn one_box_of_starts_for_all_commands() {
    for machine in [
        "unloaded --set rho=0.5",
        "loaded",
        "loaded --set rho=1",
        "unloaded --set stop.stiffness=1000",
        "SCENES/rigid.toml",
        "SCENES/kelvin-voigt.toml",
    ] {
        let line = format!("motions {machine} --starts 8 --seed 3 --transient 700");
        let report = SOFTSTOP.value(&line);
        let plane = SOFTSTOP.report(&format!("basin {machine} --size 10"));
        let (position, velocity) = (&report["region_position"], &report["region_velocity"]);
        assert_eq!(plane.at("grid/across/range"), position, "{machine}");
        assert_eq!(plane.at("grid/up/range"), velocity, "{machine}");
        assert!(
            plane.at("warning").is_null(),
            "{machine}: {}",
            plane.at("warning")
        );
        let holds = |range: &Value, motion: &Value, key: &str| {
            let own = motion[key].as_f64();
            own.is_none_or(|own| number(range, "0") <= own && own <= number(range, "1"))
        };
        for motion in at(&report, "motions").as_array().expect("a list") {
            let is_inside =
                holds(position, motion, "position") && holds(velocity, motion, "velocity");
            assert!(is_inside, "{machine}: {motion}");
        }
        let told = format!(
            "{:.4} <= x <= {:.4}",
            number(position, "0"),
            number(position, "1")
        );
        let folder = plane.folder.path().display();
        for line in [line, format!("basin {machine} --size 10 --output {folder}")] {
            let line = softstop_testing::with_folders(&line);
            let text = SOFTSTOP.text(&words(&line));
            assert!(text.contains(&told), "{told} is not in {text}");
        }
    }
}
