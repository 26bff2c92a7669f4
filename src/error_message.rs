//! Parts of the texts of error messages.

/// The text of a number in an error message: as it is, or with a power of ten if it would be long.
pub fn plain_number(value: f64) -> String {
    match value.abs() {
        0.0 | 1e-5..1e16 => value.to_string(),
        size if size.is_finite() => format!("{value:e}"),
        _ => value.to_string(),
    }
}

/// The begin of an error message with the number of the line; empty without one.
pub(crate) fn line_prefix(line: Option<usize>) -> String {
    line.map_or_else(String::new, |line| format!("line {line}: "))
}

/// The end of an error message: how revolutions per minute are stated, if `text` speaks of them; else empty.
pub fn rpm_value_hint(text: &str) -> &'static str {
    match text.contains("rpm") {
        true => {
            "; revolutions per minute over 60 are excitation.frequency_hz, of machines in SI units"
        }
        false => "",
    }
}

/// The end of an error message on a key that no machine has: how revolutions per minute are stated, if a key in Hz is
/// meant; which commands take a file that names a machine.
pub(crate) fn key_hint(key: &str, meant: Option<&str>) -> &'static str {
    match (key, meant) {
        (_, Some(meant)) if key.ends_with("rpm") && meant.ends_with("_hz") => {
            ": revolutions per minute over 60"
        }
        ("machine", _) => {
            ": a file that names its machine is a task (softstop optimize --config FILE) or a study (softstop study FILE)"
        }
        _ => "",
    }
}

/// The end of an error message on a misspelt name, of a machine or elsewhere: which `key` may be meant; empty if none is.
pub fn did_you_mean(key: Option<&str>) -> String {
    key.map_or_else(String::new, |key| format!(" (did you mean {key}?)"))
}
