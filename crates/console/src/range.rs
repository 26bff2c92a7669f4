//! Ranges as users write them, `LOW:HIGH`, and values that have to lie in one.

use std::fmt::Display;
use std::ops::RangeInclusive;

use crate::failure::Failure;

/// The range in a text.
///
/// # Errors
/// What is allowed.
pub fn rising(text: &str) -> Result<[f64; 2], String> {
    let number = |part: &str| part.trim().parse::<f64>().ok();
    let pair = text.split_once(':');
    match pair.and_then(|(low, high)| Some([number(low)?, number(high)?])) {
        Some([low, high]) if low < high && low.is_finite() && high.is_finite() => Ok([low, high]),
        _ => Err("must be LOW:HIGH, two finite numbers with LOW < HIGH, as in -20:20".to_owned()),
    }
}

/// Refuses a value outside a range.
///
/// # Errors
/// [`Failure::Usage`] naming value and range.
pub fn within<T: PartialOrd + Display>(
    name: &str,
    value: T,
    range: RangeInclusive<T>,
) -> Result<(), Failure> {
    let allowed = format!("{} to {}", range.start(), range.end());
    require(range.contains(&value), name, value, &allowed)
}

/// Refuses a value unless the condition holds, saying what is allowed; for a range that
/// [`Allowed`](softstop::Allowed) has, its own check does that.
///
/// # Errors
/// [`Failure::Usage`] naming value and range.
pub fn require(holds: bool, name: &str, value: impl Display, allowed: &str) -> Result<(), Failure> {
    match holds {
        true => Ok(()),
        false => Err(Failure::usage(format!(
            "{name} = {value}: must be {allowed}"
        ))),
    }
}
