//! Wilson's interval: how certain a share of trials is.

/// The 97.5 % quantile of the standard normal distribution.
const NORMAL_QUANTILE: f64 = 1.959_963_984_540_054;

/// Wilson's 95 % confidence interval of the probability of an event that happened in `hits` of `trials` independent trials
/// (Wilson 1927): unlike the normal approximation it is right near 0 and 1.
pub fn wilson_interval(hits: usize, trials: usize) -> [f64; 2] {
    if trials == 0 {
        return [0.0, 1.0];
    }
    let (n, z2) = (trials as f64, NORMAL_QUANTILE * NORMAL_QUANTILE);
    let p = hits as f64 / n;
    let middle = p + 0.5 * z2 / n;
    let half = NORMAL_QUANTILE * (p * (1.0 - p) / n + 0.25 * z2 / (n * n)).sqrt();
    // Without rounding at the ends.
    let low = if hits == 0 { 0.0 } else { middle - half };
    let high = if hits == trials {
        1.0
    } else {
        (middle + half) / (1.0 + z2 / n)
    };
    [low / (1.0 + z2 / n), high]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilsons_own_numbers() {
        // 81 of 263: 0.2553 to 0.3662 (Newcombe 1998, table I); 0 of 20: 0 to 0.1611; 1 of 29: 0.0061 to 0.1718.
        let near = |[low, high]: [f64; 2], a: f64, b: f64| {
            assert!(
                (low - a).abs() < 5e-5 && (high - b).abs() < 5e-5,
                "{low} {high}"
            );
        };
        near(wilson_interval(81, 263), 0.2553, 0.3662);
        near(wilson_interval(0, 20), 0.0, 0.1611);
        near(wilson_interval(1, 29), 0.0061, 0.1718);
        near(wilson_interval(20, 20), 1.0 - 0.1611, 1.0);
        assert_eq!(wilson_interval(0, 0), [0.0, 1.0]);
    }
}
