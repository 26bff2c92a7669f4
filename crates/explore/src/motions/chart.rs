//! The picture of all motions: each in the phase plane, and below it its states at drive angle phi, more closely.

use softstop::{Clock, Dimension, Machine, MotionError, Scene, Start};
use softstop_console::arguments::title;
use softstop_console::report::MotionName;
use softstop_draw::{Axis, Chart, Layer, Mark, Panel, Stroke, around};
use softstop_dynamics::Survey;
use softstop_dynamics::attractors::Attractor;

use crate::palette::line_color;
use crate::simulate::chart::FACE;

/// Motions in a row, and the most that are drawn.
const COLUMNS: usize = 3;
const MOST: usize = 9;
/// Samples of a drive period.
const SAMPLES: u32 = 400;
/// Drive periods that are drawn of what does not repeat: as a line, and as states at drive angle phi.
const WANDERING: (u64, u64) = (40, 3000);
/// Room around what is drawn, as a share of it.
const ROOM: f64 = 0.06;

/// A motion as it is drawn.
struct DrawnLoop {
    name: String,
    color: &'static str,
    repeats: bool,
    line: Vec<(f64, f64)>,
    states: Vec<(f64, f64)>,
}

/// The motions of a survey as an SVG document, that with the largest share first.
pub(super) fn svg(machine: &Machine, survey: &Survey) -> Result<String, MotionError> {
    let motions = survey.attractors.iter().take(MOST);
    let loops: Result<Vec<DrawnLoop>, _> = motions
        .map(|it| DrawnLoop::of(&machine.scene, it))
        .collect();
    let loops = loops?;
    let plane = axes(machine, || {
        loops.iter().flat_map(|it| it.line.iter().copied())
    });
    let section = axes(machine, || {
        loops.iter().flat_map(|it| it.states.iter().copied())
    });
    let panels = loops.iter().enumerate().flat_map(|(index, motion)| {
        let (column, row) = (index % COLUMNS, 2 * (index / COLUMNS));
        let panel = |[x, y]: &[Axis; 2], row, title: &str, layers: Vec<Layer>| Panel {
            title: title.to_owned(),
            at: (column, row),
            ..Panel::new(x.clone(), y.clone(), layers).sized((190.0, 180.0))
        };
        let lines = motion.line_layers(&machine.scene);
        [
            panel(&plane, row, &motion.name, lines),
            panel(&section, row + 1, "", vec![motion.state_layer()]),
        ]
    });
    let words =
        "above: the phase plane, dashed is the clearance; below: the states at drive angle φ";
    let chart = Chart {
        subtitle: words.to_owned(),
        letters: 13,
        ..Chart::new(format!("All motions of {}", title(machine)), panels)
    };
    Ok(chart.svg())
}

/// The axes of a plane that holds all points.
fn axes<I: Iterator<Item = (f64, f64)>>(machine: &Machine, points: impl Fn() -> I) -> [Axis; 2] {
    let across = machine.label("position x", "", Dimension::Length);
    let upwards = machine.label("velocity v", "", Dimension::Velocity);
    [
        Axis::new(across).range(around(points().map(|it| it.0), ROOM)),
        Axis::new(upwards).range(around(points().map(|it| it.1), ROOM)),
    ]
}

impl DrawnLoop {
    fn of(scene: &Scene, attractor: &Attractor) -> Result<Self, MotionError> {
        let periods = attractor.orbit.as_ref().map(|it| it.regime().periods);
        let drawn = periods.unwrap_or(WANDERING.0).max(1);
        let dotted = periods.unwrap_or(WANDERING.1).max(1);
        let motion = scene.trajectory(attractor.state, drawn.max(dotted))?;
        let step = motion.clock.period() / f64::from(SAMPLES);
        let sample = |cycle: u64, part: u32| {
            let at = motion
                .clock
                .after(Clock::at_cycle(cycle), f64::from(part) * step);
            motion.at(at).map(|it: Start| (it.position, it.velocity))
        };
        let name = MotionName::of(&attractor.motion).text;
        let fine = (0..drawn).flat_map(|cycle| (0..=SAMPLES).map(move |part| (cycle, part)));
        Ok(Self {
            name: format!("{name}: {:.1} % of starts", 100.0 * attractor.share),
            color: line_color(attractor.motion.class()),
            repeats: periods.is_some(),
            line: fine
                .filter_map(|(cycle, part)| sample(cycle, part))
                .collect(),
            states: (0..dotted).filter_map(|cycle| sample(cycle, 0)).collect(),
        })
    }

    fn line_layers(&self, scene: &Scene) -> Vec<Layer> {
        let width = if self.repeats { 1.8 } else { 0.4 };
        let stroke = Stroke::solid(self.color, width);
        let below = scene.below.as_ref().map(|below| -below.clearance);
        let faces = [scene.clearance].into_iter().chain(below);
        let faces = faces.map(|face| Layer::vertical(face, FACE, ""));
        let line = Layer::line(self.line.iter().copied(), stroke);
        faces.chain([line]).collect()
    }

    fn state_layer(&self) -> Layer {
        let states = self.states.iter().copied();
        match self.repeats {
            true => Layer::marks(states, Mark::Circle, self.color).sized(5.0),
            false => Layer::dots(states, 0.9, self.color),
        }
    }
}
