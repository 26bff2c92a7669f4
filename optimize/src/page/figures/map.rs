//! The before-impact velocity over the drive's frequency and another parameter.

use softstop::{Dimension, Parameter, Scene};
use softstop_console::row;
use softstop_console::sheet::Sheet;
use softstop_draw::{Axis, Layer, Mark, Panel, Stroke, around, style};
use softstop_dynamics::{Zone, parallel};

use super::velocity;
use crate::design::{Design, Problem, space};
use crate::page::branches::{BORDERS, ZoneBranches};
use crate::page::figure::{Curve, Figure, HALF, Section, WIDE, lines, middles, pieces};
use crate::page::words::quantity;

/// Maps at most.
const MAPS: usize = 2;
/// Cells across and upwards.
const CELLS: (usize, usize) = (96, 40);
/// Half the size of the design's mark.
const MARK: f64 = 8.0;
/// The borders of the zone, in the order of [`BORDERS`].
const STROKES: [Stroke; 3] = [
    Stroke::solid(style::INK, 1.6),
    Stroke::dashed(style::INK, 1.6, (9.0, 4.0)),
    Stroke::dashed(style::INK, 1.6, (2.0, 3.0)),
];
/// Corners of a box about its middle, in half widths, round to the first.
const CORNERS: [(f64, f64); 5] = [
    (-1.0, -1.0),
    (1.0, -1.0),
    (1.0, 1.0),
    (-1.0, 1.0),
    (-1.0, -1.0),
];

/// A map for each of the first parameters that were searched.
pub(super) fn maps(problem: &Problem, design: &Design) -> Vec<Figure> {
    let axes = problem.free_axes();
    let axes: Vec<&space::Axis> = axes.take(MAPS).collect();
    let size = if axes.len() == 1 { WIDE } else { HALF };
    let all = axes.iter().zip(1..);
    all.map(|(axis, number)| map(problem, design, axis, number, size))
        .collect()
}

fn map(
    problem: &Problem,
    design: &Design,
    axis: &space::Axis,
    number: usize,
    size: (f64, f64),
) -> Figure {
    let (machine, parameter) = (&design.machine, axis.parameter);
    let up = (axis.range.low, axis.range.high);
    let value = |row| match axis.is_log() {
        true => middles((up.0.ln(), up.1.ln()), CELLS.1)(row).exp(),
        false => middles(up, CELLS.1)(row),
    };
    let at = |row: usize| {
        let mut machine = machine.clone();
        machine.set(parameter, value(row));
        machine.scene
    };
    let scenes: Vec<Scene> = (0..CELLS.1).map(at).collect();
    let zones = problem.zones_of(&scenes);
    let rows = parallel::map(&zones, |zone| Some(ZoneBranches::of(zone.as_ref().ok()?)));
    let own = |frequency: f64| machine.to_own(Dimension::Frequency, frequency);
    let borders = BORDERS.iter().zip(STROKES).enumerate();
    let curves = borders.flat_map(|(index, (name, stroke))| {
        let place = |row: usize| Some((own(rows[row].as_ref()?.borders[index]?), value(row)));
        let pieces = pieces(&Vec::from_iter((0..CELLS.1).map(place)));
        pieces.into_iter().map(move |points| Curve {
            name: (*name).to_owned(),
            stroke,
            points,
        })
    });
    let curves: Vec<Curve> = curves.collect();
    let frequencies = curves.iter().flat_map(|it| it.points.iter().map(|it| it.0));
    let across = around(frequencies.chain([design.frequency()]), 0.05);
    let frequency = middles(across, CELLS.0);
    let cell = |row: usize, column: usize| {
        let motions = rows[row].as_ref()?;
        motions.velocity_at(machine.to_si(Dimension::Frequency, frequency(column)))
    };
    let places = (0..CELLS.1).flat_map(|row| (0..CELLS.0).map(move |column| (row, column)));
    let cells: Vec<Option<f64>> = places
        .clone()
        .map(|(row, column)| cell(row, column))
        .collect();

    let labels = [Parameter::Frequency, parameter].map(|it| machine.label_of(it));
    let [x, y] = labels.each_ref();
    let shade = velocity(machine);
    let place = (
        design.frequency(),
        machine.value(parameter).unwrap_or(f64::NAN),
    );
    let built = problem.as_built();
    let width = |it| built.half_width(machine, it).unwrap_or(0.0);
    let widths = [Parameter::Frequency, parameter].map(width);
    let shades = cells.iter().map(|value| value.unwrap_or(f64::NAN));
    let mut layers = vec![Layer::shades(CELLS.0, shades, &shade)];
    layers.extend(curves.iter().map(|curve| {
        Layer::contour(curve.points.iter().copied(), curve.stroke.dashes).named(&curve.name)
    }));
    if widths != [0.0, 0.0] {
        let corner = |(a, b)| (place.0 + a * widths[0], place.1 + b * widths[1]);
        layers.push(Layer::contour(CORNERS.map(corner), None));
    }
    let mark = Layer::marks([place], Mark::Diamond, style::OPTIMUM);
    layers.push(mark.sized(MARK).named("design"));
    let mut upwards = Axis::new(y).range(up);
    if axis.is_log() {
        upwards = upwards.log();
    }
    let panel = Panel::new(Axis::new(x).range(across), upwards, layers);
    let names = [Parameter::Frequency, parameter].map(|it| machine.meaning_of(it).0);
    let title = format!("Before-impact velocity over {} and {}", names[0], names[1]);
    let rows = places.zip(&cells);
    let rows = rows.map(|((row, column), cell)| row![frequency(column), value(row), *cell]);
    let name = format!("map-{number}");
    let boundaries = lines(&format!("{name}-boundaries"), "boundary", [x, y], &curves);
    let units = [Parameter::Frequency, parameter].map(|it| machine.unit_of(it));
    let caption = caption((&shade, &design.zone), place, widths, units);
    Figure::new(Section::Place, size, title, [panel], caption)
        .with([Sheet::new(name, [x, y, &shade], rows), boundaries])
}

fn caption(
    (shade, zone): (&str, &Zone),
    place: (f64, f64),
    widths: [f64; 2],
    units: [&str; 2],
) -> String {
    let widths = widths.into_iter().zip(units).filter(|it| it.0 > 0.0);
    let widths = widths.map(|(width, unit)| format!("±{}", quantity(width, unit)));
    let widths = widths.collect::<Vec<String>>().join(" and ");
    let tolerance = match widths.as_str() {
        "" => String::new(),
        widths => format!(" The box about it is its tolerance, {widths}."),
    };
    let place_of = match zone.is_hysteresis() {
        true => ", in the hysteresis zone (from g₀ to s_SN) and below it",
        false => "",
    };
    format!(
        "Colour: {shade} of the stable motion with one impact a period{place_of}; no colour: no such motion. The design stands at {} and {}.{tolerance}",
        quantity(place.0, units[0]),
        quantity(place.1, units[1])
    )
}
