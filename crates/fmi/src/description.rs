//! The model description, written from what a unit says of itself and from its table of variables.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

use crate::imprint::Imprint;
use crate::log::Category;
use crate::quantity::{Enumeration, Quantity};
use crate::unit::{About, Row, Unit};
use crate::variable::{Access, Kind, RealKind};

/// The tool that writes units, and its version.
const TOOL: &str = "softstop";
const VERSION: &str = env!("CARGO_PKG_VERSION");
const INDENT: usize = 2;

type Xml = Writer<Vec<u8>>;
pub(crate) type Attributes = Vec<(&'static str, String)>;

/// The XML of the FMU with this imprint and this GUID.
///
/// # Errors
/// If writing to memory fails.
pub fn write<U: Unit>(imprint: &Imprint<U>, guid: &str) -> io::Result<String> {
    let about = U::about();
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', INDENT);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let root = root(imprint, guid);
    element(&mut xml, "fmiModelDescription", root, |xml| {
        empty(xml, "CoSimulation", capabilities(about))?;
        element(xml, "UnitDefinitions", vec![], |xml| {
            about.quantities.iter().try_for_each(|of| unit(xml, of))
        })?;
        element(xml, "TypeDefinitions", vec![], |xml| {
            let mut quantities = about.quantities.iter();
            quantities.try_for_each(|of| real_type(xml, of))?;
            let mut enumerations = about.enumerations.iter();
            enumerations.try_for_each(|of| enumeration_type(xml, of))
        })?;
        element(xml, "LogCategories", vec![], |xml| {
            log_categories(xml, about)
        })?;
        let experiment = about.experiment.iter();
        let experiment = experiment.map(|(name, value)| (*name, (*value).to_owned()));
        empty(xml, "DefaultExperiment", experiment.collect())?;
        element(xml, "VendorAnnotations", vec![], |xml| {
            element(xml, "Tool", attributes([("name", TOOL)]), |xml| {
                empty(xml, TOOL, attributes([("version", VERSION)]))
            })
        })?;
        element(xml, "ModelVariables", vec![], |xml| {
            let mut rows = about.table.rows();
            rows.try_for_each(|variable| scalar_variable(xml, variable, imprint))
        })?;
        element(xml, "ModelStructure", vec![], |xml| {
            element(xml, "Outputs", vec![], |xml| unknowns(xml, about, false))?;
            element(xml, "InitialUnknowns", vec![], |xml| {
                unknowns(xml, about, true)
            })
        })
    })?;
    let mut bytes = xml.into_inner();
    bytes.push(b'\n');
    String::from_utf8(bytes).map_err(io::Error::other)
}

fn attributes<const N: usize>(pairs: [(&'static str, &str); N]) -> Attributes {
    pairs.map(|(name, value)| (name, value.to_owned())).into()
}

fn pairs(attributes: &Attributes) -> impl Iterator<Item = (&str, &str)> {
    let pairs = attributes.iter();
    pairs.map(|(name, value)| (*name, value.as_str()))
}

fn element(
    xml: &mut Xml,
    name: &'static str,
    attributes: Attributes,
    content: impl FnOnce(&mut Xml) -> io::Result<()>,
) -> io::Result<()> {
    xml.create_element(name)
        .with_attributes(pairs(&attributes))
        .write_inner_content(content)?;
    Ok(())
}

fn empty(xml: &mut Xml, name: &'static str, attributes: Attributes) -> io::Result<()> {
    xml.create_element(name)
        .with_attributes(pairs(&attributes))
        .write_empty()?;
    Ok(())
}

fn root<U: Unit>(imprint: &Imprint<U>, guid: &str) -> Attributes {
    let about = U::about();
    let tool = format!("{TOOL} {VERSION}");
    attributes([
        ("fmiVersion", "2.0"),
        ("modelName", imprint.name()),
        ("guid", guid),
        ("description", imprint.description()),
        ("version", about.version),
        ("license", about.license),
        ("generationTool", &tool),
        ("variableNamingConvention", "structured"),
        ("numberOfEventIndicators", "0"),
    ])
}

/// The attributes of the element `CoSimulation`.
pub(crate) fn capabilities<U: Unit>(about: &About<U>) -> Attributes {
    let order = about.table.highest_output_order().to_string();
    attributes([
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
    ])
}

fn log_categories<U: Unit>(xml: &mut Xml, about: &About<U>) -> io::Result<()> {
    let mut categories = Category::ALL.iter();
    categories.try_for_each(|category| {
        let description = category.description().unwrap_or(about.events);
        let named = [("name", category.name()), ("description", description)];
        empty(xml, "Category", attributes(named))
    })
}

fn unit(xml: &mut Xml, quantity: &Quantity) -> io::Result<()> {
    element(xml, "Unit", attributes([("name", quantity.unit)]), |xml| {
        let base = quantity.base.iter();
        let base = base.map(|(name, exponent)| (*name, exponent.to_string()));
        empty(xml, "BaseUnit", base.collect())?;
        quantity.display.iter().try_for_each(|(name, factor)| {
            let shown = [("name", *name), ("factor", &number(*factor))];
            empty(xml, "DisplayUnit", attributes(shown))
        })
    })
}

fn real_type(xml: &mut Xml, quantity: &Quantity) -> io::Result<()> {
    let named = attributes([("name", quantity.type_name)]);
    let real = attributes([("quantity", quantity.quantity), ("unit", quantity.unit)]);
    element(xml, "SimpleType", named, |xml| empty(xml, "Real", real))
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
                let named = [
                    ("name", item.name),
                    ("value", &value),
                    ("description", item.description),
                ];
                empty(xml, "Item", attributes(named))
            })
        })
    })
}

