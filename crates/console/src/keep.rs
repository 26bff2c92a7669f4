//! What is done of a long run, kept while it goes on, so that `--resume` takes it up after whatever end.
//!
//! Beside its results a run has a file, gone once they are in place. Each finished [piece] of work is appended to it at
//! once, with its checksum: a kill loses the pieces under way, and a record that it cuts off ends the file.
//!
//! [piece]: softstop_dynamics::monitor::recall_or_compute

use std::collections::HashMap;
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use anyhow::{Context, anyhow};
use clap::Args;
use serde::Serialize;
use softstop_dynamics::monitor::Memory;

use crate::failure::Failure;
use crate::interrupt::{requested, under_way};
use crate::lock;
use crate::record_log::{RecordLog, RecordSpan, run_identity};

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
    /// The file; none before the first piece.
    file: Option<RecordLog>,
    /// Whether more can be kept.
    is_open: bool,
    /// Where what was done before is, until it is recalled.
    known: HashMap<Vec<u8>, RecordSpan>,
}

/// What is said of a run that is ended.
pub const KEPT: &str =
    "interrupted: what is done is kept; the same line with --resume goes on from there";

impl Keep {
    /// The file `NAME.part` in a folder, for a run of these settings. Without `--resume` an older one is taken away.
    ///
    /// # Errors
    /// [`Failure::Usage`] if the run to go on with is another one; [`Failure::Run`] if its file cannot be read or is no run's,
    /// or that run goes on.
    pub fn open(
        folder: &Path,
        name: &str,
        of: &impl Serialize,
        arguments: KeepArguments,
    ) -> Result<Self, Failure> {
        let keep = Self {
            path: folder.join(format!("{name}.part")),
            of: run_identity(of)?,
            state: Mutex::new(State {
                file: None,
                is_open: true,
                known: HashMap::new(),
            }),
        };
        let place = keep.path.display();
        match (RecordLog::open(&keep.path), arguments.resume) {
            (Err(error), _) if error.kind() == ErrorKind::NotFound => {}
            (Ok(None), _) => return Err(lock::refusal(&keep.path)),
            (Ok(Some(file)), true) => keep.restore(file)?,
            // What cannot be taken away cannot be written, which is said then.
            (Ok(Some(_)), false) => drop(fs::remove_file(&keep.path)),
            (Err(error), false) if error.kind() != ErrorKind::InvalidData => {
                drop(fs::remove_file(&keep.path));
            }
            (Err(error), _) => {
                let error = anyhow!(error).context(format!("cannot read {place}"));
                return Err(Failure::Run(error));
            }
        }
        Ok(keep)
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes up what a file holds.
    fn restore(&self, mut file: RecordLog) -> Result<(), Failure> {
        let mut state = self.state();
        let known = &mut state.known;
        let of = file.restore(|key, at| {
            known.insert(key.to_vec(), at);
        });
        match of.with_context(|| format!("cannot read {}", self.path.display()))? {
            // It was cut off before it said what it is of.
            None => drop(fs::remove_file(&self.path)),
            Some(of) if of == self.of => {
                state.file = Some(file);
                under_way().closing = KEPT;
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
        if let Some(file) = &mut state.file {
            return file.append(key, piece).map(drop);
        }
        let Some(mut file) = RecordLog::create(&self.path, &self.of)? else {
            state.is_open = false;
            return Ok(());
        };
        let first = file.append(key, piece);
        // Nobody goes on with a file that holds nothing.
        first.inspect_err(|_| drop(fs::remove_file(&self.path)))?;
        state.file = Some(file);
        under_way().closing = KEPT;
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
    fn recall_piece(&self, key: &[u8]) -> Option<Vec<u8>> {
        let mut state = self.state();
        let at = state.known.remove(key)?;
        state.file.as_mut()?.read(at).ok()
    }

    /// What ends after the request to end may have been cut short: it is not kept.
    fn store_piece(&self, key: &[u8], piece: &[u8]) {
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
