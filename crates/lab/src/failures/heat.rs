//! One map of an atlas: verdicts over stiffness and step, axes, and the limits that theory sets.

use crate::methods::Verdict;

use crate::failures::{Axes, Cell};
use softstop_draw::pen::{Align, Area, Pen};
use softstop_draw::scale::power_of_ten;

/// Size of the letters at the axes.
const SMALL: u32 = 11;
/// Room between an axis and its numbers.
const TICK: f64 = 4.0;
/// Dashes of the line where a contact is as short as a step.
pub(super) const DASHES: (f64, f64) = (2.0, 3.0);

/// Where the cells of a map lie on the page.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid<'a> {
    pub(super) axes: &'a Axes,
    /// Left and upper end.
    pub(super) corner: (f64, f64),
    /// Width and height of a cell: whole pixels.
    pub(super) cell: (f64, f64),
}

/// A verdict, and the columns and steps from (inclusive) and to (exclusive) of a rectangle of cells that have it.
type Block = (Verdict, [usize; 2], [usize; 2]);

impl Grid<'_> {
    pub(super) fn size(&self) -> (f64, f64) {
        let (columns, steps) = (self.axes.stiffness.len(), self.axes.step.len());
        (self.cell.0 * columns as f64, self.cell.1 * steps as f64)
    }

    pub(super) fn area(&self) -> Area {
        let (width, height) = self.size();
        (self.corner.0, self.corner.1, width, height)
    }

    /// Where a stiffness is.
    fn x(&self, stiffness: f64) -> f64 {
        self.corner.0 + self.cell.0 * (place(&self.axes.stiffness, stiffness) + 0.5)
    }

    /// Where a step is.
    fn y(&self, step: f64) -> f64 {
        let bottom = self.corner.1 + self.size().1;
        bottom - self.cell.1 * (place(&self.axes.step, step) + 0.5)
    }

    /// The verdicts, a column for each stiffness.
    pub(super) fn verdicts(&self, pen: &mut Pen, columns: &[Vec<Cell>]) {
        let blocks = blocks(columns);
        let bottom = self.corner.1 + self.size().1;
        for verdict in Verdict::ALL {
            let own = blocks.iter().filter(|block| block.0 == verdict);
            let areas = own.map(|(_, [left, right], [low, high])| {
                (
                    self.corner.0 + self.cell.0 * *left as f64,
                    bottom - self.cell.1 * *high as f64,
                    self.cell.0 * (right - left) as f64,
                    self.cell.1 * (high - low) as f64,
                )
            });
            let areas: Vec<Area> = areas.collect();
            if !areas.is_empty() {
                pen.fill(&areas, color(verdict));
            }
        }
    }

    /// A line of steps over stiffness, as far as it lies on the map.
    pub(super) fn line(&self, pen: &mut Pen, steps: &[Option<f64>], dashes: Option<(f64, f64)>) {
        let (_, top, _, height) = self.area();
        let point = |(stiffness, step): (&f64, &Option<f64>)| {
            let (x, y) = (self.x(*stiffness), self.y((*step)?));
            (y >= top && y <= top + height).then_some((x, y))
        };
        let points = self.axes.stiffness.iter().zip(steps).map(point);
        for piece in points.collect::<Vec<_>>().split(Option::is_none) {
            let piece: Vec<(f64, f64)> = piece.iter().copied().flatten().collect();
            if piece.len() > 1 {
                pen.rimmed(&piece, dashes);
            }
        }
    }

    /// Ticks of the stiffness below the map.
    pub(super) fn stiffness_axis(&self, pen: &mut Pen) {
        let (_, top, _, height) = self.area();
        for exponent in powers(&self.axes.stiffness) {
            let (x, y) = (self.x(10_f64.powi(exponent)), top + height);
            pen.tick((x, y), (x, y + TICK));
            if exponent % 2 == 0 {
                let place = (x, y + TICK + 12.0);
                pen.text(place, SMALL, Align::Middle, &power_of_ten(exponent));
            }
        }
    }

    /// Ticks of the step at the left of the map.
    pub(super) fn step_axis(&self, pen: &mut Pen) {
        let (x, ..) = self.area();
        for exponent in powers(&self.axes.step) {
            let y = self.y(10_f64.powi(exponent));
            pen.tick((x - TICK, y), (x, y));
            let place = (x - TICK - 3.0, y + 4.0);
            pen.text(place, SMALL, Align::Right, &power_of_ten(exponent));
        }
    }
}

/// The index of a value in a logarithmic row, as a real number.
fn place(row: &[f64], value: f64) -> f64 {
    match (row.first(), row.last()) {
        (Some(first), Some(last)) if last > first => {
            (row.len() - 1) as f64 * (value / first).ln() / (last / first).ln()
        }
        _ => 0.0,
    }
}

/// The powers of ten within a row.
fn powers(row: &[f64]) -> std::ops::RangeInclusive<i32> {
    // What is a power of ten but for rounding is one.
    let low = row.first().map_or(0.0, |value| value.log10() - 1e-9);
    let high = row.last().map_or(0.0, |value| value.log10() + 1e-9);
    low.ceil() as i32..=high.floor() as i32
}

/// The cells in few rectangles: runs of each column, joined with the same runs of the column before.
fn blocks(columns: &[Vec<Cell>]) -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    for (column, cells) in columns.iter().enumerate() {
        let mut from = 0;
        for run in cells.chunk_by(|a, b| a.verdict == b.verdict) {
            let (verdict, steps) = (run[0].verdict, [from, from + run.len()]);
            from = steps[1];
            let joins =
                |block: &&mut Block| (block.0, block.1[1], block.2) == (verdict, column, steps);
            match blocks.iter_mut().rev().find(joins) {
                Some(block) => block.1[1] = column + 1,
                None => blocks.push((verdict, [column, column + 1], steps)),
            }
        }
    }
    blocks
}

/// The colour of a class of outcomes: blues where the motion is right at least in kind, all others apart from
/// them and from each other in lightness too, so that readers who see no green and red tell them apart.
pub(super) const fn color(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Converged => "#0072B2",
        Verdict::Inaccurate => "#9CCDEC",
        Verdict::WrongCount => "#F0E442",
        Verdict::MissedContact => "#009E73",
        Verdict::EnergyGain => "#CC6D00",
        Verdict::BlownUp => "#3A3A3A",
        Verdict::Stuck => "#7F3B08",
        Verdict::Unsuited => "#EEEEEE",
    }
}
