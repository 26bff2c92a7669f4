//! Files that runs hold locked: of two runs that write to one place, the second is refused.

use std::fs::{self, File, Metadata, OpenOptions, TryLockError};
use std::io;
use std::path::Path;

use anyhow::anyhow;

use crate::failure::Failure;

/// A file of this run's own, open for reading and writing.
#[derive(Debug)]
pub struct Locked {
    /// The file. Its lock ends with it.
    pub file: File,
    /// Whether it is locked; not so where the file system has no locks.
    pub is_held: bool,
}

/// How often a file is opened again that the run before it took away in between.
const ATTEMPTS: usize = 10;

/// Opens a file and locks it, without following a link; none if a run that lives has it.
///
/// # Errors
/// What the system says; [`io::ErrorKind::InvalidInput`] if it is no regular file, or has a second name.
pub fn open(path: &Path, create: bool) -> io::Result<Option<Locked>> {
    for _ in 0..ATTEMPTS {
        let file = options(create).open(path)?;
        let own = file.metadata()?;
        if !own.is_file() || has_other_names(&own) {
            let message = "it is a link or no regular file";
            return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        }
        let is_held = match file.try_lock() {
            Err(TryLockError::WouldBlock) => return Ok(None),
            held => held.is_ok(),
        };
        if fs::symlink_metadata(path).is_ok_and(|there| is_same(&own, &there)) {
            return Ok(Some(Locked { file, is_held }));
        }
    }
    Ok(None)
}

/// What is said to the second of two runs.
pub fn refusal(place: &Path) -> Failure {
    let place = place.display();
    Failure::Run(anyhow!("{place}: is written by another run that goes on"))
}

fn options(create: bool) -> OpenOptions {
    let mut options = OpenOptions::new();
    options.read(true).write(true).create(create);
    // A pipe in its place must not make the run wait.
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(
        &mut options,
        libc::O_NOFOLLOW | libc::O_NONBLOCK,
    );
    options
}

#[cfg(unix)]
fn has_other_names(file: &Metadata) -> bool {
    std::os::unix::fs::MetadataExt::nlink(file) > 1
}

#[cfg(not(unix))]
fn has_other_names(_: &Metadata) -> bool {
    false
}

#[cfg(unix)]
fn is_same(one: &Metadata, other: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;

    (one.dev(), one.ino()) == (other.dev(), other.ino())
}

#[cfg(not(unix))]
fn is_same(_: &Metadata, other: &Metadata) -> bool {
    other.is_file()
}
