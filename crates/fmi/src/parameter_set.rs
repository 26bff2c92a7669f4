//! The start values of an FMU as a parameter set of SSP 1.0 (an SSV file): names, values and units as in the model
//! description.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

use crate::description::{GENERATOR, NONE, Xml, element, empty, number, unit};
use crate::imprint::Imprint;
use crate::quantity::{Enumeration, Quantity};
use crate::unit::{Row, Unit};
use crate::variable::{Access, Kind};

const VALUES: &str = "http://ssp-standard.org/SSP1/SystemStructureParameterValues";
const COMMON: &str = "http://ssp-standard.org/SSP1/SystemStructureCommon";

/// The XML with all parameters of an imprint.
///
/// # Errors
/// If writing to memory fails.
pub fn write<U: Unit>(imprint: &Imprint<U>) -> io::Result<String> {
    write_some(imprint, |_| true)
}

/// The parameter set with some of the parameters only.
///
/// # Errors
/// If writing to memory fails.
pub fn write_some<U: Unit>(
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
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let root = [
        ("xmlns:ssv", VALUES),
        ("xmlns:ssc", COMMON),
        ("version", "1.0"),
        ("name", imprint.name()),
        ("description", imprint.description()),
        ("generationTool", GENERATOR),
    ];
    element(&mut xml, "ssv:ParameterSet", root, |xml| {
        element(xml, "ssv:Parameters", NONE, |xml| {
            parameters
                .iter()
                .try_for_each(|row| parameter(xml, row, imprint))
        })?;
        let mut used = about
            .enumerations
            .iter()
            .filter(|of| uses_type(of))
            .peekable();
        if used.peek().is_some() {
            element(xml, "ssv:Enumerations", NONE, |xml| {
                used.try_for_each(|of| {
                    let named = [("name", of.type_name), ("description", of.description)];
                    element(xml, "ssc:Enumeration", named, |xml| {
                        of.items.iter().try_for_each(|item| {
                            let value = item.value.to_string();
                            empty(xml, "ssc:Item", [("name", item.name), ("value", &value)])
                        })
                    })
                })
            })?;
        }
        element(xml, "ssv:Units", NONE, |xml| {
            let mut used = about.quantities.iter().filter(|of| uses_unit(of));
            used.try_for_each(|of| unit(xml, ["ssc:Unit", "ssc:BaseUnit"], of, |_| Ok(())))
        })
    })?;
    let mut bytes = xml.into_inner();
    bytes.push(b'\n');
    String::from_utf8(bytes).map_err(io::Error::other)
}

fn unit_of(kind: &Kind) -> Option<&'static str> {
    match kind {
        Kind::Real(real) => Some(real.quantity?.unit),
        _ => None,
    }
}

fn parameter<U: Unit>(xml: &mut Xml, row: &Row<U>, imprint: &Imprint<U>) -> io::Result<()> {
    let value = row.slot().map_or(0.0, |slot| imprint.values()[slot.0]);
    let (element_name, value) = match row.kind {
        Kind::Real(_) => ("ssv:Real", number(value)),
        Kind::Boolean => ("ssv:Boolean", (value != 0.0).to_string()),
        Kind::Count { .. } => ("ssv:Integer", (value as i32).to_string()),
        Kind::Enumeration(of) => {
            let chosen = of.items.iter().find(|item| item.value == value as i32);
            let chosen = chosen.ok_or_else(|| io::Error::other(row.name))?;
            ("ssv:Enumeration", chosen.name.to_owned())
        }
    };
    let of = match row.kind {
        Kind::Enumeration(of) => Some(("name", of.type_name)),
        _ => unit_of(&row.kind).map(|unit| ("unit", unit)),
    };
    let typed = [("value", value.as_str())].into_iter().chain(of);
    let named = [("name", row.name), ("description", row.description)];
    element(xml, "ssv:Parameter", named, |xml| {
        empty(xml, element_name, typed)
    })
}
