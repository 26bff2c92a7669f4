//! Scales: the range of an axis, and the round values on it.

/// A range narrower than this is rounding.
const TINY: f64 = 1e-12;

/// From the least to the greatest finite value, with this share of room on both sides; a range around the
/// value if there is but one, and from 0 to 1 if there is none.
pub fn around(values: impl IntoIterator<Item = f64>, room: f64) -> (f64, f64) {
    let values = values.into_iter().filter(|value| value.is_finite());
    let ends = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = values.fold(ends, |(low, high), value| (low.min(value), high.max(value)));
    if high < low {
        return (0.0, 1.0);
    }
    let room = room * (high - low);
    if high - low > TINY * low.abs().max(high.abs()).max(1.0) {
        (low - room, high + room)
    } else {
        (low - 1.0, low + 1.0)
    }
}

/// Round values in a range, about so many, and how they are written in units of a power of ten, which stands behind
/// them if it is to be told.
pub(crate) fn ticks(
    (low, high): (f64, f64),
    count: usize,
    power: i32,
    is_told: bool,
) -> Vec<(f64, String)> {
    let width = high - low;
    if !width.is_finite() || width <= 0.0 || count == 0 {
        return Vec::new();
    }
    let rough = width / count as f64;
    let decade = 10f64.powf(rough.log10().floor());
    let factor = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .find(|factor| factor * decade >= 0.8 * rough);
    let step = factor.unwrap_or(10.0) * decade;
    let (first, last) = (
        (low / step - 1e-6).ceil() as i64,
        (high / step + 1e-6).floor() as i64,
    );
    let decimals = (f64::from(power) - (step.log10() + 1e-9).floor()).max(0.0) as usize;
    let written = |index: i64| {
        let value = index as f64 * step;
        let digits = format!("{:.decimals$}", value / 10f64.powi(power)).replace('-', "−");
        let name = match index {
            0 if power != 0 => "0".to_owned(),
            _ if power == 0 || !is_told => digits,
            _ => format!("{digits}×{}", power_of_ten(power)),
        };
        (value, name)
    };
    (first..=last).map(written).collect()
}

/// Values at a logarithmic axis over a range of powers of ten: these powers, about so many of them named, or, where they are
/// few, once, twice and five times them.
pub(crate) fn log_ticks((low, high): (f64, f64), count: usize) -> Vec<(f64, String)> {
    let inside = |power: f64| low - 1e-9 <= power && power <= high + 1e-9;
    let (first, last) = (low.floor() as i32, high.ceil() as i32);
    let powers = (first..=last).filter(|power| inside(f64::from(*power)));
    let powers: Vec<i32> = powers.collect();
    if powers.len() > 2 {
        let step = powers.len().div_ceil(count + count / 2) as i32;
        let written = |power: i32| match power % step {
            0 => power_of_ten(power),
            _ => String::new(),
        };
        let powers = powers.into_iter();
        return powers
            .map(|power| (f64::from(power), written(power)))
            .collect();
    }
    let factors = (first..=last).flat_map(|power| [1.0f64, 2.0, 5.0].map(|factor| (factor, power)));
    let values = factors.map(|(factor, power)| (factor.log10() + f64::from(power), factor, power));
    let inside: Vec<_> = values.filter(|it| inside(it.0)).collect();
    if inside.len() < 2 {
        let range = (10f64.powf(low), 10f64.powf(high));
        let ticks = ticks(range, count, power_of(range), true);
        return ticks
            .into_iter()
            .map(|(value, text)| (value.log10(), text))
            .collect();
    }
    let written = |factor: f64, power: i32| match (-3..5).contains(&power) {
        true => format!(
            "{:.*}",
            (-power).max(0) as usize,
            factor * 10f64.powi(power)
        ),
        false => format!("{factor}×{}", power_of_ten(power)),
    };
    let ticks = inside.into_iter();
    ticks
        .map(|(at, factor, power)| (at, written(factor, power)))
        .collect()
}

/// Numbers from here to there are written without a power of ten.
const PLAIN: (f64, f64) = (1e-3, 1e5);

