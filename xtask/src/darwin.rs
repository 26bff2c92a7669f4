//! The library for macOS, linked without Apple's development kit.
//!
//! The linker that comes with Rust (LLD) knows macOS; of the kit it needs no more than the list of
//! the system library's symbols, and Zig brings that. Zig's own linker for macOS would do as well,
//! but it exports every function.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};

use crate::library::{Artifact, Build};
use crate::run::{cargo_command, target};

/// The standard library asks for iconv by name, but uses none of it; the linker drops it again.
const NO_ICONV: &str = "--- !tapi-tbd
tbd-version: 4
targets: [ x86_64-macos, arm64-macos ]
install-name: '/usr/lib/libiconv.2.dylib'
...
";

/// What the Python package asks of it: the name of the time zone, for dates in tables.
const CORE_FOUNDATION: &str = "--- !tapi-tbd
tbd-version: 4
targets: [ x86_64-macos, arm64-macos ]
install-name: '/System/Library/Frameworks/CoreFoundation.framework/Versions/A/CoreFoundation'
exports:
  - targets: [ x86_64-macos, arm64-macos ]
    symbols: [ _CFRelease, _CFStringGetBytes, _CFStringGetCStringPtr, _CFStringGetLength, _CFTimeZoneCopySystem,
      _CFTimeZoneGetName, _CFTimeZoneResetSystem ]
...
";

/// Makes a folder that stands in for Apple's kit; returns where it is.
pub fn kit(zig_library: &Path) -> Result<PathBuf> {
    let kit = target().join("darwin-kit");
    let folder = kit.join("usr/lib");
    fs::create_dir_all(&folder)?;
    let system = zig_library.join("darwin/libSystem.tbd");
    for name in ["libSystem.tbd", "libc.tbd", "libm.tbd"] {
        fs::copy(&system, folder.join(name)).with_context(|| system.display().to_string())?;
    }
    fs::write(folder.join("libiconv.tbd"), NO_ICONV)?;
    let framework = kit.join("System/Library/Frameworks/CoreFoundation.framework");
    fs::create_dir_all(&framework)?;
    fs::write(framework.join("CoreFoundation.tbd"), CORE_FOUNDATION)?;
    Ok(kit)
}

/// How to build for one processor.
pub fn build(artifact: Artifact, triple: &str, kit: &Path) -> Build {
    let mut command = cargo_command();
    command.env("SDKROOT", kit);
    let flags = [
        "-Clinker=rust-lld",
        "-Clinker-flavor=ld64.lld",
        "-Clink-arg=-install_name",
        "-Clink-arg=@rpath/softstop.dylib",
        "-Clink-arg=-dead_strip_dylibs",
        // Without paths of object files, which would enter the fingerprint of the library.
        "-Clink-arg=-S",
    ];
    Build {
        artifact,
        command,
        target: triple.to_owned(),
        flags: flags.map(str::to_owned).to_vec(),
    }
}

const UNIVERSAL: u32 = 0xcafe_babe;
const LIBRARY_OF_64_BITS: [u8; 4] = [0xcf, 0xfa, 0xed, 0xfe];

/// Pages of Apple's processors: each library starts on one.
const ALIGNMENT_BITS: u32 = 14;

/// Puts libraries for several processors into one file, as Apple's lipo does.
pub fn universal(slices: &[Vec<u8>]) -> Result<Vec<u8>> {
    let mut header = Vec::new();
    let mut put = |number: u32| header.extend(number.to_be_bytes());
    put(UNIVERSAL);
    put(u32::try_from(slices.len())?);
    let mut content = Vec::new();
    let page = 1 << ALIGNMENT_BITS;
    for slice in slices {
        ensure!(
            slice.len() >= 12 && slice.starts_with(&LIBRARY_OF_64_BITS),
            "not a 64-bit library for macOS"
        );
        content.resize(content.len().next_multiple_of(page), 0);
        // Processor and its variety stand behind the first word, in the order of the processor.
        for word in slice[4..12].as_chunks().0 {
            put(u32::from_le_bytes(*word));
        }
        put(u32::try_from(page + content.len())?);
        put(u32::try_from(slice.len())?);
        put(ALIGNMENT_BITS);
        content.extend_from_slice(slice);
    }
    header.resize(page, 0);
    header.append(&mut content);
    Ok(header)
}
