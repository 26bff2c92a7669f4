//! Every library of an FMU exports the functions of its standard and nothing else, and needs
//! nothing but the system.
//!
//! They are in the FMUs that were packed from the libraries built along with this test, and in the one that
//! `SOFTSTOP_FMU` names with the one for FMI 3.0 beside it: they should be as they are shipped.

use crate::common::library;
use std::collections::BTreeSet;
use std::env;
use std::fs;
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};

use library::library_path;
use object::endian::Endianness;
use object::read::elf::{ElfFile64, FileHeader, SectionHeader};
use object::read::macho::{FatArch, MachOFatFile32};
use object::{File, Object};
use softstop_fmu::package::{self, Library};
use softstop_fmu::{Imprint, Standard};

const STANDARDS: [Standard; 2] = [Standard::Fmi2, Standard::Fmi3];

/// Libraries that every Linux has, the loader among them. Since version 2.34 of the C library all
/// are parts of `libc.so.6` but `libm.so.6` and the loader.
const LINUX: [&str; 6] = [
    "libc.so.6",
    "libm.so.6",
    "libpthread.so.0",
    "libdl.so.2",
    "ld-linux-x86-64.so.2",
    "ld-linux-aarch64.so.1",
];
/// Libraries that every Windows since version 10 has, and Wine.
const WINDOWS: [&str; 2] = ["kernel32.dll", "ntdll.dll"];
/// API sets of Windows 10: the C library and waiting for an address.
const WINDOWS_SETS: [&str; 2] = ["api-ms-win-crt-", "api-ms-win-core-synch-"];
const MACOS: [&str; 1] = ["/usr/lib/libSystem.B.dylib"];

/// The oldest C library that a package for many platforms must run with.
const OLDEST_GLIBC: (u32, u32) = (2, 17);

struct Packed {
    standard: Standard,
    /// Folder in `binaries/`.
    platform: String,
    bytes: Vec<u8>,
}

/// The libraries of each FMU, and whether it was built apart from this test.
fn fmus() -> Vec<(Vec<Packed>, bool)> {
    let own = STANDARDS.map(|standard| {
        let library = Library::read(&library_path(standard)).expect("a readable library");
        (packed(standard, library), false)
    });
    let given = env::var_os("SOFTSTOP_FMU").map(PathBuf::from);
    let given = given.into_iter().flat_map(|path| {
        let beside = path.with_file_name("softstop-fmi3.fmu");
        STANDARDS.into_iter().zip([path, beside])
    });
    let given = given.map(|(standard, path)| {
        let archive = fs::read(path).expect("the FMU that SOFTSTOP_FMU names, and the one beside");
        (libraries(standard, &archive), true)
    });
    own.into_iter().chain(given).collect()
}

fn all_libraries() -> impl Iterator<Item = Packed> {
    fmus().into_iter().flat_map(|(libraries, _)| libraries)
}

fn imprint(standard: Standard) -> Imprint {
    Imprint::library().with_standard(standard)
}

/// The library as it is in the FMU.
fn packed(standard: Standard, library: Library) -> Vec<Packed> {
    let archive = package::archive(&imprint(standard), &[library]).expect("an archive");
    libraries(standard, &archive)
}

fn libraries(standard: Standard, archive: &[u8]) -> Vec<Packed> {
    let mut archive = zip::ZipArchive::new(Cursor::new(archive)).expect("an archive");
    let names: Vec<_> = archive
        .file_names()
        .map(|name| name.expect("a name").into_owned())
        .filter(|name| name.starts_with("binaries/"))
        .collect();
    assert!(!names.is_empty(), "no library");
    names
        .iter()
        .map(|name| {
            let mut bytes = Vec::new();
            let mut file = archive.by_name(name).expect("an entry");
            file.read_to_end(&mut bytes).expect("a readable entry");
            let platform = name.split('/').nth(1).expect("a folder").to_owned();
            Packed {
                standard,
                platform,
                bytes,
            }
        })
        .collect()
}

