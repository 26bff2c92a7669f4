//! A sketch of the machine with its dimensions, from its values; lengths are not to scale.

use softstop::{Machine, Parameter, Stop};
use softstop_draw::{Align, Axis, Layer, Panel, Stroke, style};

use crate::page::figure::{Figure, Section};
use crate::page::words::quantity;

/// Size of the picture, whose panel is in the same units.
const SIZE: (f64, f64) = (980.0, 305.0);
/// Heights of dampers, springs and dimensions, and of what they stand beside.
const DAMPER: f64 = 175.0;
const SPRING: f64 = 115.0;
const FRAME: (f64, f64) = (80.0, 210.0);
const DIMENSION: f64 = 52.0;
/// Height of a line of letters.
const LINE: f64 = 19.0;
/// The wall of the suspension.
const WALL: f64 = 40.0;
/// Left and right sides of the mass, where the strip or the stop begins, and lengths that stand for strip, gap and stop.
const MASS: (f64, f64) = (205.0, 310.0);
const FACE: f64 = 470.0;
const STRIP: f64 = 80.0;
const GAP: f64 = 80.0;
const STOP: f64 = 100.0;

const THIN: Stroke = Stroke::solid(style::INK, 1.2);
const THICK: Stroke = Stroke::solid(style::INK, 2.4);
const FORCE: Stroke = Stroke::solid(style::OPTIMUM, 2.4);

/// A machine with its dimensions.
pub fn sketch(machine: &Machine) -> Figure {
    let mut sketch = Sketch {
        machine,
        layers: Vec::new(),
    };
    sketch.suspension();
    sketch.mass();
    let face = sketch.strip();
    sketch.stop(face);
    let [x, y] = [SIZE.0, SIZE.1].map(|end| Axis::bare().range((0.0, end)));
    let panel = Panel::new(x, y, sketch.layers);
    let caption = "Not to scale. The mass is drawn at position 0, where the suspension is without force; positions count to the \
                   right. All numbers are those of the design.";
    let title = "The machine and its dimensions";
    Figure::new(Section::Motion, SIZE, title, [panel], caption)
}

struct Sketch<'a> {
    machine: &'a Machine,
    layers: Vec<Layer>,
}

