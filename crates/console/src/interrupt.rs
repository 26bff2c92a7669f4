//! Ctrl-C and the other [`signals`] to end: the first asks the run to end in good order and ends it itself a little
//! later, or later still if it saves what it has ([`save`]); the second ends it at once. What was staged goes with it.

use std::fs;
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
use std::sync::{Mutex, MutexGuard, Once, PoisonError};
use std::thread;
use std::time::Duration;

use crate::signals;

/// The signal that asked the run to end; 0 before.
static REQUESTED: AtomicI32 = AtomicI32::new(0);
static SAVING: AtomicBool = AtomicBool::new(false);
static INSTALL: Once = Once::new();
static UNDER_WAY: Mutex<UnderWay> = Mutex::new(UnderWay {
    outputs: Vec::new(),
    closing: "interrupted: no files were written",
});

/// What stands for the signal where a program that calls this one as a library asks.
const LIBRARY: i32 = -1;

/// How long a run may take to end by itself.
const GRACE: Duration = Duration::from_millis(700);

/// How much longer, if it saves what it has.
const SAVING_GRACE: Duration = Duration::from_secs(10);

/// What is said besides where that was not enough.
pub const LATE: &str = "ended in the middle of a long step";

/// What a run has begun to write. Nothing ends the run while somebody holds it.
#[derive(Debug)]
pub struct UnderWay {
    /// The outputs that are begun and not whole yet.
    pub outputs: Vec<StagingDir>,
    /// What is said if the run is ended.
    pub closing: &'static str,
}

/// What there is of an output that is not whole yet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StagingDir {
    /// The folder where its files are until then.
    pub staging: PathBuf,
    /// The file that its run holds locked.
    pub lock: PathBuf,
    /// Folders made for it, outermost first.
    pub made: Vec<PathBuf>,
}

impl StagingDir {
    /// Takes away what is there of it; a folder that has been filled meanwhile stays.
    pub fn undo(&self) {
        let _ = fs::remove_dir_all(&self.staging);
        let _ = fs::remove_file(&self.lock);
        self.unmake();
    }

    /// Takes away the folders made for it that are empty.
    pub fn unmake(&self) {
        for folder in self.made.iter().rev() {
            let _ = fs::remove_dir(folder);
        }
    }
}

/// What is under way, to change it or to write without being ended in between.
pub fn under_way() -> MutexGuard<'static, UnderWay> {
    UNDER_WAY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Takes over Ctrl-C and the other signals to end. Without handlers (a system that refuses them) the default
/// stands: the process ends at once, and staged files stay out of sight.
pub fn install() {
    INSTALL.call_once(|| {
        if let Err(error) = signals::listen(receive) {
            let _ = writeln!(
                io::stderr(),
                "warning: Ctrl-C will end the run at once ({error})"
            );
        }
    });
}

/// The first signal asks the run to end, any further one ends it.
fn receive(signal: i32) {
    let first = REQUESTED.compare_exchange(0, signal, Ordering::SeqCst, Ordering::SeqCst);
    if first.is_ok() {
        let _ = thread::Builder::new().spawn(end_late);
        return;
    }
    if let Ok(under_way) = UNDER_WAY.try_lock() {
        end(&under_way);
    }
    std::process::exit(exit_code().into());
}

/// Asks the run to end, as a signal does, but never ends the process, and nothing is saved; for programs that call this one
/// as a library.
pub fn request() {
    let _ = REQUESTED.compare_exchange(0, LIBRARY, Ordering::SeqCst, Ordering::SeqCst);
}

/// Takes [`request`] back, once the run has ended.
pub fn clear() {
    REQUESTED.store(0, Ordering::SeqCst);
    SAVING.store(false, Ordering::SeqCst);
}

/// 128 and the number of the signal that asked the run to end.
pub fn exit_code() -> u8 {
    signals::exit_code(REQUESTED.load(Ordering::SeqCst))
}

/// Ends a run that has not ended by itself: one in the middle of a step that knows of no requests.
fn end_late() {
    thread::sleep(GRACE);
    if SAVING.load(Ordering::SeqCst) {
        thread::sleep(SAVING_GRACE);
    }
    let under_way = under_way();
    let _ = writeln!(io::stderr(), "{LATE}");
    end(&under_way);
}

fn end(under_way: &UnderWay) -> ! {
    under_way.outputs.iter().for_each(StagingDir::undo);
    let _ = writeln!(io::stderr(), "{}", under_way.closing);
    std::process::exit(exit_code().into())
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

/// Whether the user asked the run to end, and it does not save what it has.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::SeqCst) != 0 && !SAVING.load(Ordering::SeqCst)
}

/// The run that was asked to end saves what it has: it has some seconds for that and is not asked again. Another signal
/// still ends it at once.
pub fn save() {
    SAVING.store(
        REQUESTED.load(Ordering::SeqCst) != LIBRARY,
        Ordering::SeqCst,
    );
}
