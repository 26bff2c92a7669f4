//! Programs as users and scripts meet them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};
use serde_json::Value;

/// The arguments of a line.
pub fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

/// A program, and the arguments that each of its calls begins with.
#[derive(Clone, Copy, Debug)]
pub struct Program {
    /// Its file: `env!("CARGO_BIN_EXE_…")`.
    pub file: &'static str,
    /// Its first arguments: a command, say.
    pub first: &'static [&'static str],
}

impl Program {
    /// The program with all its arguments, not yet started.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(self.file);
        command.args(self.first).args(arguments);
        command
    }

    /// Runs the program to its end.
    ///
    /// # Panics
    /// If it does not start.
    pub fn run(&self, arguments: &[&str]) -> Output {
        let output = self.command(arguments).output();
        output.expect("the program starts")
    }

    /// Runs the program where it has to succeed: what it wrote.
    ///
    /// # Panics
    /// If it fails, or writes other than UTF-8.
    #[track_caller]
    pub fn text(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{arguments:?}: {message}");
        String::from_utf8(output.stdout).expect("UTF-8")
    }

    /// Runs the program where it has to succeed: the JSON that it wrote.
    ///
    /// # Panics
    /// If it fails, or writes other than JSON.
    #[track_caller]
    pub fn json(&self, arguments: &[&str]) -> Value {
        let text = self.text(&[arguments, &["--format", "json"]].concat());
        serde_json::from_str(&text).expect("JSON")
    }

    /// Runs the program where it has to succeed, writing into a folder: the JSON that it wrote to stdout.
    ///
    /// # Panics
    /// If it fails, or writes other than JSON.
    #[track_caller]
    pub fn json_into(&self, folder: &Path, arguments: &[&str]) -> Value {
        let folder = folder.to_str().expect("UTF-8");
        self.json(&[arguments, &["--output", folder]].concat())
    }

    /// As [`Program::refuses`], where the folder that it was to write into is not made.
    ///
    /// # Panics
    /// If it does otherwise.
    #[track_caller]
    pub fn refuses_and_writes_nothing(&self, arguments: &[&str], words: &[&str]) {
        let folder = std::env::temp_dir().join(format!("softstop-refused-{}", std::process::id()));
        let path = folder.to_str().expect("UTF-8");
        self.refuses(&[arguments, &["--output", path]].concat(), words);
        assert!(!folder.exists(), "{arguments:?} made its folder");
    }

    /// Runs the program where it has to refuse its arguments, with exit code 2, a message that has all of `words`,
    /// and nothing on the standard output.
    ///
    /// # Panics
    /// If it does otherwise.
    #[track_caller]
    pub fn refuses(&self, arguments: &[&str], words: &[&str]) {
        self.ends_with(arguments, 2, words);
    }

    /// Runs the program where it has to fail, with this exit code, a message that has all of `words`, and nothing
    /// on the standard output.
    ///
    /// # Panics
    /// If it does otherwise.
    #[track_caller]
    pub fn ends_with(&self, arguments: &[&str], code: i32, words: &[&str]) {
        let output = self.run(arguments);
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {message}");
        assert!(output.stdout.is_empty(), "{arguments:?} wrote to stdout");
        for word in words {
            assert!(
                message.contains(word),
                "{arguments:?}: {word:?} is not in {message:?}"
            );
        }
    }

    /// Kills the program at random moments of a job that writes into the folder `out`, and takes the job up again with
    /// `--resume`, over and over: in the end its files, and no others, hold what they hold after an undisturbed run.
    /// So many kills, or `SOFTSTOP_KILLS`, of a seed or `SOFTSTOP_KILLS_SEED`; `folder` is empty.
    ///
    /// # Panics
    /// If it does otherwise.
    #[track_caller]
    pub fn survives_kills(&self, arguments: &[&str], kills: u64, folder: &Path) {
        let mut left = given("SOFTSTOP_KILLS").unwrap_or(kills);
        let mut chance = SplitMix64::seed_from_u64(given("SOFTSTOP_KILLS_SEED").unwrap_or(2003));
        let start = |more: &[&str]| {
            let mut command = self.command(&[arguments, &["--output", "out"], more].concat());
            let silent = command.stdout(Stdio::null()).stderr(Stdio::null());
            let run = silent.current_dir(folder).spawn();
            run.expect("the program starts")
        };
        let out = folder.join("out");
        let begin = Instant::now();
        let status = start(&[]).wait().expect("it ends");
        assert!(status.success(), "{arguments:?}: {status}");
        let (longest, whole) = (begin.elapsed(), contents(&out));
        let (mut jobs, mut taken_up) = (0, 0);
        while left > 0 || jobs == 0 {
            std::fs::remove_dir_all(&out).expect("a folder");
            let status = loop {
                let mut run = start(&["--resume"]);
                if left == 0 {
                    break run.wait().expect("it ends");
                }
                // The first kill waits for something to be kept; the others fall at random moments.
                let share = chance.next_u64() as f64 / u64::MAX as f64;
                let moment = Instant::now() + longest.mul_f64(share);
                let waits = |now| {
                    if taken_up == 0 {
                        !keeps(&out)
                    } else {
                        now < moment
                    }
                };
                let mut ended = None;
                while ended.is_none() && waits(Instant::now()) {
                    std::thread::sleep(Duration::from_millis(1));
                    ended = run.try_wait().expect("a process");
                }
                if let Some(status) = ended {
                    assert!(taken_up > 0, "{arguments:?} keeps nothing: {status}");
                    break status;
                }
                left -= 1;
                kill(
                    SIGNALS[chance.next_u64() as usize % SIGNALS.len()],
                    run.id(),
                );
                run.wait().expect("it ends");
                taken_up += u64::from(keeps(&out));
            };
            assert!(status.success(), "{arguments:?}, job {jobs}: {status}");
            holds(&out, &whole, &format!("{arguments:?}, job {jobs}"));
            jobs += 1;
        }
        println!("{arguments:?}: {jobs} jobs, {taken_up} times something was kept");
    }
}

