//! The model description, written from what a unit says of itself and from its table of variables.

use std::borrow::Cow;
use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

use crate::imprint::Imprint;
use crate::log::{Category, LOG_ALL};
use crate::quantity::{Enumeration, Quantity};
use crate::unit::{About, Row, Unit};
use crate::variable::{Access, Kind, RealKind};

/// The tool that writes units, and its version.
const TOOL: &str = "softstop";
const VERSION: &str = env!("CARGO_PKG_VERSION");
pub(crate) const GENERATOR: &str = concat!("softstop ", env!("CARGO_PKG_VERSION"));
const INDENT: usize = 2;

pub(crate) type Xml = Writer<Vec<u8>>;
type Attributes = Vec<(&'static str, String)>;
pub(crate) const NONE: [(&str, &str); 0] = [];

/// The XML of the FMU with this imprint and this GUID.
///
/// # Errors
/// If writing to memory fails.
pub fn write<U: Unit>(imprint: &Imprint<U>, guid: &str) -> io::Result<String> {
    let about = U::about();
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', INDENT);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let root = [
        ("fmiVersion", "2.0"),
        ("modelName", imprint.name()),
        ("guid", guid),
        ("description", imprint.description()),
        ("author", about.author),
        ("version", about.version),
        ("copyright", about.copyright),
        ("license", about.license),
        ("generationTool", GENERATOR),
        ("generationDateAndTime", about.date),
        ("variableNamingConvention", "structured"),
        ("numberOfEventIndicators", "0"),
    ];
    element(&mut xml, "fmiModelDescription", root, |xml| {
        empty(xml, "CoSimulation", capabilities(about))?;
        element(xml, "UnitDefinitions", NONE, |xml| {
            about
                .quantities
                .iter()
                .try_for_each(|of| unit(xml, ["Unit", "BaseUnit"], of, |xml| shown(xml, of)))
        })?;
        element(xml, "TypeDefinitions", NONE, |xml| {
            let mut quantities = about.quantities.iter();
            quantities.try_for_each(|of| real_type(xml, of))?;
            let mut enumerations = about.enumerations.iter();
            enumerations.try_for_each(|of| enumeration_type(xml, of))
        })?;
        element(xml, "LogCategories", NONE, |xml| log_categories(xml, about))?;
        let experiment = about.experiment.iter().copied();
        empty(xml, "DefaultExperiment", experiment)?;
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
    })?;
    let mut bytes = xml.into_inner();
    bytes.push(b'\n');
    String::from_utf8(bytes).map_err(io::Error::other)
}

pub(crate) fn element<'a, V: Into<Cow<'a, str>>>(
    xml: &mut Xml,
    name: &'static str,
    attributes: impl IntoIterator<Item = (&'static str, V)>,
    content: impl FnOnce(&mut Xml) -> io::Result<()>,
) -> io::Result<()> {
    let attributes = attributes.into_iter();
    xml.create_element(name)
        .with_attributes(attributes.map(|(name, value)| (name, value.into())))
        .write_inner_content(content)?;
    Ok(())
}

pub(crate) fn empty<'a, V: Into<Cow<'a, str>>>(
    xml: &mut Xml,
    name: &'static str,
    attributes: impl IntoIterator<Item = (&'static str, V)>,
) -> io::Result<()> {
    let attributes = attributes.into_iter();
    xml.create_element(name)
        .with_attributes(attributes.map(|(name, value)| (name, value.into())))
        .write_empty()?;
    Ok(())
}

/// The attributes of the element `CoSimulation`.
pub(crate) fn capabilities<U: Unit>(about: &About<U>) -> Vec<(&'static str, String)> {
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

/// The categories of the unit by their own names and by the standard's; a unit without events has none for them.
fn log_categories<U: Unit>(xml: &mut Xml, about: &About<U>) -> io::Result<()> {
    let told = Category::ALL.map(|it| (it, it.description().unwrap_or(about.events)));
    let told = told
        .into_iter()
        .filter(|(_, description)| !description.is_empty());
    let own = told
        .clone()
        .map(|(category, description)| (category.name(), description));
    let standard = told.flat_map(|(category, description)| {
        let names = category.standard_names().iter();
        names.map(move |name| (*name, description))
    });
    let all = [(LOG_ALL, "all of these")];
    let mut categories = own.chain(standard).chain(all);
    categories.try_for_each(|(name, description)| {
        empty(
            xml,
            "Category",
            [("name", name), ("description", description)],
        )
    })
}

/// A unit and its base units, in elements of these names.
pub(crate) fn unit(
    xml: &mut Xml,
    [name, base]: [&'static str; 2],
    quantity: &Quantity,
    more: impl FnOnce(&mut Xml) -> io::Result<()>,
) -> io::Result<()> {
    element(xml, name, [("name", quantity.unit)], |xml| {
        let exponents = quantity.base.iter();
        let exponents = exponents.map(|(name, exponent)| (*name, exponent.to_string()));
        empty(xml, base, exponents)?;
        more(xml)
    })
}

/// The units in which a quantity may be shown.
fn shown(xml: &mut Xml, quantity: &Quantity) -> io::Result<()> {
    quantity.display.iter().try_for_each(|(name, factor)| {
        let shown = [("name", *name), ("factor", &number(*factor))];
        empty(xml, "DisplayUnit", shown)
    })
}

fn real_type(xml: &mut Xml, quantity: &Quantity) -> io::Result<()> {
    let named = [("name", quantity.type_name)];
    let real = [("quantity", quantity.quantity), ("unit", quantity.unit)];
    element(xml, "SimpleType", named, |xml| empty(xml, "Real", real))
}

fn enumeration_type(xml: &mut Xml, of: &Enumeration) -> io::Result<()> {
    let named = [("name", of.type_name), ("description", of.description)];
    element(xml, "SimpleType", named, |xml| {
        element(xml, "Enumeration", NONE, |xml| {
            of.items.iter().try_for_each(|item| {
                let value = item.value.to_string();
                let named = [
                    ("name", item.name),
                    ("value", &value),
                    ("description", item.description),
                ];
                empty(xml, "Item", named)
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
    let initial = match variable.access {
        Access::Parameter { .. } => Some("exact"),
        Access::Signal(_) | Access::Input(_) => None,
        _ => Some("calculated"),
    };
    let named = [
        ("name", variable.name),
        ("valueReference", &reference),
        ("description", variable.description),
        ("causality", variable.causality()),
        ("variability", variable.variability()),
    ];
    let named = named.into_iter().chain(initial.map(|it| ("initial", it)));
    let typed = match &variable.kind {
        Kind::Real(kind) => real_attributes(kind),
        Kind::Count { min, max } => count_attributes(*min, *max),
        Kind::Boolean => vec![],
        Kind::Enumeration(items) => vec![("declaredType", items.type_name.to_owned())],
    };
    let start = start_value(variable, imprint).map(|value| ("start", value));
    let typed = typed.into_iter().chain(start);
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
pub(crate) fn number(value: f64) -> String {
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
        let known = [
            ("index", (row + 1).to_string()),
            ("dependencies", indices.join(" ")),
            ("dependenciesKind", kinds.join(" ")),
        ];
        empty(xml, "Unknown", known)?;
    }
    Ok(())
}
