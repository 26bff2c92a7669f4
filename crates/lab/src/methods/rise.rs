//! Where a function rises through zero, by what it is at tried places.

/// A tried place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probe<T> {
    /// The place.
    pub at: f64,
    /// The function there.
    pub value: f64,
    /// What else is known there.
    pub what: T,
}

/// How closely a zero is to be found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fineness {
    /// Width of the bracket.
    pub width: f64,
    /// Size of the function that counts as zero.
    pub value: f64,
}

/// Regula falsi with halved weights (Illinois; Dowell and Jarratt 1971) in the bracket from `low`, where the
/// function is below zero, to `high`, where it is not. Where two tries in a row have not halved the bracket, its
/// middle is tried.
///
/// # Errors
/// Those of the function.
pub fn rise<T: Copy, E>(
    mut low: Probe<T>,
    mut high: Probe<T>,
    fine: Fineness,
    mut function: impl FnMut(f64) -> Result<(f64, T), E>,
) -> Result<Probe<T>, E> {
    let (mut below, mut above) = (low.value, high.value);
    let mut last_rose = None;
    let mut widths = [f64::INFINITY; 2];
    loop {
        let width = high.at - low.at;
        if high.value <= fine.value || width <= fine.width {
            return Ok(high);
        }
        if -low.value <= fine.value {
            return Ok(low);
        }
        let slow = width > 0.5 * widths[0];
        let middle = low.at + 0.5 * width;
        let secant = low.at + width * (below / (below - above));
        let inside = low.at < secant && secant < high.at;
        let at = if slow || !inside { middle } else { secant };
        widths = if slow {
            [f64::INFINITY; 2]
        } else {
            [widths[1], width]
        };
        if at <= low.at || at >= high.at {
            return Ok(high);
        }
        let (value, what) = function(at)?;
        let rose = value >= 0.0;
        let repeated = last_rose == Some(rose);
        last_rose = Some(rose);
        if rose {
            high = Probe { at, value, what };
            above = value;
            below *= if repeated { 0.5 } else { 1.0 };
        } else {
            low = Probe { at, value, what };
            below = value;
            above *= if repeated { 0.5 } else { 1.0 };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn zero(low: f64, high: f64, function: impl Fn(f64) -> f64) -> (f64, u32) {
        let mut tries = 0;
        let probe = |at: f64| Probe {
            at,
            value: function(at),
            what: (),
        };
        let fine = Fineness {
            width: 1e-15,
            value: 0.0,
        };
        let found = rise(probe(low), probe(high), fine, |at| {
            tries += 1;
            Ok::<_, ()>((function(at), ()))
        });
        (found.expect("a zero").at, tries)
    }

    #[test]
    fn finds_simple_flat_and_steep_zeros() {
        let (at, tries) = zero(0.0, 2.0, |x| x * x - 2.0);
        assert!(
            (at - 2f64.sqrt()).abs() < 1e-15 && tries < 14,
            "{at} {tries}"
        );
        let (at, tries) = zero(-0.3, 2.0, |x| x.powi(9));
        assert!(at.abs() < 2e-15 && tries < 170, "{at} {tries}");
        // So close below the zero that the secant cannot be told from that end.
        let (at, tries) = zero(5.0, 6.0, |x| if x < 5.5 { -1e-30 } else { x });
        assert!((at - 5.5).abs() < 2e-15 && tries < 170, "{at} {tries}");
        let (at, tries) = zero(0.0, 1.0, |x| if x < 0.3 { -1e-9 } else { 1e9 });
        assert!((at - 0.3).abs() < 2e-15 && tries < 170, "{at} {tries}");
    }
}
