//! The model description, written from what a unit says of itself and from its table of variables.
//!
//! Here is what the descriptions of both standards have in common.

pub(crate) mod v2;
pub(crate) mod v3;

use std::borrow::Cow;
use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

use crate::imprint::Imprint;
use crate::log::{Category, LOG_ALL};
use crate::quantity::{Item, Quantity};
use crate::solving::space_of;
use crate::standard::Standard;
use crate::unit::{About, Row, State, Unit};
use crate::variable::{Access, Dependencies, Kind, RealKind};

/// The tool that writes units, and its version.
const TOOL: &str = "softstop";
const VERSION: &str = env!("CARGO_PKG_VERSION");
pub(crate) const GENERATOR: &str = concat!("softstop ", env!("CARGO_PKG_VERSION"));
const INDENT: usize = 2;

pub(crate) type Xml = Writer<Vec<u8>>;
type Attributes = Vec<(&'static str, String)>;
pub(crate) const NONE: [(&str, &str); 0] = [];

/// The XML of the FMU with this imprint and this GUID, by the imprint's standard.
///
/// # Errors
/// If writing to memory fails.
pub fn write<U: Unit>(imprint: &Imprint<U>, guid: &str) -> io::Result<String> {
    match imprint.standard() {
        Standard::Fmi2 => v2::write(imprint, guid, imprint.has_exchange()),
        Standard::Fmi3 => v3::write(imprint, guid),
    }
}

/// The attributes of the element `CoSimulation`.
pub(crate) fn capabilities<U: Unit>(standard: Standard) -> Attributes {
    match standard {
        Standard::Fmi2 => v2::capabilities(U::about()),
        Standard::Fmi3 => v3::capabilities::<U>(),
    }
}

/// Writes a whole document with this root.
pub(crate) fn write_document<'a>(
    root: &'static str,
    attributes: impl IntoIterator<Item = (&'static str, &'a str)>,
    content: impl FnOnce(&mut Xml) -> io::Result<()>,
) -> io::Result<String> {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', INDENT);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    element(&mut xml, root, attributes, content)?;
    let mut bytes = xml.into_inner();
    bytes.push(b'\n');
    String::from_utf8(bytes).map_err(io::Error::other)
}

/// What the root says in both standards, the fingerprint under this name included.
fn root<'a, U: Unit>(
    version: &'static str,
    imprint: &'a Imprint<U>,
    (name, guid): (&'static str, &'a str),
) -> [(&'static str, &'a str); 11] {
    let about = U::about();
    [
        ("fmiVersion", version),
        ("modelName", imprint.name()),
        (name, guid),
        ("description", imprint.description()),
        ("author", about.author),
        ("version", about.version),
        ("copyright", about.copyright),
        ("license", about.license),
        ("generationTool", GENERATOR),
        ("generationDateAndTime", about.date),
        ("variableNamingConvention", "structured"),
    ]
}

