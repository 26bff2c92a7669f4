//! Names that users give: of files that any system takes, and texts without control characters.

use crate::failure::Failure;

/// Names that Windows keeps for devices, whatever follows behind a dot.
const DEVICES: [&str; 6] = ["con", "prn", "aux", "nul", "conin$", "conout$"];
/// Devices whose names end with a digit.
const NUMBERED: [&str; 2] = ["com", "lpt"];
/// Characters that Windows allows in no name of a file.
const RESERVED: &str = r#"<>:"/\|?*"#;

/// Refuses a name of a file that begins like an option, or that Windows does not take.
///
/// # Errors
/// [`Failure::Usage`] with the name and what is wrong with it.
pub fn check_file(name: &str) -> Result<(), Failure> {
    let why = if name.starts_with('-') {
        "it begins like an option"
    } else if is_device(name) {
        "Windows keeps it for a device"
    } else if name.ends_with(['.', ' ']) {
        "Windows allows no dot and no blank at its end"
    } else if name.contains(char::is_control) {
        "it has control characters"
    } else if name.contains(|c| RESERVED.contains(c)) {
        r#"it has one of < > : " / \ | ? *"#
    } else {
        return Ok(());
    };
    let name = escaped(name);
    Err(Failure::usage(format!(
        "{name}: cannot be the name of a file: {why}"
    )))
}

fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default();
    let stem = stem.trim_end().to_lowercase();
    let is_digit = |rest: &str| matches!(rest, "¹" | "²" | "³") || rest.parse::<u8>().is_ok();
    let mut numbered = NUMBERED.iter().filter_map(|it| stem.strip_prefix(it));
    DEVICES.contains(&stem.as_str())
        || numbered.any(|rest| rest.chars().count() == 1 && is_digit(rest))
}

/// The name of a file after a machine's: what no name of a file may have becomes `_`.
pub fn file_stem(name: &str) -> String {
    let plain = |c: char| !c.is_control() && !RESERVED.contains(c);
    let kept = name.chars().map(|c| if plain(c) { c } else { '_' });
    kept.collect()
}

/// A text for a terminal: control characters but line feed and tab are written as `\u{1b}`.
pub fn escaped(text: &str) -> String {
    let mut all = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\n' | '\t' => all.push(c),
            c if c.is_control() => all.extend(c.escape_unicode()),
            c => all.push(c),
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files() {
        for name in [
            "CON.fmu",
            "con",
            "Prn.html",
            "nul.tar.gz",
            "COM1.fmu",
            "lpt9",
            "com².fmu",
            "-rf.fmu",
            "a.",
            "a ",
            "a\u{1b}b",
            "a:b.fmu",
            "a?.fmu",
            "CONIN$.fmu",
            "aux .fmu",
        ] {
            assert!(check_file(name).is_err(), "{name:?}");
        }
        for name in [
            "press.fmu",
            "console.fmu",
            "com.fmu",
            "com10.fmu",
            "lpt.fmu",
            "a-rf.fmu",
            "Prüfstand.fmu",
            ".x",
        ] {
            assert!(check_file(name).is_ok(), "{name:?}");
        }
        assert_eq!(file_stem("a/b:\u{7}c"), "a_b__c");
    }

    #[test]
    fn control_characters_are_written_out() {
        assert_eq!(
            escaped("a\u{1b}[31m\tb\n\u{9b}\u{7f}"),
            "a\\u{1b}[31m\tb\n\\u{9b}\\u{7f}"
        );
    }
}
