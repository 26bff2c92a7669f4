//! Position and force of contact over two periods.

use softstop::Dimension;
use softstop_console::row;
use softstop_console::sheet::Sheet;
use softstop_draw::{Axis, Layer, Panel};
use softstop_dynamics::CycleMetrics;

use super::portrait::{SampledPeriod, faces};
use crate::design::Design;
use crate::page::figure::{BOUND, DESIGN, Figure, Section, WIDE};
use crate::page::words::quantity;

/// Periods that are drawn.
const PERIODS: u32 = 2;

/// The picture of the first of these motions, the design's.
pub(super) fn motion(design: &Design, motions: &[SampledPeriod]) -> Figure {
    let machine = &design.machine;
    let periods = motions.iter().take(1).flat_map(|motion| {
        let shifted = |count: u32| {
            let later = motion.length * f64::from(count);
            motion
                .points
                .iter()
                .map(move |[t, x, v, f]| [t + later, *x, *v, *f])
        };
        (0..PERIODS).flat_map(shifted)
    });
    let units = [
        Dimension::Time,
        Dimension::Length,
        Dimension::Velocity,
        Dimension::Force,
    ];
    let own = |point: [f64; 4]| std::array::from_fn(|it| machine.to_own(units[it], point[it]));
    let points: Vec<[f64; 4]> = periods.map(own).collect();
    let names = ["time", "position", "velocity", "force of contact"];
    let label = |it: usize| machine.label(names[it], "", units[it]);
    let [time, position_label, velocity, force] = std::array::from_fn(label);
    let end = points.last().map_or(0.0, |it| it[0]);
    let panel = |row: usize, label: &str, layers: Vec<Layer>| {
        let line = points.iter().map(|point| (point[0], point[row]));
        let layers = layers.into_iter().chain([Layer::line(line, DESIGN)]);
        Panel::new(Axis::new(&time).range((0.0, end)), Axis::new(label), layers)
    };
    let faces = faces(&machine.scene).into_iter();
    let faces = faces
        .map(|(_, at)| Layer::horizontal(at, BOUND, ""))
        .collect();
    let position = panel(1, &position_label, faces);
    let drawn = points.iter().map(|it| it[3].abs()).fold(0.0, f64::max);
    let stroke = CycleMetrics::of(&design.orbit);
    let largest = stroke.map_or(drawn, |it| machine.to_own(Dimension::Force, it.stop_force));
    let forces = (drawn > 0.0).then(|| panel(3, &force, Vec::new()));
    let of_forces = match &forces {
        Some(_) => {
            let largest = quantity(largest, machine.unit(Dimension::Force));
            format!(" Beside it the force of strip and stop on the mass, at most {largest}.")
        }
        None => String::new(),
    };
    let wall = match machine.scene.wall() {
        Some(_) => " An impact on a rigid stop is an instant and has no force in time.",
        None => "",
    };
    let caption = format!(
        "The position of the mass, with lines where it meets something. Time 0 is drive angle φ.{of_forces}{wall}"
    );
    let panels = [position].into_iter().chain(forces);
    let title = "Position and force of contact over two periods of the drive";
    let rows = points.iter().map(|[t, x, v, f]| row![*t, *x, *v, *f]);
    let sheet = Sheet::new("motion", [&time, &position_label, &velocity, &force], rows);
    let mut figure = Figure::new(Section::Motion, WIDE, title, panels, caption).with([sheet]);
    figure.chart.shares_y = false;
    figure
}
