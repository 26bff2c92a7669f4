//! `cargo +nightly fuzz run --features libfuzzer state`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| softstop_fuzz::state(data));
