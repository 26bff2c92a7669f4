//! Shades for numbers: viridis (van der Walt and Smith 2015), told apart by colour-blind readers and in grey.

/// Colours of viridis, evenly spaced.
const VIRIDIS: [[f64; 3]; 9] = [
    [68.0, 1.0, 84.0],
    [71.0, 45.0, 123.0],
    [59.0, 82.0, 139.0],
    [44.0, 114.0, 142.0],
    [33.0, 145.0, 140.0],
    [40.0, 174.0, 128.0],
    [94.0, 201.0, 98.0],
    [173.0, 220.0, 48.0],
    [253.0, 231.0, 37.0],
];

/// How many shades there are.
pub(crate) const SHADES: usize = 48;

/// The shade of a value in a range.
pub(crate) fn shade(value: f64, (low, high): (f64, f64)) -> usize {
    let shade = ((value - low) / (high - low) * SHADES as f64) as usize;
    shade.min(SHADES - 1)
}

/// The colour of a shade.
pub(crate) fn color(shade: usize) -> String {
    let at = shade as f64 / (SHADES - 1) as f64 * (VIRIDIS.len() - 1) as f64;
    let from = (at as usize).min(VIRIDIS.len() - 2);
    let share = at - from as f64;
    let part = |k: usize| {
        let (low, high) = (VIRIDIS[from][k], VIRIDIS[from + 1][k]);
        (low + share * (high - low)).round() as u8
    };
    format!("#{:02x}{:02x}{:02x}", part(0), part(1), part(2))
}
