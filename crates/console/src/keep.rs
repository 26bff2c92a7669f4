//! What is done of a long run, kept while it goes on, so that `--resume` takes it up after whatever end.
//!
//! Beside its results a run has a file, gone once they are in place. Each finished [piece] of work is appended to it at
//! once, with its checksum: a kill loses the pieces under way, and a record that it cuts off ends the file.
//!
//! [piece]: softstop_dynamics::watch::piece

use std::collections::HashMap;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use anyhow::{Context, anyhow};
use clap::Args;
use serde::Serialize;
use softstop_dynamics::watch::Memory;

use crate::failure::Failure;
use crate::interrupt::{requested, under_way};

/// Whether a run goes on with what an earlier one has done.
#[derive(Debug, Clone, Copy, Args)]
pub struct KeepArguments {
    /// Go on with a run of the same arguments that was ended or killed; begin if there is none
    #[arg(long)]
    pub resume: bool,
}

/// The finished pieces of a run.
#[derive(Debug)]
pub struct Keep {
    path: PathBuf,
    /// What the run is of: a file goes with the same one alone.
    of: Vec<u8>,
    state: Mutex<State>,
}

#[derive(Debug)]
struct State {
    /// The file, locked; none before the first piece.
    file: Option<File>,
    /// Whether more can be kept.
    is_open: bool,
    /// When it was last written through to the disk.
    synced: Instant,
    /// What was done before, until it is recalled.
    known: HashMap<Vec<u8>, Vec<u8>>,
}

/// What is said of a run that is ended.
const KEPT: &str =
    "interrupted: what is done is kept; the same line with --resume goes on from there";
/// How often the file is written through to the disk, against a crash of the system; a kill takes nothing written.
const SYNC: Duration = Duration::from_secs(5);
/// Bytes in front of a record: its checksum, and the lengths of key and piece.
const HEAD: usize = 12;

impl Keep {
    /// The file `NAME.part` in a folder, for a run of these settings. Without `--resume` an older one is taken away;
    /// where that is of a run that lives, nothing is kept of this one.
    ///
    /// # Errors
    /// [`Failure::Usage`] if the run to go on with is another one, or lives; [`Failure::Run`] if its file cannot be
    /// read.
    pub fn open(
        folder: &Path,
        name: &str,
        of: &impl Serialize,
        arguments: KeepArguments,
    ) -> Result<Self, Failure> {
        let of = rmp_serde::to_vec(&(env!("CARGO_PKG_VERSION"), of));
        let keep = Self {
            path: folder.join(format!("{name}.part")),
            of: of.context("cannot tell runs apart")?,
            state: Mutex::new(State {
                file: None,
                is_open: true,
                synced: Instant::now(),
                known: HashMap::new(),
            }),
        };
        let place = keep.path.display();
        match (locked(&keep.path, false), arguments.resume) {
            (Err(error), _) if error.kind() == ErrorKind::NotFound => {}
            (Ok(None), true) => {
                let message = format!("--resume: {place} is of a run that goes on");
                return Err(Failure::usage(message));
            }
            (Ok(None), false) => keep.state().is_open = false,
            (Ok(Some(file)), true) => keep.restore(file)?,
            (Err(error), true) => {
                let error = anyhow!(error).context(format!("cannot read {place}"));
                return Err(Failure::Run(error));
            }
            // What cannot be taken away cannot be written, which is said then.
            (_, false) => drop(fs::remove_file(&keep.path)),
        }
        Ok(keep)
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Reads a file up to its first record that is not whole, and goes on behind the last one that is.
    fn restore(&self, mut file: File) -> Result<(), Failure> {
        let place = || format!("cannot read {}", self.path.display());
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).with_context(place)?;
        let mut state = self.state();
        let mut rest = bytes.as_slice();
        while let Some(([key, piece], after)) = split(rest) {
            state.known.insert(key.to_vec(), piece.to_vec());
            rest = after;
        }
        match state.known.remove([].as_slice()) {
            // It was cut off before it said what it is of.
            None => {
                state.known.clear();
                let _ = fs::remove_file(&self.path);
            }
            Some(of) if of == self.of => {
                let whole = bytes.len() - rest.len();
                file.set_len(whole as u64).with_context(place)?;
                file.seek(SeekFrom::End(0)).with_context(place)?;
                state.file = Some(file);
                under_way().close_with(KEPT);
            }
            Some(_) => {
                return Err(Failure::usage(format!(
                    "--resume: {} holds another run: all other arguments must be the same",
                    self.path.display()
                )));
            }
        }
        Ok(())
    }

