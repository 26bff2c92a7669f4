//! One report in every form: text for people, JSON for programs, tables, and files that are there whole or
//! not at all.
//!
//! A command hands over its result, mostly a [`Record`](crate::record::Record), whose names are the keys of the JSON, and
//! what people read of it, mostly by [`column::text`](crate::column::text) of the columns that
//! CSV has, too. The rest is here: the paths of the files stand in JSON as `files` (kind -> path) and
//! after the text. The kind is what the file is, `csv`, `json`, `svg`, `png` or `fmu`; where a command has
//! several of one, its name stands in front: `curves_csv`. What cannot be written is a [`Failure::Run`] that names it.
//!
//! ```
//! use softstop_console::column::{Column, Units, text};
//! use softstop_console::columns;
//! use softstop_console::export::Export;
//! use softstop_console::output::Format;
//! use softstop_console::record::Record;
//!
//! struct Order { z: String, share: f64 }
//!
//! fn table() -> [Column<Order>; 2] {
//!     columns! { Order, it;
//!         "z" [None] Plain, "p/n" => it.z.as_str();
//!         "share" [None] Percent(1), "of all starts" => it.share;
//!     }
//! }
//!
//! # let folder = tempfile::tempdir().map_err(anyhow::Error::from)?;
//! let orders = [Order { z: "1".to_owned(), share: 0.5 }];
//! let export = Export::open(folder.path(), &[("csv", "orders.csv"), ("json", "orders.json")])?;
//! export.table("csv", &table(), &orders)?;
//! let result = Record::default().hidden("orders", Record::all(&table(), &orders));
//! export.finish(&result, text(&table(), &orders, &Units::SI), Format::Text)?;
//! let table = std::fs::read_to_string(folder.path().join("orders.csv")).map_err(anyhow::Error::from)?;
//! assert_eq!(table, "z,share\n1,0.5\n");
//! assert!(folder.path().join("orders.json").exists());
//! # Ok::<(), softstop_console::failure::Failure>(())
//! ```

use std::borrow::Borrow;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use serde::{Deserialize, Serialize};

use crate::column::{Cell, Column};
use crate::failure::Failure;
use crate::output::{self, Folder, Format, Staged};
use crate::sheet::Sheet;

/// A report that was returned instead of printed.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Returned {
    /// For people, without the paths of files.
    pub text: String,
    /// One JSON object.
    pub json: String,
    /// Arrays by name, too long for both.
    pub arrays: Vec<(&'static str, Array)>,
}

/// Numbers, or which of a list's things each place has.
#[derive(Debug, Clone, PartialEq)]
pub enum Array {
    /// Numbers.
    Numbers(Vec<f64>),
    /// Places in a list.
    Indices(Vec<u16>),
}

thread_local! {
    /// Where reports go instead of being printed, while somebody on this thread asks for them.
    static RETURNED: RefCell<Option<Returned>> = const { RefCell::new(None) };
}

/// Runs a command on this thread and returns its report instead of printing it; an empty one if it prints none.
///
/// # Errors
/// Those of the command.
pub fn returned(command: impl FnOnce() -> Result<(), Failure>) -> Result<Returned, Failure> {
    RETURNED.set(Some(Returned::default()));
    let done = command();
    let returned = RETURNED.take().unwrap_or_default();
    done.map(|()| returned)
}

/// Hands an array to whoever asks for the report; programs that print have no place for it.
pub fn hand_over(name: &'static str, array: impl FnOnce() -> Array) {
    RETURNED.with_borrow_mut(|returned| {
        if let Some(returned) = returned {
            returned.arrays.push((name, array()));
        }
    });
}

/// Prints a result that has no files, and for people its text.
pub fn print(result: &impl Serialize, text: String, format: Format) -> Result<(), Failure> {
    show(output::json(result)?, text, "", format)
}

/// Prints a report and where its files are, or returns it to whoever asks for it.
fn show(json: String, text: String, files: &str, format: Format) -> Result<(), Failure> {
    RETURNED.with_borrow_mut(|returned| match (returned, format) {
        (Some(returned), _) => {
            (returned.text, returned.json) = (text, json);
            Ok(())
        }
        (None, Format::Json) => output::print(&json),
        (None, Format::Text) => output::print(&(text + files)),
    })
}

