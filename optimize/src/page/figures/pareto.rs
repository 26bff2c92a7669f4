//! The designs of a front: each pair of what is sought.

use softstop_draw::{Align, Axis, Layer, Mark, Panel, around, style};

use super::front::LINED;
use crate::design::Problem;
use crate::design::figure::Sense;
use crate::design::pareto::Pareto;
use crate::design::problem::Objective;
use crate::page::figure::{Figure, HALF, Section, WIDE};
use crate::pareto::format_tally;

/// Height of a row of panels.
const ROW: f64 = 400.0;
/// Room about the designs, as a share of their range, and the share of it within which one number stands for all.
const ROOM: f64 = 0.1;
const CLOSE: f64 = 0.04;

/// The picture.
pub fn pareto(problem: &Problem, front: &Pareto) -> Figure {
    let objectives = &front.objectives;
    let indices = 0..objectives.len();
    let pairs = indices
        .clone()
        .flat_map(|y| indices.clone().skip(y + 1).map(move |x| (x, y)));
    let panels: Vec<Panel> = pairs.map(|(x, y)| panel(problem, front, [x, y])).collect();
    let size = match panels.len() {
        1 => HALF,
        count => (WIDE.0, ROW * count.div_ceil(2) as f64),
    };
    let caption = format!(
        "Designs of which none is better in all that is sought, by their numbers; each is as required. Number 1 is the design of \
         this report, number {} is nearest to the best of each. {}",
        front.nearest + 1,
        format_tally(&front.tally)
    );
    let mut figure = Figure::new(
        Section::Cost,
        size,
        "Designs to choose from",
        panels,
        caption,
    );
    figure.chart.shares_y = false;
    figure
}

/// The designs over two of what is sought.
fn panel(problem: &Problem, front: &Pareto, axes: [usize; 2]) -> Panel {
    let machine = &problem.machine;
    let axis = |index: usize| {
        let figure = front.objectives[index].figure;
        Axis::new(machine.label(figure.meaning(), "", figure.dimension()))
    };
    let own =
        |objective: &Objective, value: f64| machine.to_own(objective.figure.dimension(), value);
    let place = |index: usize| {
        let values = &front.points[index].values;
        let [x, y] = axes.map(|axis| own(&front.objectives[axis], values[axis]));
        (x, y)
    };
    let all: Vec<(f64, f64)> = (0..front.points.len()).map(place).collect();
    let at = |index: usize| all.get(index).copied();
    let marks = Layer::marks(all.clone(), Mark::Circle, style::DESIGN).sized(3.5);
    let first = Layer::marks(at(0), Mark::Triangle, style::OPTIMUM).sized(8.0);
    let nearest = Layer::marks(at(front.nearest), Mark::Diamond, style::OPTIMUM).sized(7.0);
    let line = (front.objectives.len() == 2).then(|| Layer::line(all.clone(), LINED));
    // On the side of the designs that are dominated.
    let [x, y] = axes.map(|axis| front.objectives[axis].sense);
    let (align, right) = match x {
        Sense::Most => (Align::Left, 7.0),
        Sense::Least => (Align::Right, -7.0),
    };
    let down = if y == Sense::Least { 15.0 } else { -6.0 };
    let ranges = [
        around(all.iter().map(|at| at.0), ROOM),
        around(all.iter().map(|at| at.1), ROOM),
    ];
    let is_near =
        |one: f64, other: f64, (low, high): (f64, f64)| (one - other).abs() < CLOSE * (high - low);
    let mut numbered: Vec<usize> = Vec::new();
    for (index, at) in all.iter().enumerate() {
        let mut others = numbered.iter().map(|other| all[*other]);
        if !others.any(|it| is_near(it.0, at.0, ranges[0]) && is_near(it.1, at.1, ranges[1])) {
            numbered.push(index);
        }
    }
    let labels = numbered
        .into_iter()
        .map(|index| Layer::text(all[index], align, (index + 1).to_string()).moved(right, down));
    let layers = line.into_iter().chain([
        marks.named("front"),
        first.named("this design"),
        nearest.named("nearest to the best of each"),
    ]);
    let [x, y] = [0, 1].map(|it| axis(axes[it]).range(ranges[it]));
    Panel::new(x, y, layers.chain(labels))
}
