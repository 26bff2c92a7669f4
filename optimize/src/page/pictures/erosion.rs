//! How the basin of z = 1 shrinks along the zone.

use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::{Pen, Stroke};
use softstop_draw::shapes::Sign;
use softstop_draw::style;

use crate::page::data::Erosion;
use crate::page::figure::{EDGE, Figure, HALF, LETTERS, LINE, Names, RIGHT, ROOM, legend};

const SHARE: Stroke = Stroke::solid(style::DESIGN, 2.5);
const INTEGRITY: Stroke = Stroke::dashed(style::REFERENCE, 2.5, (9.0, 4.0));
const REQUIRED: Stroke = Stroke::dashed(style::ASIDE, 1.6, (3.0, 3.0));
const DESIGN: Stroke = Stroke::dashed(style::OPTIMUM, 1.6, (5.0, 4.0));

/// The picture.
pub(in crate::page) fn figure(erosion: &Erosion) -> Figure {
    let mut pen = Pen::new(HALF.width, HALF.height);
    let right = HALF.width - RIGHT;
    let points = || erosion.points.iter().filter(|it| it.share.is_finite());
    let shares: Vec<(f64, f64)> = points().map(|it| (it.place, it.share)).collect();
    let integrity = points().filter_map(|it| Some((it.place, it.integrity?)));
    let integrity: Vec<(f64, f64)> = integrity.collect();
    let mut entries = vec![(Sign::Line(SHARE), "share of starts".to_owned())];
    if !integrity.is_empty() {
        entries.push((Sign::Line(INTEGRITY), "integrity".to_owned()));
    }
    if erosion.required.is_some() {
        entries.push((Sign::Line(REQUIRED), "share required".to_owned()));
    }
    let top = legend(&mut pen, (ROOM.0, EDGE + 4.0), right, &entries) - LINE + 14.0;
    let area = (ROOM.0, top, right - ROOM.0, HALF.height - top - ROOM.1);
    let panel = Panel::new(area, (0.0, 1.0), (0.0, 1.02));
    let design = erosion.design.map(|place| ("design".to_owned(), place));
    let names = Names::new(&panel, design.as_slice());
    let panel = names.room(panel);
    let across = "place s in the zone: 0 at g₀, 1 at s_SN";
    let axes = Axes::new(LETTERS, Some(across), "share, integrity", (5, 5));
    panel.ground(&mut pen, &axes);
    let sure: Vec<(f64, [f64; 2])> = points()
        .map(|it| (it.place, it.interval.map(|end| end.clamp(0.0, 1.0))))
        .collect();
    if sure.len() > 1 {
        panel.band(&mut pen, &sure, style::DESIGN, 0.2);
    }
    if let Some(required) = erosion.required {
        panel.curve(&mut pen, &[(0.0, required), (1.0, required)], REQUIRED);
    }
    names.draw(&mut pen, &panel, DESIGN);
    panel.curve(&mut pen, &integrity, INTEGRITY);
    panel.curve(&mut pen, &shares, SHARE);
    panel.axes(&mut pen, &axes);
    let starts = match erosion.starts.as_str() {
        "" => String::new(),
        starts => format!(" Starts: {starts}."),
    };
    let caption = format!(
        "Share of the initial states that lead to the design's kind of motion, with its 95 % interval, and the radius of \
         the largest ball about the motion inside its basin.{starts}"
    );
    Figure::new(&pen, HALF, "How the basin shrinks along the zone", caption)
}