fn scalar_variable<U: Unit>(
    xml: &mut Xml,
    variable: &Row<U>,
    imprint: &Imprint<U>,
) -> io::Result<()> {
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
        Access::Signal(_) | Access::Input(_) => {}
        _ => named.push(("initial", "calculated".to_owned())),
    }
    let mut typed = match &variable.kind {
        Kind::Real(kind) => real_attributes(kind),
        Kind::Count { min, max } => count_attributes(*min, *max),
        Kind::Boolean => vec![],
        Kind::Enumeration(items) => attributes([("declaredType", items.type_name)]),
    };
    if let Some(value) = start_value(variable, imprint) {
        typed.push(("start", value));
    }
    element(xml, "ScalarVariable", named, |xml| {
        empty(xml, variable.kind.type_name(), typed)
    })
}

fn real_attributes(kind: &RealKind) -> Attributes {
    let texts = [
        ("declaredType", kind.quantity.map(|of| of.type_name)),
        ("quantity", kind.quantity.map(|of| of.quantity)),
        ("unit", kind.quantity.map(|of| of.unit)),
        ("displayUnit", kind.display_unit),
    ];
    let numbers = [
        ("min", kind.min),
        ("max", kind.max),
        ("nominal", kind.nominal),
    ];
    let texts = texts.map(|(name, text)| Some((name, text?.to_owned())));
    let numbers = numbers.map(|(name, value)| Some((name, number(value?))));
    texts.into_iter().chain(numbers).flatten().collect()
}

fn count_attributes(min: i32, max: Option<i32>) -> Attributes {
    let limits = [("min", Some(min)), ("max", max)];
    let texts = limits.map(|(name, limit)| Some((name, limit?.to_string())));
    texts.into_iter().flatten().collect()
}

/// The start value as it stands in the XML; outputs have none.
pub(crate) fn start_value<U: Unit>(variable: &Row<U>, imprint: &Imprint<U>) -> Option<String> {
    let value = match variable.slot() {
        Some(slot) => imprint.values()[slot.0],
        None if variable.is_output() => return None,
        None => 0.0,
    };
    Some(match variable.kind {
        Kind::Real(_) => number(value),
        Kind::Boolean => (value != 0.0).to_string(),
        Kind::Count { .. } | Kind::Enumeration(_) => (value as i32).to_string(),
    })
}

/// Shortest text that reads back as the same number.
fn number(value: f64) -> String {
    format!("{value:?}")
}

/// One `Unknown` for each output, with its dependencies; indices count variables from 1.
fn unknowns<U: Unit>(xml: &mut Xml, about: &About<U>, initial: bool) -> io::Result<()> {
    for (row, variable) in about.table.rows().enumerate() {
        let Some(depends) = variable.dependencies() else {
            continue;
        };
        let names = if initial {
            depends.initial
        } else {
            depends.inputs
        };
        let rows = names.iter().flat_map(|name| about.table.rows_of(name));
        let mut rows: Vec<_> = rows.map(|(row, _)| row).collect();
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
