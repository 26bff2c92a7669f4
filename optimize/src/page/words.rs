//! Numbers and symbols as people read them.

use softstop_draw::{power_of_ten, split_indices};

/// Significant digits of numbers in the page.
const DIGITS: i32 = 5;
/// Powers of ten that are not split off.
const PLAIN: std::ops::Range<i32> = -3..6;

/// A number with five digits, without zeros that say nothing: `0.0215`, `12 500`, `2.4 × 10⁶`.
pub(super) fn number(value: f64) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let size = value.abs();
    let mut power = size.log10().floor() as i32;
    // Rounding may lead to the next power.
    if (size / 10f64.powi(power) * 10f64.powi(DIGITS - 1)).round() >= 10f64.powi(DIGITS) {
        power += 1;
    }
    let text = if PLAIN.contains(&power) {
        grouped(&fixed(size, DIGITS - 1 - power))
    } else {
        let mantissa = fixed(size / 10f64.powi(power), DIGITS - 1);
        format!("{mantissa}\u{a0}×\u{a0}{}", power_of_ten(power))
    };
    let sign = if value < 0.0 { "−" } else { "" };
    format!("{sign}{text}")
}

/// A whole number, its digits in groups of three.
pub(super) fn count(value: u64) -> String {
    groups(&value.to_string())
}

/// Digits in groups of three.
fn groups(digits: &str) -> String {
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

/// A number as the page writes it, with its unit.
pub fn quantity(value: f64, unit: &str) -> String {
    match unit {
        "" => number(value),
        _ => format!("{}\u{a0}{unit}", number(value)),
    }
}

/// A text with its numbers as the page writes them.
pub(super) fn with_numbers(text: &str) -> String {
    let written = text.split(' ').map(|word| {
        let bare = word.trim_end_matches([',', ';', '.']);
        let value: Option<f64> = bare.parse().ok();
        value.map_or(word.to_owned(), |value| number(value) + &word[bare.len()..])
    });
    written.collect::<Vec<_>>().join(" ")
}

fn fixed(value: f64, places: i32) -> String {
    let text = format!("{value:.*}", places.max(0) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// Digits before the point in groups of three, from five digits on.
fn grouped(text: &str) -> String {
    let whole = text.find('.').unwrap_or(text.len());
    match whole > 4 {
        true => groups(&text[..whole]) + &text[whole..],
        false => text.to_owned(),
    }
}

/// The text with a capital at its beginning.
pub fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters).collect()
}

/// A text as it is typed, with g0 and g₀ as `g_0`, a sign in front of a number as a minus sign, and signs and letters that
/// stand for others as these.
pub(super) fn plain(text: &str) -> String {
    let text = text.replace('₀', "_0").replace("<=", "≤");
    let text = text.replace("angle phi", "angle φ").replace("x'", "x′");
    let mut plain = String::new();
    let mut before = ' ';
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        let is_free = !before.is_alphanumeric() && before != '_';
        let next = letters.peek().copied().unwrap_or(' ');
        match letter {
            'g' if is_free && next == '0' => plain += "g_",
            '-' if before == ' ' && next.is_ascii_digit() => plain.push('−'),
            letter => plain.push(letter),
        }
        before = letter;
    }
    plain
}

/// A text with its indices below the line, as HTML: `s_SN` becomes s with SN as its index. What a text holds besides
/// is escaped.
pub(super) fn html(text: &str) -> String {
    let write = |(text, is_index): (String, bool)| match is_index {
        true => format!("<sub>{}</sub>", escaped(&text)),
        false => escaped(&text),
    };
    split_indices(&plain(text)).into_iter().map(write).collect()
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::{count, html, number};

    #[test]
    fn numbers_have_five_digits_and_no_idle_zeros() {
        let cases = [
            (0.0, "0"),
            (0.0215, "0.0215"),
            (12.813_44, "12.813"),
            (99_999.7, "100\u{202f}000"),
            (12_500.0, "12\u{202f}500"),
            (-9000.0, "−9000"),
            (2.4e6, "2.4\u{a0}×\u{a0}10⁶"),
            (-1.23456e-7, "−1.2346\u{a0}×\u{a0}10⁻⁷"),
            (999_999.9, "1\u{a0}×\u{a0}10⁶"),
            (f64::NAN, "–"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn counts_are_grouped() {
        assert_eq!(count(1_000_000), "1\u{202f}000\u{202f}000");
        assert_eq!(count(123), "123");
    }

    #[test]
    fn indices_go_below_and_all_else_is_escaped() {
        assert_eq!(
            html("from g₀ to s_SN <"),
            "from g<sub>0</sub> to s<sub>SN</sub> &lt;"
        );
        assert_eq!(html("missing_strips"), "missing_strips");
        assert_eq!(
            html("above g0, -0.5 to 2-3"),
            "above g<sub>0</sub>, −0.5 to 2-3"
        );
        assert_eq!(
            html("-1 <= x' <= 1 at drive angle phi"),
            "−1 ≤ x′ ≤ 1 at drive angle φ"
        );
        assert_eq!(html("X_m, a_b_c"), "X<sub>m</sub>, a<sub>b</sub>_c");
    }
}
