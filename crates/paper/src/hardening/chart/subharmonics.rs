//! The panel of the frequencies at which there are motions z = 1/n.

use super::{GRAZING, LETTERS, StopOrders};
use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::{self, Align, Area, Pen};
use softstop_draw::style;

/// Colours of the stops, in their order, and how much lower the dots of each are drawn.
const STOPS: [(&str, f64); 3] = [
    ("#009E73", -0.17),
    (style::DESIGN, 0.0),
    (style::OPTIMUM, 0.17),
];

impl StopOrders {
    pub(super) fn draw(&self, pen: &mut Pen, area: Area) {
        let orders = self.found.iter().flat_map(|(_, motions)| motions);
        let highest = orders.map(|motion| motion.1).fold(2.0, f64::max);
        let panel = Panel::new(area, self.frequencies, (1.4, highest + 0.6));
        let axes = Axes::new(LETTERS, Some("η"), "n of z = 1/n", (9, highest as usize));
        panel.ground(pen, &axes);
        let grazing = [(self.grazing, panel.y.0), (self.grazing, panel.y.1)];
        panel.curve(pen, &grazing, GRAZING);
        let mut right = area.0 + area.2 - 8.0;
        for ((name, motions), (color, shift)) in self.found.iter().zip(STOPS).rev() {
            let points = motions.iter().map(|&(eta, order)| (eta, order - shift));
            panel.dots(pen, points, 3.2, color);
            right -= pen::width(13, name);
            let place = (right, panel.bottom() - 9.0);
            pen.words(place, 13, Align::Left, (color, true), name);
            right -= 10.0;
        }
        let place = (panel.across(self.grazing) + 6.0, area.1 + 18.0);
        let name = "g₀: beyond it z = 0 coexists";
        pen.words(place, LETTERS - 1, Align::Left, (style::INK, true), name);
        panel.axes(pen, &axes);
        pen.heading((area.0, area.1 - 14.0), 15, Align::Left, &self.title);
    }
}