/// A number that a variable of the environment gives.
pub(crate) fn given(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

/// Ways to end a program; more than half of them leave it no time.
const SIGNALS: [&str; 5] = ["KILL", "KILL", "KILL", "TERM", "INT"];

/// Whether a run has kept something in a folder.
fn keeps(folder: &Path) -> bool {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut kept = entries.filter(|it| it.path().extension().is_some_and(|it| it == "part"));
    kept.any(|it| it.metadata().is_ok_and(|it| it.len() > 0))
}

/// The files in a folder and below by name; of texts the lines that state no time.
pub(crate) fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let content = |path: PathBuf| {
        let bytes = std::fs::read(&path).expect("a file");
        let lines = bytes.split(|byte| *byte == b'\n');
        let lasting = lines.filter(|line| !line.trim_ascii().starts_with(b"\"seconds\""));
        (path, lasting.collect::<Vec<_>>().concat())
    };
    files(folder).into_iter().map(content).collect()
}

/// Asserts that a folder has files of these [`contents`], and no others.
#[track_caller]
pub(crate) fn holds(folder: &Path, expected: &BTreeMap<PathBuf, Vec<u8>>, what: &str) {
    let found = contents(folder);
    for path in found.keys().chain(expected.keys()) {
        // The bytes are too many to be shown.
        assert!(
            found.get(path) == expected.get(path),
            "{what}: {} is another",
            path.display()
        );
    }
}

/// Sends a process a signal.
pub fn kill(signal: &str, process: u32) {
    let arguments = [format!("-{signal}"), process.to_string()];
    let status = Command::new("kill").args(arguments).status();
    assert!(status.expect("kill starts").success(), "kill -{signal}");
}

/// All files in a folder and below; none if it does not exist.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths
        .flat_map(|path| {
            if path.is_dir() {
                files(&path)
            } else {
                vec![path]
            }
        })
        .collect()
}
