//! The picture of all motions: each in the phase plane, and below it its states at drive angle phi, more closely.

use softstop::{Clock, Dimension, Machine, MotionError, Scene, Start};
use softstop_console::arguments::title;
use softstop_console::report::MotionName;
use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Pen, Stroke};
use softstop_draw::scale::around;
use softstop_draw::shapes::Mark;
use softstop_draw::style;
use softstop_dynamics::Survey;
use softstop_dynamics::attractors::Attractor;
use softstop_dynamics::motion::MotionClass;

use crate::basin::cells::color;

/// Panels in a row, and the most that are drawn.
const COLUMNS: usize = 3;
const MOST: usize = 9;
/// Left and top of the first panel, its size, and the steps from one to the next.
const FIRST: (f64, f64) = (84.0, 112.0);
const SIZE: (f64, f64) = (300.0, 260.0);
const STEP: (f64, f64) = (390.0, 700.0);
/// From the phase plane down to the states.
const BELOW: f64 = 336.0;
/// Letters.
const LETTERS: u32 = 13;
/// Samples of a drive period.
const SAMPLES: u32 = 400;
/// Drive periods that are drawn of what does not repeat: as a line, and as states at drive angle phi.
const WANDERING: (u64, u64) = (40, 3000);
/// Room around what is drawn, as a share of it.
const ROOM: f64 = 0.06;
/// Width of a line, of what repeats and of what does not.
const LINE: (f64, f64) = (1.8, 0.4);

/// A motion as it is drawn.
struct Loop {
    name: String,
    share: f64,
    class: MotionClass,
    repeats: bool,
    line: Vec<(f64, f64)>,
    states: Vec<(f64, f64)>,
}

/// The motions of a survey as an SVG document, that with the largest share first.
pub(super) fn svg(machine: &Machine, survey: &Survey) -> Result<String, MotionError> {
    let motions = survey.attractors.iter().take(MOST);
    let loops: Result<Vec<Loop>, _> = motions.map(|it| Loop::of(&machine.scene, it)).collect();
    let loops = loops?;
    let lines = || loops.iter().flat_map(|it| it.line.iter().copied());
    let states = || loops.iter().flat_map(|it| it.states.iter().copied());
    let (plane, section) = (ranges(lines), ranges(states));
    let rows = loops.len().div_ceil(COLUMNS).max(1);
    let width = FIRST.0 + STEP.0 * loops.len().clamp(1, COLUMNS) as f64;
    let mut pen = Pen::page(width.max(720.0), FIRST.1 + STEP.1 * rows as f64);
    let head = format!("All motions of {}", title(machine));
    let words =
        "above: the phase plane, dashed is the clearance; below: the states at drive angle φ";
    heading(&mut pen, (FIRST.0, 36.0), &head, words);
    let across = machine.label("position x", "", Dimension::Length);
    let upwards = machine.label("velocity v", "", Dimension::Velocity);
    let axes = Axes::new(LETTERS, Some(&across), &upwards, (5, 6));
    for (index, motion) in loops.iter().enumerate() {
        let (column, row) = (index % COLUMNS, index / COLUMNS);
        let left = FIRST.0 + STEP.0 * column as f64;
        let top = FIRST.1 + STEP.1 * row as f64;
        let panel = Panel::new((left, top, SIZE.0, SIZE.1), plane.0, plane.1);
        let below = Panel::new((left, top + BELOW, SIZE.0, SIZE.1), section.0, section.1);
        panel.ground(&mut pen, &axes);
        below.ground(&mut pen, &axes);
        motion.draw_line(&mut pen, &panel, machine.scene.clearance);
        motion.draw_states(&mut pen, &below);
        panel.axes(&mut pen, &axes);
        below.axes(&mut pen, &axes);
        let name = format!("{}: {:.1} % of starts", motion.name, 100.0 * motion.share);
        pen.heading((left, top - 10.0), LETTERS + 1, Align::Left, &name);
    }
    Ok(pen.svg())
}

impl Loop {
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
        let fine = (0..drawn).flat_map(|cycle| (0..=SAMPLES).map(move |part| (cycle, part)));
        Ok(Self {
            name: MotionName::of(&attractor.motion).text,
            share: attractor.share,
            class: attractor.motion.class(),
            repeats: periods.is_some(),
            line: fine
                .filter_map(|(cycle, part)| sample(cycle, part))
                .collect(),
            states: (0..dotted).filter_map(|cycle| sample(cycle, 0)).collect(),
        })
    }

    fn color(&self) -> &'static str {
        match self.class {
            MotionClass::Zero => style::ASIDE,
            class => color(class),
        }
    }

    fn draw_line(&self, pen: &mut Pen, panel: &Panel, clearance: f64) {
        let face = [(clearance, panel.y.0), (clearance, panel.y.1)];
        panel.curve(pen, &face, Stroke::dashed(style::ASIDE, 1.0, (5.0, 4.0)));
        let width = if self.repeats { LINE.0 } else { LINE.1 };
        panel.curve(pen, &self.line, Stroke::solid(self.color(), width));
    }

    fn draw_states(&self, pen: &mut Pen, panel: &Panel) {
        match self.repeats {
            true => {
                for state in &self.states {
                    pen.mark(panel.place(*state), Mark::Circle, 5.0, self.color());
                }
            }
            false => panel.dots(pen, self.states.iter().copied(), 0.9, self.color()),
        }
    }
}

type Range = (f64, f64);

/// The ranges across and upwards that hold all points.
fn ranges<I: Iterator<Item = (f64, f64)>>(points: impl Fn() -> I) -> (Range, Range) {
    let across = around(points().map(|it| it.0), ROOM);
    (across, around(points().map(|it| it.1), ROOM))
}
