//! The structure of the workspace: which room may import which, no file in a circle of imports, and
//! docs/house.svg and the map in docs/design.md drawn from manifests and files; and that no page has lost a table.
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

/// Pages are written by hand around tables that programs print: one that has lost its rows would go unnoticed.
#[test]
fn no_page_has_an_empty_table_or_a_picture_that_is_not_there() {
    let docs = top().join("docs");
    for entry in std::fs::read_dir(&docs).expect("docs") {
        let path = entry.expect("a page").path();
        if path.extension().is_none_or(|it| it != "md") {
            continue;
        }
        let page = std::fs::read_to_string(&path).expect("UTF-8");
        let name = path.display();
        let lines: Vec<&str> = page.lines().collect();
        for (index, line) in lines.iter().enumerate() {
            if line.starts_with("|-") {
                let row = lines.get(index + 1).copied().unwrap_or_default();
                let is_filled = row.chars().any(char::is_alphanumeric);
                assert!(
                    row.starts_with('|') && is_filled,
                    "{name}: no row below line {}",
                    index + 1
                );
            }
        }
        let pictures = page.split("](").skip(1);
        let pictures = pictures.filter_map(|rest| rest.split(')').next());
        for picture in pictures.filter(|it| it.ends_with(".svg") || it.ends_with(".png")) {
            let length = std::fs::metadata(docs.join(picture)).map_or(0, |it| it.len());
            assert!(length > 1000, "{name}: {picture} is empty");
        }
    }
}