/// A table as comma-separated values.
///
/// # Errors
/// [`Failure::Run`] if it cannot be written.
pub fn csv<T>(
    columns: &[Column<T>],
    rows: impl IntoIterator<Item = impl Borrow<T>>,
) -> Result<Vec<u8>, Failure> {
    let cells = |row| -> Vec<Cell> {
        let row = Borrow::borrow(&row);
        columns.iter().map(|column| (column.cell)(row)).collect()
    };
    let head = columns.iter().map(|column| Cell::from(column.name));
    output::csv(
        [head.collect()]
            .into_iter()
            .chain(rows.into_iter().map(cells)),
    )
}

/// A result with the paths of its files by kind.
#[derive(Serialize)]
struct Filed<'a, R> {
    #[serde(flatten)]
    result: &'a R,
    files: BTreeMap<String, String>,
}

/// What an earlier run has said of its files.
#[derive(Default, Deserialize)]
struct Earlier {
    #[serde(default)]
    files: BTreeMap<String, String>,
}

/// The files of a command, by kind and name, until they are whole.
#[derive(Debug)]
pub struct Export {
    folder: Folder,
    files: Vec<(String, String)>,
}

impl Export {
    /// Makes the folder if need be, and tries whether files of these kinds and names can be written there.
    pub fn open(path: &Path, files: &[(&str, &str)]) -> Result<Self, Failure> {
        let names: Vec<&str> = files.iter().map(|(_, name)| *name).collect();
        Ok(Self {
            folder: Folder::open(path, &names)?,
            files: files
                .iter()
                .map(|(kind, name)| ((*kind).to_owned(), (*name).to_owned()))
                .collect(),
        })
    }

    /// Makes the folder of one file of a kind if need be, and tries whether that file can be written there.
    pub fn of_file(kind: &str, path: &Path, name: &str) -> Result<Self, Failure> {
        Ok(Self {
            folder: Folder::of_file(path, name)?,
            files: vec![(kind.to_owned(), name.to_owned())],
        })
    }

    /// Refuses folders that stand where files will, whose names are not yet known but for their ending.
    ///
    /// # Errors
    /// [`Failure::Run`] naming one.
    pub fn refuse_folders_called(&self, ending: &str) -> Result<(), Failure> {
        self.folder.refuse_folders_called(ending)
    }

