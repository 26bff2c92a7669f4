//! What the guide prints runs: each call of `softstop-lab` on a page is one that the program takes.

use clap::Parser;
use softstop_lab::CommandLine;
use softstop_testing::pages;

#[test]
fn every_call_on_a_page_is_one_that_the_program_takes() {
    let mut faults = Vec::new();
    let mut count = 0;
    for page in pages::all() {
        for program in ["softstop-lab", "cargo run --release -p softstop-lab --"] {
            for call in page.calls(program) {
                count += 1;
                let words = std::iter::once("softstop-lab".to_owned()).chain(call.clone());
                if let Err(error) = CommandLine::try_parse_from(words) {
                    faults.push(format!("{}: {call:?}: {error}", page.place.display()));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(count > 10, "only {count} calls were found");
}
