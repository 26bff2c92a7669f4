//! The arrows of a bifurcation diagram: where a sweep jumps.

use kuva::plot::LinePlot;
use kuva::render::annotations::TextAnnotation;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use softstop_dynamics::sweep::{Direction, Jump};

use super::chart::{SweepChart, WAYS};

/// Height of a jump, in units of the axis, that has an arrow.
const SEEN: f64 = 0.15;

impl SweepChart<'_> {
    /// The jumps that are seen, and which way they go.
    fn jumps(&self) -> Vec<(Direction, Jump)> {
        let top = self.range(|step| step.velocities.clone()).1;
        let jumps = self.chains.iter().flat_map(|chain| {
            let jumps = chain.jumps().into_iter();
            jumps.map(move |jump| (chain.direction, jump))
        });
        let far = |(_, jump): &(Direction, Jump)| {
            (jump.velocities.0 - jump.velocities.1).abs() > SEEN * top
        };
        jumps.filter(far).collect()
    }

    /// The shafts of their arrows.
    pub(super) fn arrows(&self) -> Vec<Plot> {
        let arrow = |(direction, jump): (Direction, Jump)| {
            let (before, after) = jump.velocities;
            Plot::Line(
                LinePlot::new()
                    .with_data([(jump.from, before), (jump.to, after)])
                    .with_color(color(direction))
                    .with_stroke_width(1.0),
            )
        };
        self.jumps().into_iter().map(arrow).collect()
    }

    pub(super) fn arrow_heads(&self, layout: Layout) -> Layout {
        let (low, high) = self.range(|step| step.velocities.clone());
        self.jumps()
            .into_iter()
            .fold(layout, |layout, (direction, jump)| {
                let (before, after) = jump.velocities;
                let (head, shift) = if after > before {
                    ("▲", -0.02)
                } else {
                    ("▼", 0.01)
                };
                let place = after + shift * (high - low);
                let head = TextAnnotation::new(head, jump.to, place).with_font_size(10);
                layout.with_annotation(head.with_color(color(direction)))
            })
    }
}

fn color(direction: Direction) -> &'static str {
    match direction {
        Direction::Up => WAYS[1].1,
        Direction::Down => WAYS[2].1,
    }
}
