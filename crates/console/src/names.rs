//! Names that users give: of files that any system takes, and texts without control characters.

use std::path::MAIN_SEPARATOR;

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

/// Characters of a word that an error shows whole, and of a longer one.
const MAX_WORD: usize = 120;
const SHOWN: usize = 60;

/// A text whose overlong words, but paths, are cut, with the number of their characters.
pub fn shortened(text: &str) -> String {
    let shorten = |part: &str| {
        let word = part.trim_end_matches(|c: char| !c.is_alphanumeric());
        let count = word.chars().count();
        if count <= MAX_WORD || word.contains(MAIN_SEPARATOR) {
            return part.to_owned();
        }
        let shown: String = word.chars().take(SHOWN).collect();
        format!("{shown}... ({count} characters){}", &part[word.len()..])
    };
    text.split_inclusive(char::is_whitespace)
        .map(shorten)
        .collect()
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
    fn long_words_are_cut() {
        let long = "x".repeat(300);
        let (cut, path) = ("x".repeat(60), format!("{MAIN_SEPARATOR}{long}"));
        let told = shortened(&format!(
            "error: eta = '{long}': must be a number\n\n{path}"
        ));
        let right = format!(
            "error: eta = '{}... (301 characters)': must be a number\n\n{path}",
            &cut[1..]
        );
        assert_eq!(told, right);
    }

    #[test]
    fn control_characters_are_written_out() {
        assert_eq!(
            escaped("a\u{1b}[31m\tb\n\u{9b}\u{7f}"),
            "a\\u{1b}[31m\tb\n\\u{9b}\\u{7f}"
        );
    }
}
