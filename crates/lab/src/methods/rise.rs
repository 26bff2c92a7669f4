//! Where a function rises through zero, by what it is at tried places.

use softstop::internals::narrow_root;

/// A tried place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probe<T> {
    /// The place.
    pub at: f64,
    /// The function there.
    pub value: f64,
    /// The state there.
    pub state: T,
}

/// The place between two at which a function, above zero at the later one, rises through zero: so close that its size is
/// within the tolerance, or that of the bracket within the width. If it begins on zero, it is taken to dip below first; if
/// no dip is found, it rises at once.
///
/// # Errors
/// Those of the function.
pub fn locate_rise<T: Copy, E>(
    [begin, mut high]: [Probe<T>; 2],
    width: f64,
    tolerance: f64,
    mut function: impl FnMut(f64) -> Result<(f64, T), E>,
) -> Result<Probe<T>, E> {
    let mut probe = |at| {
        let (value, state) = function(at)?;
        Ok(Probe { at, value, state })
    };
    let mut low = begin;
    while low.value >= -tolerance {
        let tried = match high.at - begin.at > width {
            true => probe(f64::midpoint(begin.at, high.at))?,
            false => return Ok(begin),
        };
        match tried.value < -tolerance {
            true => low = tried,
            false => high = tried,
        }
    }
    let [below, above] = [low, high].map(|end| (end.at, end.value));
    if high.value > tolerance {
        narrow_root(below, above, width, |at| {
            let tried = probe(at)?;
            if tried.value >= -tolerance {
                high = tried;
            }
            Ok(match tried.value.abs() <= tolerance {
                true => 0.0,
                false => tried.value,
            })
        })?;
    }
    Ok(high)
}

#[cfg(test)]
mod tests {
    use super::{Probe, locate_rise};

    #[test]
    fn a_function_that_begins_on_zero_rises_behind_its_dip_or_at_once() {
        for (function, expected) in [
            ((|x| x * (x - 0.75)) as fn(f64) -> f64, 0.75),
            (|x| x * (x - 1e-3), 1e-3),
            (|x| x * (x + 0.75), 0.0),
        ] {
            let probe = |at| Probe {
                at,
                value: function(at),
                state: (),
            };
            let found = locate_rise([probe(0.0), probe(1.0)], 1e-15, 1e-18, |at| {
                Ok::<_, ()>((function(at), ()))
            });
            let at = found.expect("a zero").at;
            assert!((at - expected).abs() < 2e-15, "{at}");
        }
    }
}
