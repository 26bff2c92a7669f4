//! What the paper prints in its Table 1: the figures and names with which ours are compared.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;

/// One row.
#[derive(Debug, Clone, Deserialize)]
pub struct PaperRow {
    /// Its number.
    pub number: usize,
    /// The frequency ratio as printed.
    pub eta: f64,
    /// What ends: `chaos`, or p/n of z = p/n and the order of its impacts where that matters.
    pub from: String,
    /// What follows in the end.
    pub to: String,
    /// Whether there is hysteresis.
    pub hysteresis: bool,
    /// Its type.
    pub kind: String,
}

/// The table (Peterka 2003, Table 1), in the file `docs/paper/table-1.toml`.
pub static ROWS: LazyLock<Vec<PaperRow>> = LazyLock::new(|| {
    let file: BTreeMap<String, Vec<PaperRow>> =
        toml::from_str(include_str!("../../../../docs/paper/table-1.toml"))
            .expect("the file that is built in holds rows");
    file.into_values().flatten().collect()
});

/// Its sub-intervals (a) to (d) of eta, from the first of their rows to the last, and how many values are
/// surveyed evenly in each, its ends left out.
pub static INTERVALS: LazyLock<Vec<(f64, f64, usize)>> = LazyLock::new(|| {
    let intervals = [(0, 4, 5), (5, 9, 5), (10, 15, 5), (16, 18, 3)];
    let ends = intervals.map(|(first, last, values)| (ROWS[first].eta, ROWS[last].eta, values));
    ends.to_vec()
});
