//! The model description by FMI 2.0.

use std::io;

use super::{
    Attributes, NONE, TOOL, Unknowns, VERSION, Xml, element, empty, items, log_and_experiment,
    named, of_state, real_type, root, rows_told, typed, units, write_document,
};
use crate::imprint::Imprint;
use crate::solving::space_of;
use crate::standard::Standard;
use crate::unit::{About, Row, Unit};

/// The XML of the FMU with this imprint and this GUID.
pub(crate) fn write<U: Unit>(
    imprint: &Imprint<U>,
    guid: &str,
    exchange: bool,
) -> io::Result<String> {
    let about = U::about();
    let root = root("2.0", imprint, ("guid", guid));
    let indicators = usize::from(exchange) * space_of::<U>().indicators.len();
    let indicators = indicators.to_string();
    let root = root
        .into_iter()
        .chain([("numberOfEventIndicators", &*indicators)]);
    write_document("fmiModelDescription", root, |xml| {
        if exchange {
            let flags = exchange_capabilities(about.identifier);
            empty(xml, "ModelExchange", flags)?;
        }
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
            let mut rows = rows_told(exchange, false);
            rows.try_for_each(|variable| scalar_variable(xml, variable, imprint, exchange))
        })?;
        element(xml, "ModelStructure", NONE, |xml| {
            element(xml, "Outputs", NONE, |xml| {
                unknowns::<U>(xml, Unknowns::Outputs, exchange)
            })?;
            if exchange {
                element(xml, "Derivatives", NONE, |xml| {
                    unknowns::<U>(xml, Unknowns::Derivatives, exchange)
                })?;
            }
            element(xml, "InitialUnknowns", NONE, |xml| {
                unknowns::<U>(xml, Unknowns::Initial, exchange)
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
    exchange: bool,
) -> io::Result<()> {
    let table = &U::about().table;
    element(xml, "ScalarVariable", named(variable), |xml| {
        let name = variable.kind.type_name(Standard::Fmi2);
        let number = |reference| {
            let row = table.rows().position(|row| row.reference == reference);
            (row.unwrap_or_default() + 1).to_string()
        };
        let of_state = exchange.then(|| of_state::<U>(variable, number));
        let typed = typed(variable, imprint).into_iter();
        empty(xml, name, typed.chain(of_state.into_iter().flatten()))
    })
}

/// One `Unknown` for each, with its dependencies; indices count variables from 1.
fn unknowns<U: Unit>(xml: &mut Xml, of: Unknowns, exchange: bool) -> io::Result<()> {
    for (row, _, rows) in of.each::<U>(exchange, false) {
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
