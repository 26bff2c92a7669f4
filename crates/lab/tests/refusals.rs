//! What the laboratory refuses, and in which words: `refusals/*.md`.

use std::path::Path;

use softstop_testing::Program;

#[test]
fn commands_say_what_is_wrong() {
    let laboratory = Program {
        file: env!("CARGO_BIN_EXE_softstop-lab"),
        first: &[],
    };
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/refusals");
    laboratory.says_what_a_page_shows(&folder.join("values.md"));
}
