//! Which methods the user wants, by parts of their names.

use softstop_console::failure::Failure;

/// Whether the user wants the method of a name: one that contains one of some words, whatever the case; any if there is
/// no word. Each word must be part of one of the names.
///
/// # Errors
/// [`Failure::Usage`] naming the word that is not, and the names.
pub fn filter(
    words: &[String],
    names: &[String],
) -> Result<impl Fn(&str) -> bool + use<>, Failure> {
    let words: Vec<String> = words.iter().map(|word| word.to_lowercase()).collect();
    let is_part = |word: &&String| names.iter().any(|name| is_in(word, name));
    if let Some(word) = words.iter().find(|word| !is_part(word)) {
        return Err(Failure::usage(format!(
            "method = {word}: must be part of one of: {}",
            names.join("; ")
        )));
    }
    Ok(move |name: &str| words.is_empty() || words.iter().any(|word| is_in(word, name)))
}

/// Whether a word is part of a name; none at all is part of nothing.
fn is_in(word: &str, name: &str) -> bool {
    !word.is_empty() && name.to_lowercase().contains(word)
}

#[cfg(test)]
mod tests {
    fn filter(words: &[&str]) -> Result<impl Fn(&str) -> bool + use<>, String> {
        let owned = |words: &[&str]| {
            words
                .iter()
                .map(|word| (*word).to_owned())
                .collect::<Vec<_>>()
        };
        let names = owned(&["RK4, events located", "RK4, events ignored", "Newmark"]);
        super::filter(&owned(words), &names).map_err(|failure| failure.to_string())
    }

    #[test]
    fn a_word_picks_all_names_that_it_is_part_of() -> Result<(), String> {
        let one = filter(&["rk4, EVENTS located"])?;
        assert!(one("RK4, events located") && !one("RK4, events ignored"));
        let both = filter(&["rk4"])?;
        assert!(both("RK4, events ignored") && !both("Newmark"));
        assert!(filter(&[])?("Newmark"));
        Ok(())
    }

    #[test]
    fn a_word_that_picks_nothing_is_refused() {
        for word in ["rk5", ""] {
            let error = filter(&["Newmark", word]).err().expect("refused");
            assert!(
                error.contains(&format!("method = {word}: must be part of")),
                "{error}"
            );
        }
    }
}
