//! `softstop continue` as users and scripts meet it: figures of Table 1 and of Fig. 6, files, messages.

use std::fs;

use approx::assert_abs_diff_eq;
use serde_json::Value;
use softstop::Ratios;
use softstop_dynamics::zone::grazing_frequencies;
use softstop_testing::{Program, words};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const CONTINUE: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop"),
    first: &["continue"],
};

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

/// Symbols and parameters of the special points of a branch.
fn specials(branch: &Value) -> Vec<(&str, f64)> {
    let specials = branch["specials"].as_array();
    let special = |special: &'_ Value| number(&special["value"]);
    let symbols = specials.into_iter().flatten();
    symbols
        .map(|it| (it["symbol"].as_str().unwrap_or("?"), special(it)))
        .collect()
}

#[track_caller]
fn near(found: f64, expected: f64, width: f64) {
    assert_abs_diff_eq!(found, expected, epsilon = width);
}

#[test]
fn the_z_1_branch_has_the_rows_of_table_1_and_its_files() -> Outcome {
    let folder = tempfile::tempdir()?;
    let arguments = ["--parameter", "eta", "--from", "0.9", "--to", "1.5"];
    let report = CONTINUE.json_into(folder.path(), &arguments);
    let branch = &report["branches"][0];
    let found = specials(branch);
    let symbols: Vec<&str> = found.iter().map(|special| special.0).collect();
    assert_eq!(symbols, ["G", "PD", "SN", "G"]);
    // Grazing in closed form.
    let (lower, upper) = grazing_frequencies(&Ratios::unloaded().scene()?)?;
    near(found[0].1, lower.ok_or("none")?, 1e-10);
    near(found[1].1, 0.988_907, 5e-7);
    near(found[2].1, 1.369_036, 5e-7);
    near(found[3].1, upper, 1e-10);
    let fold = &branch["specials"][2];
    near(number(&fold["before_impact_velocities"][0]), 16.87, 5e-3);
    // At a fold 1 is a multiplier: trace = 1 + determinant.
    near(
        number(&fold["trace"]) - number(&fold["determinant"]),
        1.0,
        1e-9,
    );

    let mut table = csv::Reader::from_path(folder.path().join("branches.csv"))?;
    assert_eq!(&table.headers()?[2], "value");
    let mut marked = Vec::new();
    let mut rows = 0;
    for row in table.records() {
        let row = row?;
        rows += 1;
        let parameter: f64 = row[2].parse()?;
        assert!((0.9..=1.5).contains(&parameter));
        let stable: bool = row[11].parse()?;
        // Between flip and fold, on the upper side, it is stable.
        let moduli = [(7, 8), (9, 10)].map(|(re, im)| -> Result<f64, std::num::ParseFloatError> {
            Ok(row[re].parse::<f64>()?.hypot(row[im].parse()?))
        });
        let [one, other] = moduli;
        if row[12].is_empty() {
            assert_eq!(stable, one? < 1.0 && other? < 1.0);
        } else {
            marked.push(row[12].to_owned());
        }
    }
    assert_eq!(marked, symbols);
    assert_eq!(Some(rows), branch["points"].as_u64());
    let chart = fs::read_to_string(folder.path().join("branches.svg"))?;
    for words in ["<svg", "X′₋", "η", "fold (SN)", "period 1, stable"] {
        assert!(chart.contains(words), "{words}");
    }
    Ok(())
}

#[test]
fn an_isolated_motion_is_followed_to_its_ends() -> Outcome {
    // Rows 12 and 17 of Table 1.
    let folder = tempfile::tempdir()?;
    let machine = ["--frequency", "0.9875", "--orbit", "2/3"];
    let way = ["--parameter", "eta", "--from", "0.95", "--to", "1.05"];
    let report = CONTINUE.json_into(folder.path(), &[&machine[..], &way[..]].concat());
    let found = specials(&report["branches"][0]);
    assert_eq!(report["branches"][0]["periods"], 3);
    near(found[0].1, 0.986_778_9, 5e-8);
    assert_eq!((found[0].0, found[1].0), ("G", "PD"));
    // An independent simulation sees it at 1.005452.
    near(found[1].1, 1.005_452, 5e-6);
    Ok(())
}

