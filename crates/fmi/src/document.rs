//! The documentation page inside the package.
//!
//! A page written by hand, with tables of variables and capabilities that follow from the model description.

use std::io;

use quick_xml::Writer;
use quick_xml::escape::escape;
use quick_xml::events::BytesText;

use crate::description::{array_of, capabilities, rows_told, start_value};
use crate::imprint::Imprint;
use crate::standard::Standard;
use crate::unit::{Row, Unit};
use crate::variable::Kind;

type Html = Writer<Vec<u8>>;

/// What a flag of the model description says about this unit.
const CAPABILITIES: [(&str, &str); 12] = [
    (
        "canHandleVariableCommunicationStepSize",
        "Steps of any length, each as exact as the next; a step costs by the events in it",
    ),
    (
        "canInterpolateInputs",
        "Derivatives of a continuous input, of orders 1 to 7, make it a polynomial in time until it is set anew, without error",
    ),
    (
        "maxOutputDerivativeOrder",
        "Time derivatives of the continuous outputs up to this order",
    ),
    (
        "hasEventMode",
        "Whether events can be handled by the importer, each at its instant, with the state before it and after it",
    ),
    (
        "mightReturnEarlyFromDoStep",
        "A step ends at the first event in it, if the importer allows that",
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
        "Derivatives of the outputs over the last step by continuous inputs, over the first one also by the initial state; in initialisation by every real parameter",
    ),
    (
        "providesAdjointDerivatives",
        "The same derivatives, by each known of a weighted sum of outputs",
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
pub(crate) fn html<U: Unit>(imprint: &Imprint<U>) -> io::Result<String> {
    let about = U::about();
    let page = about.page.replace("<!--version-->", about.version);
    let page = page.replace("<!--capabilities-->", &flags::<U>(imprint.standard())?);
    let page = page.replace("<!--variables-->", &variables(imprint)?);
    Ok(page.replace("<!--name-->", &escape(imprint.name())))
}

/// The flags, with the values that the model description gives them.
fn flags<U: Unit>(standard: Standard) -> io::Result<String> {
    let flags = capabilities::<U>(standard);
    rows(|html| {
        CAPABILITIES.iter().try_for_each(|(name, meaning)| {
            // Some are written in another way in FMI 3.0.
            let is_meant = |flag: &str| {
                flag.trim_end_matches('s')
                    .eq_ignore_ascii_case(name.trim_end_matches('s'))
            };
            let Some((flag, value)) = flags.iter().find(|(flag, _)| is_meant(flag)) else {
                return Ok(());
            };
            cells(html, "td", &[flag, value, meaning])
        })
    })
}

fn variables<U: Unit>(imprint: &Imprint<U>) -> io::Result<String> {
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
        let mut variables = rows_told::<U>(imprint.has_exchange(), imprint.has_arrays());
        variables.try_for_each(|variable| row(html, variable, imprint))?;
        let mut clock = imprint.clock().into_iter();
        clock.try_for_each(|clock| {
            let reference = clock.reference.to_string();
            let texts = [
                clock.name,
                &reference,
                "output",
                "clock",
                "",
                "",
                clock.description,
            ];
            cells(html, "td", &texts)
        })
    })
}

/// Rows of a table as text.
fn rows(write: impl FnOnce(&mut Html) -> io::Result<()>) -> io::Result<String> {
    let mut html = Writer::new_with_indent(Vec::new(), b' ', 1);
    write(&mut html)?;
    String::from_utf8(html.into_inner()).map_err(io::Error::other)
}

fn row<U: Unit>(html: &mut Html, variable: &Row<U>, imprint: &Imprint<U>) -> io::Result<()> {
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
    let (name, start) = match array_of(variable, imprint) {
        Some(array) => (array.name, Some(array.starts.join(" "))),
        None => (variable.name, start_value(variable, imprint)),
    };
    cells(
        html,
        "td",
        &[
            name,
            &variable.reference.to_string(),
            variable.causality(),
            variable.variability(),
            unit,
            &start.unwrap_or_default(),
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
