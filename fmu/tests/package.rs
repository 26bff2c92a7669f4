//! The package: its description, its start values, and that it is the same each time.
#![allow(
    unsafe_code,
    reason = "loads the packaged library and calls its C functions"
)]

use crate::common::library as built;
use std::ffi::{CString, c_char, c_int, c_uint, c_void};
use std::fs;
use std::io::{Cursor, Read};
use std::path::Path;
use std::ptr;

use built::library_path;
use softstop::{Scene, Start};
use softstop_fmu::package::{self, Library, PackageError};
use softstop_fmu::{Imprint, Standard, StartValues, description, guid_of, library_guid, table};

fn library() -> Library {
    Library::read(&library_path(Standard::Fmi2)).expect("a readable library")
}

fn other_design() -> (Scene, Start) {
    let mut scene = StartValues::DEFAULT.scene();
    scene.clearance = 7.25;
    scene.excitation.frequency = 1.31;
    scene.piercing = None;
    (scene, Start::new(4.5, -2.25))
}

fn entry(archive: &[u8], name: &str) -> Vec<u8> {
    let mut archive = zip::ZipArchive::new(Cursor::new(archive)).expect("an archive");
    let mut bytes = Vec::new();
    let mut file = archive.by_name(name).expect("an entry");
    file.read_to_end(&mut bytes).expect("a readable entry");
    bytes
}

#[test]
fn top_level_description_is_up_to_date() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../modelDescription.xml");
    let kept = fs::read_to_string(path).expect("modelDescription.xml at the top level");
    let imprint = Imprint::from(StartValues::DEFAULT);
    let guid = guid_of(&imprint);
    let written = description::write(&imprint, &guid);
    assert!(
        kept == written,
        "modelDescription.xml is not up to date: run cargo xtask xml"
    );
}

fn other_imprint() -> Imprint {
    let (scene, start) = other_design();
    let values = StartValues::from_scene(&scene, start).expect("a scene it serves");
    let named = Imprint::from(values).named("Press <3>");
    let named = named.and_then(|imprint| imprint.described("A press & its strip"));
    named.expect("a name and a description")
}

#[test]
fn library_and_description_agree() {
    let library = Imprint::library();
    assert_eq!(library.values(), StartValues::DEFAULT.values());
    assert_eq!(library.name(), "softstop");
    let guid = guid_of(&library);
    assert_eq!(library_guid(), guid);
    let (scene, start) = other_design();
    let other = StartValues::from_scene(&scene, start).expect("a scene it serves");
    let named = library.named("other").expect("a name");
    let described = Imprint::library()
        .described("other")
        .expect("a description");
    for other in [other.into(), named, described] {
        assert_ne!(guid_of(&other), guid);
    }
}

#[test]
fn names_that_no_description_can_have() {
    let long = "x".repeat(65);
    for name in ["", "two\nlines", "nul\0", &long] {
        let error = Imprint::library().named(name).expect_err("refused");
        assert!(error.to_string().contains("1 to 64 bytes"), "{error}");
    }
    let longer = "ü".repeat(129);
    let error = Imprint::library().described(&longer).expect_err("refused");
    assert!(error.to_string().contains("1 to 256 bytes"), "{error}");
    let whole = Imprint::library()
        .named(&long[1..])
        .expect("as long as can be");
    assert_eq!(whole.file_name(), format!("{}.fmu", &long[1..]));
    assert_eq!(other_imprint().file_name(), "Press__3_.fmu");
}

#[test]
fn archive_is_the_same_each_time() {
    let archive = || package::archive(&Imprint::library(), &[library()]).expect("an archive");
    assert!(archive() == archive());
}

type Instantiate = unsafe extern "C" fn(
    *const c_char,
    c_int,
    *const c_char,
    *const c_char,
    *const c_void,
    c_int,
    c_int,
) -> *mut c_void;
type Free = unsafe extern "C" fn(*mut c_void);
type GetReal = unsafe extern "C" fn(*mut c_void, *const c_uint, usize, *mut f64) -> c_int;

