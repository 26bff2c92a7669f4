//! Writes the FMU file: model description, libraries, documentation and licences in one archive.
//!
//! The archive depends on nothing but the imprint and the libraries: entries are sorted and
//! carry a fixed date.

use std::fs::{self, File};
use std::io::{self, Cursor, Write};
use std::path::{Path, PathBuf};

use memchr::memmem;
use thiserror::Error;
use zip::write::{SimpleFileOptions, ZipWriter};
use zip::{CompressionMethod, DateTime};

use crate::imprint::Imprint;
use crate::standard::Standard;
use crate::unit::Unit;
use crate::{description, document, guid, reference};

/// Folder in `binaries/` of the machine that this program runs on.
pub const HOST_PLATFORM: &str = if cfg!(target_os = "windows") {
    "win64"
} else if cfg!(target_os = "macos") {
    "darwin64"
} else if cfg!(target_arch = "aarch64") {
    "aarch64-linux"
} else {
    "linux64"
};

/// Deflate's level: packing at the usual one takes longer than finding a design.
const QUICKLY: i64 = 1;

/// The icon, where FMI 2.0 has it.
const ICON: &str = "model.png";

/// A compiled library for one platform.
#[derive(Debug, Clone)]
pub struct Library {
    /// Folder in `binaries/`, for instance `linux64`.
    pub platform: String,
    /// Content of the file.
    pub bytes: Vec<u8>,
}

/// Why no FMU was written.
#[derive(Debug, Error)]
pub enum PackageError {
    /// A file or folder could not be read or written.
    #[error("{path}: {source}", path = path.display())]
    File {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The archive could not be made.
    #[error("the archive could not be made: {0}")]
    Archive(#[from] zip::result::ZipError),
    /// A part of the archive could not be made.
    #[error("a part of the archive could not be made: {0}")]
    Content(#[from] io::Error),
    /// The library is not one of this version.
    #[error(
        "the library for {platform} holds {found} blocks of start values, not {wanted}: it is not of this version"
    )]
    Foreign {
        /// The library's platform.
        platform: String,
        /// How many blocks were found.
        found: usize,
        /// How many it should hold: one for each processor.
        wanted: usize,
    },
    /// There is no library to pack.
    #[error("no library given: an FMU needs one at least")]
    NoLibrary,
}

impl Library {
    /// Reads a library that was compiled for this machine.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn read(path: &Path) -> Result<Self, PackageError> {
        Ok(Self {
            platform: HOST_PLATFORM.to_owned(),
            bytes: fs::read(path).map_err(at(path))?,
        })
    }

    /// Where it lies, in a folder for each processor if the standard has one.
    fn paths(&self, identifier: &str, standard: Standard) -> Vec<String> {
        let extension = if self.platform.starts_with("win") {
            "dll"
        } else if self.platform.starts_with("darwin") {
            "dylib"
        } else {
            "so"
        };
        let folders = match (standard, self.platform.as_str()) {
            (Standard::Fmi3, "linux64") => vec!["x86_64-linux"],
            (Standard::Fmi3, "win64") => vec!["x86_64-windows"],
            // A universal library.
            (Standard::Fmi3, "darwin64") => vec!["x86_64-darwin", "aarch64-darwin"],
            (_, platform) => vec![platform],
        };
        let path = |folder| format!("binaries/{folder}/{identifier}.{extension}");
        folders.into_iter().map(path).collect()
    }

    /// How many libraries are in the file: a universal one of macOS holds one for each processor.
    fn slices(&self) -> usize {
        match self.bytes[..] {
            [0xca, 0xfe, 0xba, 0xbe, a, b, c, d, ..] => u32::from_be_bytes([a, b, c, d]) as usize,
            _ => 1,
        }
    }

