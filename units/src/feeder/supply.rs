//! Which strokes get a strip.

use serde::{Deserialize, Serialize};
use softstop_fmi::variable::Slot;
use softstop_fmi::{Enumeration, Outcome, item};

use super::{PATTERN, slot};

pub(super) const ALWAYS: i32 = 1;
const BY_PATTERN: i32 = 2;
const RANDOM: i32 = 3;

/// The laws of supply.
pub(super) static MODEL: Enumeration = Enumeration {
    type_name: "SupplyModel",
    description: "Which strokes get a strip",
    items: &[
        item(ALWAYS, "always", "every stroke"),
        item(
            BY_PATTERN,
            "pattern",
            "as many strokes with a strip, then without one, and so on by turns, as supply.pattern.strokes says; then from its beginning",
        ),
        item(
            RANDOM,
            "random",
            "each stroke with supply.probability, whatever became of the others",
        ),
    ],
};

/// What the parameters say.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Supply {
    model: i32,
    pattern: Vec<u64>,
    probability: f64,
    seed: u64,
    jam_probability: f64,
    jam_strokes: u64,
}

impl Supply {
    pub fn of(values: &[f64]) -> Outcome<Self> {
        let value = |slot: Slot| values[slot.0];
        let elements = 0..(value(slot::COUNT) as usize).min(PATTERN);
        let supply = Self {
            model: value(slot::MODEL) as i32,
            pattern: elements
                .map(|k| value(slot::STROKES.element(k)) as u64)
                .collect(),
            probability: value(slot::PROBABILITY),
            seed: value(slot::SEED) as u64,
            jam_probability: value(slot::JAM_PROBABILITY),
            jam_strokes: value(slot::JAM_STROKES) as u64,
        };
        if supply.model == BY_PATTERN && supply.pattern.iter().sum::<u64>() == 0 {
            return Err("supply.pattern.strokes = 0: at least one element up to supply.pattern.count must be > 0".into());
        }
        Ok(supply)
    }

    /// Whether a strip comes with a stroke, counted from 0.
    fn comes(&self, stroke: u64) -> bool {
        match self.model {
            BY_PATTERN => {
                let mut left = stroke % self.pattern.iter().sum::<u64>();
                let run = self.pattern.iter().position(|&strokes| {
                    let here = left < strokes;
                    left = left.saturating_sub(strokes);
                    here
                });
                run.is_some_and(|run| run % 2 == 0)
            }
            RANDOM => chance(self.seed, 2 * stroke) < self.probability,
            _ => true,
        }
    }

    /// Whether the feeder jams at a stroke.
    fn jams(&self, stroke: u64) -> bool {
        chance(self.seed, 2 * stroke + 1) < self.jam_probability
    }
}

/// Strokes so far, and what became of them.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Line {
    /// The last stroke got a strip.
    pub strip: bool,
    pub strokes: u64,
    pub strips: u64,
    pub missing: u64,
    pub jams: u64,
    /// Strokes for which a jam still lasts.
    jammed: u64,
}

impl Line {
    /// The line with the stroke that is under way at the start.
    pub fn begin(supply: &Supply, held: bool) -> Self {
        let mut line = Self::default();
        line.feed(supply, held);
        line
    }

    /// The next stroke.
    pub fn feed(&mut self, supply: &Supply, held: bool) {
        if self.jammed == 0 && supply.jams(self.strokes) {
            self.jammed = supply.jam_strokes;
            self.jams += 1;
        }
        self.strip = self.jammed == 0 && !held && supply.comes(self.strokes);
        self.jammed = self.jammed.saturating_sub(1);
        self.strokes += 1;
        *if self.strip {
            &mut self.strips
        } else {
            &mut self.missing
        } += 1;
    }
}

/// A random number in [0, 1): so many numbers on in the sequence of a seed (SplitMix64; Steele, Lea and Flood 2014).
fn chance(seed: u64, number: u64) -> f64 {
    (random(seed, number) >> 11) as f64 / (1_u64 << 53) as f64
}

fn random(seed: u64, number: u64) -> u64 {
    let at = seed.wrapping_add(0x9e37_79b9_7f4a_7c15_u64.wrapping_mul(number.wrapping_add(1)));
    let at = (at ^ (at >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let at = (at ^ (at >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    at ^ (at >> 31)
}

#[cfg(test)]
mod tests {
    use super::random;

    /// The first numbers of the authors' program for this seed.
    #[test]
    fn splitmix64() {
        let first = [0, 1, 2].map(|number| random(1_234_567, number));
        let known = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
        ];
        assert_eq!(first, known);
    }
}
