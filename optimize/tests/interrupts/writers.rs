//! Two runs that would write to one place, and what killed ones have left there.

use std::fs;
use std::os::unix::fs::symlink;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use softstop_console::output::Folder;

use super::dispositions::{Writes, lines};
use softstop_testing::{with_folders, words};

use super::{Outcome, SOFTSTOP};

/// Where another run writes, no command does: that is no wrong usage, and nothing of the other run is lost.
#[test]
fn of_two_writers_the_second_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    let (whole, one) = (Folder::open(&out, &[])?, Folder::of_file(&out, "one")?);
    let before = fs::read_dir(&out)?.count();
    for (line, writes) in lines() {
        let output = match writes {
            Writes::Nothing => continue,
            Writes::Folder => "out",
            Writes::File => "out/one",
        };
        let line = line + " --output " + output;
        let run = SOFTSTOP
            .command(&words(&line))
            .current_dir(folder.path())
            .output()?;
        let said = String::from_utf8_lossy(&run.stderr);
        assert_eq!(run.status.code(), Some(1), "{line}: {said}");
        assert!(
            said.contains(output) && said.contains("another run"),
            "{line}: {said}"
        );
        assert_eq!(fs::read_dir(&out)?.count(), before, "{line}");
    }
    drop(one);
    drop(whole);
    assert!(!out.exists());
    Ok(())
}

/// Files of one folder are written by several runs at once, if each writes but one.
#[test]
fn other_files_of_a_folder_can_be_written() -> Outcome {
    let folder = tempfile::tempdir()?;
    let lives = Folder::of_file(folder.path(), "a.fmu")?;
    let other = folder.path().join("b.fmu");
    assert!(
        SOFTSTOP
            .run(&["fmu", "--output", &other.to_string_lossy()])
            .status
            .success()
    );
    drop(lives);
    assert_eq!(fs::read_dir(folder.path())?.count(), 1);
    Ok(())
}

/// What a run that was killed has left is taken away by the next one into the same folder.
#[test]
fn the_next_run_clears_up_after_a_killed_one() -> Outcome {
    let folder = tempfile::tempdir()?;
    let basin = |size: &str| {
        let mut command = Command::new(SOFTSTOP.file);
        command
            .args(["basin", "--size", size, "--output"])
            .arg(folder.path());
        command.stdout(Stdio::null()).stderr(Stdio::null());
        command
    };
    let hidden = || -> std::io::Result<usize> {
        let names = fs::read_dir(folder.path())?.map(|entry| Ok(entry?.file_name()));
        let names = names.collect::<std::io::Result<Vec<_>>>()?;
        let hidden = names
            .iter()
            .filter(|name| name.to_string_lossy().starts_with(".softstop-"));
        Ok(hidden.count())
    };
    let mut killed = basin("3000").spawn()?;
    let deadline = Instant::now() + Duration::from_secs(20);
    while hidden()? < 2 && Instant::now() < deadline {
        std::thread::sleep(Duration::from_millis(10));
    }
    killed.kill()?;
    killed.wait()?;
    assert_eq!(hidden()?, 2, "a lock and a folder");
    assert!(basin("20").status()?.success());
    assert_eq!(hidden()?, 0);
    assert_eq!(fs::read_dir(folder.path())?.count(), 3);
    Ok(())
}

/// A link in the place of a file that a run writes as it goes on leads it nowhere.
#[test]
fn links_are_not_followed() -> Outcome {
    for (line, part) in [
        ("basin --size 40", "basin.part"),
        ("study STUDIES/map.toml", "study.part"),
    ] {
        let folder = tempfile::tempdir()?;
        let precious = folder.path().join("precious");
        fs::write(&precious, "kept")?;
        let out = folder.path().join("out");
        fs::create_dir(&out)?;
        symlink(&precious, out.join(part))?;
        let line = with_folders(line) + " --output out --resume";
        let run = SOFTSTOP
            .command(&words(&line))
            .current_dir(folder.path())
            .output()?;
        let said = String::from_utf8_lossy(&run.stderr);
        assert_eq!(run.status.code(), Some(1), "{line}: {said}");
        assert!(said.contains(part), "{line}: {said}");
        assert_eq!(fs::read_to_string(&precious)?, "kept", "{line}");
    }
    Ok(())
}
