//! The published results of `docs/gallery`: each command of the page runs, and each number of its tables is what the command
//! reports, and what the source has unless a remark stands beside it.

use serde_json::Value;
use softstop_testing::Report;
use softstop_testing::pages::{self, Page};

use crate::SOFTSTOP;

/// A heading of the page, and the numbers of its table in the report of its command.
type Entry = (&'static str, fn(&Report) -> Vec<f64>);

const ENTRIES: [Entry; 11] = [
    ("An orbit and its grazing", |it| {
        let last = |name| *column(it, 0, name).last().expect("a point");
        let after_impact = -0.8 * last("before_impact_velocity");
        let grazing = special(it, 0, "G", 0);
        vec![last("position"), last("velocity"), after_impact, grazing]
    }),
    ("A flip beside grazing", |it| {
        let flip = special(it, 0, "PD", 0);
        vec![special(it, 0, "G", 0), flip, velocity(it, "PD")]
    }),
    ("A fold and resonant grazing", |it| {
        let mut numbers = vec![special(it, 0, "SN", 0), velocity(it, "SN")];
        numbers
            .extend([0, 1].map(|at| it.number(&format!("curves/curves/0/specials/0/values/{at}"))));
        numbers
    }),
    ("The life of z = 1", |it| {
        let kinds = [("G", 0), ("PD", 0), ("G", 1), ("SN", 0)];
        kinds.map(|(kind, at)| special(it, 0, kind, at)).to_vec()
    }),
    ("An isolated motion", |it| {
        ["G", "PD"].map(|kind| special(it, 0, kind, 0)).to_vec()
    }),
    ("An ellipse of orbits", |it| {
        let clearances = column(it, 0, "value");
        let stable = velocity_at(it, 0.2);
        let orbits = |clearance: f64| {
            let sides = clearances
                .windows(2)
                .map(|it| [it[0] >= clearance, it[1] >= clearance]);
            sides.filter(|it| it[0] != it[1]).count() as f64
        };
        vec![
            special(it, 0, "SN", 0),
            velocity(it, "SN"),
            stable,
            orbits(0.2),
            orbits(0.0),
        ]
    }),
    ("Chatter", |it| {
        ["begin", "end"]
            .map(|side| it.number(&format!("rests/0/{side}")))
            .to_vec()
    }),
    ("A cascade", |it| {
        let branches = it.list("branches").len();
        let [first, second, third] = [3, 2, 1].map(|back| special(it, branches - back, "PD", 0));
        vec![(second - first) / (third - second)]
    }),
    ("The Aberdeen rig", |it| vec![special(it, 0, "G", 0)]),
    ("Between two stops", |it| {
        vec![
            velocity_at(it, 5.0),
            special(it, 0, "SN", 0),
            velocity(it, "SN"),
        ]
    }),
    ("A rattle", |it| {
        vec![
            velocity_at(it, 3.0),
            special(it, 0, "SN", 0),
            velocity(it, "SN"),
        ]
    }),
];

/// A column of the table of a branch.
fn column(report: &Report, branch: usize, name: &str) -> Vec<f64> {
    let column = report
        .list(&format!("branches/{branch}/table/{name}"))
        .iter();
    column.map(|it| it.as_f64().expect("a number")).collect()
}

/// The special points of a kind on a branch.
fn specials<'a>(report: &'a Report, branch: usize, kind: &str) -> Vec<&'a Value> {
    let all = report.list(&format!("branches/{branch}/specials")).iter();
    all.filter(|it| it["symbol"] == kind).collect()
}

/// Where the special point of a kind and a number stands on a branch.
fn special(report: &Report, branch: usize, kind: &str, number: usize) -> f64 {
    softstop_testing::number(specials(report, branch, kind)[number], "value")
}

/// The before-impact velocity of the first special point of a kind on the first branch.
fn velocity(report: &Report, kind: &str) -> f64 {
    softstop_testing::number(specials(report, 0, kind)[0], "before_impact_velocities/0")
}

/// The before-impact velocity of the first branch at the value from which it was followed.
fn velocity_at(report: &Report, start: f64) -> f64 {
    let values = column(report, 0, "value");
    let start = values
        .iter()
        .position(|it| *it == start)
        .expect("the start");
    column(report, 0, "before_impact_velocity")[start]
}

/// True if a number is the one that is printed, rounded to its digits.
fn is_printed(number: f64, printed: &str) -> bool {
    let digits = printed
        .split_once('.')
        .map_or(0, |(_, digits)| digits.len());
    format!("{number:.digits$}") == printed
}

/// The cells of the table of numbers in a section, without its head.
fn rows(section: &str) -> Vec<Vec<&str>> {
    let lines = section.lines().filter(|it| it.starts_with('|')).skip(2);
    let cells = lines.map(|it| it.trim_matches('|').split('|').map(str::trim).collect());
    cells.collect()
}

#[test]
fn the_gallery_has_the_numbers_of_its_sources() {
    let page = pages::all().into_iter();
    let mut page = page.filter(|it| it.place.ends_with("docs/gallery/README.md"));
    let page = page.next().expect("the gallery");
    let sections: Vec<&str> = page.text.split("\n## ").skip(1).collect();
    assert_eq!(sections.len(), ENTRIES.len());
    let mut agreeing = 0;
    for (section, (heading, numbers)) in sections.iter().zip(ENTRIES) {
        assert!(section.starts_with(heading), "{heading}");
        let section_page = Page {
            place: page.place.clone(),
            text: (*section).to_owned(),
        };
        let mut reports = Vec::new();
        for call in section_page.calls("softstop") {
            reports.push(SOFTSTOP.report(&call.join(" ").replace("docs/", "../docs/")));
        }
        let rows = rows(section);
        let numbers = numbers(&reports[0]);
        assert_eq!(rows.len(), numbers.len(), "{heading}");
        for (row, number) in rows.iter().zip(numbers) {
            assert!(
                is_printed(number, row[2]),
                "{heading}, {}: {number}",
                row[0]
            );
            let is_sources = is_printed(number, row[1]);
            assert_eq!(is_sources, row[3].is_empty(), "{heading}, {}", row[0]);
        }
        agreeing += usize::from(rows.iter().any(|row| row[3].is_empty()));
        let pictures = section_page
            .links()
            .into_iter()
            .filter(|it| it.is_picture)
            .count();
        assert_eq!(pictures, 1, "{heading}");
    }
    assert!(agreeing >= 9, "{agreeing} sections agree with their source");
}
