//! What is done of a sweep, kept for `--resume`.

use std::fs;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use serde::{Deserialize, Serialize};
use softstop::{Scene, Start};
use softstop_dynamics::{Chain, Plan, Step};

use softstop_console::failure::Failure;
use softstop_console::output::json;

/// The file, beside those of the result.
const NAME: &str = "sweep.part";

/// Where it is kept, and of what.
pub(super) struct Keep {
    path: PathBuf,
    /// What is swept, in full.
    of: String,
}

/// The file's content.
#[derive(Serialize, Deserialize)]
struct Content {
    of: String,
    chains: Vec<Vec<Step>>,
}

/// Bytes of the checksum at the file's end.
const CHECK: usize = 4;

/// What is swept: a file goes with the same one alone.
#[derive(Serialize)]
struct Swept<'a> {
    version: &'static str,
    parameter: &'static str,
    range: (f64, f64),
    steps: usize,
    periods: u64,
    tolerance: f64,
    start: Start,
    chains: Vec<(&'a Scene, &'static str)>,
}

impl Keep {
    pub(super) fn new(folder: &Path, plan: &Plan, chains: &[Chain]) -> Result<Self, Failure> {
        let each = chains.iter();
        let each = each.map(|chain| (&chain.machine.scene, chain.direction.name()));
        let swept = Swept {
            version: env!("CARGO_PKG_VERSION"),
            parameter: chains
                .first()
                .map_or("", |it| it.machine.name(plan.parameter)),
            range: plan.range,
            steps: plan.steps,
            periods: plan.periods,
            tolerance: plan.tolerance,
            start: plan.start,
            chains: each.collect(),
        };
        Ok(Self {
            path: folder.join(NAME),
            of: json(&swept)?,
        })
    }

    /// The file while it is being written.
    fn staged(&self) -> PathBuf {
        self.path.with_extension("part.new")
    }

    /// Puts what is done into the file, whole or not at all.
    pub(super) fn store(&self, chains: &[Chain]) -> Result<(), Failure> {
        let content = Content {
            of: self.of.clone(),
            chains: chains.iter().map(|chain| chain.steps.clone()).collect(),
        };
        let place = || format!("cannot write {}", self.path.display());
        let mut bytes = rmp_serde::to_vec(&content).with_context(place)?;
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        let staged = self.staged();
        let mut file = fs::File::create(&staged).with_context(place)?;
        file.write_all(&bytes).with_context(place)?;
        file.sync_all().with_context(place)?;
        fs::rename(&staged, &self.path).with_context(place)?;
        Ok(())
    }

    /// Gives the chains the steps that the file holds, none if there is no file.
    pub(super) fn restore(&self, chains: &mut [Chain]) -> Result<(), Failure> {
        let place = self.path.display();
        let bytes = match fs::read(&self.path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
            Err(error) => return Err(Failure::usage(format!("--resume: {place}: {error}"))),
        };
        let damaged = || Failure::Run(anyhow!("{place}: is damaged; sweep without --resume"));
        let (content, check) = bytes.split_last_chunk::<CHECK>().ok_or_else(damaged)?;
        if crc32fast::hash(content) != u32::from_le_bytes(*check) {
            return Err(damaged());
        }
        let content: Content = rmp_serde::from_slice(content).map_err(|_| damaged())?;
        if content.of != self.of || content.chains.len() != chains.len() {
            return Err(Failure::usage(format!(
                "--resume: {place} holds another sweep: all other arguments must be the same"
            )));
        }
        for (chain, steps) in chains.iter_mut().zip(content.chains) {
            chain.steps = steps;
        }
        Ok(())
    }

    /// Takes the file away.
    pub(super) fn forget(&self) {
        let _ = fs::remove_file(&self.path);
        let _ = fs::remove_file(self.staged());
    }
}
