//! The structure of the workspace: which room may import which, no file in a circle of imports, and
//! docs/house.svg drawn from the manifests. `UPDATE=1 cargo test -p softstop-draw --test house` draws it anew.

#[path = "house/files.rs"]
mod files;
#[path = "house/picture.rs"]
mod picture;
#[path = "house/rooms.rs"]
mod rooms;

use std::path::PathBuf;

/// What each room may import, besides crates of others. The lines go from the ground up.
const MAY_IMPORT: [(&str, &[&str]); 13] = [
    ("softstop", &[]),
    ("softstop-draw", &[]),
    ("softstop-fmi", &[]),
    ("softstop-lanes", &["softstop"]),
    ("softstop-fmu", &["softstop", "softstop-fmi"]),
    ("softstop-dynamics", &["softstop", "softstop-lanes"]),
    ("softstop-console", &["softstop", "softstop-dynamics"]),
    (
        "softstop-explore",
        &[
            "softstop",
            "softstop-lanes",
            "softstop-dynamics",
            "softstop-console",
            "softstop-draw",
        ],
    ),
    (
        "softstop-optimize",
        &[
            "softstop",
            "softstop-lanes",
            "softstop-dynamics",
            "softstop-console",
            "softstop-draw",
            "softstop-explore",
            "softstop-fmi",
            "softstop-fmu",
        ],
    ),
    (
        "softstop-paper",
        &[
            "softstop",
            "softstop-lanes",
            "softstop-dynamics",
            "softstop-console",
            "softstop-draw",
            "softstop-explore",
        ],
    ),
    (
        "softstop-lab",
        &[
            "softstop",
            "softstop-lanes",
            "softstop-dynamics",
            "softstop-console",
            "softstop-draw",
            "softstop-explore",
            "softstop-fmi",
            "softstop-fmu",
            "softstop-paper",
        ],
    ),
    ("softstop-testing", &["softstop"]),
    (
        "xtask",
        &["softstop-fmi", "softstop-fmu", "softstop-optimize"],
    ),
];

fn top() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .nth(2)
        .expect("the top of the workspace")
        .to_owned()
}

#[test]
fn rooms_import_only_what_they_may() {
    for room in rooms::all(&top()) {
        let (_, allowed) = MAY_IMPORT
            .iter()
            .find(|(name, _)| *name == room.name)
            .unwrap_or_else(|| panic!("{}: say in MAY_IMPORT what it may import", room.name));
        for import in &room.imports {
            assert!(
                allowed.contains(&import.as_str()),
                "{} imports {import}",
                room.name
            );
        }
    }
}

#[test]
fn no_file_is_in_a_circle_of_imports() {
    let circles: Vec<String> = rooms::all(&top())
        .iter()
        .flat_map(|room| files::circles(&room.folder.join("src")))
        .collect();
    assert!(circles.is_empty(), "{}", circles.join("\n"));
}

#[test]
fn the_picture_of_the_house_is_that_of_the_manifests() {
    let place = top().join("docs/house.svg");
    let drawn = picture::draw(&rooms::all(&top()));
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&place, &drawn).expect("docs can be written");
    }
    let kept = std::fs::read_to_string(&place).expect("docs/house.svg");
    assert!(
        kept == drawn,
        "docs/house.svg is out of date: UPDATE=1 cargo test -p softstop-draw --test house"
    );
}
