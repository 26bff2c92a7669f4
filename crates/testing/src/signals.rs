//! What programs do on signals, and where they inherit that signals are ignored, files limited, or outputs unread.

use std::io::PipeWriter;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::program::{Program, files, kill};

impl Program {
    /// Sends the program a signal (`INT`, say) in the middle of a long job that works in an empty folder: it
    /// ends with 128 and the signal's number within 10 s, and leaves no file but those of the names in `kept`. What it
    /// says.
    ///
    /// # Panics
    /// If it does otherwise, or is over before.
    #[track_caller]
    pub fn ends_on(
        &self,
        signal: &str,
        arguments: &[&str],
        folder: &Path,
        kept: &[&str],
    ) -> String {
        let mut command = self.command(arguments);
        let heard = command.stdout(Stdio::null()).stderr(Stdio::piped());
        let mut run = heard
            .current_dir(folder)
            .spawn()
            .expect("the program starts");
        let_work(run.id(), Duration::from_millis(150));
        let early = run.try_wait().expect("a process");
        assert_eq!(early, None, "{arguments:?} is over too soon");
        kill(signal, run.id());
        let deadline = Instant::now() + Duration::from_secs(10);
        let mut status = None;
        while status.is_none() && Instant::now() < deadline {
            sleep(Duration::from_millis(10));
            status = run.try_wait().expect("a process");
        }
        if status.is_none() {
            run.kill().expect("a process");
        }
        let code = status.and_then(|status| status.code());
        let told = Some(128 + number(signal));
        assert_eq!(code, told, "SIG{signal} of {arguments:?}: {status:?}");
        leaves_only(kept, folder, arguments);
        let said = run.wait_with_output().expect("a process").stderr;
        String::from_utf8_lossy(&said).into_owned()
    }

    /// The program as a shell starts it after some words of its own.
    fn after(&self, shell: &str, arguments: &[&str], folder: &Path) -> Command {
        let mut command = Command::new("sh");
        command.args(["-c", &format!("{shell}; exec \"$@\""), "sh", self.file]);
        command.args(self.first).args(arguments);
        command.current_dir(folder).stdout(Stdio::null());
        command.stderr(Stdio::piped());
        command
    }

    /// Starts a long job with SIGHUP, SIGINT and SIGQUIT ignored, as `nohup` and a shell's `&` do, and sends them: the
    /// job goes on, until SIGTERM ends it. It works in an empty folder, and leaves no file but those of the names in
    /// `kept`.
    ///
    /// # Panics
    /// If it does otherwise, or is over before.
    #[track_caller]
    pub fn outlives_ignored_signals(&self, arguments: &[&str], folder: &Path, kept: &[&str]) {
        let mut command = self.after("trap '' HUP INT QUIT", arguments, folder);
        let mut run = command.spawn().expect("a shell");
        for (number, signal) in (1..).zip(["HUP", "INT", "QUIT"]) {
            let_work(run.id(), Duration::from_millis(100 * number));
            kill(signal, run.id());
        }
        // Longer than a run may take that was asked to end.
        let_work(run.id(), Duration::from_millis(900));
        let early = run.try_wait().expect("a process");
        assert_eq!(early, None, "{arguments:?} ended");
        kill("TERM", run.id());
        let status = run.wait().expect("it ends");
        assert_eq!(status.code(), Some(143), "{arguments:?}: {status}");
        leaves_only(kept, folder, arguments);
    }

    /// Runs a job whose files are larger than it may write: it says so with exit code 1, and leaves no file but those
    /// of the names in `kept`.
    ///
    /// # Panics
    /// If it does otherwise.
    #[track_caller]
    pub fn tells_of_files_too_large(&self, arguments: &[&str], folder: &Path, kept: &[&str]) {
        let run = self.after("ulimit -f 1", arguments, folder).output();
        let Output { status, stderr, .. } = run.expect("a shell");
        let said = String::from_utf8_lossy(&stderr);
        assert_eq!(status.code(), Some(1), "{arguments:?}: {status}: {said}");
        assert!(said.contains("File too large"), "{arguments:?}: {said}");
        leaves_only(kept, folder, arguments);
    }

    /// Runs a job of whose output nobody reads a byte, nor of its messages: it ends with 128 + SIGPIPE.
    ///
    /// # Panics
    /// If it does otherwise.
    #[track_caller]
    pub fn ends_when_unread(&self, arguments: &[&str], folder: &Path) {
        for is_heard in [true, false] {
            let mut command = self.command(arguments);
            command.current_dir(folder).stdout(unread_pipe());
            command.stderr(match is_heard {
                true => Stdio::piped(),
                false => unread_pipe().into(),
            });
            let run = command.spawn().expect("it starts");
            let Output { status, stderr, .. } = run.wait_with_output().expect("it ends");
            let said = String::from_utf8_lossy(&stderr);
            assert_eq!(status.code(), Some(141), "{arguments:?}: {status}: {said}");
            assert!(!said.contains("error"), "{arguments:?}: {said}");
        }
    }

    /// Runs a job whose output goes to a full disk: it says so with exit code 1.
    ///
    /// # Panics
    /// If it does otherwise.
    #[cfg(target_os = "linux")]
    #[track_caller]
    pub fn tells_of_a_full_disk(&self, arguments: &[&str], folder: &Path) {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full");
        let mut command = self.command(arguments);
        command.current_dir(folder).stdout(full.expect("a device"));
        let Output { status, stderr, .. } = command.output().expect("it starts");
        let said = String::from_utf8_lossy(&stderr);
        assert_eq!(status.code(), Some(1), "{arguments:?}: {status}: {said}");
        assert!(said.contains("No space left"), "{arguments:?}: {said}");
    }
}

/// Waits until a process has worked for so long, or is over: on a busy computer that takes a while.
fn let_work(process: u32, time: Duration) {
    let deadline = Instant::now() + Duration::from_secs(60);
    let worked = || {
        let text = std::fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
        // Behind the name its state, and as the 12th and 13th number from there hundredths of seconds.
        let (_, rest) = text.rsplit_once(") ")?;
        let mut ticks = rest.split(' ').skip(11).map(str::parse::<u64>);
        let ticks = ticks.next()?.ok()? + ticks.next()?.ok()?;
        (!rest.starts_with('Z')).then(|| Duration::from_millis(10 * ticks))
    };
    if !Path::new("/proc").exists() {
        sleep(4 * time);
    }
    while worked().is_some_and(|worked| worked < time) && Instant::now() < deadline {
        sleep(Duration::from_millis(5));
    }
}

/// A pipe that has lost its reader before anything is written.
fn unread_pipe() -> PipeWriter {
    let (_reader, writer) = std::io::pipe().expect("a pipe");
    writer
}

/// The number of a signal, as Linux has it.
fn number(signal: &str) -> i32 {
    let numbers = [
        ("HUP", 1),
        ("INT", 2),
        ("QUIT", 3),
        ("USR1", 10),
        ("TERM", 15),
    ];
    let known = numbers.into_iter().find(|(name, _)| *name == signal);
    known.expect("a signal of the list").1
}

/// There is no file in a folder and below but those of these names.
///
/// # Panics
/// If there is one.
#[track_caller]
fn leaves_only(kept: &[&str], folder: &Path, arguments: &[&str]) {
    let left = files(folder);
    let mut strange = left
        .iter()
        .filter(|file| !kept.iter().any(|name| file.ends_with(name)));
    assert_eq!(strange.next(), None, "{arguments:?}");
}
