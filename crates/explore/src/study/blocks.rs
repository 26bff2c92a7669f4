//! Finished blocks of a study in files: of the whole study, or of its shards.

use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use softstop_console::failure::Failure;
use softstop_console::lock;
use softstop_console::record_log::{RecordLog, RecordSpan};

use super::file::Study;
use super::shard::Shard;

/// Blocks that are done: which file has them, and where.
#[derive(Debug)]
pub(super) struct Blocks {
    pub files: Vec<RecordLog>,
    /// Of each block; files by their place.
    pub places: Vec<Option<(u32, RecordSpan)>>,
}

pub(super) fn place(path: &Path) -> String {
    path.display().to_string()
}

impl Blocks {
    pub fn none(study: &Study) -> Self {
        Self {
            files: Vec::new(),
            places: vec![None; study.blocks() as usize],
        }
    }

    /// Takes in what a file holds of a study.
    pub fn take(&mut self, study: &Study, mut file: RecordLog) -> Result<(), Failure> {
        let number = self.files.len() as u32;
        let places = &mut self.places;
        let of = file.restore(|key, at| {
            let block = key.try_into().map(u64::from_le_bytes);
            let slot = block.ok().and_then(|it| places.get_mut(it as usize));
            if let Some(slot) = slot {
                *slot = Some((number, at));
            }
        });
        let path = file.path().to_owned();
        match of.with_context(|| format!("cannot read {}", place(&path)))? {
            Some(of) if of != study.hash.as_bytes() => {
                let path = place(&path);
                return Err(Failure::usage(format!(
                    "{path}: holds blocks of another study, or of another version of this program"
                )));
            }
            _ => self.files.push(file),
        }
        Ok(())
    }

    /// All blocks that files of finished shards hold.
    ///
    /// # Errors
    /// [`Failure::Usage`] if a file holds another study's; [`Failure::Run`] if one cannot be read, or is being written.
    pub fn merged(study: &Study, paths: &[PathBuf]) -> Result<Self, Failure> {
        let mut blocks = Self::none(study);
        for path in paths {
            let file =
                RecordLog::open(path).with_context(|| format!("cannot read {}", place(path)))?;
            let busy = || lock::refusal(path);
            blocks.take(study, file.ok_or_else(busy)?)?;
        }
        Ok(blocks)
    }

    /// Whether all blocks of a shard are there.
    pub fn has(&self, shard: Shard) -> bool {
        let mut own = self
            .places
            .iter()
            .zip(0..)
            .filter(|(_, it)| shard.holds(*it));
        own.all(|(place, _)| place.is_some())
    }

    /// Says what is missing.
    ///
    /// # Errors
    /// [`Failure::Run`] with which shards and points are.
    pub fn complete(&self, study: &Study) -> Result<(), Failure> {
        let missing = || self.places.iter().zip(0..).filter(|(it, _)| it.is_none());
        let Some((_, first)) = missing().next() else {
            return Ok(());
        };
        let paths = self.files.iter().map(RecordLog::path);
        let of = paths.filter_map(Shard::of_file);
        let of = of.map(|shard| shard.of).max().unwrap_or(1);
        let mut shards: Vec<u64> = missing().map(|(_, block)| block % of + 1).collect();
        shards.sort_unstable();
        shards.dedup();
        let (count, points) = (missing().count(), study.block(first));
        let told = shards
            .iter()
            .take(TOLD)
            .map(|number| format!("{number}/{of}"));
        let more = if shards.len() > TOLD { ", ..." } else { "" };
        Err(Failure::Run(anyhow!(
            "missing: {count} of {} blocks, of the shards {}{more}; the first has the points {} to {}",
            self.places.len(),
            told.collect::<Vec<_>>().join(", "),
            points.start,
            points.end - 1
        )))
    }

    /// The numbers of a block, output by output.
    ///
    /// # Errors
    /// [`Failure::Run`] if it cannot be read.
    pub fn read(&mut self, block: u64) -> Result<Vec<f64>, Failure> {
        let known = self.places[block as usize].and_then(|(file, at)| {
            let file = self.files.get_mut(file as usize)?;
            Some((file, at))
        });
        let (file, at) = known.ok_or_else(|| anyhow!("block {block} is missing"))?;
        let bytes = file.read(at);
        let bytes = bytes.with_context(|| format!("cannot read {}", place(file.path())))?;
        let numbers = bytes.chunks_exact(8).filter_map(|it| it.try_into().ok());
        Ok(numbers.map(f64::from_le_bytes).collect())
    }
}

/// Shards that a message names.
const TOLD: usize = 10;
