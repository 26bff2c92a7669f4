//! The guide as a book: mdBook over `docs`, and what its pages link to elsewhere in the project.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};

use crate::explorer;
use crate::python;
use crate::run::{cargo, cargo_command, output, run, stage, target, top};

const MDBOOK: &str = "0.5.4";

/// The style of a picture on a dark page, as the program's own pictures have it.
const DARK: &str = "<style>@media screen and (prefers-color-scheme: dark) { svg { filter: invert(.88) hue-rotate(180deg) } }</style>";

/// The folder of the book that holds what lies outside `docs`.
const OUTSIDE: &str = "top";

/// What leads from the tutorial to the documentation of the crates.
const CRATES: &str = "[All items of the engine](../rust/softstop/index.html) and of [softstop-dynamics](../rust/softstop_dynamics/index.html).";

/// Tests the pages, with the commands and examples that they show, and builds the book.
pub fn write() -> Result<PathBuf> {
    stage("pages, commands and examples");
    cargo("test --release -p softstop-testing --test pages")?;
    cargo("test --release -p softstop --test optimize guide")?;
    cargo("test --release -p softstop-lab --test lab guide")?;
    cargo("test --release -p softstop-dynamics --doc guide")?;
    stage("book");
    let folder = target().join("guide");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    lay_out(&folder)?;
    add_docstrings(&folder.join("src/python.md"))?;
    embed_explorer(&folder.join("src"))?;
    let rust = folder.join("src/tutorials/rust.md");
    let text = fs::read_to_string(&rust)?;
    fs::write(rust, format!("{text}\n{CRATES}\n"))?;
    run(Command::new(mdbook()?).arg("build").arg(&folder))?;
    add_rustdoc(&folder.join("book/rust"))?;
    Ok(folder.join("book/index.html"))
}

/// The program mdbook, built once into the target folder.
fn mdbook() -> Result<PathBuf> {
    let root = target().join("tools");
    let program = root.join(format!("bin/mdbook{}", std::env::consts::EXE_SUFFIX));
    if !program.exists() {
        run(cargo_command()
            .args(["install", "mdbook", "--version", MDBOOK, "--locked"])
            .args(["--no-default-features", "--features", "search", "--root"])
            .arg(root))
        .context("mdBook cannot be installed")?;
    }
    Ok(program)
}

/// Adds the docstrings of the Python package to its page.
fn add_docstrings(page: &Path) -> Result<()> {
    let python = python::environment("docstrings", "xtask/book/requirements.txt")?;
    let docstrings = output(Command::new(python).args(["-X", "utf8", "xtask/book/docstrings.py"]))?;
    let text = fs::read_to_string(page)?;
    fs::write(page, format!("{text}\n{docstrings}"))?;
    Ok(())
}

/// Puts the documentation of the two libraries for users beside the pages of the book.
fn add_rustdoc(place: &Path) -> Result<()> {
    stage("documentation of the crates");
    let built = target().join("guide/target");
    run(cargo_command()
        .args(["doc", "--release", "--no-deps", "--locked", "--target-dir"])
        .arg(&built)
        .args([
            "--package",
            "softstop-core",
            "--package",
            "softstop-dynamics",
        ]))?;
    fs::rename(built.join("doc"), place)?;
    fs::remove_dir_all(built)?;
    Ok(())
}

/// Puts the explorer into its page of the guide in place of its picture; where it cannot be built, the picture stays.
fn embed_explorer(source: &Path) -> Result<()> {
    if !explorer::is_installed()? {
        println!("left out, the explorer: {}", explorer::MISSING);
        return Ok(());
    }
    stage("explorer");
    let place = source.join("explorer/index.html");
    fs::create_dir_all(source.join("explorer"))?;
    fs::copy(explorer::write()?, place)?;
    let guide = source.join("explorer.md");
    let text = fs::read_to_string(&guide)?;
    let mut lines = text.lines();
    let picture = lines.find(|it| it.ends_with("](explorer.png)"));
    let picture = picture.context("explorer.md shows no explorer.png")?;
    let frame = "<iframe src=\"explorer/index.html\" title=\"The explorer\" style=\"width: 100%; height: 54em; border: 0\"></iframe>";
    let link = "[Open it in a window of its own](explorer/index.html)";
    fs::write(guide, text.replace(picture, &format!("{frame}\n\n{link}")))?;
    Ok(())
}