    /// Writes tables of which nothing was known before, each as a CSV file of its name; an empty one is left out, and
    /// so is what is no finite number.
    pub fn sheets<'a>(
        &mut self,
        sheets: impl IntoIterator<Item = &'a Sheet>,
    ) -> Result<(), Failure> {
        for Sheet { name, heads, rows } in sheets.into_iter().filter(|it| !it.rows.is_empty()) {
            let kind = format!("{name}_csv");
            self.files.push((kind.clone(), format!("{name}.csv")));
            let mut staged = self.rows(&kind)?;
            staged.row(heads)?;
            for row in rows {
                staged.row(row.iter().map(Cell::finite))?;
            }
            staged.close()?;
        }
        Ok(())
    }

    /// Writes a picture of which nothing was known before as an SVG file of its name.
    pub fn picture(&mut self, name: &str, svg: &str) -> Result<(), Failure> {
        let kind = format!("{name}_svg");
        self.files.push((kind.clone(), format!("{name}.svg")));
        self.file(&kind, svg.as_bytes())
    }

    /// There will be no file of a kind.
    pub fn forgo(&mut self, kind: &str) {
        self.files.retain(|(other, _)| other != kind);
    }

    /// Writes the file of a kind.
    pub fn file(&self, kind: &str, content: &[u8]) -> Result<(), Failure> {
        self.folder.stage(self.name(kind)?, content)
    }

    /// Opens the file of a kind, to be written through to the disk before all are put in place.
    pub fn open_file(&self, kind: &str) -> Result<File, Failure> {
        self.folder.create_file(self.name(kind)?)
    }

    /// Opens the file of a kind as a table without columns of its own, to be written row by row.
    pub fn rows(&self, kind: &str) -> Result<Staged, Failure> {
        self.folder.create(self.name(kind)?)
    }

    /// Opens a table as the file of a kind, to be written row by row.
    pub fn open_table<'a, T>(
        &self,
        kind: &str,
        columns: &'a [Column<T>],
    ) -> Result<Table<'a, T>, Failure> {
        let mut staged = self.rows(kind)?;
        staged.row(columns.iter().map(|column| column.name))?;
        Ok(Table { columns, staged })
    }

    /// Writes a table as the file of a kind.
    pub fn table<T>(
        &self,
        kind: &str,
        columns: &[Column<T>],
        rows: impl IntoIterator<Item = impl Borrow<T>>,
    ) -> Result<(), Failure> {
        let mut table = self.open_table(kind, columns)?;
        for row in rows {
            table.row(row.borrow())?;
        }
        table.close()
    }

    /// Writes a table and its chart as the files of two kinds.
    pub fn sheet<T>(
        &self,
        [table, chart]: [&str; 2],
        columns: &[Column<T>],
        rows: impl IntoIterator<Item = impl Borrow<T>>,
        svg: &str,
    ) -> Result<(), Failure> {
        self.table(table, columns, rows)?;
        self.file(chart, svg.as_bytes())
    }

    /// Writes the JSON into the file whose name says so, if there is one, puts all files in place, takes away what only an
    /// earlier run has written and prints the result, or the text of it.
    pub fn finish(
        self,
        result: &impl Serialize,
        text: String,
        format: Format,
    ) -> Result<(), Failure> {
        let place = |(kind, name): &(String, String)| {
            (kind.clone(), self.folder.place(name).display().to_string())
        };
        let files: BTreeMap<_, _> = self.files.iter().map(place).collect();
        let mut written = "\n".to_owned();
        for (kind, path) in &files {
            let older = match Path::new(path).exists() {
                true => ", in place of an older one",
                false => "",
            };
            written += &format!("Written: {path} ({kind}{older})\n");
        }
        let json = output::json(&Filed { result, files })?;
        let stale = self.stale();
        if let Some((kind, _)) = self.json() {
            self.file(kind, json.as_bytes())?;
        }
        let names: Vec<&str> = self.files.iter().map(|(_, name)| name.as_str()).collect();
        self.folder.commit(&names)?;
        for path in stale {
            let place = path.display();
            fs::remove_file(&path).with_context(|| format!("cannot remove {place}"))?;
            written += &format!("Removed: {place} (of an earlier run)\n");
        }
        show(json, text, &written, format)
    }

    /// Kind and name of the file that holds the JSON.
    fn json(&self) -> Option<&(String, String)> {
        self.files.iter().find(|file| file.1.ends_with(".json"))
    }

    /// The files in the folder that the JSON of an earlier run there names, and that there will be no more.
    fn stale(&self) -> Vec<PathBuf> {
        let text = self.json().map(|(_, name)| self.folder.place(name));
        // A pipe in its place would never be read to its end.
        let text = text.filter(|path| path.is_file());
        let text = text.and_then(|path| fs::read_to_string(path).ok());
        let earlier: Option<Earlier> = text.and_then(|text| serde_json::from_str(&text).ok());
        let stale = |(kind, path): (String, String)| {
            let name = Path::new(&path).file_name()?.to_str()?;
            let (_, ending) = name.rsplit_once('.')?;
            let is_kind = kind.rsplit('_').next() == Some(ending);
            let is_written = self.files.iter().any(|(_, other)| other == name);
            let place = self.folder.place(name);
            let is_file = fs::symlink_metadata(&place).is_ok_and(|it| it.is_file());
            (is_kind && !is_written && is_file).then_some(place)
        };
        let files = earlier.unwrap_or_default().files;
        files.into_iter().filter_map(stale).collect()
    }

    /// The name of the file of a kind.
    fn name(&self, kind: &str) -> Result<&str, Failure> {
        let file = self.files.iter().find(|(other, _)| other == kind);
        let name = file.map(|(_, name)| name.as_str());
        name.ok_or_else(|| Failure::Run(anyhow!("no file was opened for {kind}")))
    }
}

/// A table that is being written.
#[derive(Debug)]
pub struct Table<'a, T> {
    columns: &'a [Column<T>],
    staged: Staged,
}

impl<T> Table<'_, T> {
    /// Adds one row.
    pub fn row(&mut self, row: &T) -> Result<(), Failure> {
        let cells = self.columns.iter().map(|column| (column.cell)(row));
        self.staged.row(cells)
    }

    /// Writes what is left through to the disk.
    pub fn close(self) -> Result<(), Failure> {
        self.staged.close()
    }
}
