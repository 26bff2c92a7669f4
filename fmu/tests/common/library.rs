//! The library that was built along with the tests.

use std::env;
use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::path::PathBuf;

/// Where it is: beside the running test, in `deps`.
pub fn library_path() -> PathBuf {
    let program = env::current_exe().expect("a running program");
    let path = program.with_file_name(format!("{DLL_PREFIX}softstop_fmu{DLL_SUFFIX}"));
    assert!(path.is_file(), "{} is not there", path.display());
    path
}
