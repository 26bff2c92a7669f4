//! The documentation page inside the package.
//!
//! A page written by hand, with tables of variables and capabilities that follow from the model description.

use quick_xml::escape::escape;

use crate::description::{Listed, capabilities, rows_told};
use crate::element::Element;
use crate::imprint::Imprint;
use crate::standard::Standard;
use crate::unit::{Row, Unit};
use crate::variable::Kind;

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
pub(crate) fn html<U: Unit>(imprint: &Imprint<U>) -> String {
    let about = U::about();
    let page = about.page.replace("<!--version-->", about.version);
    let page = page.replace("<!--capabilities-->", &flags::<U>(imprint.standard()));
    let page = page.replace("<!--variables-->", &variables(imprint));
    page.replace("<!--name-->", &escape(imprint.name()))
}

/// The flags, with the values that the model description gives them.
fn flags<U: Unit>(standard: Standard) -> String {
    let flags = capabilities::<U>(standard);
    rows(CAPABILITIES.iter().filter_map(|(name, meaning)| {
        // Some are written in another way in FMI 3.0.
        let is_meant = |flag: &str| {
            flag.trim_end_matches('s')
                .eq_ignore_ascii_case(name.trim_end_matches('s'))
        };
        let (flag, value) = flags.iter().find(|(flag, _)| is_meant(flag))?;
        Some(cells("td", &[flag, value, meaning]))
    }))
}

fn variables<U: Unit>(imprint: &Imprint<U>) -> String {
    let head = "Name Reference Causality Variability Unit Start Meaning";
    let head: Vec<_> = head.split(' ').collect();
    let variables = rows_told::<U>(imprint.has_exchange(), imprint.has_arrays());
    let clock = imprint.clock().map(|clock| {
        let reference = clock.reference.to_string();
        let (name, meaning) = (clock.name, clock.description);
        cells(
            "td",
            &[name, &reference, "output", "clock", "", "", meaning],
        )
    });
    let variables = variables.map(|variable| row(variable, imprint));
    rows(
        [cells("th", &head)]
            .into_iter()
            .chain(variables)
            .chain(clock),
    )
}

/// Rows of a table as text.
fn rows(rows: impl Iterator<Item = Element>) -> String {
    let text: String = rows.map(|row| row.to_lines(1, 0)).collect();
    text.trim_end().to_owned()
}

fn row<U: Unit>(variable: &Row<U>, imprint: &Imprint<U>) -> Element {
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
    let Listed { name, start, .. } = Listed::of(variable, imprint);
    cells(
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

fn cells(name: &'static str, texts: &[&str]) -> Element {
    Element::new("tr").with(texts.iter().map(|text| Element::of_text(name, text)))
}
