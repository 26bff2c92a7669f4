//! The panels of velocity and force over position.

use softstop::PhaseKind;

use super::{CURVE, FACE, GUIDE, LETTERS, StrokeChart, StrokePoint};
use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::{Align, Area, Pen, Stroke};
use softstop_draw::style;
use softstop_explore::simulate::chart::color;

/// The axis in a panel.
const ZERO: Stroke = Stroke::solid("#cccccc", 1.0);

fn state(point: &StrokePoint) -> (f64, f64) {
    (point.position, point.velocity)
}

impl StrokeChart {
    /// The phase trajectory.
    pub(super) fn trajectory(&self, pen: &mut Pen, area: Area) {
        let (low, _) = self.range(|point| (point.time, point.position));
        let (slow, fast) = self.range(state);
        let panel = Panel::new(
            area,
            (1.12 * low, 1.3 * self.max_position),
            (1.18 * slow, 1.18 * fast),
        );
        self.plane(pen, &panel, "position X", "velocity X′", state);
        self.strike(pen, &panel);
    }

    /// The part of it beyond the clearance.
    pub(super) fn contact(&self, pen: &mut Pen, area: Area) {
        let depth = self.depth();
        let (low, high) = self.range(|point| match point.phase {
            PhaseKind::Free => (point.position, 0.0),
            _ => (point.position, point.velocity),
        });
        let room = 0.22 * (high - low);
        let panel = Panel::new(
            area,
            (
                self.clearance - 0.6 * depth,
                self.max_position + 0.25 * depth,
            ),
            (low - room, high + room),
        );
        self.tint(pen, &panel);
        let name = "position X beyond the clearance";
        self.plane(pen, &panel, name, "velocity X′", state);
        self.strike(pen, &panel);
        let beside = [(11.0, -9.0), (12.0, -7.0), (12.0, 18.0)];
        self.letters(pen, &panel, state, beside);
        for (face, name) in self.faces() {
            let place = (panel.across(face) + 4.0, panel.bottom() - 8.0);
            pen.text(place, LETTERS - 1, Align::Left, name);
        }
    }

    /// The force of contact.
    pub(super) fn force(&self, pen: &mut Pen, area: Area) {
        let show = |point: &StrokePoint| (point.position, point.force);
        let depth = self.depth();
        let (low, high) = self.range(show);
        let room = 0.12 * (high - low);
        let panel = Panel::new(
            area,
            (
                self.clearance - 0.3 * depth,
                self.max_position + 0.2 * depth,
            ),
            (low - room, high + room),
        );
        self.tint(pen, &panel);
        self.plane(pen, &panel, "position X", "contact force F/F₀", show);
    }

    /// What a panel shows, with the faces and the axis.
    fn plane(
        &self,
        pen: &mut Pen,
        panel: &Panel,
        across: &str,
        upwards: &str,
        show: fn(&StrokePoint) -> (f64, f64),
    ) {
        for (face, _) in self.faces() {
            panel.curve(pen, &[(face, panel.y.0), (face, panel.y.1)], FACE);
        }
        panel.curve(pen, &[(panel.x.0, 0.0), (panel.x.1, 0.0)], ZERO);
        panel.curve(pen, &self.curve(show), CURVE);
        let axes = Axes::new(LETTERS, Some(across), upwards, (4, 6));
        panel.axes(pen, &axes);
    }

    /// Marks X'₋ where the mass comes to the clearance.
    fn strike(&self, pen: &mut Pen, panel: &Panel) {
        let velocity = self.before_impact_velocity;
        panel.curve(
            pen,
            &[(panel.x.0, velocity), (self.clearance, velocity)],
            GUIDE,
        );
        pen.spot(panel.place((self.clearance, velocity)), 4.0);
        let place = (panel.area.0 + 8.0, panel.height(velocity) + 17.0);
        let ink = (style::OPTIMUM, true);
        pen.words(place, LETTERS + 1, Align::Left, ink, "X′₋");
    }

    /// Shades the layers beyond the clearance.
    fn tint(&self, pen: &mut Pen, panel: &Panel) {
        let faces = self.faces();
        let kinds = match faces.len() {
            1 => &[PhaseKind::Stop][..],
            _ => &[PhaseKind::Pierce, PhaseKind::Cut, PhaseKind::Stop],
        };
        let ends = faces.iter().skip(1).map(|face| face.0);
        let layers = faces.iter().zip(ends.chain([panel.x.1])).zip(kinds);
        for (((from, _), to), kind) in layers {
            let (left, right) = (panel.across(*from), panel.across(to));
            let area = (left, panel.area.1, right - left, panel.area.3);
            if let Some(color) = color(*kind) {
                pen.tint(area, color, 0.55);
            }
        }
    }
}
