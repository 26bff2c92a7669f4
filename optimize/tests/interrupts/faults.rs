//! Failing calls of the system, over every file that a command writes or keeps.

use softstop_testing::{with_folders, words};

use super::SOFTSTOP;

#[test]
fn nothing_is_lost_to_faults() {
    for (line, resumes, kept) in [
        ("sweep --from 0.8 --to 1.8 --steps 300", true, "sweep.part"),
        ("basin --size 60", true, "basin.part"),
        ("basin --along-zone 3 --size 30", true, "basin.part"),
        ("study STUDIES/map.toml --csv", true, "study.part"),
        (
            "optimize --evaluations 100 --samples 10",
            true,
            "optimize.part",
        ),
        ("motions --starts 16", false, ""),
        ("continue --parameter eta --from 1.1 --to 1.2", false, ""),
        ("simulate SCENES/hertz.toml", false, ""),
        ("stops", false, ""),
    ] {
        let line = with_folders(line);
        let folder = tempfile::tempdir().expect("a folder");
        SOFTSTOP.survives_faults(&words(&line), 6, folder.path(), resumes, kept);
    }
}
