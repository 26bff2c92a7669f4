//! Cells of tables and records, how people read them, and records, which cells may hold.

use serde::{Serialize, Serializer};

use crate::number::NumberStyle;
use crate::units::Unit;

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
    /// Figures of something else; for JSON alone.
    Record(Record),
    /// Those of several things; for JSON alone.
    Records(Vec<Record>),
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

/// Figures in order: in JSON all of them by their names, for people those with a form by their meanings.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Record(pub(crate) Vec<Figure>);

/// A figure.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Figure {
    pub(crate) name: &'static str,
    pub(crate) label: String,
    pub(crate) unit: Unit,
    pub(crate) form: Option<NumberStyle>,
    pub(crate) cell: Cell,
}

impl Serialize for Record {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|it| (it.name, &it.cell)))
    }
}

impl From<serde_json::Value> for Told {
    /// A value without words.
    fn from(value: serde_json::Value) -> Self {
        let words = String::new();
        Self { value, words }
    }
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
    Record, record => Self::Record(record);
    Vec<Record>, records => Self::Records(records);
    serde_json::Value, value => Self::Told(value.into());
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

/// Numbers of a list that people read.
const MAX_LISTED: usize = 8;

impl Cell {
    /// The cell, empty where its number is not finite.
    pub(crate) fn finite(&self) -> &Self {
        match self {
            Self::Number(number) if !number.is_finite() => &Self::Empty,
            cell => cell,
        }
    }

    /// As people read it, its numbers in a style.
    pub(crate) fn format(&self, style: NumberStyle) -> String {
        match self {
            Self::Empty => "-".to_owned(),
            Self::Text(text) => text.clone(),
            Self::Count(count) => count.to_string(),
            Self::Flag(flag) => if *flag { "yes" } else { "no" }.to_owned(),
            Self::Number(number) => style.format(*number),
            Self::List(numbers) => format_list(numbers, style),
            Self::Told(told) => told.words.clone(),
            Self::Record(_) | Self::Records(_) => String::new(),
        }
    }
}

fn format_list(numbers: &[f64], style: NumberStyle) -> String {
    if numbers.is_empty() {
        return "-".to_owned();
    }
    let listed = numbers.iter().take(MAX_LISTED);
    let mut listed: Vec<String> = listed.map(|it| style.format(*it)).collect();
    if numbers.len() > MAX_LISTED {
        listed.push(format!("... ({} in all)", numbers.len()));
    }
    listed.join(", ")
}
