//! C programs of `tests/c`, compiled where there is a C compiler, and the unit they load.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use softstop_fmu::Standard;
use tempfile::TempDir;

use super::library::library_path;

const STRICT: [&str; 7] = [
    "-std=c99",
    "-D_XOPEN_SOURCE=700",
    "-O2",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-pedantic",
];

/// A compiled program, removed when dropped.
pub struct Program {
    path: PathBuf,
    _folder: TempDir,
}

/// Whether a program of this name can be run.
pub fn available(name: &str) -> bool {
    let found = Command::new(name)
        .arg("--version")
        .output()
        .is_ok_and(|output| output.status.success());
    if !found {
        println!("skipped: {name} is not on the path");
    }
    found
}

impl Program {
    /// Compiles `tests/c/<name>.c` with the importer in `unit.c`; nothing if there is no C compiler.
    ///
    /// # Panics
    /// If the compiler so much as warns.
    pub fn compile(name: &str) -> Option<Self> {
        let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
        if !available(&compiler) {
            return None;
        }
        let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/c");
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join(name);
        let output = Command::new(compiler)
            .args(STRICT)
            .arg(sources.join(format!("{name}.c")))
            .arg(sources.join("unit.c"))
            .arg("-o")
            .arg(&path)
            .args(["-ldl", "-lm"])
            .output()
            .expect("a compiler that runs");
        succeeded(&output);
        Some(Self {
            path,
            _folder: folder,
        })
    }

    /// The program with the library that was built along with this test and its description.
    pub fn command(&self) -> Command {
        let mut command = Command::new(&self.path);
        command.args(self.arguments());
        command
    }

    /// The same under another program.
    pub fn under(&self, other: &str, options: &[&str]) -> Command {
        let mut command = Command::new(other);
        command.args(options).arg(&self.path).args(self.arguments());
        command
    }

    fn arguments(&self) -> [PathBuf; 2] {
        let description = Path::new(env!("CARGO_MANIFEST_DIR")).join("../modelDescription.xml");
        [library_path(Standard::Fmi2), description]
    }
}

/// Asserts that a program ended well; what it wrote is shown in any case.
pub fn succeeded(output: &Output) {
    let texts = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    println!("{}{}", texts[0], texts[1]);
    assert!(output.status.success(), "{}", output.status);
}
