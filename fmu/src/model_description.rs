//! The model description, written from the table of variables.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

use crate::start::StartValues;
use crate::units::{ENUMERATIONS, Enumeration, QUANTITIES, Quantity};
use crate::variables::{Access, Kind, RealKind, VARIABLES, Variable, rows_of};

/// Name of the model and, in file names and binaries, its identifier.
pub const MODEL_IDENTIFIER: &str = "softstop";
/// Categories of log lines: (name, description).
pub const LOG_CATEGORIES: [(&str, &str); 3] = [
    (
        "events",
        "impacts and pierced strips, one line for each step that has any",
    ),
    (
        "warnings",
        "calls that are carried out, but hardly as meant",
    ),
    (
        "errors",
        "calls that are refused and steps that are discarded, always logged",
    ),
];

const VERSION: &str = env!("CARGO_PKG_VERSION");
const INDENT: usize = 2;

type Xml = Writer<Vec<u8>>;
type Attributes = Vec<(&'static str, String)>;

/// The XML with these start values and this GUID.
///
/// # Errors
/// If writing to memory fails.
pub fn write(start: &StartValues, guid: &str) -> io::Result<String> {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', INDENT);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    element(&mut xml, "fmiModelDescription", root(guid), |xml| {
        empty(xml, "CoSimulation", capabilities())?;
        element(xml, "UnitDefinitions", vec![], |xml| {
            QUANTITIES
                .iter()
                .try_for_each(|quantity| unit(xml, quantity))
        })?;
        element(xml, "TypeDefinitions", vec![], |xml| {
            QUANTITIES
                .iter()
                .try_for_each(|quantity| real_type(xml, quantity))?;
            ENUMERATIONS
                .iter()
                .try_for_each(|items| enumeration_type(xml, items))
        })?;
        element(xml, "LogCategories", vec![], |xml| {
            LOG_CATEGORIES.iter().try_for_each(|(name, description)| {
                empty(
                    xml,
                    "Category",
                    attributes([("name", name), ("description", description)]),
                )
            })
        })?;
        empty(
            xml,
            "DefaultExperiment",
            attributes([
                ("startTime", "0"),
                ("stopTime", "100"),
                ("stepSize", "0.01"),
            ]),
        )?;
        element(xml, "VendorAnnotations", vec![], |xml| {
            element(xml, "Tool", attributes([("name", "softstop")]), |xml| {
                empty(xml, "softstop", attributes([("version", VERSION)]))
            })
        })?;
        element(xml, "ModelVariables", vec![], |xml| {
            VARIABLES
                .iter()
                .try_for_each(|variable| scalar_variable(xml, variable, start))
        })?;
        element(xml, "ModelStructure", vec![], |xml| {
            element(xml, "Outputs", vec![], |xml| unknowns(xml, false))?;
            element(xml, "InitialUnknowns", vec![], |xml| unknowns(xml, true))
        })
    })?;
    let mut bytes = xml.into_inner();
    bytes.push(b'\n');
    String::from_utf8(bytes).map_err(io::Error::other)
}

