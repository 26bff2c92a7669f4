//! Imports between the files of one package, read off their `use` declarations.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Modules as paths of names, the root being empty.
type Module = Vec<String>;

/// A file: what it takes from which module, and what it passes on under its own name.
#[derive(Default)]
struct File {
    takes: Vec<(Module, String)>,
    passes_on: BTreeMap<String, (Module, String)>,
}

/// The circles of a package's files, in words.
pub fn circles(source: &Path) -> Vec<String> {
    let mut files = BTreeMap::new();
    read(source, source, &mut files);
    let arrows: BTreeMap<&Module, BTreeSet<Module>> = files
        .iter()
        .map(|(module, file)| (module, targets(module, file, &files)))
        .collect();
    let reaches = |from: &Module, to: &Module| {
        let mut seen = BTreeSet::new();
        let mut open = vec![from.clone()];
        while let Some(module) = open.pop() {
            for next in &arrows[&module] {
                if next == to {
                    return true;
                }
                if seen.insert(next.clone()) {
                    open.push(next.clone());
                }
            }
        }
        false
    };
    files
        .keys()
        .filter(|module| reaches(module, module))
        .map(|module| module.join("::"))
        .map(|module| format!("{}: {module} is in a circle", source.display()))
        .collect()
}

/// The other files that a file needs: those that define what it takes.
fn targets(module: &Module, file: &File, files: &BTreeMap<Module, File>) -> BTreeSet<Module> {
    let mut targets = BTreeSet::new();
    for (from, name) in &file.takes {
        let mut place = (from.clone(), name.clone());
        // A name that a module passes on is taken from where that module has it.
        for _ in 0..8 {
            let mut longer = place.0.clone();
            longer.push(place.1.clone());
            if files.contains_key(&longer) {
                place = (longer, "self".to_owned());
            }
            match files
                .get(&place.0)
                .and_then(|file| file.passes_on.get(&place.1))
            {
                Some(further) => place = further.clone(),
                None => break,
            }
        }
        // What a folder's own file defines is there for all files in the folder.
        let is_own_folder = module.starts_with(&place.0);
        if files.contains_key(&place.0) && !is_own_folder && place.1 != "self" {
            targets.insert(place.0);
        }
    }
    targets
}

fn read(source: &Path, folder: &Path, files: &mut BTreeMap<Module, File>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            read(source, &path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let module = module_of(path.strip_prefix(source).unwrap_or(&path));
            let text = fs::read_to_string(&path).unwrap_or_default();
            files.insert(module.clone(), file(&module, &text));
        }
    }
}

fn module_of(path: &Path) -> Module {
    let mut module: Module = path
        .with_extension("")
        .iter()
        .map(|part| part.to_string_lossy().into_owned())
        .collect();
    if matches!(module.last().map(String::as_str), Some("mod" | "lib")) {
        module.pop();
    }
    module
}

/// Reads the declarations at the margin: those of inner modules (tests) do not count.
fn file(module: &Module, text: &str) -> File {
    let mut file = File::default();
    for declaration in declarations(text) {
        let passes_on = declaration.starts_with("pub");
        let Some((_, tree)) = declaration.split_once("use ") else {
            continue;
        };
        for (path, name) in leaves(tree.trim_end_matches(';')) {
            let Some(from) = resolve(module, &path) else {
                continue;
            };
            if passes_on {
                file.passes_on.insert(name.clone(), (from, name));
            } else {
                file.takes.push((from, name));
            }
        }
    }
    file
}

fn declarations(text: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    let mut is_open = false;
    for line in text.lines() {
        let begins =
            line.starts_with("use ") || (line.starts_with("pub") && line.contains(" use "));
        if begins {
            found.push(String::new());
            is_open = true;
        }
        if is_open {
            if let Some(last) = found.last_mut() {
                last.push_str(line.trim());
                last.push(' ');
            }
            is_open = !line.trim_end().ends_with(';');
        }
    }
    found.iter().map(|text| text.trim().to_owned()).collect()
}

/// The paths of a tree of imports: modules, and the name at the end.
fn leaves(tree: &str) -> Vec<(Vec<String>, String)> {
    let tree = tree.trim();
    if let Some((head, rest)) = tree.split_once('{') {
        let head: Vec<String> = parts(head);
        let inner = rest.trim_end().trim_end_matches('}');
        return split(inner)
            .iter()
            .flat_map(|branch| leaves(branch))
            .map(|(path, name)| (head.iter().cloned().chain(path).collect(), name))
            .collect();
    }
    let mut path = parts(tree.split(" as ").next().unwrap_or(tree));
    match path.pop() {
        Some(name) => vec![(path, name)],
        None => Vec::new(),
    }
}

fn parts(path: &str) -> Vec<String> {
    path.split("::")
        .map(str::trim)
        .filter(|part| !part.is_empty())
        .map(str::to_owned)
        .collect()
}

/// Splits at the commas that no brace holds.
fn split(text: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    let (mut depth, mut begin) = (0, 0);
    for (at, letter) in text.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                pieces.push(&text[begin..at]);
                begin = at + 1;
            }
            _ => {}
        }
    }
    pieces.push(&text[begin..]);
    pieces.retain(|piece| !piece.trim().is_empty());
    pieces
}

/// The module that a path leads to from this one; none outside the package.
fn resolve(module: &Module, path: &[String]) -> Option<Module> {
    let mut place = module.clone();
    let mut names = path.iter().peekable();
    match names.peek().map(|name| name.as_str()) {
        Some("crate") => {
            place.clear();
            names.next();
        }
        Some("super") => {
            while names.next_if(|name| *name == "super").is_some() {
                place.pop()?;
            }
        }
        Some("self") => {
            names.next();
        }
        _ => {}
    }
    place.extend(names.cloned());
    Some(place)
}
