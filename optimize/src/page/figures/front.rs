//! What more of one good costs of another.

use softstop_console::row;
use softstop_console::sheet::Sheet;
use softstop_draw::{Axis, Layer, Mark, Panel, Stroke, style};

use crate::design::Problem;
use crate::design::figure::Figure as Quantity;
use crate::design::front::Front;
use crate::page::figure::{Figure, HALF, Section};
use crate::page::words::capital;

/// The line through designs.
pub(super) const LINED: Stroke = Stroke::solid(style::DESIGN, 1.6);

/// The picture.
pub(super) fn front(problem: &Problem, front: &Front) -> Figure {
    let (machine, sought) = (&problem.machine, problem.objective.figure);
    let own = |figure: Quantity, value: f64| machine.to_own(figure.dimension(), value);
    let place = |(x, y): (f64, f64)| (own(front.figure, x), own(sought, y));
    let points = || front.points.iter().map(|it| place(*it));
    let marks = Layer::marks(points(), Mark::Circle, style::DESIGN);
    let design = Layer::marks([place(front.design)], Mark::Triangle, style::OPTIMUM);
    let [x, y] = [front.figure, sought].map(|it| machine.label(it.meaning(), "", it.dimension()));
    let layers = [
        Layer::line(points(), LINED),
        marks.sized(3.5).named("best designs"),
        design.sized(8.0).named("this design"),
    ];
    let panel = Panel::new(Axis::new(&x), Axis::new(&y), layers);
    let caption = format!(
        "Each point is the best design that the search found with another bound of one of the two. {}",
        front.note()
    );
    let title = capital(&format!(
        "{} against {}",
        sought.meaning(),
        front.figure.meaning()
    ));
    let rows = points().map(|(x, y)| row![x, y]);
    let name = format!("front-{}", front.figure.name());
    let sheet = Sheet::new(name, [x, y], rows);
    Figure::new(Section::Cost, HALF, title, [panel], caption.trim_end()).with([sheet])
}
