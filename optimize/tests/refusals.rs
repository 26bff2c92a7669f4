//! What the commands refuse, and in which words: `refusals/*.md` are commands and what they say, `refusals/*.toml` files
//! and words of what is said of them. Nothing is left behind.

use std::fs;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use softstop_optimize::design::figure::Figure;
use softstop_testing::{docs, files, with_folders, words};

use crate::interrupts::dispositions::{self, Writes};
use crate::{Outcome, SOFTSTOP};

fn place(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/refusals")
        .join(name)
}

#[test]
fn commands_say_what_is_wrong_and_leave_nothing() -> Outcome {
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    let left = || -> std::io::Result<_> { Ok((fs::read_dir(top)?.count(), files(&place("")))) };
    let before = left()?;
    for page in files(&place("")) {
        if page.extension().is_some_and(|end| end == "md") {
            SOFTSTOP.says_what_a_page_shows(&page);
        }
    }
    assert_eq!(left()?, before);
    Ok(())
}

/// A file that is refused.
#[derive(Deserialize)]
struct Case {
    /// The file that it begins with, if it does.
    machine: Option<String>,
    text: String,
    says: Vec<String>,
}

/// The cases of a file under a key.
fn cases(name: &str, key: &str) -> Outcome<Vec<Case>> {
    let mut table: toml::Table = fs::read_to_string(place(name))?.parse()?;
    let cases = table.remove(key).ok_or("no cases")?;
    Ok(cases.try_into()?)
}

/// Every file of some cases is refused with its words, and nothing is written.
fn are_refused(cases: &[Case], name: &str, line: &str, code: i32) -> Outcome {
    let folder = tempfile::tempdir()?;
    let (file, output) = (folder.path().join(name), folder.path().join("never"));
    let paths = [&file, &output].map(|path| path.display().to_string());
    for case in cases {
        let machine = case
            .machine
            .as_ref()
            .map(|it| fs::read_to_string(place(it)));
        let machine = machine.transpose()?.unwrap_or_default();
        fs::write(&file, machine + &case.text)?;
        println!("{}", case.text);
        let says: Vec<&str> = case.says.iter().map(String::as_str).collect();
        let line = [&words(line)[..], &[&paths[0], "--output", &paths[1]]].concat();
        SOFTSTOP.ends_with(&line, code, &says);
        assert!(!output.exists(), "something is left behind");
    }
    Ok(())
}

#[test]
fn what_is_wrong_with_a_task_is_told() -> Outcome {
    let mut cases = cases("tasks.toml", "task")?;
    for case in &mut cases {
        case.machine = Some("press.toml".to_owned());
    }
    are_refused(&cases, "press.toml", "optimize", 2)
}

#[test]
fn what_is_wrong_with_a_task_file_is_told() -> Outcome {
    let cases = cases("task_files.toml", "task")?;
    are_refused(&cases, "task.toml", "optimize --config", 2)
}

#[test]
fn bad_scenes_are_named_with_key_value_and_range() -> Outcome {
    let good = fs::read_to_string(docs("scenes/preloaded.toml"))?;
    let mut cases = cases("machines.toml", "change")?;
    for case in &mut cases {
        let (from, to) = case.text.split_once(" -> ").ok_or("no change")?;
        assert!(good.contains(from), "{from}");
        case.text = good.replace(from, to);
        case.says.push("machine.toml".to_owned());
    }
    are_refused(&cases, "machine.toml", "simulate", 2)
}

/// A requirement in vain, alone or against others: every figure is tried.
#[test]
fn conflicts_are_named_with_how_much_is_missing() -> Outcome {
    let cases = cases("conflicts.toml", "conflict")?;
    for name in Figure::ALL.iter().map(|figure| figure.name()) {
        let words = format!("\n{name} = ");
        assert!(cases.iter().any(|it| it.text.contains(&words)), "{name}");
    }
    are_refused(&cases, "press.toml", "optimize --no-report", 1)
}

#[test]
fn what_a_machine_does_not_have_is_refused_by_every_command() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    let refusals: [(&str, &[&str]); 7] = [
        (
            "--set initial.velocity=3",
            &["initial.velocity", "plays no part"],
        ),
        (
            "--set clearence=3",
            &["clearence", "did you mean clearance?"],
        ),
        (
            "--set stop.exponent=2",
            &["stop.exponent", "no such parameter"],
        ),
        ("--set clearance=wide", &["clearance = wide"]),
        ("--set rho=3 --set clearance=4", &["twice"]),
        ("--set clearance", &["KEY=VALUE"]),
        ("nowhere.toml", &["nowhere.toml"]),
    ];
    // These take a start.
    let starts = ["simulate", "watch", "explore", "fidelity", "fmu"];
    let explore = &("explore", "", Writes::File);
    let mut met = 0;
    for (command, _, writes) in dispositions::COMMANDS.iter().chain([explore]) {
        let command = with_folders(command);
        let name = words(&command)[0];
        if !SOFTSTOP.text(&[name, "--help"]).contains("[MACHINE]") {
            continue;
        }
        met += 1;
        let output = match writes {
            Writes::Nothing => String::new(),
            _ => format!("--output {}", out.display()),
        };
        for (line, told) in refusals.iter().skip(usize::from(starts.contains(&name))) {
            SOFTSTOP.ends_with(&words(&format!("{command} {output} {line}")), 2, told);
        }
    }
    assert!(!out.exists());
    assert!(met >= 13, "{met} commands take a machine");
    Ok(())
}

#[test]
fn a_file_of_more_than_a_mebibyte_is_refused() -> Outcome {
    let file = tempfile::NamedTempFile::new()?;
    fs::write(&file, " ".repeat((1 << 20) + 1))?;
    let path = file.path().to_str().ok_or("path")?;
    SOFTSTOP.ends_with(&["orbit", path], 2, &["1 MiB"]);
    Ok(())
}
