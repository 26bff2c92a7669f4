//! `cargo +nightly fuzz run --features libfuzzer calls`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| softstop_fuzz::calls(data));
