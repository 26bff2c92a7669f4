//! The report of a design as one page that stands alone, light or dark, on screen or paper.

mod branches;
pub mod figure;
pub mod figures;
mod words;

pub use words::{capital, quantity};

use std::collections::BTreeMap;

use minijinja::value::{Serde, Value};
use minijinja::{Environment, Error, UndefinedBehavior, context};
use serde::Serialize;
use softstop::{Dimension, Machine};

use softstop_console::number::NumberStyle::Percent;
use softstop_draw::style;

use crate::report::OptimizeReport;
use figure::{Figure, Section};

/// A margin that is less, in units of the value, is rounding.
const ROUNDING: f64 = 1e-9;

/// The sections of the page that have pictures.
const SECTIONS: [(Section, &str, &str); 4] = [
    (Section::Place, "place", "Where the design stands"),
    (
        Section::Motion,
        "motion",
        "The machine, how it moves, and how it is reached",
    ),
    (Section::Cost, "fronts", "What it costs"),
    (Section::Tolerances, "tolerances", "What the tolerances do"),
];

/// The page of a report: an HTML document, well-formed as XML, without scripts and without anything from elsewhere.
///
/// # Errors
/// If the page's template does not fit the data.
pub fn html(report: &OptimizeReport) -> Result<String, Error> {
    let mut environment = Environment::new();
    environment.set_undefined_behavior(UndefinedBehavior::SemiStrict);
    environment.add_filter("symbols", |text: &str| {
        Value::from_safe_string(words::html(text))
    });
    environment.add_filter("number", |value: Option<f64>| {
        value.map_or("–".to_owned(), words::number)
    });
    environment.add_filter("quantity", quantity);
    environment.add_filter("capital", capital);
    environment.add_filter("numbers", words::with_numbers);
    environment.add_filter("count", words::count);
    environment.add_filter("beside", |small: Option<f64>, size: Option<f64>| {
        let (small, size) = (small.unwrap_or(f64::NAN), size.unwrap_or(f64::NAN));
        let is_rounding = small.abs() < ROUNDING * size.abs();
        words::number(if is_rounding { 0.0 } else { small })
    });
    environment.add_filter("percent", |share: Option<f64>| {
        let share = share.filter(|share| share.is_finite());
        share.map_or("–".to_owned(), |share| Percent(1).format(share))
    });
    environment.add_template("report.html", include_str!("../../assets/report.html"))?;
    let template = environment.get_template("report.html")?;
    template.render(context! {
        version => env!("CARGO_PKG_VERSION"),
        style => style::PAGE.to_owned() + include_str!("../../assets/report.css"),
        sections => Serde(sections(report.pictures())),
        report => Serde(report),
        header => Serde(&report.title),
        name => report.machine.name.as_deref().unwrap_or("machine"),
        sources => Serde(&report.sources),
        units => units(&report.machine),
    })
}

/// A picture as the template takes it.
#[derive(Serialize)]
struct Picture {
    title: String,
    svg: String,
    narrow: Option<String>,
    caption: String,
    is_wide: bool,
}

/// The pictures of each section that has some, under its name in addresses and its heading.
fn sections<'a>(
    figures: impl Iterator<Item = &'a Figure> + Clone,
) -> Vec<(&'static str, &'static str, Vec<Picture>)> {
    let picture = |it: &Figure| Picture {
        title: it.chart.title.clone(),
        svg: it.chart.inline(words::plain),
        narrow: it.narrow().map(|chart| chart.inline(words::plain)),
        caption: it.caption.clone(),
        is_wide: it.is_wide(),
    };
    let pictures = |section| {
        let figures = figures.clone().filter(|it| it.section == section);
        figures.map(picture).collect::<Vec<_>>()
    };
    let all = SECTIONS.map(|(section, id, title)| (id, title, pictures(section)));
    all.into_iter().filter(|it| !it.2.is_empty()).collect()
}

/// The signs of the units of a machine; empty for ratios.
fn units(machine: &Machine) -> BTreeMap<&'static str, &'static str> {
    let all = [
        ("velocity", Dimension::Velocity),
        ("frequency", Dimension::Frequency),
        ("force", Dimension::Force),
        ("length", Dimension::Length),
    ];
    all.into_iter()
        .map(|(name, dimension)| (name, machine.unit(dimension)))
        .collect()
}
