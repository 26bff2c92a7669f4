//! The panel of the motions over frequency and stiffness.

use super::{GRAZING, HardeningChart, LETTERS, StopFolds, StopRegime};
use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::{self, Align, Area, Pen, Stroke};
use softstop_draw::style;

const FOLD: Stroke = Stroke::solid(style::INK, 2.0);

impl HardeningChart {
    /// On the way up; a dot where the way down ends in another motion.
    pub(super) fn map(&self, pen: &mut Pen, area: Area) {
        let panel = Panel::new(area, self.frequencies, self.decades);
        for regime in StopRegime::ALL {
            let cells = self.cells(&panel, |(up, _)| up == regime);
            if !cells.is_empty() {
                pen.fill(&cells, regime.color());
            }
        }
        let differs = self.cells(&panel, |(up, down)| up != down);
        let middle = |(x, y, width, height): &Area| (x + 0.5 * width, y + 0.5 * height);
        let dots: Vec<(f64, f64)> = differs.iter().map(middle).collect();
        pen.dots(&dots, 0.9, style::INK);
        for eta in [self.grazing.0, self.grazing.1] {
            panel.curve(pen, &[(eta, panel.y.0), (eta, panel.y.1)], GRAZING);
        }
        self.line(pen, &panel, FOLD, |fold| Some(fold.strong?.0));
        self.line(pen, &panel, FOLD, |fold| fold.flip);
        let axes = Axes::new(LETTERS, Some("η"), "log₁₀ k₂/k₁", (12, 5));
        panel.axes(pen, &axes);
        self.names(pen, &panel);
        self.legend(pen, (area.0, area.1 - 14.0));
    }

    /// The cells with such motions.
    fn cells(&self, panel: &Panel, wanted: impl Fn((StopRegime, StopRegime)) -> bool) -> Vec<Area> {
        let height = panel.area.3 / self.map.len().max(1) as f64;
        let mut cells = Vec::new();
        for (index, row) in self.map.iter().enumerate() {
            let top = panel.bottom() - height * (index + 1) as f64;
            let width = panel.area.2 / row.len().max(1) as f64;
            for (column, motions) in row.iter().enumerate() {
                if wanted(*motions) {
                    let left = panel.area.0 + width * column as f64;
                    cells.push((left, top, width, height));
                }
            }
        }
        cells
    }

    fn line(
        &self,
        pen: &mut Pen,
        panel: &Panel,
        stroke: Stroke,
        eta: impl Fn(&StopFolds) -> Option<f64>,
    ) {
        let place = |fold: &StopFolds| Some((eta(fold)?, fold.stiffness.log10()));
        let points: Vec<(f64, f64)> = self.folds.iter().filter_map(place).collect();
        panel.curve(pen, &points, stroke);
    }

    /// Names of the lines.
    fn names(&self, pen: &mut Pen, panel: &Panel) {
        let ink = (style::INK, true);
        let Some(last) = self.folds.iter().rev().find(|fold| fold.strong.is_some()) else {
            return;
        };
        if let Some((eta, _)) = last.strong {
            let place = (panel.across(eta) + 8.0, panel.area.1 + 24.0);
            pen.words(place, LETTERS, Align::Left, ink, "s_SN");
        }
        if let Some(eta) = last.flip {
            let place = (panel.across(eta) + 8.0, panel.area.1 + 24.0);
            pen.words(place, LETTERS, Align::Left, ink, "s_PD");
        }
        let place = (panel.across(self.grazing.1) + 6.0, panel.bottom() - 12.0);
        pen.words(place, LETTERS, Align::Left, ink, "g₀");
    }

    /// The motions that occur.
    fn legend(&self, pen: &mut Pen, (left, y): (f64, f64)) {
        let occurs = |regime: &StopRegime| {
            let mut motions = self.map.iter().flatten();
            motions.any(|(up, _)| up == regime)
        };
        let mut x = left;
        for regime in StopRegime::ALL.into_iter().filter(occurs) {
            let area = (x, y - 11.0, 16.0, 12.0);
            pen.fill(&[area], regime.color());
            pen.frame(area);
            pen.text((x + 21.0, y), 13, Align::Left, regime.name());
            x += 21.0 + pen::width(13, regime.name()) + 8.0;
        }
        pen.dots(&[(x + 4.0, y - 5.0)], 1.6, style::INK);
        pen.text((x + 12.0, y), 13, Align::Left, "falling η differs");
    }
}
