//! One period in the phase plane: the whole motion, and the part of it near the stop.

use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::Pen;
use softstop_draw::scale::around;
use softstop_draw::shapes::Sign;

use super::stroke;
use crate::page::data::Portrait;
use crate::page::figure::{
    BOUND, EDGE, Figure, LETTERS, LINE, Names, RIGHT, ROOM, WIDE, finite, legend,
};

/// How far before the first face the near part begins, in units of how far the mass goes beyond it.
const BEFORE: f64 = 0.8;

/// The picture.
pub(in crate::page) fn figure(portrait: &Portrait) -> Figure {
    let mut pen = Pen::new(WIDE.width, WIDE.height);
    let right = WIDE.width - RIGHT;
    let mut entries: Vec<(Sign, String)> = Vec::new();
    for curve in &portrait.curves {
        if !entries.iter().any(|(_, name)| *name == curve.name) {
            entries.push((Sign::Line(stroke(curve.role)), curve.name.clone()));
        }
    }
    let top = legend(&mut pen, (ROOM.0, EDGE + 4.0), right, &entries) - LINE + 14.0;
    let points: Vec<(f64, f64)> = portrait
        .curves
        .iter()
        .flat_map(|curve| finite(&curve.points))
        .collect();
    let across = around(points.iter().map(|it| it.0), 0.06);
    let up = around(points.iter().map(|it| it.1), 0.06);
    let first = portrait
        .faces
        .iter()
        .map(|face| face.1)
        .fold(f64::INFINITY, f64::min);
    let deepest = points
        .iter()
        .map(|it| it.0)
        .fold(f64::NEG_INFINITY, f64::max);
    let depth = deepest - first;
    let names = (portrait.x.line(), portrait.y.line());
    let near_name = format!("{}, near the stop", portrait.x.name);
    let near_name = match portrait.x.unit.as_str() {
        "" => near_name,
        unit => format!("{near_name} ({unit})"),
    };
    let wide = 0.5 * (right - 2.0 * ROOM.0 - 14.0);
    let tall = WIDE.height - top - ROOM.1;
    let near = (first - BEFORE * depth, deepest + 0.15 * depth);
    let mut panels = vec![(
        Panel::new((ROOM.0, top, wide, tall), across, up),
        &names.0,
        false,
    )];
    if depth.is_finite() && depth > 0.0 {
        let area = (right - wide, top, wide, tall);
        panels.push((Panel::new(area, near, up), &near_name, true));
    }
    let last = panels.last().map(|(panel, ..)| *panel);
    let faces = last.map(|panel| Names::new(&panel, &portrait.faces));
    for (panel, name, is_near) in panels {
        let panel = faces.as_ref().map_or(panel, |faces| faces.room(panel));
        let axes = Axes::new(LETTERS, Some(name), &names.1, (4, 6));
        panel.ground(&mut pen, &axes);
        match &faces {
            Some(faces) if is_near => faces.draw(&mut pen, &panel, BOUND),
            _ => portrait
                .faces
                .iter()
                .filter(|face| face.1.is_finite())
                .for_each(|(_, at)| {
                    panel.curve(&mut pen, &[(*at, up.0), (*at, up.1)], BOUND);
                }),
        }
        for curve in &portrait.curves {
            panel.curve(&mut pen, &finite(&curve.points), stroke(curve.role));
        }
        panel.axes(&mut pen, &axes);
    }
    let caption = "Left the whole motion, right the same near the stop. The mass runs round clockwise: up on its way to the \
                   stop, down on its way back.";
    Figure::new(
        &pen,
        WIDE,
        "One period of the motion in the phase plane",
        caption.to_owned(),
    )
}
