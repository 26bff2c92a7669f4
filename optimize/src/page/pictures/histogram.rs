//! How often a value occurs among machines within the tolerances.

use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::{Area, Pen, Stroke};
use softstop_draw::scale::around;
use softstop_draw::style;

use crate::page::data::Histogram;
use crate::page::figure::{EDGE, Figure, HALF, LETTERS, Names, RIGHT, ROOM, ends};
use crate::page::words::{count, quantity};

const AT: Stroke = Stroke::dashed(style::OPTIMUM, 1.8, (5.0, 4.0));

/// The picture.
pub(in crate::page) fn figure(histogram: &Histogram) -> Figure {
    let mut pen = Pen::new(HALF.width, HALF.height);
    let right = HALF.width - RIGHT;
    let mut marks = vec![("design".to_owned(), histogram.nominal)];
    marks.extend(histogram.worst.map(|worst| ("worst".to_owned(), worst)));
    let (low, high) = ends(histogram.range);
    let places = [low, high].into_iter().chain(marks.iter().map(|it| it.1));
    let all = histogram.counts.iter().sum::<u64>().max(1) as f64;
    let shares = histogram
        .counts
        .iter()
        .map(|count| 100.0 * *count as f64 / all);
    let shares: Vec<f64> = shares.collect();
    let highest = shares.iter().copied().fold(0.0, f64::max);
    let area = (ROOM.0, EDGE, right - ROOM.0, HALF.height - EDGE - ROOM.1);
    let panel = Panel::new(
        area,
        around(places, 0.04),
        (0.0, if highest > 0.0 { 1.08 * highest } else { 1.0 }),
    );
    let names = Names::new(&panel, &marks);
    let panel = names.room(panel);
    let name = histogram.x.line();
    let axes = Axes::new(LETTERS, Some(&name), "machines in each bar (%)", (5, 5));
    panel.ground(&mut pen, &axes);
    let step = (high - low) / shares.len().max(1) as f64;
    let bars = shares.iter().enumerate().filter(|(_, share)| **share > 0.0);
    let bars: Vec<Area> = bars
        .map(|(index, share)| {
            let from = panel.place((low + step * index as f64, *share));
            let wide = panel.across(low + step * (index + 1) as f64) - from.0;
            (from.0, from.1, wide.max(0.5), panel.bottom() - from.1)
        })
        .collect();
    pen.fill(&bars, style::ALLOWED);
    names.draw(&mut pen, &panel, AT);
    panel.axes(&mut pen, &axes);
    let unit = &histogram.x.unit;
    let lost = match histogram.lost {
        0 => "none of them loses the motion".to_owned(),
        1 => "one of them loses the motion".to_owned(),
        lost => format!("{} of them lose the motion", count(lost)),
    };
    let worst = histogram.worst.map_or(String::new(), |worst| {
        format!(
            ", the worst within the tolerances {}",
            quantity(worst, unit)
        )
    });
    let caption = format!(
        "{} machines drawn from the tolerances: {lost}. The design has {}{worst}.",
        count(histogram.samples),
        quantity(histogram.nominal, unit)
    );
    Figure::new(&pen, HALF, "The machines as they will be built", caption)
}
