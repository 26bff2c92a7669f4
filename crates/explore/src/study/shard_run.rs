//! A run of a shard of a study, or of the whole, that can be taken up where it ended.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use anyhow::{Context, Error};
use rayon::prelude::*;
use softstop_console::failure::{Failure, check_interrupt};
use softstop_console::interrupt::under_way;
use softstop_console::keep::KEPT;
use softstop_console::lock;
use softstop_console::progress::Progress;
use softstop_console::record_log::RecordLog;
use softstop_dynamics::parallel::parallel_blocks;

use super::blocks::{Blocks, place};
use super::file::Study;
use super::points::BLOCK;
use super::shard::Shard;

/// A run of a shard, or of the whole study.
#[derive(Debug)]
pub(super) struct ShardRun<'a> {
    study: &'a Study,
    shard: Shard,
    path: PathBuf,
    blocks: Mutex<Blocks>,
}

impl<'a> ShardRun<'a> {
    /// Waits while another run has the file: a shard may be given to a second worker before the first has ended.
    ///
    /// # Errors
    /// [`Failure::Interrupted`].
    pub fn wait(path: &Path) -> Result<(), Failure> {
        while matches!(RecordLog::open(path), Ok(None)) && path.exists() {
            check_interrupt()?;
            thread::sleep(WAIT);
        }
        Ok(())
    }

    /// Begins one with a file of this name, or goes on with it.
    ///
    /// # Errors
    /// [`Failure::Usage`] if the file is another study's; [`Failure::Run`] if it cannot be read or written, or another
    /// run writes it.
    pub fn open(
        study: &'a Study,
        shard: Shard,
        path: PathBuf,
        resume: bool,
    ) -> Result<Self, Failure> {
        let mut blocks = Blocks::none(study);
        let cannot = |what: &str, error: io::Error| {
            let place = place(&path);
            Failure::Run(Error::from(error).context(format!("cannot {what} {place}")))
        };
        match RecordLog::open(&path) {
            Ok(Some(file)) if resume => blocks.take(study, file)?,
            Ok(_) => {}
            Err(error) if error.kind() == ErrorKind::NotFound => {}
            // It is somebody else's.
            Err(error) => return Err(cannot("read", error)),
        }
        let is_begun = blocks.places.iter().any(Option::is_some);
        if !is_begun {
            // The lock of a file without any block goes before it is made anew.
            blocks.files.clear();
            let file = RecordLog::create(&path, study.hash.as_bytes());
            let file = file.map_err(|error| cannot("write", error))?;
            let busy = || lock::refusal(&path);
            blocks.files = vec![file.ok_or_else(busy)?];
        }
        under_way().closing = KEPT;
        Ok(Self {
            study,
            shard,
            path,
            blocks: Mutex::new(blocks),
        })
    }

    fn blocks(&self) -> MutexGuard<'_, Blocks> {
        self.blocks.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Does what is left to do.
    ///
    /// # Errors
    /// [`Failure::Interrupted`]; [`Failure::Run`] if the file cannot be written. What is done is kept.
    pub fn go_on(&self) -> Result<(), Failure> {
        let all = 0..self.study.blocks();
        let own = || all.clone().filter(|block| self.shard.holds(*block));
        let size = |block| {
            let points = self.study.block(block);
            points.end - points.start
        };
        let progress = Progress::new(own().map(size).sum(), "points");
        let known = |block: &u64| self.blocks().places[*block as usize].is_some();
        progress.begin_at(own().filter(known).map(size).sum());
        parallel_blocks(0..self.study.points, BLOCK).try_for_each(|points| {
            let block = points.start / BLOCK;
            if !self.shard.holds(block) || known(&block) {
                return Ok(());
            }
            let numbers = self.study.evaluate(block)?;
            let bytes: Vec<u8> = numbers.iter().flat_map(|it| it.to_le_bytes()).collect();
            self.keep(block, &bytes)?;
            progress.steps(points.end - points.start)
        })
    }

    fn keep(&self, block: u64, bytes: &[u8]) -> Result<(), Failure> {
        let mut blocks = self.blocks();
        let Blocks { files, places } = &mut *blocks;
        let file = files.last_mut().context("no file to keep blocks in")?;
        let at = file.append(&block.to_le_bytes(), bytes).with_context(|| {
            let place = place(&self.path);
            match places.iter().any(Option::is_some) {
                true => {
                    format!("cannot write {place}; what is done is kept, --resume goes on with it")
                }
                false => {
                    let _ = fs::remove_file(&self.path);
                    format!("cannot write {place}")
                }
            }
        })?;
        places[block as usize] = Some((0, at));
        Ok(())
    }

    /// Puts the file in place under another name.
    ///
    /// # Errors
    /// [`Failure::Run`] if that cannot be done.
    pub fn close(self, name: &Path) -> Result<(), Failure> {
        let mut blocks = self.blocks();
        let file = blocks.files.last_mut().context("no file to put in place")?;
        let put = file.sync().and_then(|()| fs::rename(&self.path, name));
        put.with_context(|| format!("cannot write {}", place(name)))?;
        Ok(())
    }

    /// Its blocks, all of which are done.
    pub fn done(self) -> Blocks {
        let blocks = self.blocks.into_inner();
        blocks.unwrap_or_else(PoisonError::into_inner)
    }
}

/// Between two looks whether another run of the same shard has ended.
const WAIT: Duration = Duration::from_millis(100);

#[cfg(test)]
mod tests {
    use anyhow::anyhow;
    use softstop_console::budget::Budget;

    use super::*;

    #[test]
    fn a_file_that_no_run_has_written_is_left_and_told() -> anyhow::Result<()> {
        let folder = tempfile::tempdir()?;
        let [file, part] = ["study.toml", "study.part"].map(|name| folder.path().join(name));
        let text = "outputs = [\"z\"]\n[[axis]]\nparameter = \"eta\"\nvalues = [1.0]\n";
        fs::write(&file, text)?;
        fs::write(&part, "a letter, say, and no blocks")?;
        let study = Study::read(&file, Budget::POINT)?;
        for resume in [false, true] {
            let run = ShardRun::open(&study, Shard::WHOLE, part.clone(), resume);
            let Err(Failure::Run(error)) = run else {
                return Err(anyhow!("it was taken for its own"));
            };
            let told = format!("cannot read {}: no run has written it", place(&part));
            assert!(format!("{error:#}").starts_with(&told), "{error:#}");
        }
        assert_eq!(fs::read_to_string(&part)?, "a letter, say, and no blocks");
        Ok(())
    }
}
