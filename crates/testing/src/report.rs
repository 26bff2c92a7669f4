//! What a program reports in JSON, and the files that it wrote.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use tempfile::TempDir;

use crate::near::is_near;
use crate::program::{Program, files};
use crate::{docs, words};

/// A line with the folders of scenes and studies of `docs` in place of `SCENES` and `STUDIES`.
pub fn with_folders(line: &str) -> String {
    let place = |name: &str| docs(name).display().to_string();
    let line = line.replace("SCENES", &place("scenes"));
    line.replace("STUDIES", &place("studies"))
}

/// A row of a table: its cells by the names of their columns.
pub type Row = BTreeMap<String, String>;

/// The rows of a table, each with all columns.
///
/// # Panics
/// If there is none.
#[track_caller]
pub fn table(path: &Path) -> Vec<Row> {
    let mut reader = csv::Reader::from_path(path).expect("a table");
    let rows = reader.deserialize();
    rows.map(|row| row.expect("a row")).collect()
}

/// The number in a column of a row.
///
/// # Panics
/// If there is none.
#[track_caller]
pub fn number_in(row: &Row, column: &str) -> f64 {
    let number = row.get(column).and_then(|cell| cell.parse().ok());
    number.unwrap_or_else(|| panic!("{column} is no number in {row:?}"))
}

/// A report, and the folder of its files, which goes with it.
#[derive(Debug)]
pub struct Report {
    /// All of it.
    pub value: Value,
    /// Where its files are.
    pub folder: TempDir,
}

impl Program {
    /// Runs a line where it has to succeed: the JSON that it wrote.
    ///
    /// # Panics
    /// If it fails, or writes other than JSON.
    #[track_caller]
    pub fn value(&self, line: &str) -> Value {
        self.json(&words(&with_folders(line)))
    }

    /// Runs a line where it has to succeed, writing into a new folder.
    ///
    /// # Panics
    /// If it fails, or writes other than JSON.
    #[track_caller]
    pub fn report(&self, line: &str) -> Report {
        self.report_into(tempfile::tempdir().expect("a folder"), line)
    }

    /// Runs a line where it has to succeed, writing into a new folder, with a file of this name and text there in place of
    /// `FILE`.
    ///
    /// # Panics
    /// If it fails, or writes other than JSON.
    #[track_caller]
    pub fn report_of(&self, name: &str, text: &str, line: &str) -> Report {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join(name);
        fs::write(&file, text).expect("a file");
        self.report_into(folder, &line.replace("FILE", &file.display().to_string()))
    }

    #[track_caller]
    fn report_into(&self, folder: TempDir, line: &str) -> Report {
        let value = self.value(&format!("{line} --output {}", folder.path().display()));
        Report { value, folder }
    }
}

impl Report {
    /// What stands at a place, `branches/0/value` say.
    #[track_caller]
    pub fn at(&self, place: &str) -> &Value {
        at(&self.value, place)
    }

    /// The number at a place.
    #[track_caller]
    pub fn number(&self, place: &str) -> f64 {
        number(&self.value, place)
    }

    /// The list at a place.
    #[track_caller]
    pub fn list(&self, place: &str) -> &[Value] {
        let list = self.at(place).as_array();
        list.unwrap_or_else(|| panic!("{place} is no list in {}", self.value))
    }

    /// Asserts that the numbers at places are near others: place, number, tolerance.
    #[track_caller]
    pub fn has_near(&self, expected: &[(&str, f64, f64)]) {
        has_near(&self.value, expected);
    }

    /// A file that it wrote.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The names of all files that it wrote, in order.
    pub fn names(&self) -> Vec<String> {
        let name = |path: PathBuf| path.strip_prefix(self.folder.path()).map(Path::to_path_buf);
        let names = files(self.folder.path()).into_iter().map(name);
        let mut names: Vec<String> = names
            .map(|name| name.expect("in the folder").display().to_string())
            .collect();
        names.sort();
        names
    }

    /// The text of a file that it wrote.
    ///
    /// # Panics
    /// If there is none.
    #[track_caller]
    pub fn text(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).expect(name)
    }

    /// The rows of a table that it wrote.
    #[track_caller]
    pub fn table(&self, name: &str) -> Vec<Row> {
        table(&self.path(name))
    }

    /// Asserts that a picture is whole and has these words.
    #[track_caller]
    pub fn shows(&self, name: &str, words: &[&str]) {
        let picture = self.text(name);
        assert!(picture.starts_with("<svg"), "{name} begins otherwise");
        assert!(picture.trim_end().ends_with("</svg>"), "{name} has no end");
        for word in words {
            assert!(picture.contains(word), "{word} is not in {name}");
        }
    }

    /// Asserts that a file holds the report.
    #[track_caller]
    pub fn is_in(&self, name: &str) {
        let file: Value = serde_json::from_str(&self.text(name)).expect("JSON");
        assert_eq!(file, self.value, "{name}");
    }
}

/// What stands at a place of a value, `branches/0/value` say; null where there is nothing.
pub fn at<'a>(value: &'a Value, place: &str) -> &'a Value {
    value.pointer(&format!("/{place}")).unwrap_or(&Value::Null)
}

/// The number at a place of a value.
///
/// # Panics
/// If there is none.
#[track_caller]
pub fn number(value: &Value, place: &str) -> f64 {
    let number = at(value, place).as_f64();
    number.unwrap_or_else(|| panic!("{place} is no number in {value}"))
}

/// Asserts that the numbers at places of a value are near others: place, number, tolerance.
///
/// # Panics
/// If one is not.
#[track_caller]
pub fn has_near(value: &Value, expected: &[(&str, f64, f64)]) {
    for (place, expected, tolerance) in expected {
        let found = number(value, place);
        let is_near = is_near(found, *expected, *tolerance);
        assert!(is_near, "{place}: {found}, not {expected}");
    }
}
