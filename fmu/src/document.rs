//! The documentation page inside the package: a page written by hand, with tables of variables and
//! capabilities that follow from the model description.

use std::io;

use quick_xml::events::{BytesText, Event};
use quick_xml::{Reader, Writer};

use crate::model_description::{self, start_value};
use crate::start::StartValues;
use crate::variables::{Kind, VARIABLES, Variable};

type Html = Writer<Vec<u8>>;

const PAGE: &str = include_str!("../assets/page.html");

/// What a flag of the model description says about this unit.
const CAPABILITIES: [(&str, &str); 9] = [
    (
        "canHandleVariableCommunicationStepSize",
        "Steps of any length, each as exact as the next; a step costs by the events in it",
    ),
    (
        "canInterpolateInputs",
        "Derivatives of the input force, of orders 1 to 7, make it a polynomial in time until it is set anew, without error",
    ),
    (
        "maxOutputDerivativeOrder",
        "Time derivatives of the continuous outputs up to this order",
    ),
    (
        "canGetAndSetFMUstate",
        "The whole state can be kept and taken up again, bit for bit",
    ),
    (
        "canSerializeFMUstate",
        "A kept state can be written as bytes and taken up by another instance",
    ),
    (
        "providesDirectionalDerivative",
        "Derivatives of the outputs over the last step by force, over the first one also by the initial state; in initialisation by every real parameter",
    ),
    (
        "canBeInstantiatedOnlyOncePerProcess",
        "How many instances: any number if false, also on several threads",
    ),
    (
        "canNotUseMemoryManagementFunctions",
        "The importer's functions for memory are not called and may be NULL",
    ),
    (
        "needsExecutionTool",
        "Whether another program must be there besides the library",
    ),
];

/// The page.
///
/// # Errors
/// If writing to memory fails.
pub(crate) fn html(start: &StartValues) -> io::Result<String> {
    let page = PAGE.replace("<!--version-->", env!("CARGO_PKG_VERSION"));
    let page = page.replace("<!--capabilities-->", &capabilities(start)?);
    Ok(page.replace("<!--variables-->", &variables(start)?))
}

/// The flags, with the values that the model description gives them.
fn capabilities(start: &StartValues) -> io::Result<String> {
    let flags = flags(&model_description::write(start, "")?)?;
    rows(|html| {
        CAPABILITIES.iter().try_for_each(|(name, meaning)| {
            let value = flags.iter().find(|(flag, _)| flag == name);
            // A flag that is not given is false by the standard.
            let value = value.map_or("false", |(_, value)| value);
            cells(html, "td", &[name, value, meaning])
        })
    })
}

/// Names and values of the attributes of the element `CoSimulation`.
fn flags(description: &str) -> io::Result<Vec<(String, String)>> {
    let mut reader = Reader::from_str(description);
    loop {
        match reader.read_event().map_err(io::Error::other)? {
            Event::Start(element) | Event::Empty(element)
                if element.name().as_ref() == "CoSimulation" =>
            {
                return element
                    .attributes()
                    .map(|attribute| {
                        let attribute = attribute.map_err(io::Error::other)?;
                        let name = attribute.key.as_ref().to_owned();
                        Ok((name, attribute.value.into_owned()))
                    })
                    .collect();
            }
            Event::Eof => return Err(io::Error::other("no element CoSimulation")),
            _ => {}
        }
    }
}

fn variables(start: &StartValues) -> io::Result<String> {
    rows(|html| {
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
    })
}

/// Rows of a table as text.
fn rows(write: impl FnOnce(&mut Html) -> io::Result<()>) -> io::Result<String> {
    let mut html = Writer::new_with_indent(Vec::new(), b' ', 1);
    write(&mut html)?;
    String::from_utf8(html.into_inner()).map_err(io::Error::other)
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
