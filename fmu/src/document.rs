//! The documentation page inside the package, written from the table of variables.

use std::io;

use quick_xml::Writer;
use quick_xml::events::BytesText;

use crate::model_description::start_value;
use crate::start::StartValues;
use crate::variables::{Kind, VARIABLES, Variable};

type Html = Writer<Vec<u8>>;

const INTRODUCTION: &[&str] = &[
    "A mass on a spring, driven by a harmonic force, meets a strip of material at the clearance and \
     a stop behind it. The unit solves the motion exactly, event by event: impact times and states \
     do not depend on the communication step.",
    "F is the force of strip and stop on the mass, positive in compression. Below the clearance r \
     it is zero. Up to r + s (phase I) it is the forming force k2 (x - r) with the dry friction \
     k3 (x - r) sign x'; up to r + s + v (phase II) the dry friction of the cut strip; beyond, that \
     of the stop. With contact the damping b takes the place of b1; F includes the difference.",
    "If the thickness s and the travel v are both zero, there is no strip and the stop stands at \
     the clearance.",
    "With the deflection d = x - r - s - v the stop presses with k4 d (kelvinVoigt), with the \
     stop.preload + k4 d (preloaded), with k4 d^n max(0, 1 + c x') (hertz; n is stop.exponent, c \
     stop.dissipation, k4 in N/m^n), or along a chain of slopes (piecewiseLinear): each holds from \
     its deflection on, on the way back those of stop.unloading, if there are any. A rigid stop \
     returns the mass with -stop.restitution times its velocity. Another one stands the distance \
     rigid.travel behind each of the yielding stops, unless rigid.present is false.",
    "While the phase is chatter, position and velocity follow the bounces, while acceleration and \
     contact.force are means over them.",
    "Model: F. Peterka, Behaviour of impact oscillator with soft and preloaded stop, Chaos, \
     Solitons and Fractals 18 (2003) 79-88.",
];

const STYLE: &str = "body{font-family:sans-serif;max-width:60em;margin:2em auto;padding:0 1em}\
    table{border-collapse:collapse}td,th{border:1px solid #aaa;padding:.3em .5em;text-align:left;\
    vertical-align:top}.equation{font-style:italic;text-align:center}";

const EQUATION: &str = "m x'' + b1 x' + k1 x + F = F0 cos(w t + phi) + force";

/// The page with the equation and the table of variables.
///
/// # Errors
/// If writing to memory fails.
pub(crate) fn html(start: &StartValues) -> io::Result<String> {
    let mut html = Writer::new_with_indent(b"<!DOCTYPE html>\n".to_vec(), b' ', 1);
    html.create_element("html")
        .with_attribute(("lang", "en"))
        .write_inner_content(|html| {
            html.create_element("head").write_inner_content(|html| {
                html.create_element("meta")
                    .with_attribute(("charset", "utf-8"))
                    .write_empty()?;
                text(html, "title", "softstop")?;
                text(html, "style", STYLE)
            })?;
            html.create_element("body")
                .write_inner_content(|html| body(html, start))?;
            Ok(())
        })?;
    let mut bytes = html.into_inner();
    bytes.push(b'\n');
    String::from_utf8(bytes).map_err(io::Error::other)
}

fn body(html: &mut Html, start: &StartValues) -> io::Result<()> {
    text(html, "h1", concat!("softstop ", env!("CARGO_PKG_VERSION")))?;
    html.create_element("p")
        .with_attribute(("class", "equation"))
        .write_text_content(BytesText::new(EQUATION))?;
    INTRODUCTION
        .iter()
        .try_for_each(|paragraph| text(html, "p", paragraph))?;
    text(html, "h2", "Variables")?;
    html.create_element("table").write_inner_content(|html| {
        let head = [
            "Name",
            "Reference",
            "Causality",
            "Variability",
            "Unit",
            "Start",
            "Meaning",
        ];
        cells(html, "th", &head)?;
        VARIABLES
            .iter()
            .try_for_each(|variable| row(html, variable, start))
    })?;
    Ok(())
}

fn row(html: &mut Html, variable: &Variable, start: &StartValues) -> io::Result<()> {
    let (unit, items) = match &variable.kind {
        Kind::Real(kind) => (kind.quantity.map_or("", |q| q.unit), String::new()),
        Kind::Enumeration(items) => {
            let items: Vec<_> = items
                .items
                .iter()
                .map(|item| format!("{} = {} ({})", item.value, item.name, item.description))
                .collect();
            ("", format!(": {}", items.join("; ")))
        }
        Kind::Count { .. } | Kind::Boolean => ("", String::new()),
    };
    cells(
        html,
        "td",
        &[
            variable.name,
            &variable.reference.to_string(),
            variable.causality(),
            variable.variability(),
            unit,
            &start_value(variable, start).unwrap_or_default(),
            &format!("{}{items}", variable.description),
        ],
    )
}

fn cells(html: &mut Html, name: &'static str, texts: &[&str]) -> io::Result<()> {
    html.create_element("tr")
        .write_inner_content(|html| texts.iter().try_for_each(|cell| text(html, name, cell)))?;
    Ok(())
}

fn text(html: &mut Html, name: &'static str, content: &str) -> io::Result<()> {
    html.create_element(name)
        .write_text_content(BytesText::new(content))?;
    Ok(())
}
