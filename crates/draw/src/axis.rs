//! An axis on the page: its range, and the values and texts on it.

use crate::chart::Axis;
use crate::index::width;
use crate::scale::{around, log_ticks, power_of, prefixed, ticks};

/// Room around what is drawn, as a share of it.
const ROOM: f64 = 0.06;

/// Values at an axis and what is written there.
pub(crate) type Ticks = Vec<(f64, String)>;

/// The widest of the texts of ticks.
pub(crate) fn widest(ticks: &Ticks, letters: u32) -> f64 {
    let widths = ticks.iter().map(|(_, text)| width(letters, text));
    widths.fold(0.0, f64::max)
}

/// About so many ticks have room on a length across.
fn count_across(length: f64) -> usize {
    (2.0 + length / 150.0).round().max(2.0) as usize
}

/// About so many ticks have room on a length upwards.
pub(crate) fn count_upwards(length: f64) -> usize {
    (2.5 + length / 110.0).round().max(2.0) as usize
}

impl Axis {
    /// A value as it is placed: on a logarithmic axis its power of ten.
    pub fn position(&self, value: f64) -> f64 {
        match self.is_log {
            true => value.log10(),
            false => value,
        }
    }

    /// The range of positions that holds these values.
    pub(crate) fn range_of(&self, values: impl Iterator<Item = f64>) -> (f64, f64) {
        let (low, high) = around(values.map(|value| self.position(value)), 0.0);
        let end = |end: Option<f64>| end.map(|it| self.position(it)).filter(|it| it.is_finite());
        let [from, to] = self.ends.map(end);
        let (low, high) = (from.unwrap_or(low), to.unwrap_or(high));
        let high = if high > low { high } else { low + 1.0 };
        let room = |end: Option<f64>| match end {
            Some(_) => 0.0,
            None => ROOM * (high - low),
        };
        (low - room(from), high + room(to))
    }

    /// Ticks in a range of positions, about so many.
    pub(crate) fn ticks_of(&self, range: (f64, f64), count: usize) -> Ticks {
        match &self.ticks {
            Some(ticks) => {
                let ticks = ticks.iter();
                let ticks = ticks.map(|(value, text)| (self.position(*value), text.clone()));
                let inside = ticks.filter(|it| range.0 <= it.0 && it.0 <= range.1);
                inside.collect()
            }
            None if self.is_log => log_ticks(range, count),
            None => {
                let power = power_of(range);
                ticks(range, count, power, prefixed(&self.name, power).is_none())
            }
        }
    }

    /// Its name over a range of positions, with the unit in which its ticks are written.
    pub(crate) fn label(&self, range: (f64, f64)) -> String {
        let prefixed = match self.ticks.is_some() || self.is_log {
            true => None,
            false => prefixed(&self.name, power_of(range)),
        };
        prefixed.unwrap_or_else(|| self.name.clone())
    }

    /// Ticks across, so many that their texts stay apart.
    pub(crate) fn ticks_across(&self, range: (f64, f64), length: f64, letters: u32) -> Ticks {
        let mut count = count_across(length);
        loop {
            let ticks = self.ticks_of(range, count);
            let named = ticks.iter().filter(|(_, text)| !text.is_empty()).count();
            let room = 1.2 * (widest(&ticks, letters) + 4.0) * named as f64;
            if room <= length || count <= 2 || self.ticks.is_some() {
                return ticks;
            }
            count -= 1;
        }
    }

    /// Whether nothing is written of it, if these are its ticks.
    pub(crate) fn is_bare(&self, ticks: &Ticks) -> bool {
        ticks.is_empty() && self.name.is_empty()
    }
}
