//! A study as a measurement takes it: its machines, and all of it in one call.

use std::fs::File;
use std::path::Path;

use anyhow::Context;
use softstop::Machine;
use softstop_console::budget::Budget;
use softstop_console::failure::Failure;

use super::blocks::Run;
use super::file::Study;
use super::shard::Shard;
use super::{TABLE, table};

/// A study whose time is taken.
#[derive(Debug)]
pub struct Measured(Study);

impl Measured {
    /// Reads its file.
    ///
    /// # Errors
    /// [`Failure::Usage`] naming the file, the key, its value and what is allowed.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        Study::read(path, Budget::POINT).map(Self)
    }

    /// How many points it has.
    pub fn points(&self) -> u64 {
        self.0.points
    }

    /// Drive periods for which each motion is followed.
    pub fn periods(&self) -> u64 {
        self.0.settling.periods
    }

    /// The machine at a point.
    pub fn machine_at(&self, point: u64) -> Machine {
        self.0.machine_at(point)
    }

    /// Computes all of it and writes its table, into a folder that is taken away.
    ///
    /// # Errors
    /// [`Failure::Run`] if a file cannot be written; [`Failure::Interrupted`].
    pub fn compute(&self) -> Result<(), Failure> {
        let folder = tempfile::tempdir().context("no folder for the results")?;
        let part = folder.path().join("study.part");
        let run = Run::open(&self.0, Shard::WHOLE, part, false)?;
        run.go_on()?;
        let file = File::create(folder.path().join(TABLE)).context(TABLE)?;
        table::write(&self.0, &mut run.done(), file, None)?;
        Ok(())
    }
}
