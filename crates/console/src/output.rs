//! Output: text to stdout, and files that appear whole or not at all. What cannot be written is a [`Failure::Run`]
//! that names it.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use tempfile::TempDir;

use crate::failure::Failure;
use crate::interrupt;

/// How a subcommand prints its result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// For people.
    #[default]
    Text,
    /// For programs: one JSON object and nothing else on stdout.
    Json,
}

/// Prints to stdout. A reader that has gone away (`softstop … | head`) is not an error.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
    {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::Run(
            anyhow!(error).context("cannot write to stdout"),
        )),
        _ => Ok(()),
    }
}

/// The value as indented JSON with a final line feed.
pub fn json(value: &impl Serialize) -> Result<String, Failure> {
    let mut text = serde_json::to_string_pretty(value).context("cannot write JSON")?;
    text.push('\n');
    Ok(text)
}

/// Rows as comma-separated values under a line of their names.
pub fn csv(rows: impl IntoIterator<Item = impl Serialize>) -> Result<Vec<u8>, Failure> {
    let mut table = csv::Writer::from_writer(Vec::new());
    for row in rows {
        table.serialize(row).context("cannot write a table")?;
    }
    Ok(table.into_inner().context("cannot write a table")?)
}

/// An output folder that is known to be writable. Files are staged in a hidden folder inside
/// it and renamed into place together; a folder made in vain is taken away again.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// Folders made for this run, outermost first.
    made: Vec<PathBuf>,
    staging: TempDir,
}

impl Folder {
    /// Makes the folder if need be and tries whether it and the files of these names in it
    /// can be written.
    pub fn open(path: &Path, names: &[&str]) -> Result<Self, Failure> {
        if let Some(place) = names
            .iter()
            .map(|name| path.join(name))
            .find(|place| place.is_dir())
        {
            let place = place.display();
            return Err(Failure::Run(anyhow!(
                "{place}: cannot be written, a folder is in its place"
            )));
        }
        let made = missing(path);
        let staging = fs::create_dir_all(path).and_then(|()| {
            tempfile::Builder::new()
                .prefix(".softstop-")
                .tempdir_in(path)
        });
        match staging {
            Ok(staging) => Ok(Self {
                path: path.to_owned(),
                made,
                staging,
            }),
            Err(error) => {
                remove(&made);
                let place = path.display();
                Err(Failure::Run(anyhow!(error).context(format!(
                    "output folder {place}: cannot be written"
                ))))
            }
        }
    }

    /// Where the file of this name is until [`Folder::commit`].
    fn staged(&self, name: &str) -> PathBuf {
        self.staging.path().join(name)
    }

    /// The place of the file of this name after [`Folder::commit`].
    pub fn place(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Writes one file into the staging folder and through to the disk.
    pub fn stage(&self, name: &str, content: &[u8]) -> Result<(), Failure> {
        fs::File::create(self.staged(name))
            .and_then(|mut file| file.write_all(content).and_then(|()| file.sync_all()))
            .with_context(|| format!("cannot write {}", self.place(name).display()))?;
        Ok(())
    }

    /// Opens one table in the staging folder, to be written row by row and closed with
    /// [`Staged::close`].
    pub fn create(&self, name: &str) -> Result<Staged, Failure> {
        let place = self.place(name);
        let file = fs::File::create(self.staged(name))
            .with_context(|| format!("cannot write {}", place.display()))?;
        let table = csv::WriterBuilder::new()
            .has_headers(false)
            .from_writer(file);
        Ok(Staged { place, table })
    }

    /// Puts the staged files into place, replacing older ones.
    pub fn commit(mut self, names: &[&str]) -> Result<(), Failure> {
        if interrupt::requested() {
            return Err(Failure::Interrupted);
        }
        for name in names {
            fs::rename(self.staged(name), self.place(name))
                .with_context(|| format!("cannot write {}", self.place(name).display()))?;
            self.made.clear();
        }
        Ok(())
    }
}

/// A staged CSV table that is being written.
#[derive(Debug)]
pub struct Staged {
    place: PathBuf,
    table: csv::Writer<fs::File>,
}

impl Staged {
    /// Adds one row.
    pub fn row(&mut self, cells: impl IntoIterator<Item = impl Serialize>) -> Result<(), Failure> {
        let cells: Vec<_> = cells.into_iter().collect();
        self.table
            .serialize(cells)
            .with_context(|| format!("cannot write {}", self.place.display()))?;
        Ok(())
    }

    /// Writes what is left through to the disk.
    pub fn close(mut self) -> Result<(), Failure> {
        self.table
            .flush()
            .and_then(|()| self.table.get_ref().sync_all())
            .with_context(|| format!("cannot write {}", self.place.display()))?;
        Ok(())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        if !self.made.is_empty() {
            // The staging folder stands in the way of removing its parent.
            let _ = fs::remove_dir_all(self.staging.path());
            remove(&self.made);
        }
    }
}

/// The folders on the way to `path` that do not exist yet, outermost first.
fn missing(path: &Path) -> Vec<PathBuf> {
    let mut folders: Vec<PathBuf> = path
        .ancestors()
        .filter(|folder| !folder.as_os_str().is_empty())
        .take_while(|folder| fs::symlink_metadata(folder).is_err())
        .map(Path::to_owned)
        .collect();
    folders.reverse();
    folders
}

/// Takes away empty folders, innermost first; one that has been filled meanwhile stays.
fn remove(folders: &[PathBuf]) {
    for folder in folders.iter().rev() {
        let _ = fs::remove_dir(folder);
    }
}
