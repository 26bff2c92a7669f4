//! What a machine is handed on as: the FMU and the parameter set tell the same of it.

use std::collections::BTreeMap;
use std::io::{Cursor, Read};

use proptest::prelude::*;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use softstop::{Machine, Parameter, Start, Units};
use softstop_fmu::{Imprint, StartValues, description, guid_of, parameter_set};
use softstop_optimize::fmu;
use softstop_testing::machines::machines;
use softstop_testing::random::cases;

use crate::SOFTSTOP;

use crate::Outcome;

type Attributes = BTreeMap<String, String>;
/// The elements of a file in order, each with how deep it stands.
type Elements = Vec<(usize, String, Attributes)>;

/// Reads a file to its end; all its elements are closed.
fn elements(xml: &str) -> Outcome<Elements> {
    let mut reader = Reader::from_str(xml);
    let mut found = Vec::new();
    let mut depth = 0;
    let element = |depth, tag: &BytesStart<'_>| -> Outcome<_> {
        let name = tag.name().as_ref().to_owned();
        let mut attributes = Attributes::new();
        for attribute in tag.attributes() {
            let attribute = attribute?;
            let key = attribute.key.as_ref().to_owned();
            let value = attribute.value.into_owned();
            attributes.insert(key, quick_xml::escape::unescape(&value)?.into_owned());
        }
        Ok((depth, name, attributes))
    };
    loop {
        match reader.read_event()? {
            Event::Start(tag) => {
                found.push(element(depth, &tag)?);
                depth += 1;
            }
            Event::Empty(tag) => found.push(element(depth, &tag)?),
            Event::End(_) => depth -= 1,
            Event::Eof => break,
            _ => {}
        }
    }
    assert_eq!(depth, 0, "all is closed");
    Ok(found)
}

/// A variable's start value and unit, and whether it is a parameter.
type Told = (String, Option<String>, bool);

/// The variables of a model description by their names.
fn described(xml: &str) -> Outcome<BTreeMap<String, Told>> {
    let mut variables = BTreeMap::new();
    let all = elements(xml)?;
    for pair in all.windows(2) {
        let ((_, name, variable), (_, _, kind)) = (&pair[0], &pair[1]);
        if name == "ScalarVariable" {
            let start = kind.get("start").cloned().unwrap_or_default();
            let is_parameter = variable["causality"] == "parameter";
            let told = (start, kind.get("unit").cloned(), is_parameter);
            variables.insert(variable["name"].clone(), told);
        }
    }
    Ok(variables)
}

/// The parameter set names each parameter of the model description once, with its start value and unit.
fn agree(imprint: &Imprint) -> Outcome {
    let set = elements(&parameter_set::write(imprint, |_| true)?)?;
    let described = described(&description::write(imprint, &guid_of(imprint)))?;
    let parts: Vec<&str> = set
        .iter()
        .filter(|it| it.0 == 1)
        .map(|it| it.1.as_str())
        .collect();
    assert_eq!(parts, ["ssv:Parameters", "ssv:Enumerations", "ssv:Units"]);
    let named = |element: &str| -> Vec<&str> {
        let of = set.iter().filter(|it| it.1 == element);
        of.filter_map(|it| it.2.get("name").map(String::as_str))
            .collect()
    };
    let (units, types) = (named("ssc:Unit"), named("ssc:Enumeration"));
    let mut seen = Vec::new();
    for pair in set.windows(2) {
        let ((_, name, parameter), (_, kind, told)) = (&pair[0], &pair[1]);
        if name != "ssv:Parameter" {
            continue;
        }
        let name = &parameter["name"];
        let (start, unit, is_parameter) = described.get(name).ok_or(name.as_str())?;
        assert!(is_parameter, "{name}");
        match kind.as_str() {
            "ssv:Enumeration" => assert!(types.contains(&told["name"].as_str()), "{name}"),
            _ => assert_eq!(&told["value"], start, "{name}"),
        }
        assert_eq!(told.get("unit"), unit.as_ref(), "{name}");
        assert!(
            unit.as_ref()
                .is_none_or(|unit| units.contains(&unit.as_str())),
            "{name}"
        );
        seen.push(name.clone());
    }
    let expected: Vec<_> = described
        .iter()
        .filter(|it| it.1.2)
        .map(|it| it.0.clone())
        .collect();
    seen.sort();
    assert_eq!(seen, expected);
    Ok(())
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn parameter_sets_agree_with_the_model_description(scene in machines(), stiffness in 1e3..1e7f64) {
        let scene = scene.in_units(Units { mass: 120.0, stiffness, force: 9e3 })?;
        if let Ok(values) = StartValues::from_scene(&scene, Start::new(0.0, 1.0)) {
            let imprint = Imprint::from(values).named("a <press> & \"its\" stop")?;
            agree(&imprint).map_err(|error| TestCaseError::fail(error.to_string()))?;
        }
    }
}

