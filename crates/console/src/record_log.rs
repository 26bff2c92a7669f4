//! Files of records that grow while a run goes on: whatever ends the run, all that was whole is there after it.
//!
//! Each record has a key, a piece of work and their checksum. Its first, with an empty key, says what the file is of. A
//! record that a kill cuts off ends the file.

use std::fs::{self, File};
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use anyhow::Context;
use serde::Serialize;
use softstop_dynamics::monitor::to_bytes;
use uuid::Uuid;

use crate::lock::{self, Locked};

/// A file of records, locked by this run.
#[derive(Debug)]
pub struct RecordLog {
    path: PathBuf,
    file: File,
    /// Where its whole records end.
    end: u64,
    /// When it was last written through to the disk.
    synced: Instant,
}

/// Where a piece is in its file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RecordSpan {
    offset: u64,
    key: u32,
    piece: u32,
}

/// How often a file is written through to the disk, against a crash of the system; a kill takes nothing written.
const SYNC: Duration = Duration::from_secs(5);
/// Bytes of what a first record says the file is of, at most.
const MAX_FIRST_PIECE: u32 = 1 << 20;
/// Bytes in front of a record: its checksum, and the lengths of key and piece.
const HEAD: usize = 12;

impl RecordLog {
    /// A new file, of which this says what it is; none if a run that lives has one there.
    ///
    /// # Errors
    /// What the system says.
    pub fn create(path: &Path, of: &[u8]) -> io::Result<Option<Self>> {
        let Some(Locked { file, .. }) = lock::open(path, true)? else {
            return Ok(None);
        };
        let mut log = Self::of(path, file);
        let empty = log.file.set_len(0);
        let begun = empty.and_then(|()| log.append(&[], of));
        begun.inspect_err(|_| drop(fs::remove_file(path)))?;
        Ok(Some(log))
    }

    /// The file that is there, not yet read; none if a run that lives has it.
    ///
    /// # Errors
    /// What the system says; [`io::ErrorKind::NotFound`]; [`io::ErrorKind::InvalidData`] if no run has written it.
    pub fn open(path: &Path) -> io::Result<Option<Self>> {
        let Some(locked) = lock::open(path, false)? else {
            return Ok(None);
        };
        let mut log = Self::of(path, locked.file);
        match log.begins_as_one()? {
            true => Ok(Some(log)),
            false => Err(io::Error::new(
                io::ErrorKind::InvalidData,
                "no run has written it: move it away",
            )),
        }
    }

    /// Whether the file holds nothing, not even after a crash of the system that left zeros, or begins with a record without
    /// a key, whole or cut off.
    fn begins_as_one(&mut self) -> io::Result<bool> {
        let length = self.file.seek(SeekFrom::End(0))?;
        self.file.seek(SeekFrom::Start(0))?;
        let mut head = Vec::new();
        Read::by_ref(&mut self.file)
            .take(HEAD as u64)
            .read_to_end(&mut head)?;
        let piece = head.last_chunk().copied().map_or(0, u32::from_le_bytes);
        let is_cut_off = head.len() < HEAD
            || (piece < MAX_FIRST_PIECE && HEAD as u64 + u64::from(piece) > length);
        self.file.seek(SeekFrom::Start(0))?;
        let is_empty = head.iter().all(|byte| *byte == 0);
        let has_no_key = head.get(4..8) == Some(&[0; 4]);
        Ok(is_empty || (has_no_key && (is_cut_off || next(&mut self.file, 0, length)?.is_some())))
    }

