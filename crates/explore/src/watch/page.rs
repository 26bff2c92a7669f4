//! The page: one document with style, script and the motion as JSON in it, and nothing from elsewhere.

use std::collections::BTreeMap;

use anyhow::Context;
use serde::Serialize;
use softstop::{Dimension, Machine, PhaseKind, Stop};
use softstop_console::arguments::title;
use softstop_console::failure::Failure;
use softstop_console::report::MachineReport;

use super::strip::Strip;
use crate::page::{fill, in_script};
use crate::palette::phase_color;
use crate::simulate::{Crossed, Outcome, Plan, chart, name};

/// What the page shows, in the machine's own units.
#[derive(Debug, Serialize)]
pub(super) struct Page {
    /// The machine in a few words.
    pub title: String,
    pub machine: MachineReport,
    /// Names with units of what is shown.
    pub labels: BTreeMap<&'static str, String>,
    pub drive: Drive,
    pub places: Places,
    /// Begin and end of what is shown.
    pub span: [f64; 2],
    pub samples: Samples,
    pub phases: Vec<Shown>,
    /// From when on which strip lies there.
    pub strips: Vec<(f64, Strip)>,
    /// Every impact, and every rebound from a rigid stop.
    pub hits: Vec<Hit>,
}

/// The drive `amplitude` cos(2 pi t/`period` + `angle`).
#[derive(Debug, Serialize)]
pub(super) struct Drive {
    pub amplitude: f64,
    pub period: f64,
    pub angle: f64,
}

/// Where things stand; none if the machine does not have them.
#[derive(Debug, Serialize)]
pub(super) struct Places {
    pub clearance: f64,
    /// Near and far side of the strip.
    pub strip: Option<[f64; 2]>,
    /// The face of a stop that yields.
    pub stop: Option<f64>,
    /// The face of a rigid stop, in front of the mass or behind the one that yields.
    pub wall: Option<f64>,
    pub model: &'static str,
    pub is_damped: bool,
    pub is_damped_in_contact: bool,
    /// The stop on the other side.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub below: Option<BelowPlace>,
}

/// Where a stop below stands, and its law.
#[derive(Debug, Serialize)]
pub(super) struct BelowPlace {
    pub face: f64,
    pub model: &'static str,
}

/// The motion; between two samples of one time something changes at once.
#[derive(Debug, Default, Serialize)]
pub(super) struct Samples {
    pub time: Vec<f64>,
    pub position: Vec<f64>,
    pub velocity: Vec<f64>,
    pub force: Vec<f64>,
}

/// A stretch of time in one phase.
#[derive(Debug, Serialize)]
pub(super) struct Shown {
    pub kind: &'static str,
    pub from: f64,
    pub to: f64,
    pub color: Option<&'static str>,
}

/// A hit, in the words of crossings.csv.
#[derive(Debug, Serialize)]
pub(super) struct Hit {
    pub time: f64,
    pub kind: &'static str,
    pub position: f64,
    pub velocity_before: f64,
    pub velocity_after: f64,
    pub impact: bool,
}

impl Hit {
    /// That of a crossing, if it is one.
    pub(super) fn of(it: &Crossed) -> Option<Self> {
        let crossing = &it.crossing;
        let kind = it.kind();
        let impact = crossing.kind.is_impact();
        (impact || kind == "rebound").then_some(Self {
            time: it.time,
            kind,
            position: crossing.position,
            velocity_before: crossing.velocity,
            velocity_after: crossing.velocity_after,
            impact,
        })
    }
}

impl Page {
    /// What a run has shown.
    pub(super) fn new(
        plan: &Plan<'_>,
        outcome: &Outcome,
        strips: Vec<(f64, Strip)>,
        hits: Vec<Hit>,
    ) -> Self {
        let machine = &plan.begun.machine;
        let excitation = &machine.scene.excitation;
        let samples = samples(&outcome.drawing);
        let shown = |(kind, from, to): &(PhaseKind, f64, f64)| Shown {
            kind: name(*kind),
            from: *from,
            to: *to,
            color: phase_color(*kind),
        };
        Self {
            title: title(machine),
            machine: MachineReport::of(machine),
            labels: labels(machine),
            drive: Drive {
                amplitude: excitation.amplitude,
                period: machine.scene.period(),
                angle: excitation.phase,
            },
            places: places(machine),
            // The last sample's time may differ from the duration by rounding.
            span: [
                plan.drawn_from(),
                samples.time.last().copied().unwrap_or(outcome.duration),
            ],
            samples,
            phases: outcome.drawing.phases.iter().map(shown).collect(),
            strips,
            hits,
        }
    }

    /// The document.
    pub(super) fn html(&self) -> Result<String, Failure> {
        let json = serde_json::to_string(self).context("cannot write JSON")?;
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
}

fn labels(machine: &Machine) -> BTreeMap<&'static str, String> {
    let [time, position, velocity, force] = chart::labels(machine);
    let before = machine.label("before-impact velocity", "", Dimension::Velocity);
    let all = [
        ("time", time),
        ("position", position),
        ("velocity", velocity),
        ("force", force),
        ("before_impact_velocity", before),
    ];
    all.into_iter().collect()
}

fn places(machine: &Machine) -> Places {
    let scene = &machine.scene;
    let near = scene.clearance;
    let yields = !matches!(scene.stop, Stop::None | Stop::Rigid { .. });
    let below = scene.below.as_ref();
    let below = below.filter(|below| below.stop != Stop::None);
    Places {
        clearance: near,
        strip: scene.piercing.map(|strip| [near, near + strip.thickness]),
        stop: yields.then(|| scene.stop_position()),
        wall: scene.wall().map(|wall| wall.position),
        model: scene.stop.model(),
        is_damped: scene.damping > 0.0,
        is_damped_in_contact: scene.contact_damping > 0.0,
        below: below.map(|below| BelowPlace {
            face: -below.clearance,
            model: below.stop.model(),
        }),
    }
}

/// The points of a drawing. Where an arc ends, the time of the crossing is told by the arc that follows.
fn samples(drawing: &chart::Drawing) -> Samples {
    let mut samples = Samples::default();
    for [time, position, velocity, force] in &drawing.points {
        if let Some(last) = samples.time.last_mut() {
            *last = time.min(*last);
        }
        samples.time.push(*time);
        samples.position.push(*position);
        samples.velocity.push(*velocity);
        samples.force.push(*force);
    }
    samples
}
