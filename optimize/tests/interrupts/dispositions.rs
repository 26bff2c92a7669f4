//! Every command where its output is unread, its disk full, its files limited: it says so, and leaves nothing half
//! written.

use softstop_testing::{with_folders, words};

use super::SOFTSTOP;

/// What a command writes besides its output.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Writes {
    Nothing,
    Folder,
    File,
}

use Writes::{File, Folder, Nothing};

/// All commands, the machine that each is run with if it is not the paper's unloaded one, and what they write. None takes long.
pub const COMMANDS: &[(&str, &str, Writes)] = &[
    ("orbit", "", Nothing),
    ("motions --starts 16", "", Folder),
    ("continue --parameter eta --from 1.1 --to 1.2", "", Folder),
    ("zone", "", Nothing),
    ("prove", "A", File),
    ("sweep --from 0.8 --to 1.8 --steps 100", "", Folder),
    ("basin --size 60", "", Folder),
    ("basin --along-zone 3 --size 20", "", Folder),
    (
        "basin --parameter eta --from 1.1 --to 1.2 --steps 3 --size 20",
        "",
        Folder,
    ),
    ("study STUDIES/map.toml", "", Folder),
    (
        "optimize --evaluations 100 --no-report --samples 10",
        "",
        Folder,
    ),
    ("fmu", "", File),
    ("schema", "", Nothing),
    ("schema study", "", Nothing),
    ("simulate", "SCENES/hertz.toml", Folder),
    ("watch", "loaded", File),
    ("stops", "", Folder),
    ("fidelity --repeats 1", "B", Folder),
];

/// Their lines, with the folders of scenes and studies.
pub fn lines() -> impl Iterator<Item = (String, Writes)> {
    let lines = COMMANDS.iter();
    lines.map(|(line, machine, writes)| (with_folders(&format!("{line} {machine}")), *writes))
}

/// The names of all commands, from the help.
pub fn names() -> Vec<String> {
    let help = SOFTSTOP.text(&["--help"]);
    let list = help
        .split("Commands:")
        .nth(1)
        .and_then(|rest| rest.split("Options:").next());
    let names = list
        .unwrap_or_default()
        .lines()
        .filter(|line| line.starts_with("  "));
    let names = names.filter_map(|line| line.split_whitespace().next());
    let names = names.filter(|name| *name != "help").map(str::to_owned);
    let names: Vec<String> = names.collect();
    assert!(names.len() > 12, "{help}");
    names
}

/// But `explore`, which writes only if its engine has been built for the browser.
#[test]
fn the_table_has_every_command() {
    for name in names().into_iter().filter(|name| name != "explore") {
        let mut all = COMMANDS.iter();
        assert!(all.any(|(line, ..)| words(line)[0] == name), "{name}");
    }
}

#[test]
fn nobody_reads_the_output() {
    let folder = tempfile::tempdir().expect("a folder");
    for (line, _) in lines() {
        SOFTSTOP.ends_when_unread(&words(&line), folder.path());
    }
    SOFTSTOP.ends_when_unread(&["--help"], folder.path());
}

#[cfg(target_os = "linux")]
#[test]
fn the_output_goes_to_a_full_disk() {
    let folder = tempfile::tempdir().expect("a folder");
    for (line, _) in lines() {
        SOFTSTOP.tells_of_a_full_disk(&words(&line), folder.path());
        SOFTSTOP.tells_of_a_full_disk(&[words(&line)[0], "--help"], folder.path());
    }
    SOFTSTOP.tells_of_a_full_disk(&["--help"], folder.path());
    SOFTSTOP.tells_of_a_full_disk(&["--version"], folder.path());
}

#[test]
fn the_files_are_too_large() {
    for (line, _) in lines().filter(|(_, writes)| *writes != Nothing) {
        let folder = tempfile::tempdir().expect("a folder");
        let line = line + " --output out/one";
        SOFTSTOP.tells_of_files_too_large(&words(&line), folder.path(), &[]);
    }
}