#[test]
fn packed_library_has_its_own_name_and_values() {
    let imprint = other_imprint();
    let archive = package::archive(&imprint, &[library()]).expect("an archive");
    let guid = guid_of(&imprint);
    let xml = String::from_utf8(entry(&archive, "modelDescription.xml")).expect("UTF-8");
    assert!(xml.contains(&format!("guid=\"{guid}\"")));
    assert!(xml.contains("start=\"7.25\""));
    assert!(
        xml.contains("modelName=\"Press &lt;3&gt;\"")
            && xml.contains("modelIdentifier=\"softstop\"")
    );
    assert!(xml.contains("description=\"A press &amp; its strip\""));
    let page = String::from_utf8(entry(&archive, "documentation/index.html")).expect("UTF-8");
    assert!(page.contains("<title>Press &lt;3&gt;</title>"));

    let folder = tempfile::tempdir().expect("a folder");
    let path = folder
        .path()
        .join(std::env::consts::DLL_PREFIX.to_owned() + "packed");
    let suffix = std::env::consts::DLL_EXTENSION;
    let name = format!("binaries/{}/softstop.{suffix}", package::HOST_PLATFORM);
    fs::write(&path, entry(&archive, &name)).expect("a written library");
    let guids = [guid, library_guid()];
    let guids = guids.map(|guid| CString::new(guid).expect("no NUL"));
    // SAFETY: the library is ours, and the types are those of the standard.
    unsafe {
        let library = libloading::Library::new(&path).expect("a library that loads");
        let instantiate = library
            .get::<Instantiate>(b"fmi2Instantiate")
            .expect("a function");
        let free = library
            .get::<Free>(b"fmi2FreeInstance")
            .expect("a function");
        let get_real = library.get::<GetReal>(b"fmi2GetReal").expect("a function");
        let [own, default] = guids.each_ref().map(|guid| {
            let nothing = ptr::null();
            instantiate(
                c"unit".as_ptr(),
                1,
                guid.as_ptr(),
                nothing,
                ptr::null(),
                0,
                0,
            )
        });
        assert!(default.is_null());
        assert!(!own.is_null());
        let names = [
            "clearance",
            "excitation.frequency",
            "initial.velocity",
            "piercing.travel",
        ];
        let references = names.map(|name| table().by_name(name).expect("a variable").reference);
        let mut read = [f64::NAN; 4];
        assert_eq!(get_real(own, references.as_ptr(), 4, read.as_mut_ptr()), 0);
        assert_eq!(read, [7.25, 1.31, -2.25, 0.0]);
        free(own);
    }
}

#[test]
fn the_file_appears_whole_or_not_at_all() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("design.fmu");
    package::write(&path, &Imprint::library(), &[library()]).expect("a written file");
    let names: Vec<_> = fs::read_dir(folder.path())
        .expect("a readable folder")
        .map(|entry| entry.expect("an entry").file_name())
        .collect();
    assert_eq!(names, ["design.fmu"]);

    let nowhere = folder.path().join("missing").join("design.fmu");
    let error =
        package::write(&nowhere, &Imprint::library(), &[library()]).expect_err("no such folder");
    assert!(error.to_string().contains("design.fmu"), "{error}");
    assert!(matches!(error, PackageError::File { .. }));
}

#[test]
fn foreign_libraries_are_refused() {
    let foreign = Library {
        platform: "win64".to_owned(),
        bytes: vec![0; 4096],
    };
    let error = package::archive(&Imprint::library(), &[foreign]).expect_err("no start block");
    assert!(error.to_string().contains("win64"), "{error}");
    let none = package::archive(&Imprint::library(), &[]).expect_err("no library");
    assert!(matches!(none, PackageError::NoLibrary));
}
