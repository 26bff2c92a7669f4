//! What study.parquet tells of its columns.

use std::fs;

use parquet::basic::Compression;
use parquet::file::reader::{FileReader, SerializedFileReader};

use super::{Outcome, STUDY, table, written};

/// The file tells of each column what it is and in which unit, how far its numbers reach, and is compressed.
#[test]
fn the_table_tells_of_itself() -> Outcome {
    let folder = tempfile::tempdir()?;
    let scene = softstop_testing::docs("scenes/hertz.toml");
    let text = format!(
        "machine = {scene:?}\noutputs = [\"kind\", \"velocity\"]\n[motion]\nperiods = 64\nwatched = 16\n\
         [[axis]]\nparameter = \"stop.stiffness\"\nfrom = 1e8\nto = 2e8\ncount = 40\n"
    );
    let study = written(folder.path(), &text)?;
    let out = folder.path().join("out");
    STUDY.text(&[&study, "--csv", "--output", &out.display().to_string()]);
    let reader = SerializedFileReader::new(fs::File::open(out.join("study.parquet"))?)?;
    let file = reader.metadata().file_metadata();
    let all = file.key_value_metadata().ok_or("key-value metadata")?;
    let told = all.iter().find(|pair| pair.key == "columns");
    let told = told
        .and_then(|pair| pair.value.as_deref())
        .ok_or("columns")?;
    let columns: serde_json::Value = serde_json::from_str(told)?;
    let named: Vec<_> = ["stop.stiffness", "kind", "velocity"]
        .into_iter()
        .zip(["N/m^exponent", "", "m/s"])
        .collect();
    for (number, (name, unit)) in named.into_iter().enumerate() {
        assert_eq!(columns[number]["name"], name);
        assert_eq!(columns[number]["unit"], unit);
        assert!(
            columns[number]["meaning"]
                .as_str()
                .is_some_and(|it| !it.is_empty())
        );
        let column = reader.metadata().row_group(0).column(number);
        assert_eq!(column.column_path().parts(), [name]);
        assert_eq!(column.compression(), Compression::SNAPPY);
        assert!(
            column
                .statistics()
                .is_some_and(|it| it.min_bytes_opt().is_some())
        );
    }
    let number = |bytes: Option<&[u8]>| Some(f64::from_le_bytes(bytes?.try_into().ok()?));
    let (_, rows) = table(&out)?;
    for (place, column) in [(0, 0), (2, 2)] {
        let statistics = reader
            .metadata()
            .row_group(0)
            .column(column)
            .statistics()
            .ok_or("statistics")?;
        let cells = rows.iter().filter_map(|row| row[place].parse::<f64>().ok());
        let ends = cells.fold([f64::MAX, f64::MIN], |[low, high], it| {
            [low.min(it), high.max(it)]
        });
        assert_eq!(
            [
                number(statistics.min_bytes_opt()),
                number(statistics.max_bytes_opt())
            ],
            ends.map(Some)
        );
    }
    Ok(())
}
