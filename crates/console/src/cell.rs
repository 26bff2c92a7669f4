//! Cells of tables and records, and how people read them.

use serde::Serialize;

use crate::table::{figure, number};

/// What stands in a column of a row.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Cell {
    /// Nothing.
    Empty,
    /// A word.
    Text(String),
    /// A number.
    Number(f64),
    /// A count.
    Count(u64),
    /// Yes or no.
    Flag(bool),
    /// Numbers; for JSON and people alone.
    List(Vec<f64>),
    /// What has parts; for JSON and people alone.
    Told(Told),
}

/// A value with the words that people read instead.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Told {
    /// The value.
    pub value: serde_json::Value,
    /// The words.
    #[serde(skip)]
    pub words: String,
}

macro_rules! cells {
    ($($from:ty, $it:ident => $cell:expr;)*) => {$(
        impl From<$from> for Cell {
            fn from($it: $from) -> Self {
                $cell
            }
        }
    )*};
}

cells! {
    &str, text => Self::Text(text.to_owned());
    String, text => Self::Text(text);
    f64, number => Self::Number(number);
    u64, count => Self::Count(count);
    usize, count => Self::Count(count as u64);
    bool, flag => Self::Flag(flag);
    Vec<f64>, numbers => Self::List(numbers);
    [f64; 2], numbers => Self::List(numbers.into());
    Told, told => Self::Told(told);
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

/// Numbers of a list that people are told.
const MOST: usize = 8;

/// How numbers are written for people.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// As they are.
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

impl Form {
    pub(crate) fn write(self, cell: &Cell) -> String {
        match cell {
            Cell::Empty => "-".to_owned(),
            Cell::Text(text) => text.clone(),
            Cell::Count(count) => count.to_string(),
            Cell::Flag(flag) => if *flag { "yes" } else { "no" }.to_owned(),
            Cell::Number(number) => self.number(*number),
            Cell::List(numbers) => self.list(numbers),
            Cell::Told(told) => told.words.clone(),
        }
    }

    fn number(self, value: f64) -> String {
        match self {
            Self::Plain => value.to_string(),
            Self::Fixed(decimals) => format!("{value:.decimals$}"),
            Self::Power(decimals) => format!("{value:.decimals$e}"),
            Self::Percent(decimals) => format!("{:.decimals$} %", 100.0 * value),
            Self::Six => number(value),
            Self::Seven => figure(value),
        }
    }

    fn list(self, numbers: &[f64]) -> String {
        if numbers.is_empty() {
            return "-".to_owned();
        }
        let told = numbers.iter().take(MOST).map(|it| self.number(*it));
        let mut told: Vec<String> = told.collect();
        if numbers.len() > MOST {
            told.push(format!("... ({} in all)", numbers.len()));
        }
        told.join(", ")
    }
}
