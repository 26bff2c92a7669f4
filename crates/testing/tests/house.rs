//! The structure of the workspace: a room imports only what the table of docs/design.md allows it, and no file is in a
//! circle of imports.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use softstop_testing::pages::top;
use toml::Table;

fn manifest(place: &str) -> Table {
    let path = top().join(place).join("Cargo.toml");
    let text = fs::read_to_string(path).expect("a manifest");
    text.parse().expect("TOML")
}

/// The rooms of docs/design.md, from the ground up: the place of each, and the names of those that it may import besides
/// what these may import.
fn rows() -> Vec<(String, Vec<String>)> {
    let page = fs::read_to_string(top().join("docs/design.md")).expect("a page");
    let (_, section) = page.split_once("## Rooms").expect("the rooms");
    let table = section.lines().skip_while(|line| !line.starts_with("| `"));
    let quoted = |cell: &str| {
        cell.split('`')
            .skip(1)
            .step_by(2)
            .map(str::to_owned)
            .collect()
    };
    let rows = table.map_while(|line| {
        let mut cells = line.strip_prefix("| ")?.split(" | ");
        let place = cells.next()?.trim_matches(['`', '/']).to_owned();
        Some((place, quoted(cells.next()?)))
    });
    rows.collect()
}

/// The folder of a package, and the name of its room.
fn room(place: &str) -> (&str, &str) {
    match place {
        "src" | "." => ("", "src"),
        _ => (place, place.rsplit('/').next().unwrap_or(place)),
    }
}

#[test]
fn rooms_import_only_what_they_may() {
    let root = manifest("");
    let dependencies = root["workspace"]["dependencies"]
        .as_table()
        .expect("a table");
    let path = |value: &toml::Value| value.get("path")?.as_str().map(|it| room(it).1.to_owned());
    let packages: BTreeMap<_, _> = dependencies
        .iter()
        .filter_map(|(name, value)| Some((name, path(value)?)))
        .collect();
    let mut below: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (place, imports) in rows() {
        let (folder, name) = room(&place);
        let mut allowed = BTreeSet::new();
        for import in imports {
            let further = below.get(&import);
            allowed.extend(
                further
                    .unwrap_or_else(|| panic!("{import} is not below {name}"))
                    .clone(),
            );
            allowed.insert(import);
        }
        let manifest = manifest(folder);
        let imports = manifest.get("dependencies").and_then(|it| it.as_table());
        for import in imports
            .into_iter()
            .flatten()
            .filter_map(|(key, _)| packages.get(key))
        {
            assert!(allowed.contains(import), "{name} imports {import}");
        }
        below.insert(name.to_owned(), allowed);
    }
    let missing: Vec<_> = packages
        .values()
        .filter(|name| !below.contains_key(*name))
        .collect();
    assert!(
        missing.is_empty(),
        "without a row in docs/design.md: {missing:?}"
    );
}

#[test]
fn no_file_is_in_a_circle_of_imports() {
    for (place, _) in rows() {
        let mut arrows = arrows(&top().join(room(&place).0).join("src"));
        while let Some(free) = arrows
            .iter()
            .find(|(_, targets)| !targets.iter().any(|it| arrows.contains_key(it)))
            .map(|(module, _)| module.clone())
        {
            arrows.remove(&free);
        }
        assert!(
            arrows.is_empty(),
            "{place}: a circle, or what imports from it: {arrows:#?}"
        );
    }
}

/// The modules of a package that are files, and the other files from which each imports.
fn arrows(source: &Path) -> BTreeMap<String, BTreeSet<String>> {
    let mut files = BTreeMap::new();
    read(source, source, &mut files);
    let passed_on: BTreeMap<_, _> = files
        .iter()
        .flat_map(|(module, text)| imports(module, text).map(move |it| (module, it)))
        .filter(|(_, (is_public, _))| *is_public)
        .map(|(module, (_, target))| (join(module, split(&target).1), target))
        .collect();
    let defining = |module: &str, mut target: String| {
        // A name that a module passes on counts where that module has it from.
        while let Some(further) = passed_on.get(&target).filter(|it| **it != target) {
            target = further.clone();
        }
        let (file, _) = split(&target);
        // What a folder's own file defines is there for all files in the folder.
        let is_own_folder =
            module == file || file.is_empty() || module.starts_with(&format!("{file}::"));
        let is_module = files.contains_key(&target);
        (files.contains_key(file) && !is_own_folder && !is_module).then(|| file.to_owned())
    };
    files
        .iter()
        .map(|(module, text)| {
            let taken = imports(module, text).filter(|(is_public, _)| !is_public);
            let targets = taken.filter_map(|(_, target)| defining(module, target));
            (module.clone(), targets.collect())
        })
        .collect()
}

/// Reads the files of a folder by the names of their modules; that of the root is empty.
fn read(source: &Path, folder: &Path, files: &mut BTreeMap<String, String>) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    for path in entries.map(|it| it.path()) {
        if path.is_dir() {
            read(source, &path, files);
        } else if path.extension().is_some_and(|it| it == "rs") {
            let module = module(path.strip_prefix(source).expect("a file below"));
            files.insert(module, fs::read_to_string(&path).expect("a text"));
        }
    }
}

fn module(file: &Path) -> String {
    let file: PathBuf = match file.file_stem().and_then(|it| it.to_str()) {
        Some("lib" | "mod") => file.parent().unwrap_or(file).to_owned(),
        _ => file.with_extension(""),
    };
    let parts: Vec<_> = file.iter().map(|it| it.to_string_lossy()).collect();
    parts.join("::")
}

