//! The model description by FMI 2.0.

use super::{
    Unknowns, annotations, dependent, enumeration, items, log_and_experiment, named, of_state,
    real_type, root, rows_told, start_value, typed, units,
};
use crate::element::{Attributes, Element};
use crate::imprint::Imprint;
use crate::solving::space_of;
use crate::standard::Standard;
use crate::unit::{About, Row, Unit};

/// The XML of the FMU with this imprint and this GUID.
pub(crate) fn write<U: Unit>(imprint: &Imprint<U>, guid: &str, exchange: bool) -> String {
    let about = U::about();
    let indicators = usize::from(exchange) * space_of::<U>().indicators.len();
    let for_exchange = exchange
        .then(|| Element::new("ModelExchange").set_all(exchange_capabilities(about.identifier)));
    let rows = rows_told(exchange, false);
    let variables = rows.map(|variable| scalar_variable(variable, imprint, exchange));
    let unknowns = |name, of| Element::new(name).with(unknowns::<U>(of, exchange));
    let structure = Element::new("ModelStructure")
        .with([unknowns("Outputs", Unknowns::Outputs)])
        .with(exchange.then(|| unknowns("Derivatives", Unknowns::Derivatives)))
        .with([unknowns("InitialUnknowns", Unknowns::Initial)]);
    root("2.0", imprint, ("guid", guid))
        .set("numberOfEventIndicators", indicators)
        .with(for_exchange)
        .with([
            Element::new("CoSimulation").set_all(capabilities(about)),
            units(about.quantities),
            types(about),
        ])
        .with(log_and_experiment(about))
        .with([
            annotations(["VendorAnnotations", "Tool", "name"]),
            Element::new("ModelVariables").with(variables),
            structure,
        ])
        .to_document()
}

/// The attributes of the element `CoSimulation`.
pub(super) fn capabilities<U: Unit>(about: &About<U>) -> Attributes {
    let order = about.table.highest_output_order().to_string();
    let flags = [
        ("modelIdentifier", about.identifier),
        ("needsExecutionTool", "false"),
        ("canHandleVariableCommunicationStepSize", "true"),
        ("canInterpolateInputs", "true"),
        ("maxOutputDerivativeOrder", &order),
        ("canRunAsynchronuously", "false"),
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canNotUseMemoryManagementFunctions", "true"),
        ("canGetAndSetFMUstate", "true"),
        ("canSerializeFMUstate", "true"),
        ("providesDirectionalDerivative", "true"),
    ];
    flags.map(|(name, value)| (name, value.to_owned())).into()
}

/// The attributes of the element `ModelExchange`.
fn exchange_capabilities(identifier: &str) -> [(&'static str, &str); 8] {
    [
        ("modelIdentifier", identifier),
        ("needsExecutionTool", "false"),
        ("completedIntegratorStepNotNeeded", "false"),
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canNotUseMemoryManagementFunctions", "true"),
        ("canGetAndSetFMUstate", "true"),
        ("canSerializeFMUstate", "true"),
        ("providesDirectionalDerivative", "true"),
    ]
}

fn types<U: Unit>(about: &About<U>) -> Element {
    let quantities = about.quantities.iter().map(|of| {
        let [name, rest @ ..] = real_type(of);
        let real = Element::new("Real").set_all(rest);
        Element::new("SimpleType").set_all([name]).with([real])
    });
    let enumerations = about.enumerations.iter().map(|of| {
        let items = Element::new("Enumeration").with(items(of.items));
        enumeration("SimpleType", of).with([items])
    });
    Element::new("TypeDefinitions").with(quantities.chain(enumerations))
}

fn scalar_variable<U: Unit>(variable: &Row<U>, imprint: &Imprint<U>, exchange: bool) -> Element {
    let number = |reference| {
        let mut rows = U::about().table.rows();
        let row = rows.position(|row| row.reference == reference);
        (row.unwrap_or_default() + 1).to_string()
    };
    let element = Element::new(variable.kind.type_name(Standard::Fmi2));
    let element = typed(element, variable, start_value(variable, imprint));
    let element = match exchange {
        true => of_state(element, variable, number),
        false => element,
    };
    named("ScalarVariable", variable.name, variable).with([element])
}

/// One `Unknown` for each, with its dependencies; indices count variables from 1.
fn unknowns<U: Unit>(of: Unknowns, exchange: bool) -> impl Iterator<Item = Element> {
    let unknowns = of.each::<U>(exchange, false).into_iter();
    unknowns.map(|(row, _, rows)| {
        let indices = rows.iter().map(|(row, _)| row + 1);
        dependent("Unknown", ("index", row + 1), indices)
    })
}
