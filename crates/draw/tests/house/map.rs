//! The map of the house in words: each file with the first sentence that it says of itself, and what it defines.

use std::fs;
use std::path::{Path, PathBuf};

use super::rooms::Room;

/// Where the map begins in docs/design.md; it goes to the end of the page.
pub const HEADING: &str = "\n## Map\n";

/// The map as Markdown: a list for each room, a line for each folder.
pub fn draw(rooms: &[Room]) -> String {
    let mut map = format!(
        "{HEADING}\n<details><summary>Each file with what it says of itself and, in brackets, its types and the functions \
         that others may use. What stands right behind a folder's name is in its <code>mod.rs</code>. \
         <code>UPDATE=1 cargo test -p softstop-draw --test house</code> writes this list.</summary>\n"
    );
    for room in rooms {
        let place = room.place.trim_end_matches('/');
        let source = if place.is_empty() { "src" } else { place };
        map += &format!("\n**`{source}/`** {}\n\n", room.job);
        folder(&room.folder.join("src"), "", &mut map);
        map += &tests(&room.folder.join("tests"));
    }
    map + "\n</details>\n"
}

/// The line of a room's tests: their names alone, which say what is claimed.
fn tests(path: &Path) -> String {
    if !path.is_dir() {
        return String::new();
    }
    let (_, files) = entries(path);
    let is_test =
        |file: &&PathBuf| file.extension().is_some_and(|it| it == "rs") && stem(file) != "main";
    let names: Vec<String> = files
        .iter()
        .filter(is_test)
        .map(|file| format!("`{}`", stem(file)))
        .collect();
    format!("- **tests/** {}\n", names.join(", "))
}

/// The folders and the files in a folder, by name.
fn entries(path: &Path) -> (Vec<PathBuf>, Vec<PathBuf>) {
    let entries = fs::read_dir(path).expect("a folder");
    let mut entries: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    entries.sort();
    entries.into_iter().partition(|path| path.is_dir())
}

/// The line of a folder, and those of the folders in it.
fn folder(path: &Path, name: &str, map: &mut String) {
    let (folders, files) = entries(path);
    // A folder speaks by its `mod.rs`, a room by its manifest.
    let speaks = |file: &&PathBuf| !["lib", "mod"].contains(&stem(file).as_str());
    let words: Vec<String> = files
        .iter()
        .filter(speaks)
        .map(|file| format!("`{}` {}", stem(file), said(file)))
        .collect();
    let parts: Vec<String> = head(path, name).into_iter().chain(words).collect();
    if !parts.is_empty() {
        *map += &format!("- {}\n", parts.join(" · "));
    }
    for folder_in in folders {
        let name = format!("{name}/{}", stem(&folder_in));
        folder(&folder_in, name.trim_start_matches('/'), map);
    }
}

/// What a folder says of itself; of the root of a room only what it defines, if anything.
fn head(path: &Path, name: &str) -> Option<String> {
    if name.is_empty() {
        let text = fs::read_to_string(path.join("lib.rs")).unwrap_or_default();
        let names = defined(&text).join(", ");
        return (!names.is_empty()).then(|| format!("`lib` ({names})"));
    }
    Some(format!("**{name}/** {}", said(&path.join("mod.rs"))))
}

fn stem(path: &Path) -> String {
    path.file_stem()
        .expect("a name")
        .to_string_lossy()
        .into_owned()
}

/// The first sentence of a file, without links and its full stop, and what the file defines.
fn said(file: &Path) -> String {
    let text = fs::read_to_string(file).expect("a file");
    let lines = text.lines().map_while(|line| line.strip_prefix("//!"));
    let paragraph: Vec<&str> = lines
        .map(str::trim)
        .take_while(|line| !line.is_empty())
        .collect();
    let paragraph = paragraph.join(" ");
    let sentence = paragraph.split(". ").next().unwrap_or_default();
    let sentence = sentence
        .trim_end_matches('.')
        .replace("[`", "`")
        .replace("`]", "`");
    assert!(
        !sentence.is_empty(),
        "{}: say in a line `//!` what it holds",
        file.display()
    );
    match defined(&text).join(", ") {
        names if names.is_empty() => sentence,
        names => format!("{sentence} ({names})"),
    }
}

/// The types that stand at the margin, and the functions there that are not private.
fn defined(text: &str) -> Vec<&str> {
    text.lines().filter_map(name).collect()
}

/// The name that a line defines.
fn name(line: &str) -> Option<&str> {
    let public = line
        .strip_prefix("pub")
        .and_then(|rest| Some(rest.split_once(' ')?.1));
    let words = public.unwrap_or(line).trim_start_matches("const ");
    let (kind, rest) = words.split_once(' ')?;
    let is_type = ["struct", "enum", "trait"].contains(&kind);
    let is_wanted = is_type || (kind == "fn" && public.is_some());
    let end = rest.find(|letter: char| !letter.is_alphanumeric() && letter != '_');
    is_wanted.then(|| &rest[..end.unwrap_or(rest.len())])
}
