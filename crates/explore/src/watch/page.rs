//! The page: one document with style, script and the motion as JSON in it, and nothing from elsewhere.

use anyhow::Context;
use serde_json::json;
use softstop::{Dimension, Machine, Stop};
use softstop_console::arguments::title;
use softstop_console::failure::Failure;
use softstop_console::record::Record;
use softstop_console::report::stated_machine;

use super::strip::StripState;
use crate::page::{fill, in_script};
use crate::palette::phase_color;
use crate::simulate::{CrossingRow, RunOutcome, chart, crossing_columns, name};

/// A crossing as crossings.csv has it, if it is an impact or a rebound from a rigid stop.
pub(super) fn hit(it: &CrossingRow) -> Option<Record> {
    let is_hit = it.crossing.kind.is_impact() || it.kind() == "rebound";
    is_hit.then(|| Record::of(&crossing_columns(), it))
}

/// What the page shows of a run, in the machine's own units: from when on which strip lies there, and every hit.
pub(super) fn shown(
    outcome: &RunOutcome<'_>,
    strips: &[(f64, StripState)],
    hits: Vec<Record>,
) -> Record {
    let machine = &outcome.plan.machine;
    let excitation = &machine.scene.excitation;
    // The drive `amplitude` cos(2 pi t/`period` + `angle`).
    let drive = Record::default()
        .hidden("amplitude", excitation.amplitude)
        .hidden("period", machine.scene.period())
        .hidden("angle", excitation.phase);
    let [time, position, velocity, force] = samples(&outcome.drawing);
    // The last sample's time may differ from the duration by rounding.
    let end = time.last().copied().unwrap_or(outcome.duration);
    // Between two samples of one time something changes at once.
    let samples = Record::default()
        .hidden("time", time)
        .hidden("position", position)
        .hidden("velocity", velocity)
        .hidden("force", force);
    let phases = outcome.drawing.phases.iter().map(|(kind, from, to)| {
        let phase = Record::default().hidden("kind", name(*kind));
        let phase = phase.hidden("from", *from).hidden("to", *to);
        phase.hidden("color", phase_color(*kind))
    });
    Record::default()
        .hidden("title", title(machine))
        .hidden("machine", stated_machine(machine))
        .hidden("labels", labels(machine))
        .hidden("drive", drive)
        .hidden("places", places(machine))
        .hidden("span", [outcome.plan.drawn_from(), end])
        .hidden("samples", samples)
        .hidden("phases", phases.collect::<Vec<_>>())
        .hidden("strips", json!(strips))
        .hidden("hits", hits)
}

/// The document that shows this.
pub(super) fn html(shown: &Record) -> Result<String, Failure> {
    let json = serde_json::to_string(shown).context("cannot write JSON")?;
    let parts = [
        ("page.css", include_str!("../../assets/watch/page.css")),
        ("motion.js", include_str!("../../assets/watch/motion.js")),
        (
            "pictures.js",
            include_str!("../../assets/watch/pictures.js"),
        ),
        ("player.js", include_str!("../../assets/watch/player.js")),
        ("motion", &in_script(&json)),
    ];
    Ok(fill(include_str!("../../assets/watch/page.html"), &parts))
}

/// Names with units of what is shown.
fn labels(machine: &Machine) -> Record {
    let [time, position, velocity, force] = chart::labels(machine);
    let before = machine.label("before-impact velocity", "", Dimension::Velocity);
    Record::default()
        .hidden("before_impact_velocity", before)
        .hidden("force", force)
        .hidden("position", position)
        .hidden("time", time)
        .hidden("velocity", velocity)
}

/// Where things stand; nothing if the machine does not have them.
fn places(machine: &Machine) -> Record {
    let scene = &machine.scene;
    let near = scene.clearance;
    let yields = !matches!(scene.stop, Stop::None | Stop::Rigid { .. });
    // Near and far side of the strip; the face of a stop that yields; that of a rigid one, before or behind it.
    let places = Record::default()
        .hidden("clearance", near)
        .hidden(
            "strip",
            scene.piercing.map(|it| [near, near + it.thickness]),
        )
        .hidden("stop", yields.then(|| scene.stop_position()))
        .hidden("wall", scene.wall().map(|wall| wall.position))
        .hidden("model", scene.stop.model())
        .hidden("is_damped", scene.damping > 0.0)
        .hidden("is_damped_in_contact", scene.contact_damping > 0.0);
    let below = scene.below.as_ref();
    match below.filter(|below| below.stop != Stop::None) {
        Some(below) => {
            let face = Record::default().hidden("face", -below.clearance);
            places.hidden("below", face.hidden("model", below.stop.model()))
        }
        None => places,
    }
}

/// Times, positions, velocities and forces of a drawing. Where an arc ends, the time of the crossing is told by the arc that
/// follows.
fn samples(drawing: &chart::DrawnMotion) -> [Vec<f64>; 4] {
    let mut samples = [const { Vec::new() }; 4];
    for point in &drawing.points {
        if let Some(last) = samples[0].last_mut() {
            *last = point[0].min(*last);
        }
        for (all, value) in samples.iter_mut().zip(point) {
            all.push(*value);
        }
    }
    samples
}