    fn append(&self, state: &mut State, key: &[u8], piece: &[u8]) -> io::Result<()> {
        if state.file.is_none() {
            let Some(mut file) = locked(&self.path, true)? else {
                state.is_open = false;
                return Ok(());
            };
            let written = file.set_len(0);
            let written = written.and_then(|()| file.write_all(&record(&[], &self.of)?));
            state.file = Some(file);
            written?;
            under_way().close_with(KEPT);
        }
        let Some(file) = &mut state.file else {
            return Ok(());
        };
        file.write_all(&record(key, piece)?)?;
        if state.synced.elapsed() >= SYNC {
            file.sync_data()?;
            state.synced = Instant::now();
        }
        Ok(())
    }

    /// Takes the file away: the results are in place, or there are none to come.
    pub fn forget(self) {
        if self.state().file.is_some() {
            let _ = fs::remove_file(&self.path);
        }
    }
}

impl Memory for Keep {
    fn recall(&self, key: &[u8]) -> Option<Vec<u8>> {
        self.state().known.remove(key)
    }

    /// What ends after the request to end may have been cut short: it is not kept.
    fn keep(&self, key: &[u8], piece: &[u8]) {
        let mut state = self.state();
        if !state.is_open || requested() {
            return;
        }
        if let Err(error) = self.append(&mut state, key, piece) {
            state.is_open = false;
            let place = self.path.display();
            let _ = writeln!(
                io::stderr(),
                "warning: {place}: {error}; what is done from here on is not kept"
            );
        }
    }
}

/// Opens a file and locks it; none if a run that lives has it.
fn locked(path: &Path, create: bool) -> io::Result<Option<File>> {
    let mut options = OpenOptions::new();
    let options = options.read(true).write(true).create(create);
    let file = options.truncate(false).open(path)?;
    Ok(match file.try_lock() {
        Err(TryLockError::WouldBlock) => None,
        // The other run has ended in between, and taken its file away.
        _ if !path.exists() => None,
        // Where there are no locks, no other run is expected.
        _ => Some(file),
    })
}

fn record(key: &[u8], piece: &[u8]) -> io::Result<Vec<u8>> {
    let mut bytes = vec![0; 4];
    for part in [key, piece] {
        let length = u32::try_from(part.len()).map_err(io::Error::other)?;
        bytes.extend(length.to_le_bytes());
    }
    bytes.extend([key, piece].concat());
    let check = crc32fast::hash(&bytes[4..]);
    bytes[..4].copy_from_slice(&check.to_le_bytes());
    Ok(bytes)
}

/// Key and piece of the first record, and what follows it; none if it is not whole.
fn split(bytes: &[u8]) -> Option<([&[u8]; 2], &[u8])> {
    let (head, rest) = bytes.split_first_chunk::<HEAD>()?;
    let number = |at: usize| Some(u32::from_le_bytes(*head[at..].first_chunk()?));
    let (key, after) = rest.split_at_checked(number(4)? as usize)?;
    let (piece, after) = after.split_at_checked(number(8)? as usize)?;
    let whole = &bytes[4..bytes.len() - after.len()];
    (crc32fast::hash(whole) == number(0)?).then_some(([key, piece], after))
}
