//! What moves where: regimes in the cells of a map.

use std::fmt;

use softstop_dynamics::basin::{Axis, Grid, clearing};
use softstop_dynamics::orbit::{Count, Orbit, Regime};

/// Radius of a place, in units of half the map, that has room for its name.
const WIDE: f64 = 0.09;

/// What moves in one cell of a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RegimeCell {
    /// It repeats.
    Periodic {
        /// The regime.
        regime: Regime,
        /// True if impacts come in pairs, as in the paper's (2/4)B: 1-1-0-0.
        is_paired: bool,
    },
    /// It does not repeat, and small differences grow.
    Chaos,
    /// It has not settled.
    Unsettled,
    /// It cannot be computed.
    Lost,
}

/// Regimes of one colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RegimeClass {
    /// No impacts.
    Zero,
    /// One impact in each drive period.
    One,
    /// The same number of impacts as drive periods, but two or more.
    Doubled,
    /// z = 2/3 = 4/6 = ...
    TwoThirds,
    /// Other regimes between 1/2 and 1.
    Between,
    /// z = 1/2, (2/4)A and others whose impacts are apart.
    Half,
    /// (2/4)B and others whose impacts are in pairs.
    Paired,
    /// 0 < z < 1/2.
    Few,
    /// z > 1.
    Many,
    /// No regime.
    Chaos,
    /// Not settled.
    Unsettled,
    /// Not computed.
    Lost,
}

impl RegimeClass {
    /// All, in the order of the legend.
    pub const ALL: [Self; 12] = [
        Self::Zero,
        Self::One,
        Self::Doubled,
        Self::Between,
        Self::TwoThirds,
        Self::Half,
        Self::Paired,
        Self::Few,
        Self::Many,
        Self::Chaos,
        Self::Unsettled,
        Self::Lost,
    ];

    /// In a word or two.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Zero => "z = 0",
            Self::One => "z = 1",
            Self::Doubled => "z = n/n, n > 1",
            Self::TwoThirds => "z = 2/3",
            Self::Between => "1/2 < z < 1 but 2/3",
            Self::Half => "z = 1/2, (2/4)A",
            Self::Paired => "z = (2/4)B",
            Self::Few => "0 < z < 1/2",
            Self::Many => "z > 1",
            Self::Chaos => "chaos",
            Self::Unsettled => "not settled",
            Self::Lost => "lost",
        }
    }

    /// Okabe and Ito's colours, and greys.
    pub const fn color(self) -> &'static str {
        match self {
            Self::Zero => "#E4E4E4",
            Self::One => "#56B4E9",
            Self::Doubled => "#0072B2",
            Self::TwoThirds => "#009E73",
            Self::Between => "#9AD6B4",
            Self::Half => "#E69F00",
            Self::Paired => "#D55E00",
            Self::Few => "#CC79A7",
            Self::Many => "#F0E442",
            Self::Chaos => "#000000",
            Self::Unsettled => "#8C8C8C",
            Self::Lost => "#FFFFFF",
        }
    }
}

impl RegimeCell {
    /// That of an orbit.
    #[must_use]
    pub fn of(orbit: &Orbit) -> Self {
        let pattern = orbit.pattern();
        let counts = pattern.counts();
        let next = counts.iter().cycle().skip(1);
        let one = Count::Finite(1);
        let regime = orbit.regime();
        let pairs = counts.iter().zip(next);
        Self::Periodic {
            regime,
            is_paired: 2 * regime.impacts == regime.periods
                && pairs.into_iter().any(|pair| pair == (&one, &one)),
        }
    }

    /// Its colour's class.
    #[must_use]
    pub fn class(&self) -> RegimeClass {
        let (regime, is_paired) = match self {
            Self::Periodic { regime, is_paired } => (regime, *is_paired),
            Self::Chaos => return RegimeClass::Chaos,
            Self::Unsettled => return RegimeClass::Unsettled,
            Self::Lost => return RegimeClass::Lost,
        };
        let (p, n) = (regime.impacts, regime.periods);
        match () {
            () if p == 0 => RegimeClass::Zero,
            () if p == 1 && n == 1 => RegimeClass::One,
            () if p == n => RegimeClass::Doubled,
            () if p > n => RegimeClass::Many,
            () if 3 * p == 2 * n => RegimeClass::TwoThirds,
            () if 2 * p > n => RegimeClass::Between,
            () if 2 * p == n && is_paired => RegimeClass::Paired,
            () if 2 * p == n => RegimeClass::Half,
            () => RegimeClass::Few,
        }
    }
}

impl fmt::Display for RegimeCell {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Periodic { regime, is_paired } if *is_paired => write!(formatter, "({regime})B"),
            Self::Periodic { regime, .. } => write!(formatter, "{regime}"),
            Self::Chaos => formatter.write_str("chaos"),
            Self::Unsettled => formatter.write_str("unsettled"),
            Self::Lost => formatter.write_str("lost"),
        }
    }
}

/// Cells over frequency and clearance.
#[derive(Debug, Clone, PartialEq)]
pub struct RegimeMap {
    /// Where the first column begins and the last one ends.
    pub eta: (f64, f64),
    /// Where the lowest row begins and the highest one ends.
    pub rho: (f64, f64),
    /// Cells in a row.
    pub columns: usize,
    /// The cells, row by row, the lowest row first.
    pub cells: Vec<RegimeCell>,
}

impl RegimeMap {
    /// Share of the cells that belong to a class.
    #[must_use]
    pub fn share(&self, class: RegimeClass) -> f64 {
        let own = self.cells.iter().filter(|cell| cell.class() == class);
        own.count() as f64 / self.cells.len() as f64
    }

    /// The middle of the widest place of a class, if that is wide.
    pub fn widest(&self, class: RegimeClass) -> Option<(f64, f64)> {
        let rows = self.cells.len() / self.columns;
        let grid = Grid::states(
            Axis::position(self.eta.0, self.eta.1, self.columns),
            Axis::velocity(self.rho.0, self.rho.1, rows),
            0.0,
        );
        let ball = clearing(&grid, |cell| self.cells[cell].class() == class)?;
        (ball.radius > WIDE).then_some((ball.centre[0], ball.centre[1]))
    }
}
