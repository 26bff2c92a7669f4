//! The panel of the motions over frequency and stiffness.

use super::{Chart, LETTERS, grazes};
use crate::hardening::DECADES;
use crate::hardening::folds::Folds;
use crate::hardening::stops::{CLEARANCE, grazing};
use crate::hardening::swept::{Kind, RANGE, kind};
use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::{self, Align, Area, Pen, Stroke};
use softstop_draw::style;

const FOLD: Stroke = Stroke::solid(style::INK, 2.0);

impl Chart<'_> {
    /// On the way up; a dot where the way down ends in another motion.
    pub(super) fn map(&self, pen: &mut Pen, area: Area) {
        let panel = Panel::new(area, RANGE, DECADES);
        let cells = self.cells(&panel);
        for own in Kind::ALL {
            let cells = cells.iter().filter(|(up, _, _)| *up == own);
            let areas: Vec<Area> = cells.map(|cell| cell.2).collect();
            if !areas.is_empty() {
                pen.fill(&areas, own.color());
            }
        }
        let differs = cells.iter().filter(|(up, down, _)| up != down);
        let dots = differs.map(|(.., (x, y, width, height))| (x + 0.5 * width, y + 0.5 * height));
        pen.dots(&dots.collect::<Vec<_>>(), 0.9, style::INK);
        grazes(pen, &panel);
        let lines = [
            |fold: &Folds| Some(fold.strong?.0),
            |fold: &Folds| fold.flip,
        ];
        for eta in lines {
            let points = self.folds.iter();
            let points = points.filter_map(|fold| Some((eta(fold)?, fold.stiffness.log10())));
            panel.curve(pen, &points.collect::<Vec<_>>(), FOLD);
        }
        let axes = Axes::new(LETTERS, Some("η"), "log₁₀ k₂/k₁", (12, 5));
        panel.axes(pen, &axes);
        if let Some(last) = self.folds.iter().rfind(|fold| fold.strong.is_some()) {
            let mut name = |eta: f64, shift: f64, y: f64, name: &str| {
                let (place, ink) = ((panel.across(eta) + shift, y), (style::INK, true));
                pen.words(place, LETTERS, Align::Left, ink, name);
            };
            for (eta, text) in lines.map(|eta| eta(last)).into_iter().zip(["s_SN", "s_PD"]) {
                if let Some(eta) = eta {
                    name(eta, 8.0, area.1 + 24.0, text);
                }
            }
            name(grazing(CLEARANCE).1, 6.0, panel.bottom() - 12.0, "g₀");
        }
        let occurs = |kind: &Kind| cells.iter().any(|(up, ..)| up == kind);
        let (mut x, y) = (area.0, area.1 - 14.0);
        for kind in Kind::ALL.into_iter().filter(occurs) {
            let area = (x, y - 11.0, 16.0, 12.0);
            pen.fill(&[area], kind.color());
            pen.frame(area);
            pen.text((x + 21.0, y), 13, Align::Left, kind.name());
            x += 21.0 + pen::width(13, kind.name()) + 8.0;
        }
        pen.dots(&[(x + 4.0, y - 5.0)], 1.6, style::INK);
        pen.text((x + 12.0, y), 13, Align::Left, "falling η differs");
    }

    /// The cells with the motions on the way up and on the way down.
    fn cells(&self, panel: &Panel) -> Vec<(Kind, Kind, Area)> {
        let height = panel.area.3 / self.map.len().max(1) as f64;
        let mut cells = Vec::new();
        for (index, swept) in self.map.iter().enumerate() {
            let top = panel.bottom() - height * (index + 1) as f64;
            let width = panel.area.2 / swept.up.len().max(1) as f64;
            for (column, (up, down)) in swept.up.iter().zip(&swept.down).enumerate() {
                let left = panel.area.0 + width * column as f64;
                cells.push((kind(up), kind(down), (left, top, width, height)));
            }
        }
        cells
    }
}
