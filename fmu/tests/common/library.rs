//! The libraries that were built along with the tests.

use std::env;
use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::path::PathBuf;

use softstop_fmu::Standard;

/// Where that of a standard is: beside the running test, in `deps`.
pub fn library_path(standard: Standard) -> PathBuf {
    let program = env::current_exe().expect("a running program");
    let standard = standard.prefix();
    let path = program.with_file_name(format!("{DLL_PREFIX}softstop_{standard}{DLL_SUFFIX}"));
    assert!(path.is_file(), "{} is not there", path.display());
    path
}
