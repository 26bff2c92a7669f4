//! The model description by FMI 3.0, and where its packages have an icon.

use std::io;

use super::{
    Attributes, NONE, TOOL, VERSION, Xml, dependencies, element, empty, items, log_and_experiment,
    named, real_type, root, typed, units, write_document,
};
use crate::imprint::Imprint;
use crate::instance::Instance;
use crate::quantity::Quantity;
use crate::si;
use crate::standard::Standard;
use crate::unit::{About, Unit};

/// The XML of the FMU with this imprint and this instantiation token.
pub(crate) fn write<U: Unit>(imprint: &Imprint<U>, token: &str) -> io::Result<String> {
    let about = U::about();
    let quantities = quantities(about);
    let root = root("3.0", imprint, ("instantiationToken", token));
    write_document("fmiModelDescription", root, |xml| {
        empty(xml, "CoSimulation", capabilities::<U>())?;
        units(xml, &quantities)?;
        element(xml, "TypeDefinitions", NONE, |xml| {
            types(xml, about, &quantities)
        })?;
        log_and_experiment(xml, about)?;
        element(xml, "ModelVariables", NONE, |xml| {
            let mut rows = [&Instance::<U>::TIME].into_iter().chain(about.table.rows());
            rows.try_for_each(|variable| {
                let name = variable.kind.type_name(Standard::Fmi3);
                empty(xml, name, named(variable).chain(typed(variable, imprint)))
            })
        })?;
        element(xml, "ModelStructure", NONE, |xml| {
            unknowns(xml, about, "Output")?;
            unknowns(xml, about, "InitialUnknown")
        })?;
        element(xml, "Annotations", NONE, |xml| {
            element(xml, "Annotation", [("type", TOOL)], |xml| {
                empty(xml, TOOL, [("version", VERSION)])
            })
        })
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
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canGetAndSetFMUState", "true"),
        ("canSerializeFMUState", "true"),
        ("providesDirectionalDerivatives", "true"),
        ("providesAdjointDerivatives", "true"),
    ];
    flags.map(|(name, value)| (name, value.to_owned())).into()
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

/// One element for each output, with its dependencies by their value references.
fn unknowns<U: Unit>(xml: &mut Xml, about: &About<U>, name: &'static str) -> io::Result<()> {
    for variable in about.table.rows() {
        let Some(rows) = dependencies(variable, name == "InitialUnknown") else {
            continue;
        };
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

/// The file that says where the icon is drawn.
pub(crate) fn icons() -> io::Result<String> {
    let corners = [("x1", "-100"), ("y1", "-100"), ("x2", "100"), ("y2", "100")];
    let scale = [("suggestedScalingFactorTo_mm", "0.1")];
    write_document("fmiTerminalsAndIcons", [("fmiVersion", "3.0")], |xml| {
        element(xml, "GraphicalRepresentation", NONE, |xml| {
            empty(xml, "CoordinateSystem", corners.into_iter().chain(scale))?;
            empty(xml, "Icon", corners)
        })
    })
}
