//! `cargo +nightly fuzz run --features libfuzzer toml`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| softstop_fuzz::toml(data));