/// The libraries in a file: one, or one for each processor.
fn slices(bytes: &[u8]) -> Vec<&[u8]> {
    match MachOFatFile32::parse(bytes) {
        Ok(universal) => universal
            .arches()
            .iter()
            .map(|arch| arch.data(bytes).expect("a library inside the file"))
            .collect(),
        Err(_) => vec![bytes],
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn wanted_functions(standard: Standard) -> BTreeSet<String> {
    let definition = match standard {
        Standard::Fmi2 => include_str!("../fmi2/exports.def"),
        Standard::Fmi3 => include_str!("../fmi3/exports.def"),
    };
    let (_, names) = definition.split_once("EXPORTS").expect("a list of exports");
    names.split_whitespace().map(str::to_owned).collect()
}

#[test]
fn the_functions_of_the_standard_are_exported_and_nothing_else() {
    for library in all_libraries() {
        for slice in slices(&library.bytes) {
            let file = File::parse(slice).expect("a library");
            let exports: BTreeSet<_> = file
                .exports()
                .expect("a table of exports")
                .map(|export| {
                    let export = export.expect("an export");
                    let name = export.name();
                    text(name.name().expect("a name, not a number"))
                        .trim_start_matches('_')
                        .to_owned()
                })
                .collect();
            let wanted = wanted_functions(library.standard);
            assert_eq!(exports, wanted, "{}", library.platform);
        }
    }
}

/// Libraries that a Linux library asks for, and versions of symbols.
fn needs_of_elf(bytes: &[u8]) -> (Vec<String>, Vec<String>) {
    let file = ElfFile64::<Endianness>::parse(bytes).expect("a library for Linux");
    let (header, endian) = (file.elf_header(), file.endian());
    let sections = header.sections(endian, bytes).expect("sections");
    let mut libraries = Vec::new();
    for section in sections.iter() {
        let Some((entries, link)) = section.dynamic(endian, bytes).expect("dynamic entries") else {
            continue;
        };
        let strings = sections.strings(endian, bytes, link).expect("strings");
        for entry in entries {
            if entry.d_tag.get(endian) == object::elf::DT_NEEDED {
                let offset = u32::try_from(entry.d_val.get(endian)).expect("an offset");
                libraries.push(text(strings.get(offset).expect("a name")));
            }
        }
    }
    let mut versions = Vec::new();
    if let Some((mut files, link)) = sections.gnu_verneed(endian, bytes).expect("versions") {
        let strings = sections.strings(endian, bytes, link).expect("strings");
        while let Some((_, mut entries)) = files.next().expect("a file") {
            while let Some(entry) = entries.next().expect("a version") {
                versions.push(text(entry.name(endian, strings).expect("a name")));
            }
        }
    }
    (libraries, versions)
}

fn imports(bytes: &[u8]) -> BTreeSet<String> {
    let file = File::parse(bytes).expect("a library");
    file.imports()
        .expect("a table of imports")
        .map(|import| text(import.expect("an import").library()))
        .collect()
}

fn is_of_windows(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    WINDOWS.contains(&name.as_str()) || WINDOWS_SETS.iter().any(|set| name.starts_with(set))
}

#[test]
fn nothing_but_the_system_is_needed() {
    for library in all_libraries() {
        for slice in slices(&library.bytes) {
            let strange: Vec<_> = match library.platform.as_str() {
                linux if linux.contains("linux") => needs_of_elf(slice)
                    .0
                    .into_iter()
                    .filter(|name| !LINUX.contains(&name.as_str()))
                    .collect(),
                macos if macos.contains("darwin") => imports(slice)
                    .into_iter()
                    .filter(|name| !MACOS.contains(&name.as_str()))
                    .collect(),
                _ => imports(slice)
                    .into_iter()
                    .filter(|name| !is_of_windows(name))
                    .collect(),
            };
            assert!(strange.is_empty(), "{}: {strange:?}", library.platform);
        }
    }
}

/// The number in `GLIBC_2.17`.
fn glibc(version: &str) -> Option<(u32, u32)> {
    let mut numbers = version.strip_prefix("GLIBC_")?.split('.');
    let mut next = || numbers.next()?.parse().ok();
    Some((next()?, next()?))
}

#[test]
fn a_package_for_many_platforms_runs_with_an_old_c_library() {
    for (libraries, _) in fmus() {
        let many = libraries.len() > 1;
        for library in libraries.iter().filter(|l| l.platform.contains("linux")) {
            let (_, versions) = needs_of_elf(&library.bytes);
            let newest = versions.iter().filter_map(|version| glibc(version)).max();
            let newest = newest.expect("a version of the C library");
            println!("{}: C library {newest:?} or later", library.platform);
            assert!(!many || newest <= OLDEST_GLIBC, "{newest:?}");
        }
    }
}

#[test]
fn start_values_are_those_of_the_description() {
    for library in all_libraries() {
        // Packing again finds one block in each library and leaves the bytes as they are, since
        // the default FMU holds the default values.
        let again = Library {
            platform: library.platform,
            bytes: library.bytes.clone(),
        };
        let [packed, ..] = &packed(library.standard, again)[..] else {
            panic!("a library");
        };
        assert!(packed.bytes == library.bytes, "{}", packed.platform);
    }
}

/// A library as it is shipped tells nothing about the machine that it was built on. One of the daily build
/// does: its messages name source files.
#[test]
fn no_folder_of_this_machine_is_in_the_shipped_libraries() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    let mut folders = vec![top.expect("a workspace").to_owned()];
    folders.extend(env::home_dir());
    folders.extend(env::var_os("CARGO_HOME").map(Into::into));
    folders.extend(env::var_os("CARGO_TARGET_DIR").map(Into::into));
    let shipped = fmus().into_iter().filter(|(_, apart)| *apart);
    for library in shipped.flat_map(|(libraries, _)| libraries) {
        let text = String::from_utf8_lossy(&library.bytes);
        for folder in &folders {
            let folder = format!("{}/", folder.display());
            let platform = &library.platform;
            assert!(!text.contains(&folder), "{platform} names {folder}");
        }
    }
}
