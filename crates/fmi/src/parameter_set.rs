//! The start values of an FMU as a parameter set of SSP 1.0 (an SSV file): names, values and units as in the model
//! description.

use std::io;

use crate::description::{GENERATOR, start_value, unit};
use crate::element::Element;
use crate::imprint::Imprint;
use crate::quantity::{Enumeration, Quantity};
use crate::unit::{Row, Unit};
use crate::variable::{Access, Kind};

const VALUES: &str = "http://ssp-standard.org/SSP1/SystemStructureParameterValues";
const COMMON: &str = "http://ssp-standard.org/SSP1/SystemStructureCommon";

/// The XML with those parameters of an imprint that are wanted.
///
/// # Errors
/// If the number of an enumeration is none of its items; the error names the parameter.
pub fn write<U: Unit>(
    imprint: &Imprint<U>,
    wanted: impl Fn(&Row<U>) -> bool,
) -> io::Result<String> {
    let about = U::about();
    let is_parameter =
        |row: &&'static Row<U>| matches!(row.access, Access::Parameter { .. }) && wanted(row);
    let parameters: Vec<&Row<U>> = about.table.rows().filter(is_parameter).collect();
    let uses_unit = |of: &Quantity| {
        parameters
            .iter()
            .any(|row| unit_of(&row.kind) == Some(of.unit))
    };
    let uses_type = |of: &Enumeration| {
        let mut kinds = parameters.iter().map(|row| &row.kind);
        kinds.any(|kind| matches!(kind, Kind::Enumeration(own) if own.type_name == of.type_name))
    };
    let enumerations = about.enumerations.iter().filter(|of| uses_type(of));
    let enumerations: Vec<_> = enumerations.map(|of| enumeration(of)).collect();
    let quantities = about.quantities.iter().filter(|of| uses_unit(of));
    let units = quantities.map(|of| unit(["ssc:Unit", "ssc:BaseUnit"], of));
    let named = parameters.iter().map(|row| parameter(row, imprint));
    let named = named.collect::<io::Result<Vec<_>>>()?;
    let has_enumerations = !enumerations.is_empty();
    let root = Element::new("ssv:ParameterSet").set_all([
        ("xmlns:ssv", VALUES),
        ("xmlns:ssc", COMMON),
        ("version", "1.0"),
        ("name", imprint.name()),
        ("description", imprint.description()),
        ("generationTool", GENERATOR),
    ]);
    let root = root
        .with([Element::new("ssv:Parameters").with(named)])
        .with(has_enumerations.then(|| Element::new("ssv:Enumerations").with(enumerations)))
        .with([Element::new("ssv:Units").with(units)]);
    Ok(root.to_document())
}

fn enumeration(of: &Enumeration) -> Element {
    let items = of.items.iter().map(|item| {
        let named = Element::new("ssc:Item").set("name", item.name);
        named.set("value", item.value)
    });
    Element::new("ssc:Enumeration")
        .set_all([("name", of.type_name), ("description", of.description)])
        .with(items)
}

fn unit_of(kind: &Kind) -> Option<&'static str> {
    match kind {
        Kind::Real(real) => Some(real.quantity?.unit),
        _ => None,
    }
}

fn parameter<U: Unit>(row: &Row<U>, imprint: &Imprint<U>) -> io::Result<Element> {
    let value = start_value(row, imprint).unwrap_or_default();
    let (element_name, value) = match row.kind {
        Kind::Real(_) => ("ssv:Real", value),
        Kind::Boolean => ("ssv:Boolean", value),
        Kind::Count { .. } => ("ssv:Integer", value),
        Kind::Enumeration(of) => {
            let chosen = of.items.iter().find(|item| item.value.to_string() == value);
            let chosen = chosen.ok_or_else(|| io::Error::other(row.name))?;
            ("ssv:Enumeration", chosen.name.to_owned())
        }
    };
    let of = match row.kind {
        Kind::Enumeration(of) => Some(("name", of.type_name)),
        _ => unit_of(&row.kind).map(|unit| ("unit", unit)),
    };
    let typed = Element::new(element_name).set("value", value).set_all(of);
    let named = Element::new("ssv:Parameter").set("name", row.name);
    Ok(named.set("description", row.description).with([typed]))
}
