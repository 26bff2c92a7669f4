//! Pages that show commands and what a program says: run again, they are as they stand.

use std::path::Path;

use snapbox::{Assert, Data};

use crate::program::Program;
use crate::words;

impl Program {
    /// Runs the commands of a page's console blocks in the folder of the page's name with `.in`, or in the page's own:
    /// the page is as it stands, where `[..]` stands for any words. After a command that fails its exit code is shown, and
    /// what it says; it writes nothing to stdout. `SNAPSHOTS=overwrite` takes over what the program says now.
    ///
    /// # Panics
    /// If the page is another.
    pub fn says_what_a_page_shows(&self, page: &Path) {
        let name = page.file_stem().and_then(|it| it.to_str()).expect("a page");
        let own = page.with_extension("in");
        let folder = if own.is_dir() {
            own.as_path()
        } else {
            page.parent().expect("a folder")
        };
        let text = std::fs::read_to_string(page).expect("a page");
        let prompt = format!("$ {} ", self.name());
        let (mut shown, mut lines) = (String::new(), text.lines());
        while let Some(line) = lines.next() {
            shown += &format!("{line}\n");
            if let Some(command) = line.strip_prefix(&prompt) {
                shown += &self.answer(command, folder);
                let end = lines.find(|line| line.starts_with("```"));
                shown += end.map_or("", |_| "```\n");
            }
        }
        let assert = Assert::new().action_env("SNAPSHOTS");
        let stands = Data::read_from(page, None);
        assert
            .try_eq(Some(&name), shown.into(), stands)
            .unwrap_or_else(|error| panic!("{error}"));
    }

    /// Its name: that of its file.
    fn name(&self) -> &'static str {
        let name = Path::new(self.file).file_stem();
        name.and_then(|it| it.to_str()).expect("a program")
    }

    /// What a command says, after its exit code if it fails.
    fn answer(&self, command: &str, folder: &Path) -> String {
        let run = self.command(&words(command)).current_dir(folder).output();
        let run = run.expect("the program starts");
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("UTF-8");
        if run.status.success() {
            return text(&run.stdout);
        }
        assert!(
            run.stdout.is_empty(),
            "{command}: it fails and writes to stdout"
        );
        let code = run.status.code().expect("an exit code");
        format!("? {code}\n{}", text(&run.stderr))
    }
}
