//! The structure of the workspace: which room may import which, no file in a circle of imports, and
//! docs/house.svg and the map in docs/design.md drawn from manifests and files.
//! `UPDATE=1 cargo test -p softstop-draw --test house` draws them anew.

#[path = "house/files.rs"]
mod files;
#[path = "house/map.rs"]
mod map;
#[path = "house/picture.rs"]
mod picture;
#[path = "house/rooms.rs"]
mod rooms;

use std::path::PathBuf;

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
        for import in &room.imports {
            let may = rooms::may_import(&room.name, import);
            assert!(may, "{} imports {import}", room.name);
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
    let drawn = picture::draw(&rooms::all(&top()));
    is_kept("docs/house.svg", |_| drawn.clone());
}

#[test]
fn the_map_of_the_house_is_that_of_its_files() {
    let map = map::draw(&rooms::all(&top()));
    is_kept("docs/design.md", |page| {
        let before = page.split(map::HEADING).next().unwrap_or_default();
        format!("{before}{map}")
    });
}

/// Asks whether a file is as it is drawn now, from what it was; with `UPDATE` it is drawn anew.
fn is_kept(place: &str, draw: impl Fn(&str) -> String) {
    let path = top().join(place);
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    let drawn = draw(&kept);
    if std::env::var_os("UPDATE").is_some() {
        return std::fs::write(&path, &drawn).expect("docs can be written");
    }
    assert!(
        kept == drawn,
        "{place} is out of date: UPDATE=1 cargo test -p softstop-draw --test house"
    );
}
