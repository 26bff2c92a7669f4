//! The largest ball inside a basin, which measures its integrity.

use super::Basins;
use super::grid::{Axis, Grid};
use crate::orbit::Regime;

/// The largest ball of cells inside a basin.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct BasinBall {
    /// Its centre on both axes of the grid.
    pub centre: [f64; 2],
    /// Distance from there to the nearest cell of another basin or to the edge of the grid, in units of half of each axis: 1
    /// would fill the grid. On the axes it is an ellipse.
    pub radius: f64,
}

impl Basins {
    /// The largest ball of cells that lies inside the basin of a class and inside the grid; none if the basin has no cell.
    pub fn largest_ball(&self, class: usize) -> Option<BasinBall> {
        find_largest_ball(&self.grid, |cell| usize::from(self.cells[cell]) == class)
    }

    /// The largest ball of cells all of whose motions settle in a regime, on one motion or on several of it.
    pub fn largest_ball_of(&self, regime: Regime) -> Option<BasinBall> {
        find_largest_ball(&self.grid, |cell| {
            let class = &self.classes[usize::from(self.cells[cell])];
            class.motion.regime() == Some(regime)
        })
    }
}

/// The largest ball about the middle of a cell of a grid all of whose cells are `inside`; none if no cell is.
pub fn find_largest_ball(grid: &Grid, inside: impl Fn(usize) -> bool) -> Option<BasinBall> {
    // One row and column of outside all around.
    let (columns, rows) = (grid.across.cells + 2, grid.up.cells + 2);
    let outside = |row: usize, column: usize| {
        let within =
            (1..=grid.up.cells).contains(&row) && (1..=grid.across.cells).contains(&column);
        !within || !inside((row - 1) * grid.across.cells + column - 1)
    };
    let mut squares: Vec<Vec<f64>> = (0..rows)
        .map(|row| {
            let start = |column| match outside(row, column) {
                true => 0.0,
                false => f64::INFINITY,
            };
            let along: Vec<f64> = (0..columns).map(start).collect();
            distance_transform(&along, grid.across.cell_length())
        })
        .collect();
    for column in 0..columns {
        let along: Vec<f64> = squares.iter().map(|row| row[column]).collect();
        for (row, square) in squares
            .iter_mut()
            .zip(distance_transform(&along, grid.up.cell_length()))
        {
            row[column] = square;
        }
    }
    let places = (1..rows - 1).flat_map(|row| (1..columns - 1).map(move |column| (row, column)));
    // The first of equals.
    let to_edge = |axis: &Axis, cell: usize| {
        (cell.min(axis.cells - 1 - cell) as f64 + 0.5) * axis.cell_length()
    };
    let squares = places.map(|(row, column)| {
        let (across, up) = (
            to_edge(&grid.across, column - 1),
            to_edge(&grid.up, row - 1),
        );
        let edge = across.min(up);
        (squares[row][column].min(edge * edge), row, column)
    });
    let larger = |best: (f64, usize, usize), it: (f64, usize, usize)| match it.0 > best.0 {
        true => it,
        false => best,
    };
    let (square, row, column) = squares.fold((0.0, 0, 0), larger);
    (square > 0.0).then(|| BasinBall {
        centre: [grid.across.value_at(column - 1), grid.up.value_at(row - 1)],
        radius: square.sqrt(),
    })
}

/// The distance transform of a row of squared distances: min over q of f(q) + (h (p - q))^2 for all p, the lower envelope of
/// parabolas (Felzenszwalb and Huttenlocher 2012).
fn distance_transform(f: &[f64], h: f64) -> Vec<f64> {
    let square = |q: usize| (h * q as f64) * (h * q as f64);
    // Parabolas of the envelope, and from where on each is the lowest, in units of h.
    let mut envelope: Vec<(usize, f64)> = Vec::new();
    for q in (0..f.len()).filter(|q| f[*q].is_finite()) {
        let mut from = f64::NEG_INFINITY;
        while let Some(&(other, begin)) = envelope.last() {
            let apart = 2.0 * h * h * (q - other) as f64;
            from = (f[q] + square(q) - f[other] - square(other)) / apart;
            if from > begin {
                break;
            }
            envelope.pop();
            from = f64::NEG_INFINITY;
        }
        envelope.push((q, from));
    }
    let mut lowest = 0;
    let value = |p: usize| {
        while envelope
            .get(lowest + 1)
            .is_some_and(|next| next.1 <= p as f64)
        {
            lowest += 1;
        }
        envelope.get(lowest).map_or(f64::INFINITY, |&(q, _)| {
            let gap = h * (p as f64 - q as f64);
            f[q] + gap * gap
        })
    };
    (0..f.len()).map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;
    use softstop_testing::tolerance::MOTION;

    fn grid(columns: usize, rows: usize) -> Grid {
        Grid::of_states(
            Axis::position(-1.0, 1.0, columns),
            Axis::velocity(-1.0, 1.0, rows),
            0.0,
        )
    }

    #[test]
    fn the_largest_ball_of_a_disc_is_the_disc() {
        let grid = grid(101, 201);
        let inside = |cell| {
            let start = grid.start_of_cell(cell).0;
            (start.position - 0.2).hypot(start.velocity + 0.1) < 0.5
        };
        let found = find_largest_ball(&grid, inside).expect("there is a disc");
        assert!((found.centre[0] - 0.2).abs() < 0.02 && (found.centre[1] + 0.1).abs() < 0.02);
        assert_abs_diff_eq!(found.radius, 0.5, epsilon = 0.02);
    }

    #[test]
    fn the_same_as_by_trying_all_pairs() {
        let grid = grid(17, 12);
        let inside = |cell: usize| !(cell * cell / 7).is_multiple_of(5);
        let at = |row: i64, column: i64| {
            (0..12).contains(&row)
                && (0..17).contains(&column)
                && inside((row * 17 + column) as usize)
        };
        let mut best = 0.0f64;
        for (row, column) in (0..12).flat_map(|row| (0..17).map(move |column| (row, column))) {
            let edge = |at: i64, cells: i64| at.min(cells - 1 - at) as f64 + 0.5;
            let mut nearest = (edge(column, 17) * 2.0 / 17.0).min(edge(row, 12) / 6.0);
            for (r, c) in (0..12).flat_map(|r| (0..17).map(move |c| (r, c))) {
                if !at(r, c) {
                    let (x, y) = ((c - column) as f64 * 2.0 / 17.0, (r - row) as f64 / 6.0);
                    nearest = nearest.min(x.hypot(y));
                }
            }
            best = best.max(nearest);
        }
        let found = find_largest_ball(&grid, inside).expect("some cells are inside");
        assert_abs_diff_eq!(found.radius, best, epsilon = MOTION);
    }

    #[test]
    fn nothing_is_inside_of_nothing() {
        assert_eq!(find_largest_ball(&grid(5, 5), |_| false), None);
        let all = find_largest_ball(&grid(5, 5), |_| true).expect("the whole grid");
        assert_abs_diff_eq!(all.radius, 1.0, epsilon = MOTION);
    }
}
