//! `cargo +nightly fuzz run --features libfuzzer pieces`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| softstop_fuzz::pieces(data));