    fn of(path: &Path, file: File) -> Self {
        Self {
            path: path.to_owned(),
            file,
            end: 0,
            synced: Instant::now(),
        }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Goes through all records up to the first that is not whole, behind which it goes on; what it is of, if it was
    /// not cut off before it said so.
    ///
    /// # Errors
    /// What the system says.
    pub fn restore(
        &mut self,
        mut visit: impl FnMut(&[u8], RecordSpan),
    ) -> io::Result<Option<Vec<u8>>> {
        let length = self.file.seek(SeekFrom::End(0))?;
        self.file.seek(SeekFrom::Start(0))?;
        let (mut of, mut end) = (None, 0);
        let mut reader = BufReader::new(&self.file);
        while let Some((at, [key, piece])) = next(&mut reader, end, length)? {
            end = at.end();
            match &of {
                None if key.is_empty() => of = Some(piece),
                None => break,
                Some(_) => visit(&key, at),
            }
        }
        self.end = if of.is_some() { end } else { 0 };
        self.file.set_len(self.end)?;
        self.file.seek(SeekFrom::Start(self.end))?;
        Ok(of)
    }

    /// Adds a record.
    ///
    /// # Errors
    /// What the system says; the file then ends as before.
    pub fn append(&mut self, key: &[u8], piece: &[u8]) -> io::Result<RecordSpan> {
        let record = record(key, piece)?;
        let at = RecordSpan {
            offset: self.end,
            key: key.len() as u32,
            piece: piece.len() as u32,
        };
        self.file.seek(SeekFrom::Start(self.end))?;
        if let Err(error) = self.file.write_all(&record) {
            let _ = self.file.set_len(self.end);
            return Err(error);
        }
        self.end = at.end();
        if self.synced.elapsed() >= SYNC {
            self.sync()?;
        }
        Ok(at)
    }

    /// The piece at a place.
    ///
    /// # Errors
    /// What the system says; [`io::ErrorKind::InvalidData`] if its checksum is wrong.
    pub fn read(&mut self, at: RecordSpan) -> io::Result<Vec<u8>> {
        self.file.seek(SeekFrom::Start(at.offset))?;
        let found = next(&mut self.file, at.offset, at.end())?;
        let whole = found.filter(|(other, _)| *other == at);
        let damaged = || io::Error::new(io::ErrorKind::InvalidData, "it is damaged");
        whole.map(|(_, [_, piece])| piece).ok_or_else(damaged)
    }

    /// Writes all through to the disk.
    ///
    /// # Errors
    /// What the system says.
    pub fn sync(&mut self) -> io::Result<()> {
        self.synced = Instant::now();
        self.file.sync_data()
    }
}

impl RecordSpan {
    fn end(self) -> u64 {
        self.offset + HEAD as u64 + u64::from(self.key) + u64::from(self.piece)
    }
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

/// The record that begins at this offset in a file of this length, its key and its piece; none if it is not whole.
fn next(
    reader: &mut impl Read,
    offset: u64,
    length: u64,
) -> io::Result<Option<(RecordSpan, [Vec<u8>; 2])>> {
    if offset + HEAD as u64 > length {
        return Ok(None);
    }
    let mut head = [0; HEAD];
    reader.read_exact(&mut head)?;
    let number = |at: usize| {
        let bytes = head[at..].first_chunk().copied().unwrap_or_default();
        u32::from_le_bytes(bytes)
    };
    let at = RecordSpan {
        offset,
        key: number(4),
        piece: number(8),
    };
    if at.end() > length {
        return Ok(None);
    }
    let parts = [at.key, at.piece].map(|length| vec![0; length as usize]);
    let [mut key, mut piece] = parts;
    reader.read_exact(&mut key)?;
    reader.read_exact(&mut piece)?;
    let mut check = crc32fast::Hasher::new();
    for part in [&head[4..], &key, &piece] {
        check.update(part);
    }
    Ok((check.finalize() == number(0)).then_some((at, [key, piece])))
}

/// What runs of the same version and settings have in common, in a word: a UUID of version 5 (RFC 9562).
///
/// # Errors
/// If the settings cannot be written.
pub fn fingerprint(of: &impl Serialize) -> anyhow::Result<String> {
    Ok(Uuid::new_v5(&Uuid::NAMESPACE_OID, &run_identity(of)?).to_string())
}

/// What runs of the same version and settings have in common, as bytes.
pub(crate) fn run_identity(of: &impl Serialize) -> anyhow::Result<Vec<u8>> {
    to_bytes(&(env!("CARGO_PKG_VERSION"), of)).context("cannot tell runs apart")
}
