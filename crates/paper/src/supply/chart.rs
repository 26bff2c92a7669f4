//! How many z = 1 motions outlast an interrupted supply, and how many miss no stroke.

use anyhow::Result;
use softstop_draw::{Align, Chart, Layer, Sign, Stroke, style};
use softstop_dynamics::basin::wilson_interval;

use crate::figure::Figure;

use super::{Outcome, READINGS, RUNS, of_run};

/// The line of the share without a missed stroke.
const DOTS: (f64, f64) = (2.0, 4.0);
const MARK: Stroke = Stroke::dashed(style::INK, 1.2, (5.0, 4.0));

/// The chart; `fold` is where z = 1 ends with strips.
pub(super) fn chart(
    figure: &Figure,
    outcomes: &[Outcome],
    grazing: f64,
    fold: f64,
) -> Result<Chart> {
    let right = outcomes.iter().map(|it| it.eta).fold(fold, f64::max);
    let room = 0.03 * (right - grazing);
    let layers = READINGS.into_iter().map(|(reading, _)| {
        let runs = RUNS.into_iter().enumerate();
        let curves = runs.flat_map(|(index, mean)| {
            let color = style::ordered(index, RUNS.len());
            curves(of_run(outcomes, reading, mean).collect(), color, mean)
        });
        let marks = [
            Layer::vertical(grazing, MARK, ""),
            Layer::text((grazing, 0.5), Align::Left, "g₀").moved(6.0, 0.0),
            Layer::vertical(fold, MARK, "s_SN with strips"),
        ];
        let keys = [
            (Stroke::solid(style::INK, 2.2), "z = 1 in the end"),
            (Stroke::dashed(style::INK, 1.6, DOTS), "no stroke missed"),
        ];
        let keys = keys.map(|(stroke, name)| Layer::key(Sign::Line(stroke), name));
        curves.chain(marks).chain(keys).collect()
    });
    let mut chart = figure.picture(layers)?;
    for panel in &mut chart.panels {
        panel.x.ends = [grazing - room, right + room].map(Some);
    }
    Ok(chart)
}

/// How many are z = 1 in the end, and how many have missed no stroke.
fn curves(outcomes: Vec<&Outcome>, color: &'static str, mean: f64) -> Vec<Layer> {
    let share =
        |it: &Outcome, lost: usize| (it.eta, (it.motions - lost) as f64 / it.motions as f64);
    let interval = |it: &&Outcome| (it.eta, wilson_interval(it.motions - it.ended, it.motions));
    let open = outcomes.split(|it| it.ended == 0 || it.ended == it.motions);
    let bands = open.map(|it| Layer::band(it.iter().map(interval), color, 0.2));
    let stay = outcomes.iter().map(|it| share(it, it.ended));
    let struck = outcomes.iter().map(|it| share(it, it.missed));
    let lines = [
        Layer::line(stay, Stroke::solid(color, 2.2)).named(format!("runs of {mean} periods")),
        Layer::line(struck, Stroke::dashed(color, 1.6, DOTS)),
    ];
    bands.chain(lines).collect()
}
