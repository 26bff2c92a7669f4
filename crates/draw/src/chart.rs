//! A chart as data: panels in a grid, and the axes of each.

use serde::{Deserialize, Deserializer};

use crate::layer::{Layer, Shape};
use crate::scale::around;

/// Width and height of a small picture: a third of a page of the book or of GitHub.
const SMALL: (f64, f64) = (320.0, 280.0);
/// Longest name at an axis of a small picture, in letters.
const LONG: usize = 28;

/// A picture of one or more panels. Margins follow from the texts at the axes; sizes are pixels. All but the layers can
/// stand in a file.
#[derive(Debug, Clone, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Chart {
    /// Above the panels, in large letters.
    pub title: String,
    /// Below the title, in grey.
    pub subtitle: String,
    /// What is drawn.
    pub panels: Vec<Panel>,
    /// Where named layers are explained, unless their panel has a place of its own for that.
    pub legend: Legend,
    /// Paragraphs below the panels.
    pub notes: Vec<String>,
    /// Size of the letters at the axes; titles are larger.
    pub letters: u32,
    /// Width and height of the whole picture; if there is none, each panel has its own size.
    pub page: Option<(f64, f64)>,
    /// Panels of a column share the range across, and the lowest one alone has its numbers.
    pub shares_x: bool,
    /// Panels of a row share the range upwards, and only the first one has its numbers.
    pub shares_y: bool,
}

/// Where a legend stands: that of a chart about all panels, that of a panel about it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Legend {
    /// At the right, an entry in each line.
    #[default]
    Right,
    /// Above, in lines.
    Above,
    /// Below, in lines.
    Below,
    /// Inside each panel, in a corner.
    Inside(Corner),
}

/// A corner of a panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Corner {
    /// Upper left.
    TopLeft,
    /// Upper right.
    TopRight,
    /// Lower left.
    BottomLeft,
    /// Lower right.
    BottomRight,
}

/// Two axes, and the layers between them, the first one at the back.
#[derive(Debug, Clone, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Panel {
    /// Above the panel.
    pub title: String,
    /// Column and row of the grid, counted from the upper left.
    pub at: (usize, usize),
    /// Columns and rows that it takes.
    pub span: (usize, usize),
    /// Width and height between the axes; if the page has a fixed size, weights.
    pub size: (f64, f64),
    /// The axis across.
    pub x: Axis,
    /// The axis upwards.
    pub y: Axis,
    /// What is drawn between the axes.
    #[serde(skip)]
    pub layers: Vec<Layer>,
    /// Where its own layers are explained, if not with those of the other panels.
    pub legend: Option<Legend>,
}

/// An axis.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Axis {
    /// Name, symbol and unit.
    pub name: String,
    /// Least and greatest value; what is not given follows from the layers.
    #[serde(rename = "range", deserialize_with = "both_ends")]
    pub ends: [Option<f64>; 2],
    /// Whether it is logarithmic.
    #[serde(rename = "log")]
    pub is_log: bool,
    /// Values and what is written there; round values, if not given.
    pub ticks: Option<Vec<(f64, String)>>,
}

fn both_ends<'de, D: Deserializer<'de>>(given: D) -> Result<[Option<f64>; 2], D::Error> {
    Ok(<[f64; 2]>::deserialize(given)?.map(Some))
}

impl Default for Chart {
    fn default() -> Self {
        Self {
            title: String::new(),
            subtitle: String::new(),
            panels: Vec::new(),
            legend: Legend::default(),
            notes: Vec::new(),
            letters: 14,
            page: None,
            shares_x: false,
            shares_y: false,
        }
    }
}

impl Chart {
    /// A chart of these panels.
    pub fn new(title: impl Into<String>, panels: impl IntoIterator<Item = Panel>) -> Self {
        Self {
            title: title.into(),
            panels: panels.into_iter().collect(),
            ..Self::default()
        }
    }

    /// The picture as one of several in a row: smaller, without titles and legend, and with short names at its axes.
    pub fn small(mut self) -> Self {
        for panel in &mut self.panels {
            panel.x.shorten();
            panel.y.shorten();
            for layer in &mut panel.layers {
                layer.name.clear();
            }
        }
        Self {
            title: String::new(),
            subtitle: String::new(),
            letters: 12,
            page: Some(SMALL),
            ..self
        }
    }

    /// The place where a panel explains its own layers.
    pub(crate) fn legend_of(&self, panel: &Panel) -> Option<Legend> {
        match self.legend {
            Legend::Inside(_) => panel.legend.or(Some(self.legend)),
            _ => panel.legend,
        }
    }

    /// The panels row by row, so many in each.
    pub fn in_columns(mut self, columns: usize) -> Self {
        for (index, panel) in self.panels.iter_mut().enumerate() {
            panel.at = (index % columns, index / columns);
        }
        self
    }
}

impl Default for Panel {
    fn default() -> Self {
        Self {
            title: String::new(),
            at: (0, 0),
            span: (1, 1),
            size: (720.0, 460.0),
            x: Axis::default(),
            y: Axis::default(),
            layers: Vec::new(),
            legend: None,
        }
    }
}

impl Panel {
    /// A panel of these axes, across and upwards, and layers.
    pub fn new(x: Axis, y: Axis, layers: impl IntoIterator<Item = Layer>) -> Self {
        Self {
            x,
            y,
            layers: layers.into_iter().collect(),
            ..Self::default()
        }
    }

    /// With this width and height.
    pub fn sized(self, size: (f64, f64)) -> Self {
        Self { size, ..self }
    }

    /// The bar of shades that stands beside it, if there is one: its range and its axis.
    pub(crate) fn bar(&self) -> Option<((f64, f64), Axis)> {
        self.layers.iter().find_map(|layer| match &layer.shape {
            Shape::Shades(_, values, name) => {
                let range = around(values.iter().copied(), 0.0);
                Some((range, Axis::new(name)))
            }
            _ => None,
        })
    }
}

impl Axis {
    /// Leaves the words ahead of the first "of" of a long name.
    fn shorten(&mut self) {
        if self.name.len() > LONG
            && let Some((short, _)) = self.name.split_once(" of ")
        {
            self.name = short.to_owned();
        }
    }

    /// An axis of this name.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            ..Self::default()
        }
    }

    /// An axis of which nothing is written; a panel of two such axes has no frame.
    pub fn bare() -> Self {
        Self::new("").ticks([])
    }

    /// From here to there.
    pub fn range(self, (low, high): (f64, f64)) -> Self {
        let ends = [Some(low), Some(high)];
        Self { ends, ..self }
    }

    /// From here to a value that follows from the layers.
    pub fn from(self, low: f64) -> Self {
        let ends = [Some(low), self.ends[1]];
        Self { ends, ..self }
    }

    /// Logarithmic.
    pub fn log(self) -> Self {
        Self {
            is_log: true,
            ..self
        }
    }

    /// With these values and what is written there.
    pub fn ticks(self, ticks: impl IntoIterator<Item = (f64, String)>) -> Self {
        let ticks = Some(ticks.into_iter().collect());
        Self { ticks, ..self }
    }
}
