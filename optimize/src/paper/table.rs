//! Tables of figures as comma-separated values.

use anyhow::Context;
use serde::Serialize;

use crate::failure::Failure;

/// Lines with a header of their fields' names.
pub(super) fn csv(lines: impl IntoIterator<Item = impl Serialize>) -> Result<Vec<u8>, Failure> {
    let mut table = csv::Writer::from_writer(Vec::new());
    for line in lines {
        table.serialize(line).context("cannot write the table")?;
    }
    Ok(table.into_inner().context("cannot write the table")?)
}