/// A press in SI units, its drive in Hz.
const PRESS: &str = "
name = \"press 7\"
description = \"Press for 2 mm strip\"
mass = 120.0
stiffness = 2.4e6
damping = 600.0
clearance = 0.02
contact.damping = 2500.0
excitation = { amplitude = 9e3, frequency_hz = 24.5 }
stop = { model = \"kelvinVoigt\", stiffness = 4e7 }
piercing = { stiffness = 5e7, friction = 5.5e7, thickness = 0.002, travel = 0.002 }
";

#[test]
fn the_fmu_of_a_press_has_its_name_and_si_start_values() -> Outcome {
    let press = Machine::from_toml(PRESS)?;
    let archive = fmu::archive(
        &fmu::library(fmu::Standard::Fmi2)?,
        &press,
        Start::new(0.001, 2.5),
    )?;
    let mut archive = zip::ZipArchive::new(Cursor::new(archive))?;
    let mut xml = String::new();
    archive
        .by_name("modelDescription.xml")?
        .read_to_string(&mut xml)?;
    let all = elements(&xml)?;
    assert_eq!(all[0].2["modelName"], "press 7");
    assert_eq!(all[0].2["description"], "Press for 2 mm strip");
    let variables = described(&xml)?;
    for parameter in press.parameters() {
        let (start, unit, _) = &variables[parameter.name()];
        let value = parameter.get(&press.scene).ok_or("a value")?;
        assert_eq!(
            start.parse::<f64>()?.to_bits(),
            value.to_bits(),
            "{}",
            parameter.name()
        );
        let si = parameter.about().dimension.unit().replace(' ', ".");
        assert_eq!(unit.clone().unwrap_or_default(), si);
    }
    assert_eq!(variables["stop.model"].0, "2");
    assert_eq!(variables["initial.velocity"].0, "2.5");
    assert_eq!(
        Parameter::Frequency.get(&press.scene),
        Some(24.5 * std::f64::consts::TAU)
    );
    Ok(())
}

#[test]
fn the_fmu_for_fmi_3_tells_the_same() -> Outcome {
    let folder = tempfile::tempdir()?;
    let [machine, place] = ["press.toml", "press.fmu"].map(|name| folder.path().join(name));
    std::fs::write(&machine, PRESS)?;
    let packed = |version: &[&str]| -> Outcome<String> {
        let [machine, place] = [&machine, &place].map(|path| path.to_str().unwrap_or_default());
        SOFTSTOP.text(&[&["fmu", machine, "--output", place], version].concat());
        let bytes = std::fs::read(place)?;
        let mut archive = zip::ZipArchive::new(Cursor::new(bytes))?;
        let mut xml = String::new();
        archive
            .by_name("modelDescription.xml")?
            .read_to_string(&mut xml)?;
        Ok(xml)
    };
    let (two, three) = (packed(&["--fmi", "2"])?, packed(&["--fmi", "3"])?);
    assert_eq!(two, packed(&[])?);
    let root = |xml: &str, name: &str| {
        Ok::<_, Box<dyn std::error::Error>>(elements(xml)?[0].2[name].clone())
    };
    assert_eq!(root(&three, "fmiVersion")?, "3.0");
    assert_eq!(root(&two, "guid")?, root(&three, "instantiationToken")?);
    let variables = elements(&three)?
        .into_iter()
        .filter_map(|(_, _, variable)| {
            let causality = variable
                .get("causality")
                .filter(|it| *it != "independent")?;
            let start = variable.get("start").cloned().unwrap_or_default();
            let told = (
                start,
                variable.get("unit").cloned(),
                causality == "parameter",
            );
            Some((variable["name"].clone(), told))
        });
    // Model exchange has indicators besides.
    let is_indicator = |name: &str| name.starts_with("event.indicator[");
    let (indicators, variables): (Vec<_>, Vec<_>) = variables.partition(|it| is_indicator(&it.0));
    assert_eq!(indicators.len(), 3);
    assert_eq!(described(&two)?, variables.into_iter().collect());
    Ok(())
}