/// What the `use` declarations at the margin name, by paths from the root, and whether they pass it on.
fn imports<'a>(module: &'a str, text: &'a str) -> impl Iterator<Item = (bool, String)> + 'a {
    let mut lines = text.lines();
    let declarations = std::iter::from_fn(move || {
        let (visibility, first) =
            lines
                .by_ref()
                .find_map(|line| match line.strip_prefix("use ") {
                    Some(tree) => Some(("", tree)),
                    None => line
                        .split_once(" use ")
                        .filter(|(head, _)| head.starts_with("pub")),
                })?;
        let mut tree = first.to_owned();
        while !tree.ends_with(';') {
            tree.push_str(lines.next()?.trim());
        }
        Some((!visibility.is_empty(), tree))
    });
    declarations.flat_map(move |(is_public, tree)| {
        let paths = leaves(&tree).into_iter();
        paths.filter_map(move |path| Some((is_public, absolute(module, &path)?)))
    })
}

/// The paths of a tree of imports.
fn leaves(tree: &str) -> Vec<String> {
    let (mut found, mut heads, mut path) = (Vec::new(), vec![String::new()], String::new());
    for letter in tree.chars() {
        match letter {
            '{' => heads.push(path.clone()),
            ',' | '}' | ';' => {
                let head = heads.last().cloned().unwrap_or_default();
                if path.len() > head.len() {
                    found.extend(path.split(" as ").next().map(str::to_owned));
                }
                if letter == '}' {
                    heads.pop();
                }
                // After a closing brace nothing follows but a comma or another brace.
                path = heads.last().cloned().unwrap_or_default();
            }
            ' ' if path.is_empty() || path.ends_with("::") => {}
            _ => path.push(letter),
        }
    }
    found
}

/// A path as it is from the root, if it does not lead above it.
fn absolute(module: &str, path: &str) -> Option<String> {
    if let Some(path) = path.strip_prefix("crate::") {
        return Some(path.to_owned());
    }
    if let Some(path) = path.strip_prefix("super::") {
        return absolute(split(module).0, path).filter(|_| !module.is_empty());
    }
    Some(join(module, path.strip_prefix("self::").unwrap_or(path)))
}

/// A path without its last name, and this name.
fn split(path: &str) -> (&str, &str) {
    path.rsplit_once("::").unwrap_or(("", path))
}

fn join(module: &str, name: &str) -> String {
    match module {
        "" => name.to_owned(),
        _ => format!("{module}::{name}"),
    }
}

/// The folders of the packages in the workspace.
fn packages() -> Vec<String> {
    let root = manifest("");
    let members = root["workspace"]["members"].as_array().expect("a list");
    let mut found = Vec::new();
    for member in members.iter().filter_map(|it| it.as_str()) {
        match member.strip_suffix("/*") {
            Some(folder) => {
                let entries = fs::read_dir(top().join(folder))
                    .expect("a folder")
                    .flatten();
                let names = entries.map(|it| it.file_name().to_string_lossy().into_owned());
                let places = names.map(|name| format!("{folder}/{name}"));
                found.extend(places.filter(|it| top().join(it).join("Cargo.toml").exists()));
            }
            None => found.push(member.to_owned()),
        }
    }
    found
}

#[test]
fn published_packages_are_complete_and_need_no_others() {
    let package_of = |place: &String| manifest(place)["package"].as_table().cloned();
    let published: Vec<_> = packages()
        .into_iter()
        .filter_map(|place| Some((package_of(&place)?, place)))
        .filter(|(package, _)| !package.contains_key("publish"))
        .collect();
    let names: BTreeSet<_> = published
        .iter()
        .map(|(it, _)| it["name"].as_str())
        .collect();
    let dependencies = manifest("")["workspace"]["dependencies"].clone();
    for (package, place) in &published {
        let folder = top().join(place);
        for key in [
            "description",
            "license",
            "documentation",
            "readme",
            "include",
        ] {
            assert!(package.contains_key(key), "{place}: {key}");
        }
        let readme = package["readme"].as_str().expect("a path");
        let text = fs::read_to_string(folder.join(readme)).expect("a README");
        let links = text.split("](").skip(1);
        assert!(
            links.into_iter().all(|it| it.starts_with("https://")),
            "{place}: {readme}"
        );
        for licence in ["LICENSE-APACHE", "LICENSE-MIT"] {
            assert!(folder.join(licence).exists(), "{place}: {licence}");
        }
        let manifest = manifest(place);
        let own = manifest.get("dependencies").and_then(|it| it.as_table());
        for (key, _) in own.into_iter().flatten() {
            let Some(it) = dependencies.get(key).filter(|it| it.get("path").is_some()) else {
                continue;
            };
            let name = it.get("package").and_then(|it| it.as_str()).or(Some(key));
            assert!(
                names.contains(&name),
                "{place} needs {key}, which is not published"
            );
        }
    }
    assert_eq!(published.len(), 13);
}

#[test]
fn build_scripts_of_both_fmi_libraries_are_the_same() {
    let script = |place: &str| fs::read_to_string(top().join(place).join("build.rs"));
    assert_eq!(
        script("fmu/fmi2").expect("a script"),
        script("fmu/fmi3").expect("a script")
    );
}

#[test]
fn pages_that_name_the_version_name_this_one() {
    let version = env!("CARGO_PKG_VERSION");
    for (file, words) in [
        ("CITATION.cff", format!("\nversion: {version}\n")),
        ("docs/cite.md", format!("version = {{{version}}}")),
        ("docs/install.md", format!("Version {version} is prepared")),
        ("docs/install.md", format!("softstop-{version}-*")),
        ("CHANGELOG.md", format!("\n## {version} (")),
        (
            "Cargo.toml",
            format!("path = \"crates/dynamics\", version = \"{version}\""),
        ),
    ] {
        let text = fs::read_to_string(top().join(file)).expect("a text");
        assert!(text.contains(&words), "{file} does not say {words}");
    }
}