impl Sketch<'_> {
    fn add(&mut self, layer: Layer) {
        self.layers.push(layer);
    }

    fn line(&mut self, points: &[(f64, f64)], stroke: Stroke) {
        self.add(Layer::line(points.iter().copied(), stroke));
    }

    /// Lines of letters, the first at this height: a short name, and the value of a parameter, if the machine has it.
    fn values(&mut self, (x, mut y): (f64, f64), align: Align, all: &[(&str, Parameter)]) {
        for (name, parameter) in all {
            let Some(value) = self.machine.value(*parameter) else {
                continue;
            };
            let symbol = match self.machine.unit_of(*parameter) {
                "" => self.machine.meaning_of(*parameter).1,
                _ => "",
            };
            let value = quantity(value, self.machine.unit_of(*parameter));
            let text = match symbol {
                "" => format!("{name} {value}"),
                symbol => format!("{name} {symbol} = {value}"),
            };
            self.add(Layer::text((x, y), align, text));
            y -= LINE;
        }
    }

    /// The rim of what is as high as the frame.
    fn rectangle(&mut self, (left, right): (f64, f64)) {
        let [low, high] = FRAME.into();
        let corners = [
            (left, low),
            (right, low),
            (right, high),
            (left, high),
            (left, low),
        ];
        self.line(&corners, THIN);
    }

    /// A wall with its hatching to the left or to the right.
    fn wall(&mut self, x: f64, side: f64) {
        self.line(&[(x, FRAME.0), (x, FRAME.1)], THICK);
        let mut y = FRAME.0;
        while y < FRAME.1 {
            self.line(&[(x, y + 12.0), (x + 10.0 * side, y)], THIN);
            y += 14.0;
        }
    }

    fn spring(&mut self, from: f64, to: f64) {
        let (begin, end) = (from + 12.0, to - 12.0);
        let turn = |turn: u32| {
            let up = if turn.is_multiple_of(2) { -10.0 } else { 10.0 };
            (
                begin + (end - begin) * (f64::from(turn) + 0.5) / 10.0,
                SPRING + up,
            )
        };
        let ends = [(from, SPRING), (begin, SPRING)].into_iter();
        let points = ends
            .chain((0..10).map(turn))
            .chain([(end, SPRING), (to, SPRING)]);
        self.line(&points.collect::<Vec<_>>(), THIN);
    }

    fn damper(&mut self, from: f64, to: f64) {
        let middle = 0.5 * (from + to);
        let cup = [(-18.0, -11.0), (-18.0, 11.0), (18.0, 11.0), (18.0, -11.0)];
        self.line(&cup.map(|(x, y)| (middle + x, DAMPER + y)), THIN);
        self.line(&[(from, DAMPER), (middle - 4.0, DAMPER)], THIN);
        self.line(
            &[(middle - 4.0, DAMPER - 8.0), (middle - 4.0, DAMPER + 8.0)],
            THICK,
        );
        self.line(&[(middle + 18.0, DAMPER), (to, DAMPER)], THIN);
    }

    /// A length between two places, below what it measures.
    fn dimension(&mut self, from: f64, to: f64, name: &str, parameter: Parameter) {
        for x in [from, to] {
            self.line(
                &[(x, DIMENSION - 8.0), (x, FRAME.0)],
                Stroke::solid(style::ASIDE, 1.0),
            );
        }
        let middle = 0.5 * (from + to);
        for end in [from, to] {
            self.add(Layer::arrow((middle, DIMENSION), (end, DIMENSION), THIN));
        }
        self.values(
            (middle, DIMENSION - 26.0),
            Align::Middle,
            &[(name, parameter)],
        );
    }

    fn suspension(&mut self) {
        self.wall(WALL, -1.0);
        self.damper(WALL, MASS.0);
        self.spring(WALL, MASS.0);
        let middle = 0.5 * (WALL + MASS.0);
        for (name, parameter, height) in [
            ("damping", Parameter::Damping, DAMPER + 40.0),
            ("stiffness", Parameter::Suspension, SPRING - 32.0),
        ] {
            self.values((middle, height), Align::Middle, &[(name, parameter)]);
        }
    }

    fn mass(&mut self) {
        self.add(Layer::boxes([[MASS, FRAME]], style::ALLOWED, 0.3));
        self.rectangle(MASS);
        let middle = 0.5 * (MASS.0 + MASS.1);
        self.values((middle, 140.0), Align::Middle, &[("mass", Parameter::Mass)]);
        let height = FRAME.1 + 22.0;
        let [from, to] = [middle - 45.0, middle + 45.0].map(|x| (x, height));
        self.add(Layer::arrow(from, to, FORCE));
        let drive = [
            ("drive", Parameter::Amplitude),
            ("drive at", Parameter::Frequency),
        ];
        self.values((middle, height + 16.0 + LINE), Align::Middle, &drive);
        self.dimension(MASS.1, FACE, "clearance", Parameter::Clearance);
    }

    /// The strip, if there is one; where the stop begins.
    fn strip(&mut self) -> f64 {
        if self.machine.scene.piercing.is_none() {
            return FACE;
        }
        let (end, stop) = (FACE + STRIP, FACE + STRIP + GAP);
        self.add(Layer::boxes([[(FACE, end), FRAME]], style::REFERENCE, 0.35));
        self.rectangle((FACE, end));
        let values = [
            ("strip: stiffness", Parameter::PiercingStiffness),
            ("friction", Parameter::PiercingFriction),
        ];
        self.values(
            (0.5 * (FACE + end), FRAME.1 + 16.0 + LINE),
            Align::Middle,
            &values,
        );
        self.dimension(FACE, end, "", Parameter::Thickness);
        self.dimension(end, stop, "", Parameter::Travel);
        stop
    }

    fn stop(&mut self, face: f64) {
        let stop = &self.machine.scene.stop;
        if *stop == Stop::None {
            return;
        }
        let mut wall = face;
        if !matches!(stop, Stop::Rigid { .. }) {
            wall += STOP;
            self.line(&[(face, FRAME.0 + 10.0), (face, FRAME.1 - 10.0)], THICK);
            self.spring(face, wall);
            self.damper(face, wall);
        }
        self.wall(wall, 1.0);
        let place = (wall + 16.0, FRAME.1 - 22.0);
        let model = format!("stop: {}", stop.model());
        self.add(Layer::text(place, Align::Left, model));
        let values = [
            ("stiffness", Parameter::StopStiffness),
            ("preload", Parameter::Preload),
            ("restitution", Parameter::Restitution),
            ("exponent", Parameter::Exponent),
            ("damping in contact", Parameter::ContactDamping),
        ];
        let values = &values[..values.len() - usize::from(wall == face)];
        self.values((place.0, place.1 - LINE), Align::Left, values);
        if let Some(rigid) = self.machine.value(Parameter::RigidTravel) {
            let text = quantity(rigid, self.machine.unit_of(Parameter::RigidTravel));
            let text = format!("rigid stop {text} behind");
            self.add(Layer::text((wall + 16.0, FRAME.0), Align::Left, text));
        }
    }
}
