//! Numbers as people read them.

/// How a number is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NumberStyle {
    /// As it is.
    Plain,
    /// With so many decimals.
    Fixed(usize),
    /// With so many decimals and a power of ten.
    Power(usize),
    /// A share in per cent, with so many decimals.
    Percent(usize),
    /// With six decimals, or a power of ten where those would not tell it.
    Six,
    /// With seven significant digits.
    Seven,
}

impl NumberStyle {
    /// The number in this style.
    pub fn format(self, value: f64) -> String {
        let size = value.abs();
        match self {
            Self::Plain => value.to_string(),
            Self::Fixed(decimals) => format!("{value:.decimals$}"),
            Self::Power(decimals) => format!("{value:.decimals$e}"),
            Self::Percent(decimals) => format!("{:.decimals$} %", 100.0 * value),
            Self::Six if size == 0.0 || (1e-3..1e6).contains(&size) => format!("{value:.6}"),
            Self::Six => format!("{value:.6e}"),
            Self::Seven if size == 0.0 => "0".to_owned(),
            Self::Seven if (1e-3..1e7).contains(&size) => {
                let decimals = 6 - size.log10().floor() as i32;
                format!("{value:.*}", usize::try_from(decimals).unwrap_or(0))
            }
            Self::Seven => format!("{value:.3e}"),
        }
    }
}
