//! Text tables for people.

/// A row: what it is, and a cell for each column.
pub type Row = (String, Vec<String>);

/// A row with this label.
#[must_use]
pub fn row(label: &str, cells: impl IntoIterator<Item = String>) -> Row {
    (label.to_owned(), cells.into_iter().collect())
}

/// An underlined title.
#[must_use]
pub fn heading(title: &str) -> String {
    format!("{title}\n{}\n", "-".repeat(title.chars().count()))
}

/// A number with six places, or in powers of ten where those would not tell it.
#[must_use]
pub fn number(value: f64) -> String {
    if value == 0.0 || (1e-3..1e6).contains(&value.abs()) {
        format!("{value:.6}")
    } else {
        format!("{value:.6e}")
    }
}

/// A number with seven significant digits.
#[must_use]
pub fn figure(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e7).contains(&size) {
        let decimals = 6 - size.log10().floor() as i32;
        format!("{value:.*}", usize::try_from(decimals).unwrap_or(0))
    } else {
        format!("{value:.3e}")
    }
}

/// Labels to the left, cells to the right, every column as wide as its widest cell.
#[must_use]
pub fn table(rows: &[Row]) -> String {
    let label_width = rows
        .iter()
        .map(|(label, _)| label.chars().count())
        .max()
        .unwrap_or(0);
    let columns = rows.iter().map(|(_, cells)| cells.len()).max().unwrap_or(0);
    let width = |column: usize| {
        rows.iter()
            .filter_map(|(_, cells)| cells.get(column))
            .map(|cell| cell.chars().count())
            .max()
            .unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for (label, cells) in rows {
        let mut line = format!("{label:label_width$}");
        for (cell, width) in cells.iter().zip(&widths) {
            line += &format!("   {cell:>width$}");
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{row, table};

    #[test]
    fn columns_line_up() {
        let rows = [
            row("a", ["1.5".to_owned()]),
            row("long", ["12.25".to_owned(), "x".to_owned()]),
        ];
        assert_eq!(table(&rows), "a        1.5\nlong   12.25   x\n");
    }
}
