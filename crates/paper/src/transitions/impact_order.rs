//! Whether a motion still has the order of impacts that another one has.

use std::collections::VecDeque;

/// Compares the impacts in each of the last drive periods with those of one period of a motion.
pub(crate) struct ImpactOrder {
    /// Those of the motion, twice in a row.
    twice: Vec<usize>,
    last: VecDeque<usize>,
}

impl ImpactOrder {
    /// The order of a motion by its impacts in each drive period.
    pub fn new(order: &[usize]) -> Self {
        Self {
            twice: order.repeat(2),
            last: VecDeque::new(),
        }
    }

    /// True if the last drive periods, of which the present one has so many impacts, show the order from wherever it
    /// begins.
    pub fn goes_on(&mut self, impacts: usize) -> bool {
        self.last.push_back(impacts);
        let periods = self.twice.len() / 2;
        if self.last.len() > periods {
            self.last.pop_front();
        }
        let mut orders = self.twice.windows(periods);
        orders.any(|order| self.last.iter().eq(order))
    }
}
