//! The model description by FMI 2.0.

use std::io;

use super::{
    Attributes, NONE, TOOL, VERSION, Xml, dependencies, element, empty, items, log_and_experiment,
    named, real_type, root, typed, units, write_document,
};
use crate::imprint::Imprint;
use crate::standard::Standard;
use crate::unit::{About, Row, Unit};

/// The XML of the FMU with this imprint and this GUID.
pub(crate) fn write<U: Unit>(imprint: &Imprint<U>, guid: &str) -> io::Result<String> {
    let about = U::about();
    let root = root("2.0", imprint, ("guid", guid));
    let root = root.into_iter().chain([("numberOfEventIndicators", "0")]);
    write_document("fmiModelDescription", root, |xml| {
        empty(xml, "CoSimulation", capabilities(about))?;
        units(xml, about.quantities)?;
        element(xml, "TypeDefinitions", NONE, |xml| types(xml, about))?;
        log_and_experiment(xml, about)?;
        element(xml, "VendorAnnotations", NONE, |xml| {
            element(xml, "Tool", [("name", TOOL)], |xml| {
                empty(xml, TOOL, [("version", VERSION)])
            })
        })?;
        element(xml, "ModelVariables", NONE, |xml| {
            let mut rows = about.table.rows();
            rows.try_for_each(|variable| scalar_variable(xml, variable, imprint))
        })?;
        element(xml, "ModelStructure", NONE, |xml| {
            element(xml, "Outputs", NONE, |xml| unknowns(xml, about, false))?;
            element(xml, "InitialUnknowns", NONE, |xml| {
                unknowns(xml, about, true)
            })
        })
    })
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

fn types<U: Unit>(xml: &mut Xml, about: &About<U>) -> io::Result<()> {
    for of in about.quantities {
        let [name, rest @ ..] = real_type(of);
        element(xml, "SimpleType", [name], |xml| empty(xml, "Real", rest))?;
    }
    for of in about.enumerations {
        let named = [("name", of.type_name), ("description", of.description)];
        element(xml, "SimpleType", named, |xml| {
            element(xml, "Enumeration", NONE, |xml| items(xml, of.items))
        })?;
    }
    Ok(())
}

fn scalar_variable<U: Unit>(
    xml: &mut Xml,
    variable: &Row<U>,
    imprint: &Imprint<U>,
) -> io::Result<()> {
    element(xml, "ScalarVariable", named(variable), |xml| {
        let name = variable.kind.type_name(Standard::Fmi2);
        empty(xml, name, typed(variable, imprint))
    })
}

/// One `Unknown` for each output, with its dependencies; indices count variables from 1.
fn unknowns<U: Unit>(xml: &mut Xml, about: &About<U>, initial: bool) -> io::Result<()> {
    for (row, variable) in about.table.rows().enumerate() {
        let Some(rows) = dependencies(variable, initial) else {
            continue;
        };
        let indices: Vec<_> = rows.iter().map(|(row, _)| (row + 1).to_string()).collect();
        let kinds = vec!["dependent"; rows.len()];
        let known = [
            ("index", (row + 1).to_string()),
            ("dependencies", indices.join(" ")),
            ("dependenciesKind", kinds.join(" ")),
        ];
        empty(xml, "Unknown", known)?;
    }
    Ok(())
}
