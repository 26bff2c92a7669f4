//! What a study says has settled lies on a stable orbit, and all columns of its row are of that orbit.

use std::fs;

use approx::{assert_abs_diff_eq, assert_relative_eq};

use softstop_testing::number_in as number;
use softstop_testing::report::Row;

use super::{Outcome, STUDY};

/// A machine with little damping, whose motions settle slowly.
const SLOW: &str = "mass = 1\nstiffness = 1\ndamping = 2e-4\nclearance = 10\ncontact.damping = 4e-4\n\
    excitation = { amplitude = 1, frequency = 1.15 }\n\
    stop = { model = \"preloaded\", stiffness = 7, preload = 70 }\n";

/// Rows of a study of the paper's unloaded machine.
fn rows_of_unloaded(study: &str) -> Vec<Row> {
    let text = format!("machine = \"unloaded\"\n{study}");
    STUDY
        .report_of("study.toml", &text, "FILE --csv")
        .table("study.csv")
}

/// Rows of a study of the slow machine.
fn rows_of_slow(study: &str) -> Outcome<Vec<Row>> {
    let folder = tempfile::tempdir()?;
    let slow = folder.path().join("slow.toml");
    fs::write(&slow, SLOW)?;
    let text = format!("machine = \"{}\"\n{study}", slow.display());
    Ok(STUDY
        .report_of("study.toml", &text, "FILE --csv")
        .table("study.csv"))
}

/// Just beyond the end of a window of 2/4: there the Lyapunov exponent is +0.048 per drive period, but states nearly return.
#[test]
fn chaos_that_nearly_returns_is_not_periodic() -> Outcome {
    let study = "set = [\"initial.position=0\", \"initial.velocity=4.034008889462683\"]\n\
        outputs = [\"kind\", \"z\", \"trace\", \"exponent\"]\n[motion]\nperiods = 200\n\
        [[axis]]\nparameter = \"eta\"\nvalues = [0.98845, 0.98846, 0.98848, 0.98849]\n";
    for row in rows_of_unloaded(study) {
        assert_eq!(
            (row["z"].as_str(), row["trace"].as_str()),
            ("", ""),
            "{row:?}"
        );
        assert_ne!(row["kind"], "periodic");
        assert!(number(&row, "exponent") > 0.0);
    }
    Ok(())
}

/// z = 1 ends in a fold at η = 1.3690358386; beyond it motions linger where it was.
#[test]
fn beyond_the_fold_no_motion_settles_on_z_1() -> Outcome {
    let study = "set = [\"initial.position=-9.327707555544961\", \"initial.velocity=17.320260469539093\"]\n\
        outputs = [\"kind\", \"z\", \"trace\"]\n[motion]\nperiods = 500\n[[axis]]\nparameter = \"eta\"\n\
        values = [1.36903, 1.369036, 1.36904, 1.36905, 1.3691, 1.3695]\n";
    let rows = rows_of_unloaded(study);
    assert_eq!(
        (rows[0]["kind"].as_str(), rows[0]["z"].as_str()),
        ("periodic", "1")
    );
    assert!(rows[1..].iter().all(|row| row["z"] != "1"), "{rows:?}");
    assert!(rows[2..].iter().all(|row| row["z"] == "0"), "{rows:?}");
    Ok(())
}

/// Without impacts the amplitude is F0 / |k - m w^2 + i b w|.
#[test]
fn slow_linear_motions_have_the_amplitude_of_resonance() -> Outcome {
    let study = "outputs = [\"kind\", \"max_position\", \"exponent\"]\n[[axis]]\n\
        parameter = \"excitation.frequency\"\nvalues = [0.3333, 0.5, 0.9, 1.15, 1.2]\n";
    for row in rows_of_slow(study)? {
        let frequency = number(&row, "excitation.frequency");
        let amplitude = 1.0 / (1.0 - frequency * frequency).hypot(2e-4 * frequency);
        assert_eq!(row["kind"], "periodic");
        assert_relative_eq!(number(&row, "max_position"), amplitude, max_relative = 1e-9);
        let decay = -1e-4 * std::f64::consts::TAU / frequency;
        assert_relative_eq!(number(&row, "exponent"), decay, max_relative = 1e-9);
    }
    Ok(())
}

#[test]
fn velocity_and_impact_energy_are_of_one_motion() -> Outcome {
    let study = "set = [\"initial.position=9\"]\n\
        outputs = [\"kind\", \"z\", \"velocity\", \"impact_energy\"]\n[[axis]]\n\
        parameter = \"initial.velocity\"\nvalues = [5, 6, 7]\n";
    for row in rows_of_slow(study)? {
        assert_eq!((row["kind"].as_str(), row["z"].as_str()), ("periodic", "1"));
        let energy = 0.5 * number(&row, "velocity").powi(2);
        assert_relative_eq!(number(&row, "impact_energy"), energy, max_relative = 1e-9);
    }
    Ok(())
}

/// The multipliers of a linear motion are a complex pair of modulus exp(-b T / 2m).
#[test]
fn unsettled_linear_motions_have_the_exponent_of_their_damping() -> Outcome {
    let study = "outputs = [\"kind\", \"exponent\"]\n[motion]\nperiods = 500\n[[axis]]\n\
        parameter = \"excitation.frequency\"\nvalues = [1.15, 1.3]\n";
    for row in rows_of_slow(study)? {
        assert_eq!(row["kind"], "unsettled");
        let decay = -1e-4 * std::f64::consts::TAU / number(&row, "excitation.frequency");
        assert_abs_diff_eq!(number(&row, "exponent"), decay, epsilon = 1e-12);
    }
    Ok(())
}
