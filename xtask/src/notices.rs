//! The notices of the crates in a library, which their licences ask for.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use serde_json::Value;

use crate::run::{cargo_command, output, top};
use crate::targets;

/// What ships the libraries or programs, and the packages that they are built from.
pub struct Shipped {
    name: &'static str,
    packages: &'static [&'static str],
}

/// The FMU.
const FMU: Shipped = Shipped {
    name: "libraries of this FMU are",
    packages: &["softstop-fmi3"],
};

/// The Python package.
pub const WHEEL: Shipped = Shipped {
    name: "library of this package is",
    packages: &["softstop-python"],
};

/// The archive of the programs.
pub const PROGRAMS: Shipped = Shipped {
    name: "programs of this archive are",
    packages: &["softstop", "softstop-lab"],
};

const PARTS: &str = "
Runtime
  Rust's standard library, MIT OR Apache-2.0, https://www.rust-lang.org
  Linux, Windows: unwinder and compiler runtime of LLVM, Apache-2.0 WITH LLVM-exception,
    https://llvm.org; a library linked by GCC for its own machine holds GCC's unwinder instead,
    GPL-3.0-or-later WITH GCC-exception-3.1, https://gcc.gnu.org
  Windows: runtime of mingw-w64, ZPL-2.1 and public domain, https://www.mingw-w64.org

Crates
";

/// Writes the notices of the FMU to where the packager finds them.
pub fn write() -> Result<()> {
    let path = path();
    fs::write(&path, notices(&FMU)?).with_context(|| path.display().to_string())?;
    println!("{} written", path.display());
    Ok(())
}

fn path() -> PathBuf {
    top().join("fmu/assets/third-party.txt")
}

/// The text: a list of the crates, then each text of a licence once.
pub fn notices(shipped: &Shipped) -> Result<String> {
    let mut text = format!(
        "Third-party notices\n\nThe {} built from softstop and the parts below.\n{PARTS}",
        shipped.name
    );
    let mut licences = BTreeMap::<String, Vec<String>>::new();
    let arguments = ["metadata", "--format-version=1", "--locked"];
    let metadata = serde_json::from_str(&output(cargo_command().args(arguments))?)?;
    for package in linked_packages(&metadata, shipped.packages)? {
        let [licence, home] = ["license", "repository"].map(|key| field(package, key));
        writeln!(text, "  {}, {licence}, {home}", name(package))?;
        let manifest = Path::new(field(package, "manifest_path"));
        for licence in licence_texts(manifest.parent().unwrap_or(manifest))? {
            licences.entry(licence).or_default().push(name(package));
        }
    }
    for (licence, names) in licences {
        write!(
            text,
            "\n{}\n{}\n\n{licence}\n",
            "-".repeat(80),
            names.join(", ")
        )?;
    }
    Ok(text)
}

/// Names and versions of the crates in the libraries or programs of packages, whatever the target.
fn linked(packages: &[&str]) -> Result<BTreeSet<String>> {
    let mut crates = BTreeSet::new();
    for triple in targets::triples() {
        let tree = output(
            cargo_command()
                .args(["tree", "--locked"])
                .args(packages.iter().flat_map(|it| ["--package", it]))
                .args(["--edges=normal,no-proc-macro", "--target", triple])
                .args(["--prefix=none", "--format={p}"]),
        )?;
        crates.extend(tree.lines().filter_map(|line| {
            let (name, rest) = line.split_once(" v")?;
            Some(format!("{name} {}", rest.split(' ').next()?))
        }));
    }
    Ok(crates)
}

/// The packages of others that those of this project are linked with.
fn linked_packages<'a>(metadata: &'a Value, own: &[&str]) -> Result<Vec<&'a Value>> {
    let linked = linked(own)?;
    let packages = metadata["packages"].as_array().into_iter().flatten();
    let mut packages: Vec<_> = packages
        .filter(|package| !package["source"].is_null() && linked.contains(&name(package)))
        .collect();
    packages.sort_by_key(|package| name(package));
    Ok(packages)
}

fn field<'a>(package: &'a Value, name: &str) -> &'a str {
    package[name].as_str().unwrap_or_default()
}

fn name(package: &Value) -> String {
    format!("{} {}", field(package, "name"), field(package, "version"))
}

/// The texts of the licence in a package's folder: that of MIT if it may be chosen, for it holds
/// the copyright; otherwise all.
fn licence_texts(folder: &Path) -> Result<Vec<String>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).with_context(|| folder.display().to_string())? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let name = name.to_ascii_uppercase();
        if path.is_file()
            && ["LICENSE", "LICENCE", "COPYING"]
                .iter()
                .any(|p| name.starts_with(p))
        {
            files.push((name, path));
        }
    }
    files.sort();
    if files.iter().any(|(name, _)| name.contains("MIT")) {
        files.retain(|(name, _)| name.contains("MIT"));
    }
    let mut texts = files
        .iter()
        .map(|(_, path)| {
            let text = fs::read_to_string(path).with_context(|| path.display().to_string())?;
            let lines: Vec<_> = text.lines().map(str::trim_end).collect();
            Ok(lines.join("\n").trim_matches('\n').to_owned())
        })
        .collect::<Result<Vec<_>>>()?;
    texts.retain(|text| !text.is_empty());
    Ok(texts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_notices_are_up_to_date() {
        let kept = fs::read_to_string(path()).expect("notices beside the packager");
        let current = notices(&FMU).expect("notices");
        assert!(kept == current, "run cargo xtask notices");
    }
}
