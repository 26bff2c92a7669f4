//! The pages of the guide: their links, headings, tables and the commands that they show.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag, TagEnd};

use crate::program::files;

/// A page in Markdown.
#[derive(Clone, Debug)]
pub struct Page {
    /// Its place from the top folder.
    pub place: PathBuf,
    /// What it says.
    pub text: String,
}

/// A link or a picture of a page.
#[derive(Clone, Debug)]
pub struct Link {
    /// Where it leads, as written.
    pub target: String,
    /// What it shows: its words, or those in place of the picture.
    pub words: String,
    /// Whether it is a picture.
    pub is_picture: bool,
}

/// The top folder of the workspace.
pub fn top() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// All pages: those of `docs`, and those at the top.
///
/// # Panics
/// If one cannot be read.
pub fn all() -> Vec<Page> {
    let at_top = fs::read_dir(top()).expect("the top folder");
    let at_top = at_top.map(|entry| entry.expect("an entry").path());
    let all = at_top.chain(files(&top().join("docs")));
    let is_page = |path: &PathBuf| path.extension().is_some_and(|it| it == "md");
    let place = |path: PathBuf| path.strip_prefix(top()).expect("below the top").to_owned();
    let mut places: Vec<PathBuf> = all.filter(is_page).map(place).collect();
    places.sort();
    places.into_iter().map(Page::read).collect()
}

impl Page {
    fn read(place: PathBuf) -> Page {
        let text = fs::read_to_string(top().join(&place)).expect("a page in UTF-8");
        Page { place, text }
    }

    fn events(&self) -> impl Iterator<Item = Event<'_>> {
        Parser::new_ext(&self.text, Options::ENABLE_TABLES)
    }

    /// Its links and pictures.
    pub fn links(&self) -> Vec<Link> {
        let mut links = Vec::new();
        let mut open: Vec<Link> = Vec::new();
        for event in self.events() {
            match event {
                Event::Start(Tag::Link { dest_url, .. }) => open.push(Link::to(&dest_url, false)),
                Event::Start(Tag::Image { dest_url, .. }) => open.push(Link::to(&dest_url, true)),
                Event::End(TagEnd::Link | TagEnd::Image) => links.extend(open.pop()),
                Event::Text(words) | Event::Code(words) => {
                    open.iter_mut().for_each(|it| it.words.push_str(&words));
                }
                _ => {}
            }
        }
        links
    }

    /// The names by which its headings can be linked to, as GitHub and mdBook make them.
    pub fn anchors(&self) -> Vec<String> {
        let mut seen = HashMap::new();
        let mut heading: Option<String> = None;
        let mut anchors = Vec::new();
        for event in self.events() {
            match event {
                Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
                Event::Text(words) | Event::Code(words) => {
                    heading.iter_mut().for_each(|it| it.push_str(&words));
                }
                Event::End(TagEnd::Heading(_)) => {
                    let name = anchor(&heading.take().unwrap_or_default());
                    let count: &mut u32 = seen.entry(name.clone()).or_default();
                    anchors.push(match *count {
                        0 => name,
                        again => format!("{name}-{again}"),
                    });
                    *count += 1;
                }
                _ => {}
            }
        }
        anchors
    }

    /// How many rows each of its tables has below the head.
    pub fn tables(&self) -> Vec<usize> {
        let mut tables = Vec::new();
        for event in self.events() {
            match event {
                Event::Start(Tag::Table(_)) => tables.push(0),
                Event::Start(Tag::TableRow) => {
                    tables.iter_mut().rev().take(1).for_each(|it| *it += 1)
                }
                _ => {}
            }
        }
        tables
    }

    /// Its blocks of code, each with the name of its language (none where the block is indented).
    pub fn blocks(&self) -> Vec<(String, String)> {
        let mut blocks = Vec::new();
        let mut block: Option<(String, String)> = None;
        for event in self.events() {
            match event {
                Event::Start(Tag::CodeBlock(kind)) => {
                    let language = match kind {
                        CodeBlockKind::Fenced(language) => language.to_string(),
                        CodeBlockKind::Indented => String::new(),
                    };
                    block = Some((language, String::new()));
                }
                Event::Text(words) => block.iter_mut().for_each(|it| it.1.push_str(&words)),
                Event::End(TagEnd::CodeBlock) => blocks.extend(block.take()),
                _ => {}
            }
        }
        blocks
    }

    /// The arguments of each call of a program that the page shows, in its blocks of commands and within its sentences,
    /// where a command alone is but named. The changelog tells of calls that were.
    pub fn calls(&self, program: &str) -> Vec<Vec<String>> {
        if self.place.as_os_str() == "CHANGELOG.md" {
            return Vec::new();
        }
        let blocks = self.blocks().into_iter();
        let commands = blocks.filter(|(language, _)| language.is_empty());
        let commands = commands.map(|(_, block)| block.replace("\\\n", " "));
        let lines: Vec<String> = commands
            .flat_map(|it| it.lines().map(str::to_owned).collect::<Vec<_>>())
            .collect();
        let mut calls: Vec<_> = lines.iter().filter_map(|it| call(program, it)).collect();
        let sentences = self.events().filter_map(|event| match event {
            Event::Code(words) => call(program, &words),
            _ => None,
        });
        calls.extend(sentences.filter(|it| it.len() > 1));
        calls
    }
}

impl Link {
    fn to(target: &str, is_picture: bool) -> Link {
        Link {
            target: target.to_owned(),
            words: String::new(),
            is_picture,
        }
    }

    /// The file that it leads to, from the top folder, and the place in it; none if it leads out of the project.
    pub fn file(&self, page: &Page) -> Option<(PathBuf, Option<String>)> {
        if self.target.contains("://") || self.target.starts_with("mailto:") {
            return None;
        }
        let (file, anchor) = match self.target.split_once('#') {
            Some((file, anchor)) => (file, Some(anchor.to_owned())),
            None => (self.target.as_str(), None),
        };
        let mut place = page.place.clone();
        if !file.is_empty() {
            place.pop();
            for part in file.split('/') {
                match part {
                    ".." => drop(place.pop()),
                    "." => {}
                    part => place.push(part),
                }
            }
        }
        Some((place, anchor))
    }
}

fn anchor(heading: &str) -> String {
    let lower = heading.to_lowercase();
    let kept = lower
        .chars()
        .filter(|it| it.is_alphanumeric() || " -_".contains(*it));
    kept.map(|it| if it == ' ' { '-' } else { it }).collect()
}

/// The arguments of a line that calls a program as a user does: without its remark, and without quotes.
fn call(program: &str, line: &str) -> Option<Vec<String>> {
    let line = line.split("  #").next()?.trim();
    let line = line.split(" > ").next()?;
    let rest = line.strip_prefix(program)?.strip_prefix(' ')?;
    let is_whole = !rest.contains("...") && !rest.contains('…') && !rest.contains('|');
    let words = rest
        .split_whitespace()
        .map(|it| it.replace(['\'', '"'], ""));
    is_whole.then(|| words.collect())
}
