//! The model description by FMI 3.0, and its terminals and icon.

use std::io;

use super::{
    Attributes, NONE, TOOL, Unknowns, VERSION, Xml, array_of, element, empty, items,
    log_and_experiment, named, of_state, real_type, root, rows_told, typed, units, write_document,
};
use crate::imprint::Imprint;
use crate::instance::Instance;
use crate::quantity::Quantity;
use crate::si;
use crate::solving::space_of;
use crate::standard::Standard;
use crate::terminal::Terminal;
use crate::unit::{About, Clock, Row, Unit};

/// The XML of the FMU with this imprint and this instantiation token.
pub(crate) fn write<U: Unit>(imprint: &Imprint<U>, token: &str) -> io::Result<String> {
    let about = U::about();
    let quantities = quantities(about);
    let root = root("3.0", imprint, ("instantiationToken", token));
    write_document("fmiModelDescription", root, |xml| {
        if about.state_space.is_some() {
            let flags = exchange_capabilities(about.identifier);
            empty(xml, "ModelExchange", flags)?;
        }
        empty(xml, "CoSimulation", capabilities::<U>())?;
        units(xml, &quantities)?;
        element(xml, "TypeDefinitions", NONE, |xml| {
            types(xml, about, &quantities)
        })?;
        log_and_experiment(xml, about)?;
        element(xml, "ModelVariables", NONE, |xml| {
            let rows = rows_told::<U>(true, imprint.has_arrays());
            let mut rows = [&Instance::<U>::TIME].into_iter().chain(rows);
            rows.try_for_each(|row| variable(xml, row, imprint))?;
            let mut clock = imprint.clock().into_iter();
            clock.try_for_each(|clock| empty(xml, "Clock", clock_attributes(clock)))
        })?;
        element(xml, "ModelStructure", NONE, |xml| {
            unknowns(xml, imprint, "Output", Unknowns::Outputs)?;
            clock_as(xml, "Output", imprint)?;
            unknowns(
                xml,
                imprint,
                "ContinuousStateDerivative",
                Unknowns::Derivatives,
            )?;
            unknowns(xml, imprint, "InitialUnknown", Unknowns::Initial)?;
            clock_as(xml, "InitialUnknown", imprint)?;
            let mut indicators = space_of::<U>().indicators.iter();
            indicators.try_for_each(|reference| {
                let reference = reference.to_string();
                empty(xml, "EventIndicator", [("valueReference", reference)])
            })
        })?;
        element(xml, "Annotations", NONE, |xml| {
            element(xml, "Annotation", [("type", TOOL)], |xml| {
                empty(xml, TOOL, [("version", VERSION)])
            })
        })
    })
}

fn variable<U: Unit>(xml: &mut Xml, row: &Row<U>, imprint: &Imprint<U>) -> io::Result<()> {
    let type_name = row.kind.type_name(Standard::Fmi3);
    let of_state = of_state::<U>(row, |state| state.to_string());
    let is_told = U::HAS_EVENTS && row.is_output();
    let told = is_told.then(|| ("intermediateUpdate", "true".to_owned()));
    let typed = typed(row, imprint).into_iter().chain(of_state);
    let attributes = named(row).chain(typed).chain(told);
    let Some(array) = array_of(row, imprint) else {
        return empty(xml, type_name, attributes);
    };
    let of_array = attributes.map(|(attribute, text)| match attribute {
        "name" => (attribute, array.name.to_owned()),
        "start" => (attribute, array.starts.join(" ")),
        _ => (attribute, text),
    });
    element(xml, type_name, of_array, |xml| {
        empty(
            xml,
            "Dimension",
            [("start", array.starts.len().to_string())],
        )
    })
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
fn clock_as<U: Unit>(xml: &mut Xml, list: &'static str, imprint: &Imprint<U>) -> io::Result<()> {
    let mut clock = imprint.clock().into_iter();
    clock.try_for_each(|clock| empty(xml, list, [("valueReference", clock.reference.to_string())]))
}

/// The quantities in use, that of time among them.
fn quantities<U: Unit>(about: &About<U>) -> Vec<&'static Quantity> {
    let is_time = |of: &&Quantity| of.type_name == si::TIME.type_name;
    let time = (!about.quantities.iter().any(is_time)).then_some(&si::TIME);
    about.quantities.iter().copied().chain(time).collect()
}

fn types<U: Unit>(
    xml: &mut Xml,
    about: &About<U>,
    quantities: &[&'static Quantity],
) -> io::Result<()> {
    for of in quantities {
        empty(xml, "Float64Type", real_type(of))?;
    }
    for of in about.enumerations {
        let named = [("name", of.type_name), ("description", of.description)];
        element(xml, "EnumerationType", named, |xml| items(xml, of.items))?;
    }
    Ok(())
}

/// One element for each, with its dependencies by their value references.
fn unknowns<U: Unit>(
    xml: &mut Xml,
    imprint: &Imprint<U>,
    name: &'static str,
    of: Unknowns,
) -> io::Result<()> {
    for (_, variable, rows) in of.each::<U>(true, imprint.has_arrays()) {
        let references: Vec<_> = rows
            .iter()
            .map(|(_, of)| of.reference.to_string())
            .collect();
        let kinds = vec!["dependent"; rows.len()];
        let known = [
            ("valueReference", variable.reference.to_string()),
            ("dependencies", references.join(" ")),
            ("dependenciesKind", kinds.join(" ")),
        ];
        empty(xml, name, known)?;
    }
    Ok(())
}

/// The file that says where the icon is drawn, if there is one, and what the terminals are.
pub(crate) fn terminals_and_icons(terminals: &[Terminal], has_icon: bool) -> io::Result<String> {
    let corners = [("x1", "-100"), ("y1", "-100"), ("x2", "100"), ("y2", "100")];
    let scale = [("suggestedScalingFactorTo_mm", "0.1")];
    write_document("fmiTerminalsAndIcons", [("fmiVersion", "3.0")], |xml| {
        if has_icon {
            element(xml, "GraphicalRepresentation", NONE, |xml| {
                empty(xml, "CoordinateSystem", corners.into_iter().chain(scale))?;
                empty(xml, "Icon", corners)
            })?;
        }
        element(xml, "Terminals", NONE, |xml| {
            terminals.iter().try_for_each(|of| terminal(xml, of))
        })
    })
}

fn terminal(xml: &mut Xml, terminal: &Terminal) -> io::Result<()> {
    let named = [
        ("name", terminal.name),
        ("matchingRule", "bus"),
        ("description", terminal.description),
    ];
    element(xml, "Terminal", named, |xml| {
        terminal
            .members
            .iter()
            .try_for_each(|(member, flow, variable)| {
                let named = [
                    ("variableName", *variable),
                    ("memberName", *member),
                    ("variableKind", flow.kind()),
                ];
                empty(xml, "TerminalMemberVariable", named)
            })
    })
}
