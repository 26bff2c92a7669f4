//! The rooms: the packages of the workspace, by their manifests.

use std::fs;
use std::path::{Path, PathBuf};

use toml::Table;

/// A package.
pub struct Room {
    pub name: String,
    /// Its place from the top, empty for the top itself.
    pub place: String,
    pub folder: PathBuf,
    pub job: String,
    /// The rooms that it imports.
    pub imports: Vec<String>,
}

/// All rooms, in the order of their names.
pub fn all(top: &Path) -> Vec<Room> {
    let mut places = ["", "fmu", "optimize", "xtask"].map(str::to_owned).to_vec();
    let crates = fs::read_dir(top.join("crates")).expect("crates");
    places.extend(crates.filter_map(|entry| {
        let name = entry.ok()?.file_name().into_string().ok()?;
        Some(format!("crates/{name}"))
    }));
    let mut rooms: Vec<Room> = places
        .into_iter()
        .filter(|place| top.join(place).join("Cargo.toml").is_file())
        .map(|place| room(top, place))
        .collect();
    rooms.sort_by(|a, b| a.name.cmp(&b.name));
    rooms
}

fn room(top: &Path, place: String) -> Room {
    let folder = top.join(&place);
    let text = fs::read_to_string(folder.join("Cargo.toml")).expect("a manifest");
    let manifest: Table = text.parse().expect("TOML");
    let word = |key: &str| {
        let value = manifest["package"][key].as_str();
        value.expect("a word").to_owned()
    };
    let imports = manifest["dependencies"].as_table().expect("a table");
    Room {
        name: word("name"),
        job: word("description"),
        imports: imports
            .keys()
            .filter(|name| name.starts_with("softstop"))
            .cloned()
            .collect(),
        place,
        folder,
    }
}

impl Room {
    /// The rooms that it imports.
    pub fn below<'a>(&'a self, rooms: &'a [&Self]) -> impl Iterator<Item = &'a Self> {
        let is_below = |room: &&&Self| self.imports.contains(&room.name);
        rooms.iter().filter(is_below).copied()
    }

    /// Whether it rests on a room, over however many others.
    pub fn rests_on(&self, name: &str, rooms: &[&Self]) -> bool {
        self.below(rooms)
            .any(|room| room.name == name || room.rests_on(name, rooms))
    }
}
