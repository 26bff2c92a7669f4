//! Basin entropy: how uncertain it is which basin a start lies in (Daza, Wagemakers, Georgeot, Guery-Odelin, Sanjuan,
//! Scientific Reports 6 (2016) 31416).

use super::Basins;

/// Number of cells on a side of the boxes in which the entropy of basins is counted, as in the source.
const BOX_CELLS: usize = 5;

/// The basin entropy of a grid.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct BasinEntropy {
    /// S_b: the mean over boxes of 5 by 5 cells of the sum of -p ln p over the shares p of the basins in it (eq. 4).
    pub basin: f64,
    /// S_bb: the mean over the boxes with several basins (eq. 6); above ln 2 a boundary is fractal. None without such boxes.
    pub boundary: Option<f64>,
}

impl Basins {
    /// The basin entropy of a grid; boxes at its right and upper edge may have fewer cells.
    pub fn basin_entropy(&self) -> BasinEntropy {
        let (columns, rows) = (self.grid.across.cells, self.grid.up.cells);
        let mut sum = 0.0;
        let (mut boxes, mut mixed) = (0, 0);
        for (row, column) in
            box_starts(rows).flat_map(|row| box_starts(columns).map(move |it| (row, it)))
        {
            let mut counts = vec![0; self.classes.len()];
            for row in row..rows.min(row + BOX_CELLS) {
                let cells = &self.cells[row * columns..][column..columns.min(column + BOX_CELLS)];
                cells.iter().for_each(|it| counts[usize::from(*it)] += 1);
            }
            let entropy = entropy_of_counts(&counts);
            sum += entropy;
            boxes += 1;
            mixed += usize::from(entropy > 0.0);
        }
        BasinEntropy {
            basin: sum / f64::from(boxes),
            boundary: (mixed > 0).then(|| sum / mixed as f64),
        }
    }
}

/// The cells along an axis at which the boxes of the basin entropy begin.
fn box_starts(cells: usize) -> impl Iterator<Item = usize> + Clone {
    (0..cells).step_by(BOX_CELLS)
}

/// The sum of -p ln p over the shares p of the basins counted in a box.
fn entropy_of_counts(counts: &[usize]) -> f64 {
    let all = counts.iter().sum::<usize>() as f64;
    let shares = counts
        .iter()
        .filter(|it| **it > 0)
        .map(|it| *it as f64 / all);
    shares.map(|share| -share * share.ln()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::attractors::Attractor;
    use crate::basin::{Axis, Grid};
    use crate::motion_kind::MotionKind;
    use softstop::Start;

    fn entropy_of(cells: [usize; 2], class: impl Fn(usize, usize) -> u16) -> BasinEntropy {
        let [columns, rows] = cells;
        let across = Axis::position(0.0, 1.0, columns);
        let up = Axis::velocity(0.0, 1.0, rows);
        let all = (0..columns * rows).map(|cell| class(cell / columns, cell % columns));
        let basins = Basins {
            grid: Grid::of_states(across, up, 0.0),
            classes: [MotionKind::Chaos, MotionKind::Rest]
                .map(|it| Attractor::new(it, Start::REST, (0, 1)))
                .into(),
            lost: None,
            cells: all.collect(),
        };
        basins.basin_entropy()
    }

    #[test]
    fn one_basin_is_certain_and_a_boundary_counts_in_its_boxes() {
        let one = entropy_of([20, 20], |_, _| 0);
        assert_eq!((one.basin, one.boundary), (0.0, None));
        // A straight boundary through the middle of a column of boxes: 2 of 5 columns on one side.
        let straight = entropy_of([20, 20], |_, column| u16::from(column >= 12));
        let of_box = -(0.4f64 * 0.4f64.ln() + 0.6 * 0.6f64.ln());
        assert!((straight.basin - of_box / 4.0).abs() < 1e-15);
        assert!((straight.boundary.expect("a boundary") - of_box).abs() < 1e-15);
        // Basins mixed at random tend to ln 2; a chequerboard of 13 to 12 cells is as near as a box can come.
        let mixed = entropy_of([20, 20], |row, column| (row + column) as u16 % 2);
        let of_box = -(0.52f64 * 0.52f64.ln() + 0.48 * 0.48f64.ln());
        assert!((mixed.basin - of_box).abs() < 1e-15);
        // At the edge boxes are smaller.
        let edge = entropy_of([6, 6], |_, column| u16::from(column == 5));
        assert_eq!((edge.basin, edge.boundary), (0.0, None));
    }
}
