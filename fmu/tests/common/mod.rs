//! What the tests share: an importer, C programs, the library that was built along with them.

pub mod c_program;
mod importer;
pub mod library;

pub use importer::*;
