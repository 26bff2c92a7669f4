//! Rows of the paper's Table 1, found from a few frequencies. The whole table takes longer than a test may:
//! `softstop table1`.

use softstop::attractors::Options;
use softstop::transitions::Rules;
use softstop_optimize::table1::paper::{INTERVALS, ROWS};
use softstop_optimize::table1::report::{RowReport, TableReport};
use softstop_optimize::table1::{transitions, values};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Few motions, watched for a short time.
fn quick() -> Rules {
    Rules {
        survey: Options {
            starts: 64,
            patience: 20_000,
            ..Options::default()
        },
        motions: 8,
        patience: 1000,
        ..Rules::default()
    }
}

fn table(range: (f64, f64), values: &[f64]) -> Result<TableReport, Box<dyn std::error::Error>> {
    let rules = quick();
    let found = transitions(&rules, range, values).map_err(|failure| failure.to_string())?;
    Ok(TableReport::new(&ROWS, &found, &rules))
}

fn is_near(row: &RowReport, eta: f64, tolerance: f64) -> bool {
    row.eta.is_some_and(|found| (found - eta).abs() < tolerance)
}

#[test]
fn rest_ends_by_grazing_and_impacts_by_a_fold_beyond_it() -> Outcome {
    let table = table((1.01, 1.8), &[1.2])?;
    let (grazing, fold) = (&table.rows[17], &table.rows[18]);
    // Grazing in closed form: the amplitude of the free motion is the clearance.
    let amplitude = |eta: f64| 1.0 / (1.0 - eta * eta).hypot(0.04 * eta);
    let eta = grazing.eta.ok_or("row 18 was not found")?;
    assert!((amplitude(eta) - 10.0).abs() < 1e-8, "{eta}");
    assert_eq!(grazing.kind.as_deref(), Some("G"));
    assert!(is_near(fold, 1.369_036, 5e-7), "{fold:?}");
    assert_eq!(fold.kind.as_deref(), Some("SN"));
    assert_eq!(
        (grazing.hysteresis, fold.hysteresis),
        (Some(true), Some(true))
    );
    assert!(fold.remark.contains("loses it at 1.371"), "{}", fold.remark);
    // What was not looked for is not invented.
    assert!(table.rows[..17].iter().all(|row| row.eta.is_none()));
    Ok(())
}

#[test]
fn values_lie_inside_the_intervals() {
    let values = values(&INTERVALS);
    assert_eq!(values.len(), 18);
    for row in &ROWS {
        // No row's figure is given away to the search.
        assert!(values.iter().all(|value| *value != row.eta));
    }
}
