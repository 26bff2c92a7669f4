//! Parts of a study that other computers may take.

use std::fmt::{self, Display, Formatter};
use std::path::Path;
use std::str::FromStr;

/// How the names of files end that have all blocks of a shard.
pub(super) const DONE: &str = "blocks";

/// One of so many parts of a study, the first of which is number 1: every so manieth block is its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    number: u64,
    pub(super) of: u64,
}

/// Most shards.
const MOST_SHARDS: u64 = 1_000_000;

impl Shard {
    /// The whole study.
    pub(super) const WHOLE: Self = Self { number: 1, of: 1 };

    pub(super) fn holds(self, block: u64) -> bool {
        block % self.of == self.number - 1
    }

    /// The file of its finished blocks.
    pub(super) fn name(self) -> String {
        format!("shard-{}-of-{}.{DONE}", self.number, self.of)
    }

    /// The one whose finished blocks a file has, by its name.
    pub(super) fn of_file(path: &Path) -> Option<Self> {
        let name = path.file_stem()?.to_str()?.strip_prefix("shard-")?;
        let (number, of) = name.split_once("-of-")?;
        format!("{number}/{of}").parse().ok()
    }
}

impl Display for Shard {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.parse::<u64>().ok();
        let parts = text.split_once('/').map(|(a, b)| (number(a), number(b)));
        match parts {
            Some((Some(number), Some(of))) if (1..=of).contains(&number) && of <= MOST_SHARDS => {
                Ok(Self { number, of })
            }
            _ => Err(format!(
                "must be I/N with I from 1 to N, at most {MOST_SHARDS}, as in 3/7"
            )),
        }
    }
}
