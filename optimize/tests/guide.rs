//! What the guide prints runs: each call of `softstop` on a page is one that the program takes, and the tutorials run
//! from end to end.

use clap::Parser;
use softstop_optimize::CommandLine;
use softstop_testing::pages::{self, Page};

#[test]
fn every_call_on_a_page_is_one_that_the_program_takes() {
    let mut faults = Vec::new();
    let mut count = 0;
    for page in pages::all() {
        for program in ["softstop", "cargo run --release --"] {
            for call in page.calls(program) {
                count += 1;
                let words = std::iter::once("softstop".to_owned()).chain(call.clone());
                if let Err(error) = CommandLine::try_parse_from(words) {
                    faults.push(format!("{}: {call:?}: {error}", page.place.display()));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(count > 40, "only {count} calls were found");
}

/// In an empty folder beside `docs`, one call after the other; searches without report and with fewer machines.
#[cfg(unix)]
#[test]
fn the_tutorials_run_as_printed() -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    std::os::unix::fs::symlink(
        pages::top().canonicalize()?.join("docs"),
        folder.path().join("docs"),
    )?;
    let is_tutorial = |it: &Page| it.place.starts_with("docs/tutorials");
    for page in pages::all().into_iter().filter(is_tutorial) {
        for mut call in page.calls("softstop") {
            if call.contains(&"my-press.toml".to_owned()) {
                continue;
            }
            if call[0] == "optimize" {
                call.extend(["--no-report", "--samples", "4096"].map(str::to_owned));
            }
            let words: Vec<&str> = call.iter().map(String::as_str).collect();
            let output = crate::SOFTSTOP
                .command(&words)
                .current_dir(folder.path())
                .output()?;
            let message = String::from_utf8_lossy(&output.stderr);
            assert!(
                output.status.success(),
                "{}: {words:?}: {message}",
                page.place.display()
            );
        }
    }
    Ok(())
}
