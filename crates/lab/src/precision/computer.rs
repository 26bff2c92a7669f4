//! The computer that times are taken on.

use std::fs;

use serde::Serialize;

/// What times depend on.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Computer {
    /// Model of its processor.
    pub cpu: String,
    /// Cores that can be used.
    pub cores: usize,
    /// System and architecture.
    pub os: String,
    /// The compiler, and what it optimised for.
    pub rustc: String,
    /// Version of this program.
    pub softstop: String,
}

impl Computer {
    /// This one.
    pub fn this() -> Self {
        let profile = if cfg!(debug_assertions) {
            "not optimised"
        } else {
            "optimised"
        };
        Self {
            cpu: cpu().unwrap_or_else(|| "unknown".to_owned()),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            os: os(),
            rustc: format!("{}, {profile}", env!("SOFTSTOP_RUSTC")),
            softstop: env!("CARGO_PKG_VERSION").to_owned(),
        }
    }

    /// In one line.
    pub fn line(&self) -> String {
        let Self {
            cpu,
            cores,
            os,
            rustc,
            ..
        } = self;
        format!("{cpu}, {cores} cores, {os}, {rustc}")
    }
}

/// The processor as Linux and Windows name it.
fn cpu() -> Option<String> {
    let from_linux = || {
        let text = fs::read_to_string("/proc/cpuinfo").ok()?;
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    };
    from_linux().or_else(|| std::env::var("PROCESSOR_IDENTIFIER").ok())
}

fn os() -> String {
    let kernel = fs::read_to_string("/proc/sys/kernel/osrelease").unwrap_or_default();
    let words = [std::env::consts::OS, kernel.trim(), std::env::consts::ARCH];
    let words: Vec<&str> = words.into_iter().filter(|word| !word.is_empty()).collect();
    words.join(" ")
}
