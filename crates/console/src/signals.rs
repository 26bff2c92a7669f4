//! Signals that ask a program to end. One that is inherited as ignored stays ignored: SIGHUP under `nohup`, SIGINT and
//! SIGQUIT of a job that a shell runs in the background.

use std::io;

/// Calls a function with the number of each signal that asks the program to end, on a thread of its own. A write beyond
/// the largest file that is allowed (SIGXFSZ) no longer ends the program: it fails like any other.
///
/// # Errors
/// If the system refuses a handler.
#[cfg(unix)]
pub fn listen(receive: impl Fn(i32) + Send + 'static) -> io::Result<()> {
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    use signal_hook::consts::SIGXFSZ;
    use signal_hook::iterator::Signals;

    let heard = unix::ENDING.into_iter().filter(|it| !unix::is_ignored(*it));
    let mut signals = Signals::new(heard.collect::<Vec<_>>())?;
    signal_hook::flag::register(SIGXFSZ, Arc::<AtomicBool>::default())?;
    std::thread::Builder::new()
        .name("signals".to_owned())
        .spawn(move || signals.forever().for_each(receive))?;
    Ok(())
}

/// Calls a function with 2, the number of SIGINT, at each Ctrl-C.
///
/// # Errors
/// If the system refuses a handler.
#[cfg(not(unix))]
pub fn listen(receive: impl Fn(i32) + Send + 'static) -> io::Result<()> {
    const SIGINT: i32 = 2;
    ctrlc::set_handler(move || receive(SIGINT)).map_err(io::Error::other)
}

/// The exit code of a program that a signal ends, as shells have it.
pub fn exit_code(signal: i32) -> u8 {
    u8::try_from(128 + signal).unwrap_or(u8::MAX)
}

/// The number of SIGPIPE, by which a write to a pipe that nobody reads ends other programs.
pub const PIPE: i32 = 13;

#[cfg(unix)]
mod unix {
    use std::mem::MaybeUninit;
    use std::ptr;

    use signal_hook::consts::{
        SIGALRM, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU,
    };

    /// What ends a program that has no handler, and can be caught: by hand, and by batch systems before a limit.
    pub(super) const ENDING: [i32; 8] = [
        SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGALRM, SIGXCPU,
    ];

    /// Whether the program ignores a signal.
    #[allow(unsafe_code)]
    pub(super) fn is_ignored(signal: i32) -> bool {
        let mut action = MaybeUninit::<libc::sigaction>::zeroed();
        // SAFETY: no safe function of the standard library or of `signal-hook` tells the present action. Without a new
        // action (null), `sigaction` changes nothing and writes the present one into `action`, which lives, is zeroed
        // and so valid for every one of its fields.
        let action = unsafe {
            match libc::sigaction(signal, ptr::null(), action.as_mut_ptr()) {
                0 => action.assume_init(),
                _ => return false,
            }
        };
        action.sa_sigaction == libc::SIG_IGN
    }
}