/// Copies `docs` and the files outside that its pages link to, with the links as they have to be there.
fn lay_out(folder: &Path) -> Result<()> {
    let source = folder.join("src");
    let mut waiting = files(Path::new("docs"))?;
    let mut done = BTreeSet::new();
    while let Some(place) = waiting.pop() {
        if !done.insert(place.clone()) {
            continue;
        }
        let copy = source.join(in_book(&place));
        fs::create_dir_all(copy.parent().unwrap_or(&source))?;
        let original = top().join(&place);
        if place.extension().is_some_and(|it| it == "md") {
            let text = fs::read_to_string(&original)?;
            let (text, outside) = relinked(&text, &place);
            waiting.extend(outside);
            fs::write(copy, text)?;
        } else if place.extension().is_some_and(|it| it == "svg") {
            fs::write(copy, darkened(fs::read_to_string(&original)?))?;
        } else {
            fs::copy(&original, copy).with_context(|| original.display().to_string())?;
        }
    }
    fs::rename(source.join("book.toml"), folder.join("book.toml"))?;
    Ok(())
}

/// A picture with a style for dark pages, which those by Matplotlib lack.
fn darkened(svg: String) -> String {
    match svg.contains("prefers-color-scheme") {
        true => svg,
        false => svg.replace("</svg>", &format!("{DARK}\n</svg>")),
    }
}

/// All files below a folder, from the top.
fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(top().join(folder))? {
        let entry = entry?;
        let place = folder.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            found.extend(files(&place)?);
        } else {
            found.push(place);
        }
    }
    Ok(found)
}

/// Where a file of the project stands in the book.
fn in_book(place: &Path) -> PathBuf {
    place
        .strip_prefix("docs")
        .map_or_else(|_| Path::new(OUTSIDE).join(place), Path::to_owned)
}

/// A page with its links as they are in the book, and the files outside `docs` that it links to.
fn relinked(text: &str, place: &Path) -> (String, Vec<PathBuf>) {
    let mut pieces = text.split("](");
    let mut whole = pieces.next().unwrap_or_default().to_owned();
    let mut outside = Vec::new();
    for piece in pieces {
        let (link, rest) = piece.split_once(')').unwrap_or((piece, ""));
        let (file, anchor) = link.split_at(link.find('#').unwrap_or(link.len()));
        let leads_to = resolved(place, file);
        whole.push_str("](");
        if !file.is_empty() && !file.contains(':') && top().join(&leads_to).is_file() {
            whole.push_str(&way(&in_book(place), &in_book(&leads_to)));
            if !leads_to.starts_with("docs") {
                outside.push(leads_to);
            }
        } else {
            whole.push_str(file);
        }
        whole.push_str(anchor);
        whole.push(')');
        whole.push_str(rest);
    }
    (whole, outside)
}

/// The file that a link of a page leads to.
fn resolved(page: &Path, link: &str) -> PathBuf {
    let mut place = page.to_owned();
    place.pop();
    for part in link.split('/') {
        match part {
            ".." => drop(place.pop()),
            "." => {}
            part => place.push(part),
        }
    }
    place
}

/// A link from one file to another.
fn way(from: &Path, to: &Path) -> String {
    let up = from.components().count() - 1;
    let to = to.components().map(|it| it.as_os_str().to_string_lossy());
    let parts: Vec<_> = std::iter::repeat_n("..".into(), up).chain(to).collect();
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_lead_to_the_same_files_in_the_book() {
        let page =
            "[a](../install.md#the-crates) ![b](../../fmu/assets/machine.svg) [c](https://x.y) `x`";
        let (text, outside) = relinked(page, Path::new("docs/tutorials/rust.md"));
        assert_eq!(
            text,
            "[a](../install.md#the-crates) ![b](../top/fmu/assets/machine.svg) [c](https://x.y) `x`"
        );
        assert_eq!(outside, [Path::new("fmu/assets/machine.svg")]);
        let (text, _) = relinked("[s](docs/scale.md)", Path::new("CHANGELOG.md"));
        assert_eq!(text, "[s](../scale.md)");
    }
}
