//! Reference results of a packed unit, by the layered standard FMI-LS-REF: an experiment, and what the outputs are in it.

use std::iter::once;

use crate::description::number;
use crate::element::Element;
use crate::imprint::Imprint;
use crate::unit::{Advance, Events, Row, Unit};
use crate::variable::Access;

const FOLDER: &str = "extra/org.fmi-standard.fmi-ls-ref";
const EXPERIMENT: &str = "experiment.exp";
const RESULTS: &str = "reference.csv";

/// Communication steps of the experiment, which begins at 0, and how long each is in s.
const STEPS: u32 = 100;
const STEP: f64 = 0.1;

/// The files of the layered standard, by their places in the package; none if the unit cannot complete the experiment.
pub(crate) fn files<U: Unit>(imprint: &Imprint<U>) -> Vec<(String, Vec<u8>)> {
    let Some(results) = results(imprint) else {
        return Vec::new();
    };
    let files = [
        ("fmi-ls-manifest.xml", manifest()),
        (EXPERIMENT, experiment()),
        (RESULTS, results),
    ];
    let files = files.map(|(name, text)| (format!("{FOLDER}/{name}"), text.into_bytes()));
    files.into()
}

/// Time and all outputs at each communication point, as CSV.
fn results<U: Unit>(imprint: &Imprint<U>) -> Option<String> {
    let outputs = U::about().table.rows().filter(|row| row.is_output());
    let outputs: Vec<_> = outputs.collect();
    let names = once("time").chain(outputs.iter().map(|row| row.name));
    let names: Vec<_> = names.map(|name| format!("{name:?}")).collect();
    let mut lines = vec![names.join(",")];
    let mut unit = U::begin(imprint.values(), 0.0).ok()?;
    for step in 0..=STEPS {
        let time = f64::from(step) * STEP;
        let advance = match step {
            0 => Advance::Arrived,
            _ => unit.advance(time, None, &mut Events::default()).ok()?,
        };
        if !matches!(advance, Advance::Arrived) {
            return None;
        }
        let values = outputs.iter().map(|row| value(row, &unit));
        let values: Vec<_> = once(format!("{time:?}")).chain(values).collect();
        lines.push(values.join(","));
    }
    Some(lines.join("\n") + "\n")
}

fn value<U: Unit>(row: &Row<U>, unit: &U) -> String {
    match row.access {
        Access::Continuous { value, .. } | Access::Discrete { value, .. } => {
            format!("{:?}", value(unit))
        }
        Access::Integer { value, .. } => value(unit).to_string(),
        _ => String::new(),
    }
}

fn manifest() -> String {
    let related = |kind, source, role, description| {
        let file = Element::new("Related").set("type", kind);
        file.set_all([
            ("source", source),
            ("role", role),
            ("description", description),
        ])
    };
    let experiment = related(
        "application/x-ma-hs-experiments",
        EXPERIMENT,
        "experiment/smoke-test",
        "The unit with its start values, without inputs",
    );
    let meaning = "All outputs at all communication points of the experiment";
    let results = related("text/csv", RESULTS, "result", meaning);
    Element::new("fmiReferences")
        .set("xmlns:fmi-ls", "http://fmi-standard.org/fmi-ls-manifest")
        .set("fmi-ls:fmi-ls-name", "org.fmi-standard.fmi-ls-ref")
        .set("fmi-ls:fmi-ls-version", "1.0.0-alpha.1")
        .set(
            "fmi-ls:fmi-ls-description",
            "Layered Standard providing information on related files included in an FMU.",
        )
        .with([experiment, results])
        .to_document()
}

fn experiment() -> String {
    let times = [
        ("startTime", 0.0),
        ("stopTime", f64::from(STEPS) * STEP),
        ("stepSize", STEP),
    ];
    let times = times.map(|(name, value)| (name, number(value)));
    let content = [
        Element::new("TransientSimulation").set_all(times),
        Element::new("References").set("source", RESULTS),
    ];
    let experiment = Element::new("Experiment").set("name", "reference");
    Element::new("Experiments")
        .set("name", "reference")
        .with([experiment.with(content)])
        .to_document()
}
