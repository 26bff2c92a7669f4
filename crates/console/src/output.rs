//! Output: text to stdout, and files that appear whole or not at all. What cannot be written is a [`Failure::Run`]
//! that names it.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use crate::failure::Failure;
use crate::interrupt::{self, StagingDir, under_way};
use crate::lock::{self, Locked};
use crate::names::{check_file, escaped};

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

/// Prints to stdout, control characters [`escaped`].
///
/// # Errors
/// As [`written`].
pub fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    let done = stdout.write_all(escaped(text).as_bytes());
    written(done.and_then(|()| stdout.flush()))
}

/// What became of a write to stdout.
///
/// # Errors
/// [`Failure::Unread`] if its reader has gone away (`softstop … | head`), [`Failure::Run`] with what else went wrong.
pub fn written(done: io::Result<()>) -> Result<(), Failure> {
    done.map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => Failure::Unread,
        _ => Failure::Run(anyhow!(error).context("cannot write to stdout")),
    })
}

/// The folder and the name of a file that is to be written.
///
/// # Errors
/// [`Failure::Usage`] if the path is none of a file, or no name for one.
pub fn folder_and_file(path: &Path) -> Result<(&Path, &str), Failure> {
    let file = path.file_name().and_then(|name| name.to_str());
    let none = || Failure::usage(format!("{}: is no name of a file", path.display()));
    let file = file.ok_or_else(none)?;
    check_file(file)?;
    let folder = path.parent();
    let folder = folder.filter(|folder| !folder.as_os_str().is_empty());
    Ok((folder.unwrap_or(Path::new(".")), file))
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

/// An output folder that is known to be writable, and written by no other run. Files are staged in a hidden folder
/// inside it and renamed into place together; a folder made in vain is taken away again.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    making: StagingDir,
    /// As long as the run lives.
    _lock: Locked,
}

/// What is said of a run that is ended with its files in place.
const WRITTEN: &str = "interrupted: the files are written";

impl Folder {
    /// Makes the folder if need be, locks it and tries whether files of these names in it can be written.
    ///
    /// # Errors
    /// [`Failure::Run`] if they cannot be, or another run writes into the folder.
    pub fn open(path: &Path, names: &[&str]) -> Result<Self, Failure> {
        Self::locked(path, "", names)
    }

    /// The folder of a file, in which other runs may write other files.
    ///
    /// # Errors
    /// [`Failure::Run`] if the file cannot be written, or another run writes it.
    pub fn of_file(path: &Path, name: &str) -> Result<Self, Failure> {
        Self::locked(path, name, &[name])
    }

    /// A folder of which a part of this name is locked, the whole if it is empty.
    fn locked(path: &Path, part: &str, names: &[&str]) -> Result<Self, Failure> {
        let mut places = names.iter().map(|name| path.join(name));
        if let Some(place) = places.find(|place| fs::metadata(place).is_ok_and(|it| !it.is_file()))
        {
            return Err(in_place(&place));
        }
        let hidden = format!(".softstop-{:08x}", crc32fast::hash(part.as_bytes()));
        let mut making = StagingDir {
            staging: PathBuf::new(),
            lock: path.join(format!("{hidden}.lock")),
            made: missing(path),
        };
        let mut under_way = under_way();
        let cannot = |error: io::Error| {
            let context = format!("output folder {}: cannot be written", path.display());
            Failure::Run(anyhow!(error).context(context))
        };
        let made = fs::create_dir_all(path).and_then(|()| lock::open(&making.lock, true));
        let Some(lock) = made.inspect_err(|_| making.unmake()).map_err(cannot)? else {
            return Err(lock::refusal(&path.join(part)));
        };
        let hidden = format!("{hidden}-");
        if lock.is_held {
            remove_dead(path, &hidden);
        }
        let staging = tempfile::Builder::new().prefix(&hidden).tempdir_in(path);
        making.staging = staging
            .inspect_err(|_| making.undo())
            .map_err(cannot)?
            .keep();
        under_way.outputs.push(making.clone());
        Ok(Self {
            path: path.to_owned(),
            making,
            _lock: lock,
        })
    }

    /// Refuses folders in it whose names end so.
    ///
    /// # Errors
    /// [`Failure::Run`] naming one.
    pub fn refuse_folders_called(&self, ending: &str) -> Result<(), Failure> {
        let entries = fs::read_dir(&self.path).into_iter().flatten().flatten();
        let mut places = entries.map(|entry| entry.path());
        let is_called = |path: &Path| path.to_string_lossy().ends_with(ending) && path.is_dir();
        let place = places.find(|path| is_called(path));
        place.map_or(Ok(()), |place| Err(in_place(&place)))
    }

    /// Where the file of this name is until [`Folder::commit`].
    fn staged(&self, name: &str) -> PathBuf {
        self.making.staging.join(name)
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

    /// Opens one file in the staging folder, to be written through to the disk before it is put in place.
    pub fn create_file(&self, name: &str) -> Result<fs::File, Failure> {
        let file = fs::File::create(self.staged(name));
        Ok(file.with_context(|| format!("cannot write {}", self.place(name).display()))?)
    }

    /// Opens one table in the staging folder, to be written row by row and closed with
    /// [`Staged::close`].
    pub fn create(&self, name: &str) -> Result<Staged, Failure> {
        let place = self.place(name);
        let file = self.create_file(name)?;
        let table = csv::WriterBuilder::new()
            .has_headers(false)
            .from_writer(file);
        Ok(Staged { place, table })
    }

    /// Puts the staged files into place, replacing older ones.
    pub fn commit(mut self, names: &[&str]) -> Result<(), Failure> {
        let mut under_way = under_way();
        if interrupt::requested() {
            drop(under_way);
            return Err(Failure::Interrupted);
        }
        let mut moved = Ok(());
        for name in names {
            moved = fs::rename(self.staged(name), self.place(name))
                .with_context(|| format!("cannot write {}", self.place(name).display()));
            if moved.is_err() {
                break;
            }
            self.making.made.clear();
            under_way.closing = WRITTEN;
        }
        drop(under_way);
        moved?;
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
        let mut under_way = under_way();
        self.making.undo();
        let outputs = &mut under_way.outputs;
        outputs.retain(|other| other.staging != self.making.staging);
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

fn in_place(place: &Path) -> Failure {
    let place = place.display();
    Failure::Run(anyhow!(
        "{place}: cannot be written, a folder or a device is in its place"
    ))
}

/// Takes away the staging folders of runs that were killed: nobody else holds the lock.
fn remove_dead(path: &Path, hidden: &str) {
    let entries = fs::read_dir(path).into_iter().flatten().flatten();
    for entry in entries.filter(|entry| entry.file_name().to_string_lossy().starts_with(hidden)) {
        let _ = fs::remove_dir_all(entry.path());
    }
}
