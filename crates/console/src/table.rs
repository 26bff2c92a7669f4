//! Text for people: titles, and cells under one another.

/// An underlined title.
pub fn heading(title: &str) -> String {
    format!("{title}\n{}\n", "-".repeat(title.chars().count()))
}

/// Parts of a text, each under its title and a blank line; what is empty is left out.
pub fn sections<T: AsRef<str>>(parts: impl IntoIterator<Item = (T, String)>) -> String {
    let parts = parts.into_iter().filter(|(_, text)| !text.is_empty());
    let parts = parts.map(|(title, text)| format!("\n{}\n{text}", title.as_ref()));
    parts.collect()
}

/// Lines of cells, every column as wide as its widest cell; words stand to the left, numbers to the right.
pub fn aligned(lines: &[Vec<String>], is_word: impl Fn(usize) -> bool) -> String {
    let columns = lines.iter().map(Vec::len).max().unwrap_or(0);
    let width = |index: usize| {
        let cells = lines.iter().filter_map(|line| line.get(index));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let line = |cells: &Vec<String>| {
        let cells = cells.iter().zip(&widths).enumerate();
        let padded = cells.map(|(index, (cell, width))| match is_word(index) {
            true => format!("{cell:<width$}"),
            false => format!("{cell:>width$}"),
        });
        padded.collect::<Vec<_>>().join("   ").trim_end().to_owned() + "\n"
    };
    lines.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::aligned;

    #[test]
    fn columns_line_up() {
        let lines = [vec!["a", "1.5"], vec!["long", "12.25", "x"]];
        let lines = lines.map(|line| line.into_iter().map(str::to_owned).collect());
        assert_eq!(
            aligned(&lines, |index| index == 0),
            "a        1.5\nlong   12.25   x\n"
        );
    }
}