#[test]
fn folds_over_clearance_are_those_of_fig_6() -> Outcome {
    let folder = tempfile::tempdir()?;
    let first = ["--parameter", "eta", "--from", "1.1", "--to", "1.8"];
    let second = ["--second", "rho", "--second-from", "2", "--second-to", "18"];
    let report = CONTINUE.json_into(folder.path(), &[&first[..], &second[..]].concat());
    let curves = report["curves"]["curves"].as_array().ok_or("no curves")?;
    let fold = curves.iter().find(|curve| curve["symbol"] == "SN");
    let fold = fold.ok_or("no fold")?;
    let mut ends = ["from", "to"].map(|end| [0, 1].map(|index| number(&fold[end][index])));
    ends.sort_by(|a, b| a[1].total_cmp(&b[1]));
    near(ends[0][0], 1.690_31, 1e-5);
    near(ends[0][1], 2.0, 1e-9);
    near(ends[1][0], 1.180_34, 1e-5);
    near(ends[1][1], 18.0, 1e-9);
    assert!(folder.path().join("curves.csv").exists());
    assert!(folder.path().join("curves.svg").exists());
    Ok(())
}

#[test]
fn a_mass_that_bounces_without_end_is_no_obstacle() -> Outcome {
    // Pressed on a stop at its place of rest; doubling there once ran without end.
    let folder = tempfile::tempdir()?;
    let machine = ["--preload", "1", "--clearance", "0", "--double", "1"];
    let way = ["--parameter", "eta", "--from", "0.9", "--to", "1.5"];
    let report = CONTINUE.json_into(folder.path(), &[&machine[..], &way[..]].concat());
    assert_eq!(specials(&report["branches"][0])[0].0, "PD");
    Ok(())
}

#[test]
fn ranges_end_where_no_machine_is_beyond() -> Outcome {
    let folder = tempfile::tempdir()?;
    let arguments = ["--parameter", "Fp", "--from", "0", "--to", "200"];
    let report = CONTINUE.json_into(folder.path(), &arguments);
    let branch = &report["branches"][0];
    near(number(&branch["from"]), 0.0, 1e-12);
    near(number(&branch["to"]), 200.0, 1e-12);
    assert_eq!(branch["ends"][0], "the range ends");
    Ok(())
}

#[test]
fn values_that_cannot_be_are_refused_by_name_value_and_range() -> Outcome {
    let cases: [(&[&str], &[&str]); 4] = [
        (
            &["--parameter", "eta", "--from", "1.2", "--to", "1.5"],
            &["--from 1.2", "--to 1.5", "frequency = 1.15"],
        ),
        (
            &["--parameter", "F0", "--from", "1", "--to", "2"],
            &["--parameter F0", "has no such parameter"],
        ),
        (
            &["--parameter", "mass", "--from", "1", "--to", "2"],
            &["mass", "has no such parameter", "excitation.frequency"],
        ),
        (
            &words("--parameter eta --from 1 --to 2 --orbit 1/0"),
            &["1/0", "n from 1 to 64"],
        ),
    ];
    for (arguments, words) in cases {
        CONTINUE.refuses_and_writes_nothing(arguments, words);
    }
    let folder = tempfile::tempdir()?;
    let place = folder.path().join("none");
    let place = place.to_str().ok_or("path")?;
    let absent = ["--orbit", "5/7", "--parameter", "eta"];
    let way = ["--from", "1", "--to", "2", "--output", place];
    let told = ["no stable z = 5/7 motion", "z = 1"];
    CONTINUE.ends_with(&[&absent[..], &way].concat(), 1, &told);
    assert!(!folder.path().join("none").exists());
    Ok(())
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing_behind() -> Outcome {
    let folder = tempfile::tempdir()?;
    let place = folder.path().join("new");
    // The search for a motion that is not there, among slow ones, takes seconds.
    let scene = format!("{}/../docs/scenes/chatter.toml", env!("CARGO_MANIFEST_DIR"));
    let way = ["--parameter", "w", "--from", "0.1", "--to", "1.8"];
    let arguments = [&[scene.as_str(), "--orbit", "5/7"], &way[..]].concat();
    CONTINUE.leaves_nothing_when_interrupted(&arguments, &place);
    Ok(())
}
