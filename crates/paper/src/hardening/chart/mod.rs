//! The chart of stops from soft to rigid: diagrams, a map of the motions, and folds.

mod map;
mod subharmonics;
mod widths;

use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Area, Pen, Stroke};
use softstop_draw::style;

/// A kind of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StopRegime {
    /// Without impacts.
    None,
    /// z = 1.
    One,
    /// z = n/n with n > 1: as many impacts as drive periods.
    Split,
    /// z = 1/2.
    Half,
    /// Another z = p/n.
    Other,
    /// Chaos.
    Chaos,
    /// Not settled.
    Unsettled,
}

impl StopRegime {
    const ALL: [Self; 7] = [
        Self::None,
        Self::One,
        Self::Split,
        Self::Half,
        Self::Other,
        Self::Chaos,
        Self::Unsettled,
    ];

    /// What it is called.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "z = 0",
            Self::One => "z = 1",
            Self::Split => "z = n/n, n > 1",
            Self::Half => "z = 1/2",
            Self::Other => "other z = p/n",
            Self::Chaos => "chaos",
            Self::Unsettled => "not settled",
        }
    }

    const fn color(self) -> &'static str {
        match self {
            Self::None => "#ededed",
            Self::One => "#9CCDEC",
            Self::Split => style::DESIGN,
            Self::Half => "#009E73",
            Self::Other => "#F0E442",
            Self::Chaos => style::OPTIMUM,
            Self::Unsettled => "#a8a8a8",
        }
    }
}

/// Where the branch of z = 1 bends.
#[derive(Debug, Clone, Copy)]
pub struct StopFolds {
    /// k2/k1.
    pub stiffness: f64,
    /// η and X'₋ where strong impacts end.
    pub strong: Option<(f64, f64)>,
    /// η and X'₋ where weak impacts end.
    pub weak: Option<(f64, f64)>,
    /// η of the flip right beyond grazing, below the resonance.
    pub first_flip: Option<f64>,
    /// η of the flip from which on z = 1 is stable.
    pub flip: Option<f64>,
}

/// Motions z = 1/n of stops with a narrow clearance.
#[derive(Debug, Clone)]
pub struct StopOrders {
    /// What is shown.
    pub title: String,
    /// Range of η.
    pub frequencies: (f64, f64),
    /// η up to which the impact-less motion would hit the stop.
    pub grazing: f64,
    /// For each stop its name, and η and n of its motions.
    pub found: Vec<(String, Vec<(f64, f64)>)>,
}

/// A stop's name, and η and X'₋ on the way up and on the way down.
pub type Diagram = (String, [Vec<(f64, f64)>; 2]);

/// The chart.
#[derive(Debug, Clone)]
pub struct HardeningChart {
    /// What holds for all of it.
    pub explanation: String,
    /// η at which the impact-less motion grazes.
    pub grazing: (f64, f64),
    /// Range of η.
    pub frequencies: (f64, f64),
    /// The diagrams.
    pub diagrams: Vec<Diagram>,
    /// log10 of the least and the largest k2/k1 of the map.
    pub decades: (f64, f64),
    /// For each stiffness, rising, the motions on the way up and on the way down.
    pub map: Vec<Vec<(StopRegime, StopRegime)>>,
    /// The folds, by rising stiffness.
    pub folds: Vec<StopFolds>,
    /// Motions of higher order.
    pub orders: StopOrders,
}

const PAGE: (f64, f64) = (1480.0, 1212.0);
const LETTERS: u32 = 14;
/// Diagrams in a row.
const ACROSS: usize = 4;
/// Left end and top of the first diagram, distance to the next, and size.
const DIAGRAM: ((f64, f64), (f64, f64), (f64, f64)) =
    ((78.0, 104.0), (354.0, 272.0), (306.0, 208.0));
const MAP: Area = (78.0, 694.0, 760.0, 420.0);
const WIDTHS: Area = (938.0, 694.0, 508.0, 176.0);
const ORDERS: Area = (938.0, 956.0, 508.0, 158.0);
const GRAZING: Stroke = Stroke::dashed(style::INK, 1.2, (5.0, 4.0));
/// Radius of a dot of the diagrams.
const DOT: f64 = 1.0;

impl HardeningChart {
    /// The picture as an SVG document.
    pub fn svg(&self) -> String {
        let mut pen = Pen::new(PAGE.0, PAGE.1);
        let title = "From a soft to a rigid stop: the stiffness k₂ from 0 to infinity";
        heading(&mut pen, (28.0, 38.0), title, &self.explanation);
        legend(&mut pen, (PAGE.0 - 320.0, 60.0));
        for (row, diagrams) in self.diagrams.chunks(ACROSS).enumerate() {
            // What is linear grows without regard to the clearance.
            let top = fastest(&diagrams[usize::from(row == 0)..]);
            for (column, diagram) in diagrams.iter().enumerate() {
                self.diagram(&mut pen, (column, row), diagram, top);
            }
        }
        self.map(&mut pen, MAP);
        self.widths(&mut pen, WIDTHS);
        self.orders.draw(&mut pen, ORDERS);
        pen.svg()
    }

    fn diagram(&self, pen: &mut Pen, at: (usize, usize), (title, [up, down]): &Diagram, top: f64) {
        let ((left, first), (across, below), (width, height)) = DIAGRAM;
        let (column, row) = at;
        let corner = (left + across * column as f64, first + below * row as f64);
        let panel = Panel::new(
            (corner.0, corner.1, width, height),
            self.frequencies,
            (0.0, top),
        );
        let last = row + 1 == self.diagrams.len().div_ceil(ACROSS);
        let axes = Axes::new(
            LETTERS,
            Some(if last { "η" } else { "" }),
            if column == 0 {
                "before-impact velocity X′₋"
            } else {
                ""
            },
            (6, 5),
        );
        panel.ground(pen, &axes);
        for eta in [self.grazing.0, self.grazing.1] {
            panel.curve(pen, &[(eta, 0.0), (eta, top)], GRAZING);
        }
        panel.dots(pen, down.iter().copied(), DOT, style::OPTIMUM);
        panel.dots(pen, up.iter().copied(), DOT, style::DESIGN);
        panel.axes(pen, &axes);
        pen.heading((corner.0, corner.1 - 8.0), 15, Align::Left, title);
    }
}

/// A little more than the highest velocity.
fn fastest(diagrams: &[Diagram]) -> f64 {
    let points = diagrams.iter().flat_map(|(_, ways)| ways).flatten();
    1.08 * points.map(|point| point.1).fold(0.0, f64::max)
}

/// Which way is which colour.
fn legend(pen: &mut Pen, (left, y): (f64, f64)) {
    let ways = [
        ("η rising", style::DESIGN),
        ("η falling only", style::OPTIMUM),
    ];
    for (index, (name, color)) in ways.into_iter().enumerate() {
        let x = left + 130.0 * index as f64;
        pen.dots(&[(x, y - 5.0)], 5.0, color);
        pen.text((x + 12.0, y), LETTERS, Align::Left, name);
    }
}