fn attributes<const N: usize>(pairs: [(&'static str, &str); N]) -> Attributes {
    pairs.map(|(name, value)| (name, value.to_owned())).into()
}

fn element(
    xml: &mut Xml,
    name: &'static str,
    attributes: Attributes,
    content: impl FnOnce(&mut Xml) -> io::Result<()>,
) -> io::Result<()> {
    let pairs = attributes
        .iter()
        .map(|(name, value)| (*name, value.as_str()));
    xml.create_element(name)
        .with_attributes(pairs)
        .write_inner_content(content)?;
    Ok(())
}

fn empty(xml: &mut Xml, name: &'static str, attributes: Attributes) -> io::Result<()> {
    let pairs = attributes
        .iter()
        .map(|(name, value)| (*name, value.as_str()));
    xml.create_element(name)
        .with_attributes(pairs)
        .write_empty()?;
    Ok(())
}

fn root(guid: &str) -> Attributes {
    let tool = format!("softstop {VERSION}");
    attributes([
        ("fmiVersion", "2.0"),
        ("modelName", MODEL_IDENTIFIER),
        ("guid", guid),
        (
            "description",
            "Impact oscillator with soft, preloaded and rigid stops and piercing of a strip, solved exactly",
        ),
        ("version", VERSION),
        ("license", "MIT OR Apache-2.0"),
        ("generationTool", &tool),
        ("variableNamingConvention", "structured"),
        ("numberOfEventIndicators", "0"),
    ])
}

fn capabilities() -> Attributes {
    attributes([
        ("modelIdentifier", MODEL_IDENTIFIER),
        ("needsExecutionTool", "false"),
        ("canHandleVariableCommunicationStepSize", "true"),
        ("canInterpolateInputs", "true"),
        ("maxOutputDerivativeOrder", "2"),
        ("canRunAsynchronuously", "false"),
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canNotUseMemoryManagementFunctions", "true"),
        ("canGetAndSetFMUstate", "true"),
        ("canSerializeFMUstate", "true"),
        ("providesDirectionalDerivative", "true"),
    ])
}

fn unit(xml: &mut Xml, quantity: &Quantity) -> io::Result<()> {
    element(xml, "Unit", attributes([("name", quantity.unit)]), |xml| {
        let base = quantity.base.iter();
        empty(
            xml,
            "BaseUnit",
            base.map(|(name, exponent)| (*name, exponent.to_string()))
                .collect(),
        )?;
        quantity.display.iter().try_for_each(|(name, factor)| {
            let factor = number(*factor);
            empty(
                xml,
                "DisplayUnit",
                attributes([("name", name), ("factor", &factor)]),
            )
        })
    })
}

fn real_type(xml: &mut Xml, quantity: &Quantity) -> io::Result<()> {
    element(
        xml,
        "SimpleType",
        attributes([("name", quantity.type_name)]),
        |xml| {
            empty(
                xml,
                "Real",
                attributes([("quantity", quantity.quantity), ("unit", quantity.unit)]),
            )
        },
    )
}

fn enumeration_type(xml: &mut Xml, items: &Enumeration) -> io::Result<()> {
    let named = attributes([
        ("name", items.type_name),
        ("description", items.description),
    ]);
    element(xml, "SimpleType", named, |xml| {
        element(xml, "Enumeration", vec![], |xml| {
            items.items.iter().try_for_each(|item| {
                let value = item.value.to_string();
                empty(
                    xml,
                    "Item",
                    attributes([
                        ("name", item.name),
                        ("value", &value),
                        ("description", item.description),
                    ]),
                )
            })
        })
    })
}

fn scalar_variable(xml: &mut Xml, variable: &Variable, start: &StartValues) -> io::Result<()> {
    let reference = variable.reference.to_string();
    let mut named = attributes([
        ("name", variable.name),
        ("valueReference", &reference),
        ("description", variable.description),
        ("causality", variable.causality()),
        ("variability", variable.variability()),
    ]);
    match variable.access {
        Access::Parameter { .. } => named.push(("initial", "exact".to_owned())),
        Access::Force | Access::Material => {}
        _ => named.push(("initial", "calculated".to_owned())),
    }
    let mut typed = match &variable.kind {
        Kind::Real(kind) => real_attributes(kind),
        Kind::Count { min, max } => count_attributes(*min, *max),
        Kind::Boolean => vec![],
        Kind::Enumeration(items) => attributes([("declaredType", items.type_name)]),
    };
    if let Some(value) = start_value(variable, start) {
        typed.push(("start", value));
    }
    element(xml, "ScalarVariable", named, |xml| {
        empty(xml, variable.kind.type_name(), typed)
    })
}

fn real_attributes(kind: &RealKind) -> Attributes {
    let mut typed = kind.quantity.map_or(vec![], |quantity| {
        attributes([
            ("declaredType", quantity.type_name),
            ("quantity", quantity.quantity),
            ("unit", quantity.unit),
        ])
    });
    if let Some(unit) = kind.display_unit {
        typed.push(("displayUnit", unit.to_owned()));
    }
    let limits = [
        ("min", kind.min),
        ("max", kind.max),
        ("nominal", kind.nominal),
    ];
    typed.extend(
        limits
            .into_iter()
            .filter_map(|(name, value)| Some((name, number(value?)))),
    );
    typed
}

fn count_attributes(min: i32, max: Option<i32>) -> Attributes {
    let limits = [("min", Some(min)), ("max", max)];
    let texts = limits.map(|(name, limit)| Some((name, limit?.to_string())));
    texts.into_iter().flatten().collect()
}

/// The start value as it stands in the XML; outputs have none.
pub(crate) fn start_value(variable: &Variable, start: &StartValues) -> Option<String> {
    match (&variable.access, &variable.kind) {
        (Access::Parameter { slot, .. }, Kind::Real(_)) => Some(number(start.get(*slot))),
        (Access::Parameter { slot, .. }, Kind::Boolean) => {
            Some((start.number(*slot) != 0).to_string())
        }
        (Access::Parameter { slot, .. }, _) => Some(start.number(*slot).to_string()),
        (Access::Force, _) => Some(number(0.0)),
        (Access::Material, _) => Some("true".to_owned()),
        _ => None,
    }
}

/// Shortest text that reads back as the same number.
fn number(value: f64) -> String {
    format!("{value:?}")
}

/// One `Unknown` for each output, with its dependencies; indices count variables from 1.
fn unknowns(xml: &mut Xml, initial: bool) -> io::Result<()> {
    for (row, variable) in VARIABLES.iter().enumerate() {
        let Some(depends) = variable.dependencies() else {
            continue;
        };
        let names = if initial {
            depends.initial
        } else {
            depends.inputs
        };
        let mut rows: Vec<_> = names.iter().flat_map(|name| rows_of(name)).collect();
        rows.sort_unstable();
        let indices: Vec<_> = rows.iter().map(|row| (row + 1).to_string()).collect();
        let kinds = vec!["dependent"; rows.len()];
        let index = (row + 1).to_string();
        let known = attributes([
            ("index", &index),
            ("dependencies", &indices.join(" ")),
            ("dependenciesKind", &kinds.join(" ")),
        ]);
        empty(xml, "Unknown", known)?;
    }
    Ok(())
}