/// The units of quantities.
fn units(xml: &mut Xml, quantities: &[&'static Quantity]) -> io::Result<()> {
    element(xml, "UnitDefinitions", NONE, |xml| {
        quantities
            .iter()
            .try_for_each(|of| unit(xml, ["Unit", "BaseUnit"], of, |xml| shown(xml, of)))
    })
}

/// Log categories and the default experiment.
fn log_and_experiment<U: Unit>(xml: &mut Xml, about: &About<U>) -> io::Result<()> {
    element(xml, "LogCategories", NONE, |xml| log_categories(xml, about))?;
    let experiment = about.experiment.iter().copied();
    empty(xml, "DefaultExperiment", experiment)
}

pub(crate) fn element<'a, V: Into<Cow<'a, str>>>(
    xml: &mut Xml,
    name: &'static str,
    attributes: impl IntoIterator<Item = (&'static str, V)>,
    content: impl FnOnce(&mut Xml) -> io::Result<()>,
) -> io::Result<()> {
    let mut content = Some(content);
    let mut content = |xml: &mut Xml| content.take().map_or(Ok(()), |content| content(xml));
    write_element(
        xml,
        name,
        collect_attributes(attributes),
        Some(&mut content),
    )
}

pub(crate) fn empty<'a, V: Into<Cow<'a, str>>>(
    xml: &mut Xml,
    name: &'static str,
    attributes: impl IntoIterator<Item = (&'static str, V)>,
) -> io::Result<()> {
    write_element(xml, name, collect_attributes(attributes), None)
}

/// What writes the content of an element.
type ContentWriter<'a> = &'a mut dyn FnMut(&mut Xml) -> io::Result<()>;
/// Names and values of attributes.
type ElementAttributes<'a> = Vec<(&'static str, Cow<'a, str>)>;

fn collect_attributes<'a, V: Into<Cow<'a, str>>>(
    attributes: impl IntoIterator<Item = (&'static str, V)>,
) -> ElementAttributes<'a> {
    let attributes = attributes.into_iter();
    attributes
        .map(|(name, value)| (name, value.into()))
        .collect()
}

/// Writes an element with its content, or without one. What is generic about it is left to its callers: there are many.
fn write_element(
    xml: &mut Xml,
    name: &'static str,
    attributes: ElementAttributes<'_>,
    content: Option<ContentWriter<'_>>,
) -> io::Result<()> {
    let element = xml.create_element(name).with_attributes(attributes);
    match content {
        Some(content) => element.write_inner_content(content)?,
        None => element.write_empty()?,
    };
    Ok(())
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
        None if variable.is_calculated() || matches!(variable.access, Access::Time) => return None,
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

/// The name of a quantity's type, and what the type says.
fn real_type(quantity: &Quantity) -> [(&'static str, &str); 3] {
    [
        ("name", quantity.type_name),
        ("quantity", quantity.quantity),
        ("unit", quantity.unit),
    ]
}

/// The items of an enumeration.
fn items(xml: &mut Xml, items: &[Item]) -> io::Result<()> {
    items.iter().try_for_each(|item| {
        let value = item.value.to_string();
        let named = [
            ("name", item.name),
            ("value", &value),
            ("description", item.description),
        ];
        empty(xml, "Item", named)
    })
}

/// What a variable says whatever its type.
fn named<U: Unit>(variable: &Row<U>) -> impl Iterator<Item = (&'static str, String)> {
    let initial = match variable.access {
        Access::Parameter { .. } => Some("exact"),
        Access::Signal(_) | Access::Input(_) | Access::Time => None,
        _ => Some("calculated"),
    };
    let named = [
        ("name", variable.name.to_owned()),
        ("valueReference", variable.reference.to_string()),
        ("description", variable.description.to_owned()),
        ("causality", variable.causality().to_owned()),
        ("variability", variable.variability().to_owned()),
    ];
    let initial = initial.map(|it| ("initial", it.to_owned()));
    named.into_iter().chain(initial)
}

/// What it says by its type, its start value included.
fn typed<U: Unit>(variable: &Row<U>, imprint: &Imprint<U>) -> Attributes {
    let mut typed = match &variable.kind {
        Kind::Real(kind) => real_attributes(kind),
        Kind::Count { min, max } => count_attributes(*min, *max),
        Kind::Boolean => vec![],
        Kind::Enumeration(items) => vec![("declaredType", items.type_name.to_owned())],
    };
    typed.extend(start_value(variable, imprint).map(|value| ("start", value)));
    typed
}

/// Lists of the model structure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Unknowns {
    Outputs,
    /// The derivatives of the states, in their order.
    Derivatives,
    /// Outputs at the start.
    Initial,
}

/// A row counted from 0, and its variable.
type Counted<U> = (usize, &'static Row<U>);
/// What a list tells of an unknown, and what that depends on.
type Unknown<U> = (usize, &'static Row<U>, Vec<Counted<U>>);

impl Unknowns {
    /// Each with what it depends on, in the order of the rows.
    fn each<U: Unit>(self, exchange: bool, arrays: bool) -> Vec<Unknown<U>> {
        let listed: Vec<_> = match self {
            Self::Derivatives => {
                let states = space_of::<U>().states.iter();
                states
                    .filter_map(|state| row_of(state.derivative))
                    .collect()
            }
            _ => U::about().table.rows().enumerate().collect(),
        };
        let with_dependencies = |(row, variable): Counted<U>| {
            let depends = variable.dependencies()?;
            let mut rows = match self {
                Self::Initial => rows_of(depends.initial),
                _ => rows_of(depends.inputs),
            };
            if exchange && self != Self::Initial {
                rows.extend(states_behind(variable, depends, self));
            }
            rows.retain(|(_, row)| !(arrays && matches!(row.element(), Some((_, 2..)))));
            rows.sort_unstable_by_key(|(row, _)| *row);
            Some((row, variable, rows))
        };
        listed.into_iter().filter_map(with_dependencies).collect()
    }
}

fn row_of<U: Unit>(reference: u32) -> Option<Counted<U>> {
    let mut rows = U::about().table.rows().enumerate();
    rows.find(|(_, row)| row.reference == reference)
}

fn rows_of<U: Unit>(names: &[&str]) -> Vec<Counted<U>> {
    let rows = names.iter().flat_map(|name| U::about().table.rows_of(name));
    rows.collect()
}

/// The states that a variable depends on: those with whose start it begins. A state as an output depends on itself.
fn states_behind<U: Unit>(
    variable: &Row<U>,
    depends: &Dependencies,
    list: Unknowns,
) -> Vec<Counted<U>> {
    let states = space_of::<U>().states;
    let is_state = states.iter().any(|it| it.value == variable.reference);
    if is_state && list == Unknowns::Outputs {
        return row_of(variable.reference).into_iter().collect();
    }
    let begins_with = |state: &&State| {
        let start = U::about().table.by_reference(state.start);
        start.is_some_and(|start| depends.initial.contains(&start.name))
    };
    let behind = states.iter().filter(begins_with);
    behind.filter_map(|state| row_of(state.value)).collect()
}

/// What a variable says as a state, and as the derivative of one, which `name` tells.
fn of_state<U: Unit>(variable: &Row<U>, name: impl Fn(u32) -> String) -> Attributes {
    let states = || space_of::<U>().states.iter();
    let is_state = states().any(|state| state.value == variable.reference);
    let state = states().find(|state| state.derivative == variable.reference);
    let derived = state.map(|state| ("derivative", name(state.value)));
    let reinit = is_state.then(|| ("reinit", "true".to_owned()));
    reinit.into_iter().chain(derived).collect()
}

/// An array of parameters that is one variable.
pub(crate) struct Array {
    pub name: &'static str,
    /// The start values of its elements.
    pub starts: Vec<String>,
}

/// The array that a variable is the first element of, in an FMU that tells of arrays.
pub(crate) fn array_of<U: Unit>(row: &Row<U>, imprint: &Imprint<U>) -> Option<Array> {
    let (name, _) = row.element().filter(|_| imprint.has_arrays())?;
    let elements = U::about().table.rows_of(name);
    let starts = elements
        .filter_map(|(_, row)| start_value(row, imprint))
        .collect();
    Some(Array { name, starts })
}

/// The variables of a description: what is local is for model exchange, and the first element of an array of parameters may
/// stand for all.
pub(crate) fn rows_told<U: Unit>(
    exchange: bool,
    arrays: bool,
) -> impl Iterator<Item = &'static Row<U>> {
    let is_told = move |row: &&Row<U>| {
        let is_later = matches!(row.element(), Some((_, 2..)));
        (exchange || !matches!(row.access, Access::Local(_))) && !(arrays && is_later)
    };
    U::about().table.rows().filter(is_told)
}