    /// The library's bytes with another imprint in its block.
    fn with_imprint<U: Unit>(&self, imprint: &Imprint<U>) -> Result<Vec<u8>, PackageError> {
        let marker = U::block().marker();
        let values = imprint.to_bytes();
        let found: Vec<_> = memmem::find_iter(&self.bytes, &marker)
            .map(|position| position + marker.len())
            .filter(|start| start + values.len() <= self.bytes.len())
            .collect();
        let wanted = self.slices();
        if found.len() != wanted {
            return Err(PackageError::Foreign {
                platform: self.platform.clone(),
                found: found.len(),
                wanted,
            });
        }
        let mut bytes = self.bytes.clone();
        for position in found {
            bytes[position..position + values.len()].copy_from_slice(&values);
        }
        Ok(bytes)
    }
}

fn at(path: &Path) -> impl FnOnce(io::Error) -> PackageError {
    let path = path.to_owned();
    move |source| PackageError::File { path, source }
}

/// Writes an FMU with this imprint.
///
/// The file appears complete or not at all: it is written beside its place and then moved there.
///
/// # Errors
/// If a library is not one of this version, or the file cannot be written.
pub fn write<U: Unit>(
    path: &Path,
    imprint: &Imprint<U>,
    libraries: &[Library],
) -> Result<(), PackageError> {
    write_file(path, &archive(imprint, libraries)?)
}

/// Writes a file that is there whole or not at all.
///
/// # Errors
/// If it cannot be written.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), PackageError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let beside = path.with_file_name(format!(".{name}.{}.part", std::process::id()));
    let written = write_whole(&beside, bytes)
        .and_then(|()| fs::rename(&beside, path))
        .map_err(at(path));
    if written.is_err() {
        // Best effort: if the file cannot be removed, the first error is the one to tell.
        let _ = fs::remove_file(&beside);
    }
    written
}

fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// The bytes of the FMU.
///
/// # Errors
/// If a library is not one of this version.
pub fn archive<U: Unit>(
    imprint: &Imprint<U>,
    libraries: &[Library],
) -> Result<Vec<u8>, PackageError> {
    if libraries.is_empty() {
        return Err(PackageError::NoLibrary);
    }
    let xml = description::write(imprint, &guid::guid_of(imprint));
    let page = document::html(imprint);
    let mut entries = vec![
        ("modelDescription.xml".to_owned(), xml.into_bytes()),
        ("documentation/index.html".to_owned(), page.into_bytes()),
    ];
    let about = U::about();
    let standard = imprint.standard();
    let files = about.files.iter();
    entries.extend(files.map(|(name, bytes)| {
        let name = match (standard, *name) {
            (Standard::Fmi3, ICON) => "terminalsAndIcons/icon.png",
            (_, name) => name,
        };
        (name.to_owned(), bytes.to_vec())
    }));
    if standard == Standard::Fmi3 {
        let has_icon = about.files.iter().any(|(name, _)| *name == ICON);
        let text = description::v3::terminals_and_icons(about.terminals, has_icon);
        let name = "terminalsAndIcons/terminalsAndIcons.xml".to_owned();
        entries.push((name, text.into_bytes()));
        entries.extend(reference::files(imprint));
    }
    for library in libraries {
        let bytes = library.with_imprint(imprint)?;
        let paths = library.paths(about.identifier, standard).into_iter();
        entries.extend(paths.map(|path| (path, bytes.clone())));
    }
    zipped(entries)
}

/// The bytes of an archive with these files.
///
/// # Errors
/// If it cannot be made.
pub fn zipped(mut entries: Vec<(String, Vec<u8>)>) -> Result<Vec<u8>, PackageError> {
    entries.sort();
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .compression_level(Some(QUICKLY))
        .last_modified_time(DateTime::default());
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in entries {
        let mode = if name.starts_with("binaries/") {
            0o755
        } else {
            0o644
        };
        archive.start_file(name, options.unix_permissions(mode))?;
        archive.write_all(&bytes)?;
    }
    Ok(archive.finish()?.into_inner())
}