/// The power of ten, a multiple of three, in units of which the numbers of a range are written.
pub(crate) fn power_of((low, high): (f64, f64)) -> i32 {
    let size = low.abs().max(high.abs());
    match (PLAIN.0..PLAIN.1).contains(&size) {
        true => 0,
        false => 3 * (size.log10() / 3.0).floor() as i32,
    }
}

/// Units that take a prefix.
const UNITS: [&str; 9] = ["N", "m", "s", "J", "W", "Pa", "Hz", "V", "A"];

/// A name whose unit, in parentheses at its end, has the prefix of a power of ten; none if it takes none.
pub(crate) fn prefixed(name: &str, power: i32) -> Option<String> {
    let prefixes = [
        (-9, "n"),
        (-6, "µ"),
        (-3, "m"),
        (3, "k"),
        (6, "M"),
        (9, "G"),
    ];
    let (_, prefix) = prefixes.into_iter().find(|it| it.0 == power)?;
    let (what, unit) = name.strip_suffix(')')?.rsplit_once('(')?;
    let first = unit.split([' ', '/']).next()?;
    let takes = UNITS.contains(&first);
    takes.then(|| format!("{what}({prefix}{unit})"))
}

/// A power of ten in print: 10 with a raised exponent.
pub fn power_of_ten(exponent: i32) -> String {
    let digits = exponent.to_string();
    let raised = digits.chars().map(|digit| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32(u32::from('⁰') + digit.to_digit(10).unwrap_or(0)).unwrap_or(digit),
    });
    format!("10{}", raised.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::{around, log_ticks, power_of, power_of_ten, prefixed, ticks};

    #[test]
    fn exponents_are_raised() {
        assert_eq!(power_of_ten(-12), "10⁻¹²");
        assert_eq!(power_of_ten(340), "10³⁴⁰");
    }

    #[test]
    fn units_take_prefixes() {
        let written = |name, power| prefixed(name, power).unwrap_or_default();
        assert_eq!(written("contact force F (N)", 3), "contact force F (kN)");
        assert_eq!(written("stiffness (N/m)", 6), "stiffness (MN/m)");
        assert_eq!(written("mass (kg)", 3), "");
        assert_eq!(written("area (m^2)", -6), "");
        assert_eq!(written("velocity X′₋", 6), "");
        assert_eq!(written("force (N)", 12), "");
    }

    #[test]
    fn ticks_are_round_and_inside() {
        let names = |range, count| -> Vec<String> {
            let ticks = ticks(range, count, power_of(range), true);
            ticks.into_iter().map(|tick| tick.1).collect()
        };
        assert_eq!(
            names((0.8, 1.0), 4),
            ["0.80", "0.85", "0.90", "0.95", "1.00"]
        );
        assert_eq!(names((-1.0, 1.0), 4), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(names((0.0, 25.0), 5), ["0", "5", "10", "15", "20", "25"]);
        assert_eq!(names((0.0, 8e7), 2), ["0", "50×10⁶"]);
        assert_eq!(names((-2e-4, 2e-4), 2), ["−200×10⁻⁶", "0", "200×10⁻⁶"]);
    }

    #[test]
    fn logarithmic_ticks_are_powers_of_ten_where_there_are_many() {
        let names = |range, count| -> Vec<String> {
            let ticks = log_ticks(range, count).into_iter();
            ticks.map(|tick| tick.1).collect()
        };
        assert_eq!(
            names((-6.2, 1.0), 4),
            ["10⁻⁶", "", "10⁻⁴", "", "10⁻²", "", "10⁰", ""]
        );
        assert_eq!(names((0.0, 1.0), 5), ["1", "2", "5", "10"]);
        assert_eq!(names((-2.1, -1.0), 5), ["0.01", "0.02", "0.05", "0.1"]);
        assert_eq!(names((0.1, 0.2), 4), ["1.3", "1.4", "1.5"]);
    }

    #[test]
    fn ranges_are_never_empty() {
        assert_eq!(around([], 0.1), (0.0, 1.0));
        assert_eq!(around([3.0], 0.1), (2.0, 4.0));
        assert_eq!(around([0.0, 12.5e-48], 0.1), (-1.0, 1.0));
        assert_eq!(around([1.0, f64::NAN, 3.0], 0.5), (0.0, 4.0));
        assert!(ticks((1.0, 1.0), 5, 0, true).is_empty());
    }
}
