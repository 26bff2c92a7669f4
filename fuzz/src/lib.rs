//! What reads bytes that others may have damaged: each function takes any bytes, and panics where the project's own
//! code does, or breaks a promise.

#[allow(missing_docs, dead_code, reason = "of tests")]
#[path = "../../fmu/tests/common/importer.rs"]
mod common;
mod state;
#[allow(missing_docs, dead_code, reason = "of tests")]
#[path = "../../fmu/tests/state_machine/mod.rs"]
mod state_machine;

use std::io::Write;

use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use softstop::{Effort, Machine, Simulation};
use softstop_console::record_log::RecordLog;

pub use state::{behind_fitting_header, serialized, state, take_up};

/// A machine file: it is refused, or its machine moves on and every number of it stays finite.
///
/// # Panics
/// If not.
pub fn toml(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };
    let Ok(machine) = Machine::from_toml(text) else {
        return;
    };
    let Ok(mut motion) = Simulation::new(&machine.scene, machine.start) else {
        return;
    };
    let period = std::f64::consts::TAU / machine.scene.excitation.frequency;
    let mut effort = Effort::windows(1 << 16);
    if motion.watch(3.0 * period, &mut effort).is_ok() {
        let sample = motion.sample();
        assert!(
            sample.position.is_finite() && sample.velocity.is_finite(),
            "{text}"
        );
    }
}

/// A file that keeps what a run has done: all that is recalled can be read, what is added is recalled with it; a file that no run
/// has written is refused and stays as it is.
///
/// # Panics
/// If not, or if files cannot be written.
pub fn pieces(data: &[u8]) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.part");
    let mut file = std::fs::File::create(&path).expect("a file");
    file.write_all(data).expect("a file");
    if let Err(error) = RecordLog::open(&path) {
        assert_eq!(error.kind(), std::io::ErrorKind::InvalidData);
        assert_eq!(std::fs::read(&path).expect("a file"), data);
        return;
    }
    let read = || {
        let mut known = Vec::new();
        let mut file = RecordLog::open(&path)
            .expect("a file")
            .expect("no other run");
        let of = file.restore(|key, at| known.push((key.to_vec(), at)));
        let of = of.expect("a file that can be read");
        for (key, at) in &known {
            file.read(*at)
                .unwrap_or_else(|error| panic!("{key:?}: {error}"));
        }
        (of, known, file)
    };
    let (of, mut known, mut file) = read();
    if of.is_some() {
        let at = file.append(b"key", b"piece").expect("a file");
        known.push((b"key".to_vec(), at));
        drop(file);
        let again = read();
        assert_eq!((again.0, again.1), (of, known));
    }
}

/// C calls to several units: each four bytes draw one, so that calls can be left out, doubled and moved.
///
/// # Panics
/// If a unit does other than the model of the calls says.
pub fn calls(data: &[u8]) {
    let any = state_machine::draw::any_call();
    let drawn = data.chunks_exact(4).take(MOST_CALLS).map(|seed| {
        let chance = TestRng::from_seed(RngAlgorithm::XorShift, &seed.repeat(4));
        let mut runner = TestRunner::new_with_rng(Config::default(), chance);
        let call = any.new_tree(&mut runner).expect("no call is refused");
        call.current()
    });
    state_machine::run(&drawn.collect::<Vec<_>>());
}

/// More calls find nothing that fewer do not.
const MOST_CALLS: usize = 200;
