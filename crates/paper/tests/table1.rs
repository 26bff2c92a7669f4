//! Rows of the paper's Table 1, found from a few frequencies. The whole table takes longer than a test may:
//! `softstop-lab table1`.

use softstop_dynamics::attractors::SearchOptions;
use softstop_paper::table1::paper::{INTERVALS, ROWS};
use softstop_paper::table1::report::{RowReport, TableReport};
use softstop_paper::table1::{transitions, values};
use softstop_paper::transitions::Rules;
use softstop_testing::tolerance::GROWN;
use softstop_testing::{assert_near, is_near};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Few motions, watched for a short time; the lifetimes of 8 would scatter more than the rows of chaos allow.
fn quick() -> Rules {
    Rules {
        survey: SearchOptions {
            starts: 64,
            patience: 20_000,
            ..SearchOptions::default()
        },
        motions: 32,
        patience: 1000,
        ..Rules::default()
    }
}

fn table(range: (f64, f64), values: &[f64]) -> Result<TableReport, Box<dyn std::error::Error>> {
    let rules = quick();
    let found = transitions(&rules, range, values, None).map_err(|failure| failure.to_string())?;
    Ok(TableReport::new(&ROWS, &found, &rules))
}

/// Our figure of a row, its type, and whether there is hysteresis.
type Expected = (usize, f64, f64, &'static str, bool);

/// Compares rows with figures known to a tolerance.
fn compare(table: &TableReport, expected: &[Expected]) {
    for &(number, eta, tolerance, kind, hysteresis) in expected {
        let row = &table.rows[number - 1];
        assert!(is_at(row, eta, tolerance), "{row:?}");
        assert_eq!(row.kind.as_deref(), Some(kind), "{row:?}");
        assert_eq!(row.hysteresis, Some(hysteresis), "{row:?}");
    }
}

fn is_at(row: &RowReport, eta: f64, tolerance: f64) -> bool {
    row.eta.is_some_and(|found| is_near(found, eta, tolerance))
}

#[test]
fn rest_ends_by_grazing_and_impacts_by_a_fold_beyond_it() -> Outcome {
    let table = table((1.01, 1.8), &[1.2])?;
    let (grazing, fold) = (&table.rows[17], &table.rows[18]);
    // Grazing in closed form: the amplitude of the free motion is the clearance.
    let amplitude = |eta: f64| 1.0 / (1.0 - eta * eta).hypot(0.04 * eta);
    let eta = grazing.eta.ok_or("row 18 was not found")?;
    assert_near(amplitude(eta), 10.0, GROWN);
    assert_eq!(grazing.kind.as_deref(), Some("G"));
    assert!(is_at(fold, 1.369_036, 5e-7), "{fold:?}");
    assert_eq!(fold.kind.as_deref(), Some("SN"));
    assert_eq!(
        (grazing.hysteresis, fold.hysteresis),
        (Some(true), Some(true))
    );
    // As an independent integrator swept so.
    assert!(
        fold.remark
            .contains("1e-3 per 50 drive periods loses the motion at 1.371"),
        "{}",
        fold.remark
    );
    // What was not looked for is not invented.
    assert!(table.rows[..17].iter().all(|row| row.eta.is_none()));
    Ok(())
}

#[test]
fn values_lie_inside_the_intervals() {
    let values = values(&INTERVALS);
    assert_eq!(values.len(), 18);
    for row in ROWS.iter() {
        // No row's figure is given away to the search.
        assert!(values.iter().all(|value| *value != row.eta));
    }
}

/// Rows whose figures an independent integrator gave (to the digits written), found from the frequencies of the
/// sub-intervals alone.
#[test]
fn the_sub_interval_of_hard_impacts_is_found() -> Outcome {
    let table = table((0.975, 1.02), &values(&INTERVALS[2..3]))?;
    compare(
        &table,
        &[
            (11, 0.983_055_2, 1.5e-7, "G", true),
            (12, 0.986_778_9, 1.5e-7, "G", true),
            (13, 0.988_495_6, 2.5e-6, "IPD", false),
            (14, 0.988_907_07, 1e-8, "PD -> SN", true),
            (15, 0.988_99, 5e-5, "G", true),
            (16, 0.992_706_3, 2.5e-6, "PD -> ISN -> OCH", true),
            (17, 1.005_452, 2.5e-6, "PD -> ISN -> OCH", true),
        ],
    );
    assert_eq!(table.rows[10].from.as_deref(), Some("z = (2/4)B"));
    assert_eq!(table.rows[15].to.as_deref(), Some("chaos -> z = 2/3"));
    Ok(())
}

#[test]
fn motions_of_many_periods_are_found() -> Outcome {
    let table = table((0.95, 0.958), &values(&INTERVALS[..2]))?;
    compare(
        &table,
        &[
            (1, 0.952_641_75, 3e-5, "OCH", true),
            (2, 0.952_651_56, 1e-8, "G", true),
            (3, 0.952_655, 1e-6, "ISN", false),
            (4, 0.952_656, 2.5e-6, "G", true),
            (5, 0.952_666, 1e-6, "G", true),
            (6, 0.953_410_05, 5e-5, "OCH", true),
            (7, 0.953_802_5, 1e-7, "G", true),
            (8, 0.954_06, 1e-5, "IPD", false),
            (9, 0.955_42, 1e-4, "OCH", true),
            (10, 0.956_114_6, 1e-7, "G", true),
        ],
    );
    Ok(())
}
