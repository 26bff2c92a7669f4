//! The largest Lyapunov exponent beneath the bifurcation diagram.

use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Pen, Stroke};
use softstop_draw::style;
use softstop_dynamics::sweep::Step;

use crate::diagram::{dots, same};

/// Pixels for each unit of length.
const SCALE: f32 = 2.0;
const WIDTH: f64 = 1200.0;
/// Left and right ends of the columns, and the heights of the rows.
const COLUMNS: [(f64, f64); 2] = [(84.0, 664.0), (756.0, 1172.0)];
const HEIGHTS: [f64; 2] = [330.0, 330.0];
const LETTERS: u32 = 14;
const DOT: f64 = 0.7;
/// Colours: both ways, up only, down only.
const COLOURS: [&str; 3] = ["#444444", style::DESIGN, style::OPTIMUM];

/// A step of a sweep along eta.
#[derive(Debug, Clone)]
pub struct StabilityPoint {
    /// The step.
    pub step: Step,
    /// The largest exponent per unit of tau, and the half-width of its 95 % interval.
    pub exponent: (f64, f64),
}

/// The diagram and the exponents over a range of eta.
#[derive(Debug, Clone)]
pub struct StabilityPart {
    /// Range of eta.
    pub range: (f64, f64),
    /// Least and largest exponent to be seen.
    pub exponents: (f64, f64),
    /// The sweeps up and down, in rising order of eta.
    pub ways: [Vec<StabilityPoint>; 2],
}

/// The picture.
#[derive(Debug, Clone)]
pub struct StabilityChart<'a> {
    /// The whole range, and a part of it.
    pub parts: &'a [StabilityPart],
    /// z = 1 up to its fold: eta, X'-, exponent.
    pub branch: &'a [[f64; 3]],
    /// Points to mark on z = 1 in the whole range: name, eta, X'-, exponent.
    pub marks: &'a [(String, [f64; 3])],
    /// How it was made.
    pub explanation: String,
}

impl StabilityChart<'_> {
    /// As PNG.
    ///
    /// # Errors
    /// What the encoder says.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        let tops = [112.0, 112.0 + HEIGHTS[0] + 24.0];
        let mut pen = Pen::new(WIDTH, tops[1] + HEIGHTS[1] + 58.0);
        let title = "Stability of the motions along ρ = 10: the largest Lyapunov exponent λ";
        heading(&mut pen, (COLUMNS[0].0, 30.0), title, &self.explanation);
        legend(&mut pen, 80.0);
        for (part, (left, right)) in self.parts.iter().zip(COLUMNS) {
            let area = |row: usize| (left, tops[row], right - left, HEIGHTS[row]);
            let whole = left == COLUMNS[0].0;
            let points = part.ways.iter().flatten();
            let top = points.map(|point| point.step.hardest()).fold(1.0, f64::max);
            let diagram = Panel::new(area(0), part.range, (-0.04 * top, 1.08 * top));
            let exponents = Panel::new(area(1), part.range, part.exponents);
            let ticks = (if whole { 10 } else { 5 }, 5);
            let upper = axes(None, "before-impact velocity X′₋", ticks);
            let lower = axes(Some("drive frequency η = ω/Ω"), "λ per unit of τ", ticks);
            diagram.ground(&mut pen, &upper);
            exponents.ground(&mut pen, &lower);
            self.curves(&mut pen, part, &diagram, &exponents);
            let z_one = Stroke::solid(COLOURS[1], 1.8);
            let curve = |which: usize| -> Vec<(f64, f64)> {
                self.branch.iter().map(|at| (at[0], at[which])).collect()
            };
            if whole {
                diagram.curve(&mut pen, &curve(1), z_one);
                exponents.curve(&mut pen, &curve(2), z_one);
                let beyond = "chaos: λ > 0, at the right";
                let place = (exponents.across(0.965), exponents.height(0.0) - 8.0);
                pen.words(place, LETTERS - 1, Align::Left, (style::INK, true), beyond);
            }
            let zero = [(part.range.0, 0.0), (part.range.1, 0.0)];
            exponents.curve(&mut pen, &zero, Stroke::solid(style::INK, 1.0));
            if whole {
                self.marks(&mut pen, &diagram, &exponents);
            }
            diagram.axes(&mut pen, &upper);
            exponents.axes(&mut pen, &lower);
        }
        pen.png_at(SCALE)
    }

    fn curves(&self, pen: &mut Pen, part: &StabilityPart, diagram: &Panel, exponents: &Panel) {
        for way in [1, 2, 0] {
            let mut points = classed(part);
            points.retain(|(class, point)| *class == way && point.step.is_settled());
            let points = points.iter().map(|(_, point)| point);
            let velocities = points.clone().flat_map(|point| dots(&point.step));
            diagram.dots(pen, velocities, DOT, COLOURS[way]);
            let values = points.map(|point| (point.step.value, point.exponent.0));
            exponents.dots(pen, values, 1.4 * DOT, COLOURS[way]);
        }
    }

    fn marks(&self, pen: &mut Pen, diagram: &Panel, exponents: &Panel) {
        for (name, [eta, velocity, exponent]) in self.marks {
            let line = Stroke::dashed(style::ASIDE, 0.9, (3.0, 3.0));
            let x = diagram.across(*eta);
            pen.line(&[(x, diagram.area.1), (x, exponents.bottom())], line);
            for (panel, value) in [(diagram, *velocity), (exponents, *exponent)] {
                pen.spot((x, panel.height(value)), 4.5);
            }
            let (shift, align) = if *eta < 1.2 {
                (-9.0, Align::Right)
            } else {
                (9.0, Align::Left)
            };
            let place = (x + shift, exponents.height(*exponent) + 20.0);
            pen.words(place, LETTERS - 1, align, (style::INK, false), name);
        }
    }
}

/// Points with 0 if they are the same on both ways (shown once), 1 for up, 2 for down.
fn classed(part: &StabilityPart) -> Vec<(usize, &StabilityPoint)> {
    let [up, down] = &part.ways;
    let mut points = Vec::new();
    for (a, b) in up.iter().zip(down) {
        if same(&a.step, &b.step) {
            points.push((0, a));
            if a.step.motion.regime().is_none() {
                points.push((0, b));
            }
        } else {
            points.extend([(1, a), (2, b)]);
        }
    }
    points
}

fn axes<'a>(across: Option<&'a str>, upwards: &'a str, ticks: (usize, usize)) -> Axes<'a> {
    Axes::new(LETTERS, across, upwards, ticks)
}

fn legend(pen: &mut Pen, y: f64) {
    let names = ["up and down", "up only", "down only"];
    let mut x = COLUMNS[0].0;
    for (color, name) in COLOURS.into_iter().zip(names) {
        pen.tint((x, y - 11.0, 12.0, 12.0), color, 1.0);
        pen.text((x + 18.0, y), LETTERS, Align::Left, name);
        x += 18.0 + softstop_draw::pen::width(LETTERS, name) + 22.0;
    }
}
