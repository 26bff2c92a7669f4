//! The order of the impacts within the period of a motion.

use std::fmt;

use serde::{Deserialize, Serialize};

use softstop::Instant;

/// Number of impacts in one drive period of an impact pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ImpactCount {
    /// So many impacts.
    Finite(u64),
    /// Complete chatter: ever weaker impacts that end in rest.
    Infinite,
}

/// Impacts in each drive period of a periodic motion, in order of time.
///
/// The cuts between the drive periods lie at the drive angle that is farthest from all impacts, so that
/// impacts on both sides of drive angle phi do not count as those of two periods. Of the rotations of the
/// list the largest one stands for all: 1-0-1-0 for the paper's (2/4)A, 1-1-0-0 for its (2/4)B.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ImpactPattern(Vec<ImpactCount>);

impl ImpactPattern {
    /// The pattern of impacts, and of complete chatter that ends at `rests`, within `periods` of `period` seconds each.
    pub fn new(impacts: &[Instant], rests: &[Instant], periods: u64, period: f64) -> Self {
        let all: Vec<Instant> = [impacts, rests].concat();
        let separation = period_separation(&all, period);
        let cycle = |instant: &Instant| {
            let early = u64::from(instant.offset < separation);
            ((instant.cycles as u64 + periods - early) % periods) as usize
        };
        let mut counts = vec![ImpactCount::Finite(0); periods as usize];
        for instant in impacts {
            if let ImpactCount::Finite(count) = &mut counts[cycle(instant)] {
                *count += 1;
            }
        }
        for instant in rests {
            counts[cycle(instant)] = ImpactCount::Infinite;
        }
        Self(largest_rotation(&counts))
    }

    /// The number of impacts in each drive period of the pattern.
    pub fn counts_per_period(&self) -> &[ImpactCount] {
        &self.0
    }

    /// True if two neighbouring drive periods have one impact each, as in the paper's (2/4)B.
    pub fn has_pair(&self) -> bool {
        let next = self.0.iter().cycle().skip(1);
        let is_one = |count: &ImpactCount| *count == ImpactCount::Finite(1);
        self.0.iter().zip(next).any(|(a, b)| is_one(a) && is_one(b))
    }
}

/// Offset in s into the drive period at which periods are separated when impacts are counted per period: the middle of the longest
/// gap of all offsets folded into one period.
fn period_separation(instants: &[Instant], period: f64) -> f64 {
    let mut offsets: Vec<f64> = instants.iter().map(|instant| instant.offset).collect();
    offsets.sort_by(f64::total_cmp);
    let (Some(first), Some(last)) = (offsets.first(), offsets.last()) else {
        return 0.0;
    };
    let around = (first + period - last, *last);
    let gaps = offsets.windows(2).map(|pair| (pair[1] - pair[0], pair[0]));
    let (gap, from) = gaps.fold(around, |best, gap| if gap.0 > best.0 { gap } else { best });
    let middle = from + 0.5 * gap;
    if middle < period {
        middle
    } else {
        middle - period
    }
}

/// The largest of all rotations of a list of impact counts.
fn largest_rotation(counts: &[ImpactCount]) -> Vec<ImpactCount> {
    let rotations = (0..counts.len()).map(|by| [&counts[by..], &counts[..by]].concat());
    rotations.max().unwrap_or_default()
}

impl fmt::Display for ImpactPattern {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, count) in self.0.iter().enumerate() {
            let dash = if index > 0 { "-" } else { "" };
            match count {
                ImpactCount::Finite(count) => write!(formatter, "{dash}{count}")?,
                ImpactCount::Infinite => write!(formatter, "{dash}∞")?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn instants_of(instants: &[(f64, f64)]) -> Vec<Instant> {
        let instant = |&(cycles, offset): &(f64, f64)| Instant { cycles, offset };
        instants.iter().map(instant).collect()
    }

    fn pattern(instants: &[(f64, f64)], periods: u64) -> String {
        ImpactPattern::new(&instants_of(instants), &[], periods, 1.0).to_string()
    }

    #[test]
    fn the_order_of_impacts_differs_whatever_the_first_period() {
        assert_eq!(pattern(&[(0.0, 0.4), (2.0, 0.4)], 4), "1-0-1-0");
        assert_eq!(pattern(&[(1.0, 0.4), (3.0, 0.4)], 4), "1-0-1-0");
        assert_eq!(pattern(&[(0.0, 0.4), (3.0, 0.5)], 4), "1-1-0-0");
        assert_eq!(pattern(&[], 1), "0");
    }

    #[test]
    fn complete_chatter_is_without_number() {
        let impacts = instants_of(&[(0.0, 0.3), (1.0, 0.3), (1.0, 0.4)]);
        let pattern = ImpactPattern::new(&impacts, &instants_of(&[(1.0, 0.5)]), 2, 1.0);
        assert_eq!(pattern.to_string(), "∞-1");
    }

    #[test]
    fn impacts_on_both_sides_of_the_sections_angle_belong_together() {
        // At 0.98 of period 0 and 0.02 of period 2: of neighbouring periods, not two apart.
        assert_eq!(pattern(&[(0.0, 0.98), (2.0, 0.02)], 4), "1-1-0-0");
        assert_eq!(pattern(&[(3.0, 0.98), (0.0, 0.02)], 4), "2-0-0-0");
    }
}
