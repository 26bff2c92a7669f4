//! The rooms: the packages of the workspace, by their manifests.

use std::fs;
use std::path::{Path, PathBuf};

use toml::Table;

/// A room of the plan: its name, column and floor in the picture (floors count from the roof; none outside the
/// house), and what it may import besides crates of others and all that those rooms may import.
type Plan = (&'static str, Option<(f64, f64)>, &'static [&'static str]);

/// The plan of the house, from the ground up.
const PLAN: [Plan; 14] = [
    ("softstop", Some((1.0, 6.0)), &[]),
    ("softstop-fmi", Some((0.0, 6.0)), &[]),
    ("softstop-lanes", Some((1.0, 5.0)), &["softstop"]),
    (
        "softstop-fmu",
        Some((0.0, 5.0)),
        &["softstop", "softstop-fmi"],
    ),
    ("softstop-units", Some((2.0, 5.0)), &["softstop-fmi"]),
    ("softstop-dynamics", Some((1.0, 4.0)), &["softstop-lanes"]),
    ("softstop-console", Some((1.0, 3.0)), &["softstop-dynamics"]),
    ("softstop-draw", Some((2.0, 3.0)), &[]),
    (
        "softstop-explore",
        Some((1.0, 2.0)),
        &["softstop-console", "softstop-draw"],
    ),
    ("softstop-paper", Some((2.0, 1.0)), &["softstop-explore"]),
    (
        "softstop-optimize",
        Some((0.0, 1.0)),
        &["softstop-explore", "softstop-fmu"],
    ),
    (
        "softstop-lab",
        Some((1.0, 0.0)),
        &["softstop-paper", "softstop-fmu", "softstop-units"],
    ),
    ("softstop-testing", None, &["softstop"]),
    (
        "xtask",
        None,
        &[
            "softstop-fmi",
            "softstop-fmu",
            "softstop-optimize",
            "softstop-units",
        ],
    ),
];

/// A package.
pub struct Room {
    pub name: String,
    /// Its place from the top, empty for the top itself.
    pub place: String,
    pub folder: PathBuf,
    pub job: String,
    /// Its column and floor in the picture; none outside the house.
    pub corner: Option<(f64, f64)>,
    /// The rooms that it imports.
    pub imports: Vec<String>,
}

/// A room's line of the plan.
fn plan(name: &str) -> &'static Plan {
    let line = PLAN.iter().find(|room| room.0 == name);
    line.unwrap_or_else(|| panic!("{name}: give it a line in PLAN"))
}

/// Whether a room may import another.
pub fn may_import(room: &str, import: &str) -> bool {
    let below = plan(room).2.iter();
    below
        .copied()
        .any(|below| below == import || may_import(below, import))
}

/// All rooms, from the ground up.
pub fn all(top: &Path) -> Vec<Room> {
    let mut places = ["", "fmu", "optimize", "units", "xtask"]
        .map(str::to_owned)
        .to_vec();
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
    rooms.sort_by_key(|room| PLAN.iter().position(|line| line.0 == room.name));
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
        corner: plan(&word("name")).1,
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
