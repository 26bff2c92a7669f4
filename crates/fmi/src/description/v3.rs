//! The model description by FMI 3.0, and its terminals and icon.

use super::{
    Listed, Unknowns, annotations, dependent, enumeration, items, log_and_experiment, named,
    of_state, real_type, root, rows_told, typed, units,
};
use crate::element::{Attributes, Element};
use crate::imprint::Imprint;
use crate::instance::Instance;
use crate::quantity::Quantity;
use crate::si;
use crate::solving::space_of;
use crate::standard::Standard;
use crate::terminal::Terminal;
use crate::unit::{About, Clock, Row, Unit};

/// The XML of the FMU with this imprint and this instantiation token.
pub(crate) fn write<U: Unit>(imprint: &Imprint<U>, token: &str) -> String {
    let about = U::about();
    let quantities = quantities(about);
    let for_exchange = about
        .state_space
        .map(|_| Element::new("ModelExchange").set_all(exchange_capabilities(about.identifier)));
    let rows = rows_told::<U>(true, imprint.has_arrays());
    let rows = [&Instance::<U>::TIME].into_iter().chain(rows);
    let clock = imprint
        .clock()
        .map(|clock| Element::new("Clock").set_all(clock_attributes(clock)));
    let indicators = space_of::<U>().indicators.iter();
    let indicators = indicators.map(|it| Element::new("EventIndicator").set("valueReference", it));
    let structure = Element::new("ModelStructure")
        .with(unknowns(imprint, "Output", Unknowns::Outputs))
        .with(clock_as("Output", imprint))
        .with(unknowns(
            imprint,
            "ContinuousStateDerivative",
            Unknowns::Derivatives,
        ))
        .with(unknowns(imprint, "InitialUnknown", Unknowns::Initial))
        .with(clock_as("InitialUnknown", imprint))
        .with(indicators);
    root("3.0", imprint, ("instantiationToken", token))
        .with(for_exchange)
        .with([
            Element::new("CoSimulation").set_all(capabilities::<U>()),
            units(&quantities),
            types(about, &quantities),
        ])
        .with(log_and_experiment(about))
        .with([
            Element::new("ModelVariables")
                .with(rows.map(|row| variable(row, imprint)))
                .with(clock),
            structure,
            annotations(["Annotations", "Annotation", "type"]),
        ])
        .to_document()
}

fn variable<U: Unit>(row: &Row<U>, imprint: &Imprint<U>) -> Element {
    let Listed {
        name,
        start,
        length,
    } = Listed::of(row, imprint);
    let element = named(row.kind.type_name(Standard::Fmi3), name, row);
    let element = typed(element, row, start);
    let element = of_state(element, row, |state| state.to_string());
    let is_told = U::HAS_EVENTS && row.is_output();
    let element = element.set_all(is_told.then_some(("intermediateUpdate", "true")));
    match length {
        Some(length) => element.with([Element::new("Dimension").set("start", length)]),
        None => element,
    }
}

/// The attributes of the element `CoSimulation`.
pub(super) fn capabilities<U: Unit>() -> Attributes {
    let about = U::about();
    let order = about.table.highest_output_order().to_string();
    let events = U::HAS_EVENTS.to_string();
    let flags = [
        ("modelIdentifier", about.identifier),
        ("needsExecutionTool", "false"),
        ("canHandleVariableCommunicationStepSize", "true"),
        ("maxOutputDerivativeOrder", &order),
        ("hasEventMode", &events),
        ("mightReturnEarlyFromDoStep", "true"),
        ("providesIntermediateUpdate", &events),
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canGetAndSetFMUState", "true"),
        ("canSerializeFMUState", "true"),
        ("providesDirectionalDerivatives", "true"),
        ("providesAdjointDerivatives", "true"),
    ];
    flags.map(|(name, value)| (name, value.to_owned())).into()
}

/// The attributes of the element `ModelExchange`.
fn exchange_capabilities(identifier: &str) -> [(&'static str, &str); 8] {
    [
        ("modelIdentifier", identifier),
        ("needsExecutionTool", "false"),
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canGetAndSetFMUState", "true"),
        ("canSerializeFMUState", "true"),
        ("providesDirectionalDerivatives", "true"),
        ("providesAdjointDerivatives", "true"),
        ("needsCompletedIntegratorStep", "true"),
    ]
}

/// What a clock says: it ticks when the unit lets it.
fn clock_attributes<U>(clock: &Clock<U>) -> [(&'static str, String); 6] {
    [
        ("name", clock.name.to_owned()),
        ("valueReference", clock.reference.to_string()),
        ("description", clock.description.to_owned()),
        ("causality", "output".to_owned()),
        ("variability", "discrete".to_owned()),
        ("intervalVariability", "triggered".to_owned()),
    ]
}

/// Lists the clock, if it is told of. It depends on all that the motion depends on.
fn clock_as<U: Unit>(list: &'static str, imprint: &Imprint<U>) -> Option<Element> {
    let clock = imprint.clock()?;
    Some(Element::new(list).set("valueReference", clock.reference))
}

/// The quantities in use, that of time among them.
fn quantities<U: Unit>(about: &About<U>) -> Vec<&'static Quantity> {
    let is_time = |of: &&Quantity| of.type_name == si::TIME.type_name;
    let time = (!about.quantities.iter().any(is_time)).then_some(&si::TIME);
    about.quantities.iter().copied().chain(time).collect()
}

fn types<U: Unit>(about: &About<U>, quantities: &[&'static Quantity]) -> Element {
    let quantities = quantities.iter();
    let quantities = quantities.map(|of| Element::new("Float64Type").set_all(real_type(of)));
    let enumerations = about.enumerations.iter();
    let enumerations =
        enumerations.map(|of| enumeration("EnumerationType", of).with(items(of.items)));
    Element::new("TypeDefinitions").with(quantities.chain(enumerations))
}

/// One element for each, with its dependencies by their value references.
fn unknowns<U: Unit>(
    imprint: &Imprint<U>,
    name: &'static str,
    of: Unknowns,
) -> impl Iterator<Item = Element> {
    let unknowns = of.each::<U>(true, imprint.has_arrays()).into_iter();
    unknowns.map(move |(_, variable, rows)| {
        let references = rows.iter().map(|(_, of)| of.reference);
        dependent(name, ("valueReference", variable.reference), references)
    })
}

/// The file that says where the icon is drawn, if there is one, and what the terminals are.
pub(crate) fn terminals_and_icons(terminals: &[Terminal], has_icon: bool) -> String {
    let corners = [("x1", "-100"), ("y1", "-100"), ("x2", "100"), ("y2", "100")];
    let system = Element::new("CoordinateSystem").set_all(corners);
    let system = system.set("suggestedScalingFactorTo_mm", "0.1");
    let drawn = [system, Element::new("Icon").set_all(corners)];
    let drawn = has_icon.then(|| Element::new("GraphicalRepresentation").with(drawn));
    Element::new("fmiTerminalsAndIcons")
        .set("fmiVersion", "3.0")
        .with(drawn)
        .with([Element::new("Terminals").with(terminals.iter().map(terminal))])
        .to_document()
}

fn terminal(terminal: &Terminal) -> Element {
    let members = terminal.members.iter().map(|(member, flow, variable)| {
        Element::new("TerminalMemberVariable").set_all([
            ("variableName", *variable),
            ("memberName", *member),
            ("variableKind", flow.kind()),
        ])
    });
    let named = Element::new("Terminal").set_all([
        ("name", terminal.name),
        ("matchingRule", "bus"),
        ("description", terminal.description),
    ]);
    named.with(members)
}
