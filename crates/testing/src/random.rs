//! Random cases that are the same on every run.

use proptest::prelude::Strategy;
use proptest::test_runner::{Config, RngSeed};

/// `cases` random cases from one fixed seed, so that a run of the tests is repeatable. Another seed
/// and another number of cases are taken from `PROPTEST_RNG_SEED` and `PROPTEST_CASES`.
pub fn cases(cases: u32) -> Config {
    let given = |name: &str| std::env::var(name).ok()?.parse().ok();
    Config {
        cases: given("PROPTEST_CASES").map_or(cases, |n: u64| n as u32),
        rng_seed: RngSeed::Fixed(given("PROPTEST_RNG_SEED").unwrap_or(2003)),
        failure_persistence: None,
        ..Config::default()
    }
}

/// Numbers evenly spread in their logarithm.
pub fn log_uniform(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.ln()..high.ln()).prop_map(f64::exp)
}
