//! Which methods the user wants, by parts of their names.

use softstop_console::failure::Failure;

/// The methods whose name contains one of some words, whatever the case; all of them if there is no word.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Filter(Vec<String>);

impl Filter {
    /// A filter by these words, each of which must be part of one of the names.
    ///
    /// # Errors
    /// [`Failure::Usage`] naming the word that is not, and the names.
    pub fn new(words: &[String], names: &[String]) -> Result<Self, Failure> {
        let filter = Self(words.iter().map(|word| word.to_lowercase()).collect());
        let is_part = |word: &String| names.iter().any(|name| is_in(word, name));
        match filter.0.iter().find(|word| !is_part(word)) {
            None => Ok(filter),
            Some(word) => Err(Failure::usage(format!(
                "method = {word}: must be part of one of: {}",
                names.join("; ")
            ))),
        }
    }

    /// Whether the method of this name is wanted.
    pub fn wants(&self, name: &str) -> bool {
        self.0.is_empty() || self.0.iter().any(|word| is_in(word, name))
    }
}

/// Whether a word is part of a name; none at all is part of nothing.
fn is_in(word: &str, name: &str) -> bool {
    !word.is_empty() && name.to_lowercase().contains(word)
}

#[cfg(test)]
mod tests {
    use super::Filter;

    fn filter(words: &[&str]) -> Result<Filter, String> {
        let owned = |words: &[&str]| {
            words
                .iter()
                .map(|word| (*word).to_owned())
                .collect::<Vec<_>>()
        };
        let names = owned(&["RK4, events located", "RK4, events ignored", "Newmark"]);
        Filter::new(&owned(words), &names).map_err(|failure| failure.to_string())
    }

    #[test]
    fn a_word_picks_all_names_that_it_is_part_of() -> Result<(), String> {
        let one = filter(&["rk4, EVENTS located"])?;
        assert!(one.wants("RK4, events located") && !one.wants("RK4, events ignored"));
        let both = filter(&["rk4"])?;
        assert!(both.wants("RK4, events ignored") && !both.wants("Newmark"));
        assert!(filter(&[])?.wants("Newmark"));
        Ok(())
    }

    #[test]
    fn a_word_that_picks_nothing_is_refused() {
        for word in ["rk5", ""] {
            let error = filter(&["Newmark", word]).expect_err("refused");
            assert!(
                error.contains(&format!("method = {word}: must be part of")),
                "{error}"
            );
        }
    }
}
