//! The model description, written from what a unit says of itself and from its table of variables.
//!
//! Here is what the descriptions of both standards have in common.

pub(crate) mod v2;
pub(crate) mod v3;

use crate::element::{Attributes, Element};
use crate::imprint::Imprint;
use crate::log::{Category, LOG_ALL};
use crate::quantity::{Enumeration, Item, Quantity};
use crate::solving::space_of;
use crate::standard::Standard;
use crate::unit::{About, Row, State, Unit};
use crate::variable::{Access, Dependencies, Kind};

/// The tool that writes units, with its version.
const TOOL: &str = "softstop";
pub(crate) const GENERATOR: &str = concat!("softstop ", env!("CARGO_PKG_VERSION"));

/// The XML of the FMU with this imprint and this GUID, by the imprint's standard.
pub fn write<U: Unit>(imprint: &Imprint<U>, guid: &str) -> String {
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

/// The root, without its content, of a description by a version of the standard, with the fingerprint under this name.
fn root<U: Unit>(
    version: &str,
    imprint: &Imprint<U>,
    (name, guid): (&'static str, &str),
) -> Element {
    let about = U::about();
    Element::new("fmiModelDescription").set_all([
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
    ])
}

/// An element for what tools say beyond the standard, with this tool's version.
fn annotations([list, annotation, key]: [&'static str; 3]) -> Element {
    let version = Element::new(TOOL).set("version", env!("CARGO_PKG_VERSION"));
    Element::new(list).with([Element::new(annotation).set(key, TOOL).with([version])])
}

/// The units of quantities.
fn units(quantities: &[&'static Quantity]) -> Element {
    let units = quantities.iter().map(|of| {
        let shown = of.display.iter().map(|(name, factor)| {
            let shown = Element::new("DisplayUnit").set("name", name);
            shown.set("factor", number(*factor))
        });
        unit(["Unit", "BaseUnit"], of).with(shown)
    });
    Element::new("UnitDefinitions").with(units)
}

/// Log categories and the default experiment.
fn log_and_experiment<U: Unit>(about: &About<U>) -> [Element; 2] {
    let experiment = about.experiment.iter().copied();
    [
        Element::new("LogCategories").with(log_categories(about)),
        Element::new("DefaultExperiment").set_all(experiment),
    ]
}

/// The categories of the unit by their own names and by the standard's; a unit without events has none for them.
fn log_categories<U: Unit>(about: &About<U>) -> impl Iterator<Item = Element> {
    let told = Category::ALL.map(|it| {
        let category = it.declaration();
        (category, category.description.unwrap_or(about.events))
    });
    let told = told
        .into_iter()
        .filter(|(_, description)| !description.is_empty());
    let own = told
        .clone()
        .map(|(category, description)| (category.name, description));
    let standard = told.flat_map(|(category, description)| {
        let names = category.standard_names.iter();
        names.map(move |name| (*name, description))
    });
    let all = own.chain(standard).chain([(LOG_ALL, "all of these")]);
    all.map(|(name, description)| {
        Element::new("Category").set_all([("name", name), ("description", description)])
    })
}

/// A unit and its base units, in elements of these names.
pub(crate) fn unit([name, base]: [&'static str; 2], quantity: &Quantity) -> Element {
    let exponents = Element::new(base).set_all(quantity.base.iter().copied());
    Element::new(name)
        .set("name", quantity.unit)
        .with([exponents])
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

/// An enumeration in an element of this name.
fn enumeration(name: &'static str, of: &Enumeration) -> Element {
    Element::new(name).set_all([("name", of.type_name), ("description", of.description)])
}

/// The items of an enumeration.
fn items(items: &[Item]) -> impl Iterator<Item = Element> {
    items.iter().map(|item| {
        let named = Element::new("Item").set("name", item.name);
        named
            .set("value", item.value)
            .set("description", item.description)
    })
}

/// An element with what a variable says whatever its type, its own name or that of its array among it.
fn named<U: Unit>(element: &'static str, name: &str, variable: &Row<U>) -> Element {
    let initial = match variable.access {
        Access::Parameter { .. } => Some("exact"),
        Access::Signal(_) | Access::Input(_) | Access::Time => None,
        _ => Some("calculated"),
    };
    Element::new(element)
        .set("name", name)
        .set("valueReference", variable.reference)
        .set("description", variable.description)
        .set("causality", variable.causality())
        .set("variability", variable.variability())
        .set_all(initial.map(|it| ("initial", it)))
}

/// Adds what a variable says by its type, and its start value.
fn typed<U: Unit>(element: Element, variable: &Row<U>, start: Option<String>) -> Element {
    let element = match &variable.kind {
        Kind::Real(kind) => {
            let declared = kind.quantity.map(|of| ("declaredType", of.type_name));
            let quantity = kind
                .quantity
                .map(|of| [("quantity", of.quantity), ("unit", of.unit)]);
            let limits = [
                ("min", kind.min),
                ("max", kind.max),
                ("nominal", kind.nominal),
            ];
            let limits = limits.map(|(name, limit)| Some((name, number(limit?))));
            element
                .set_all(declared)
                .set_all(quantity.into_iter().flatten())
                .set_all(kind.display_unit.map(|unit| ("displayUnit", unit)))
                .set_all(limits.into_iter().flatten())
        }
        Kind::Count { min, max } => element.set("min", min).set_all(max.map(|max| ("max", max))),
        Kind::Boolean => element,
        Kind::Enumeration(items) => element.set("declaredType", items.type_name),
    };
    element.set_all(start.map(|start| ("start", start)))
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

/// An element that tells of an unknown, and of what that depends on.
fn dependent(
    name: &'static str,
    (key, unknown): (&'static str, impl ToString),
    knowns: impl Iterator<Item = impl ToString>,
) -> Element {
    let knowns: Vec<_> = knowns.map(|known| known.to_string()).collect();
    Element::new(name)
        .set(key, unknown)
        .set("dependencies", knowns.join(" "))
        .set(
            "dependenciesKind",
            vec!["dependent"; knowns.len()].join(" "),
        )
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

/// Adds what a variable says as a state, and as the derivative of one, which `name` tells.
fn of_state<U: Unit>(element: Element, variable: &Row<U>, name: impl Fn(u32) -> String) -> Element {
    let states = || space_of::<U>().states.iter();
    let is_state = states().any(|state| state.value == variable.reference);
    let state = states().find(|state| state.derivative == variable.reference);
    element
        .set_all(is_state.then_some(("reinit", "true")))
        .set_all(state.map(|state| ("derivative", name(state.value))))
}

/// A variable as a description has it: an array of parameters, in an FMU that tells of arrays, by its first element.
pub(crate) struct Listed {
    pub name: &'static str,
    /// The start values of all elements.
    pub start: Option<String>,
    /// The number of elements of an array.
    pub length: Option<usize>,
}

impl Listed {
    pub fn of<U: Unit>(row: &Row<U>, imprint: &Imprint<U>) -> Self {
        let Some((name, _)) = row.element().filter(|_| imprint.has_arrays()) else {
            let (name, start) = (row.name, start_value(row, imprint));
            return Self {
                name,
                start,
                length: None,
            };
        };
        let elements = U::about().table.rows_of(name);
        let starts: Vec<_> = elements
            .filter_map(|(_, row)| start_value(row, imprint))
            .collect();
        Self {
            name,
            start: Some(starts.join(" ")),
            length: Some(starts.len()),
        }
    }
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
