//! A figure of the paper as `softstop-lab paper` draws it in draft, once for all tests.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock, Mutex, OnceLock};

use serde_json::Value;
use softstop_testing::report::Row;
use softstop_testing::{Program, is_near, table};

const PROGRAM: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop-lab"),
    first: &["paper"],
};

type Cell = Arc<OnceLock<Arc<Figure>>>;

static DRAWN: LazyLock<Mutex<HashMap<&'static str, Cell>>> = LazyLock::new(Mutex::default);

/// What a figure found, and where its files are.
pub struct Figure {
    findings: Value,
    folder: PathBuf,
}

impl Figure {
    /// A figure by its name.
    pub fn of(name: &'static str) -> Arc<Self> {
        let cell = Arc::clone(DRAWN.lock().expect("no panic").entry(name).or_default());
        Arc::clone(cell.get_or_init(|| Arc::new(Self::draw(name))))
    }

    fn draw(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("paper-{name}"));
        let place = folder.to_str().expect("UTF-8");
        let report = PROGRAM.json(&[name, "--draft", "--output", place]);
        let figure = &report["figures"][0];
        for file in figure["files"].as_array().expect("files") {
            let file = file.as_str().expect("a name");
            let length = std::fs::metadata(file).expect(file).len();
            assert!(length > 50, "{file} is empty");
        }
        Self {
            findings: figure["findings"].clone(),
            folder,
        }
    }

    /// One of its files.
    pub fn file(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// A table of it: its lines as maps by the header.
    pub fn table(&self, name: &str) -> Vec<Row> {
        table(&self.file(name))
    }

    /// A number that it found, if it did.
    pub fn find(&self, name: &str) -> Option<f64> {
        self.findings[name].as_f64()
    }

    /// A number that it found.
    #[track_caller]
    pub fn get(&self, name: &str) -> f64 {
        self.find(name)
            .unwrap_or_else(|| panic!("no {name:?} in {}", self.findings))
    }

    /// Holds a number that it found to a value.
    #[track_caller]
    pub fn near(&self, name: &str, value: f64, tolerance: f64) {
        let found = self.get(name);
        let is_near = is_near(found, value, tolerance);
        assert!(is_near, "{name}: {found}, not {value}");
    }
}
