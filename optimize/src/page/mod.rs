//! The report of a design: plain data ([`data`]) made into one page that stands alone, light or dark, on screen or paper.

pub mod computed;
pub mod data;
mod figure;
mod pictures;
mod tables;
mod words;

pub use tables::csv;
pub use words::{count, quantity};

use minijinja::value::{Serde, Value};
use minijinja::{Environment, Error, UndefinedBehavior, context};
use serde::Serialize;

use softstop_console::number::NumberStyle::Percent;
use softstop_draw::style;

use data::Report;
use figure::{Figure, HALF, WIDE};
use pictures::{basin, effects, erosion, front, histogram, map, portrait, response};

/// A margin that is less, in units of the value, is rounding.
const ROUNDING: f64 = 1e-9;

/// Pictures under a heading.
#[derive(Serialize)]
struct Section {
    id: &'static str,
    title: &'static str,
    figures: Vec<Figure>,
}

/// The page of a report: an HTML document, well-formed as XML, without scripts and without anything from elsewhere.
///
/// # Errors
/// If the page's template does not fit the data.
pub fn html(report: &Report) -> Result<String, Error> {
    let mut environment = Environment::new();
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    environment.add_filter("symbols", |text: &str| {
        Value::from_safe_string(words::html(text))
    });
    environment.add_filter("number", |value: Option<f64>| {
        value.map_or("–".to_owned(), words::number)
    });
    environment.add_filter("numbers", words::with_numbers);
    environment.add_filter("count", count);
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
    let page = template.render(context! {
        version => env!("CARGO_PKG_VERSION"),
        style => style::PAGE.to_owned() + include_str!("../../assets/report.css"),
        sections => Serde(sections(report)),
        report => Serde(report),
    })?;
    Ok(page)
}

/// The sections that have a picture.
fn sections(report: &Report) -> Vec<Section> {
    let of_map = |it| map::figure(it, if report.maps.len() == 1 { WIDE } else { HALF });
    let effects = Some(&report.sensitivities[..]).filter(|all| !all.is_empty());
    let all = [
        Section {
            id: "place",
            title: "Where the design stands",
            figures: report
                .maps
                .iter()
                .map(of_map)
                .chain(report.response.iter().map(response::figure))
                .collect(),
        },
        Section {
            id: "motion",
            title: "How it moves, and how it is reached",
            figures: report
                .portrait
                .iter()
                .map(portrait::figure)
                .chain(report.basin.iter().map(basin::figure))
                .chain(report.erosion.iter().map(erosion::figure))
                .collect(),
        },
        Section {
            id: "fronts",
            title: "What it costs",
            figures: report.fronts.iter().map(front::figure).collect(),
        },
        Section {
            id: "tolerances",
            title: "What the tolerances do",
            figures: report
                .histogram
                .iter()
                .map(histogram::figure)
                .chain(effects.map(effects::figure))
                .collect(),
        },
    ];
    all.into_iter()
        .filter(|section| !section.figures.is_empty())
        .collect()
}
