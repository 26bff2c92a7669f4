//! Ctrl-C and the signals to end: the first asks the run to end in good order and ends it itself a little later,
//! the second ends it at once. What was staged goes with it.

use std::fs;
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, Once, PoisonError};
use std::thread;
use std::time::Duration;

static REQUESTED: AtomicBool = AtomicBool::new(false);
static INSTALL: Once = Once::new();
static UNDER_WAY: Mutex<UnderWay> = Mutex::new(UnderWay {
    outputs: Vec::new(),
    is_kept: false,
    closing: MESSAGE,
});

/// How long a run may take to end by itself.
const GRACE: Duration = Duration::from_millis(700);

/// What is said besides where that was not enough.
pub const LATE: &str = "ended in the middle of a long step";

/// What is said at the end.
pub const MESSAGE: &str = "interrupted: no files were written";

/// What a run has begun to write. Nothing ends the run while somebody holds it.
#[derive(Debug)]
pub struct UnderWay {
    outputs: Vec<Making>,
    /// The run has taken its end upon itself: it keeps what is done.
    is_kept: bool,
    /// What is said if the run is ended.
    closing: &'static str,
}

/// Folders of an output that is not whole yet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Making {
    /// Where its files are until then.
    pub staging: PathBuf,
    /// Folders made for it, outermost first.
    pub made: Vec<PathBuf>,
}

impl Making {
    /// Takes away what is there of it; a folder that has been filled meanwhile stays.
    pub fn undo(&self) {
        let _ = fs::remove_dir_all(&self.staging);
        for folder in self.made.iter().rev() {
            let _ = fs::remove_dir(folder);
        }
    }
}

impl UnderWay {
    /// Begins an output.
    pub fn begin(&mut self, making: Making) {
        self.outputs.push(making);
    }

    /// Ends one, whole or not.
    pub fn end(&mut self, making: &Making) {
        self.outputs.retain(|other| other.staging != making.staging);
    }

    /// Files stand: from now on this is said if the run is ended.
    pub fn close_with(&mut self, closing: &'static str) {
        self.closing = closing;
    }

    /// The run ends by itself, however long it takes to keep what is done; only a second signal ends it before.
    pub fn keep(&mut self) {
        self.is_kept = true;
    }
}

/// What is under way, to change it or to write without being ended in between.
pub fn under_way() -> MutexGuard<'static, UnderWay> {
    UNDER_WAY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Takes over Ctrl-C and the signals to terminate and to hang up. Without a handler (a system that refuses
/// one) the default stands: the process ends at once, and staged files stay out of sight.
pub fn install() {
    INSTALL.call_once(|| {
        let handler = || {
            if REQUESTED.swap(true, Ordering::SeqCst) {
                if let Ok(under_way) = UNDER_WAY.try_lock() {
                    end(&under_way);
                }
                std::process::exit(130);
            }
            let _ = thread::Builder::new().spawn(end_late);
        };
        if let Err(error) = ctrlc::set_handler(handler) {
            eprintln!("warning: Ctrl-C will end the run at once ({error})");
        }
    });
}

/// Ends a run that has not ended by itself: one in the middle of a step that knows of no requests.
fn end_late() {
    thread::sleep(GRACE);
    let under_way = under_way();
    if !under_way.is_kept {
        let _ = writeln!(io::stderr(), "{LATE}");
        end(&under_way);
    }
}

fn end(under_way: &UnderWay) -> ! {
    under_way.outputs.iter().for_each(Making::undo);
    let _ = writeln!(io::stderr(), "{}", under_way.closing);
    std::process::exit(130)
}

/// Stops work that is watched once the user asked the run to end.
pub fn go_on() -> ControlFlow<()> {
    match requested() {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    }
}

/// The same for work that tells how much of it is done.
pub fn watch(_: u64, _: u64) -> ControlFlow<()> {
    go_on()
}

/// Whether the user asked the run to end.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::SeqCst)
}
