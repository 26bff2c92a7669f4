//! The guide hangs together: no link leads nowhere, no page is left out, no table and no picture is empty.

use std::fs;
use std::path::Path;

use softstop_testing::pages::{Page, all, top};

fn judge(what: &str, faults: Vec<String>) {
    assert!(faults.is_empty(), "{what}:\n{}", faults.join("\n"));
}

fn find<'a>(pages: &'a [Page], place: &Path) -> Option<&'a Page> {
    pages.iter().find(|it| it.place == place)
}

#[test]
fn every_link_leads_somewhere() {
    let pages = all();
    let mut faults = Vec::new();
    for page in &pages {
        for link in page.links() {
            let Some((place, anchor)) = link.file(page) else {
                continue;
            };
            let is_there = top().join(&place).exists();
            let is_named = anchor.is_none_or(|name| {
                find(&pages, &place).is_some_and(|it| it.anchors().contains(&name))
            });
            if !is_there || !is_named {
                faults.push(format!("{}: {}", page.place.display(), link.target));
            }
        }
    }
    judge("broken links", faults);
}

#[test]
fn every_page_is_in_the_summary() {
    let pages = all();
    let summary = find(&pages, Path::new("docs/SUMMARY.md")).expect("the summary");
    let listed: Vec<_> = summary
        .links()
        .iter()
        .filter_map(|it| it.file(summary))
        .collect();
    let left_out = pages.iter().filter(|page| {
        page.place.starts_with("docs")
            && page.place != summary.place
            && !listed.iter().any(|(place, _)| *place == page.place)
    });
    judge(
        "not in docs/SUMMARY.md",
        left_out.map(|it| it.place.display().to_string()).collect(),
    );
}

/// Pages are written by hand around tables that programs print: one that has lost its rows would go unnoticed.
#[test]
fn no_table_is_empty() {
    let pages = all();
    let empty = pages.iter().filter(|it| it.tables().contains(&0));
    judge(
        "an empty table",
        empty.map(|it| it.place.display().to_string()).collect(),
    );
}

#[test]
fn every_picture_shows_something_and_says_what() {
    let mut faults = Vec::new();
    for page in all() {
        for link in page.links().into_iter().filter(|it| it.is_picture) {
            let file = link.file(&page).map(|(place, _)| top().join(place));
            let length = file
                .and_then(|it| fs::metadata(it).ok())
                .map_or(0, |it| it.len());
            if length < 1000 || link.words.len() < 10 {
                faults.push(format!("{}: {}", page.place.display(), link.target));
            }
        }
    }
    judge(
        "pictures that are empty or without words in their place",
        faults,
    );
}
