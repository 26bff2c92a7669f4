//! Ranges as users write them: `LOW:HIGH`.

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
