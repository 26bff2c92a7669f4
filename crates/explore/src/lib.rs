//! The commands that analyse one machine, each with its own picture, and the one for many machines, [`study`].
//!
//! Whatever fails does so with [`Failure::Usage`] for values that cannot be, with [`Failure::Run`] if nothing can be
//! computed or written, and with [`Failure::Interrupted`] after Ctrl-C.
//!
//! [`Failure::Usage`]: softstop_console::failure::Failure::Usage
//! [`Failure::Run`]: softstop_console::failure::Failure::Run
//! [`Failure::Interrupted`]: softstop_console::failure::Failure::Interrupted
#![forbid(unsafe_code)]

pub mod basin;
pub mod continuation;
pub mod explorer;
pub mod fidelity;
pub mod motions;
pub mod orbit;
mod page;
pub mod palette;
pub mod prove;
pub mod simulate;
pub mod stops;
pub mod study;
pub mod sweep;
pub mod watch;
pub mod zone;
