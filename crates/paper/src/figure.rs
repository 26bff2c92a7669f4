//! What a figure is, and what figures share.

use std::collections::BTreeMap;
use std::sync::{LazyLock, OnceLock};

use crate::transitions::{Rules, Transition};
use anyhow::{Context, Result, ensure};
use rayon::prelude::*;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use softstop_console::column::Column;
use softstop_console::record::Record;
use softstop_draw::{Chart, Layer};
use softstop_dynamics::attractors::SearchOptions;
use softstop_dynamics::monitor::{OptionalMemory, recall_or_compute};

use crate::table1::{self, paper};

/// A figure as `docs/paper/figures.toml` states it.
#[derive(Debug, Deserialize)]
pub(crate) struct Figure {
    /// What it is called on the command line.
    pub(crate) name: String,
    /// What it shows, in one line.
    pub(crate) title: String,
    /// Names of its files: pictures and tables.
    pub(crate) files: Vec<String>,
    /// How its pictures look, without what is drawn.
    #[serde(default)]
    pub(crate) chart: Chart,
    /// What is computed, by keys of its own.
    #[serde(flatten)]
    settings: toml::Table,
}

/// The figures that the file states, in its order.
static FIGURES: LazyLock<Vec<Figure>> = LazyLock::new(|| {
    let file: BTreeMap<String, Vec<Figure>> =
        toml::from_str(include_str!("../../../docs/paper/figures.toml"))
            .expect("the file that is built in holds figures");
    file.into_values().flatten().collect()
});

impl Figure {
    /// The one of a name.
    pub(crate) fn called(name: &str) -> Result<&'static Self> {
        let figure = FIGURES.iter().find(|it| it.name == name);
        figure.with_context(|| format!("no figure {name} in docs/paper/figures.toml"))
    }

    /// Its picture, with the layers of its panels in order.
    ///
    /// # Errors
    /// If there are not as many as the file states panels.
    pub(crate) fn picture(&self, layers: impl IntoIterator<Item = Vec<Layer>>) -> Result<Chart> {
        let mut chart = self.chart.clone();
        let (name, panels) = (&self.name, chart.panels.len());
        let layers: Vec<_> = layers.into_iter().collect();
        let place = "docs/paper/figures.toml";
        ensure!(
            layers.len() == panels,
            "figure {name} has {panels} panels in {place}, {} are drawn",
            layers.len()
        );
        for (panel, layers) in chart.panels.iter_mut().zip(layers) {
            panel.layers = layers;
        }
        Ok(chart)
    }

    /// What a key of its own says.
    pub(crate) fn get<T: DeserializeOwned>(&self, key: &str) -> Result<T> {
        let value = self.settings.get(key).cloned().map(T::deserialize);
        let place = || format!("{key} of figure {} in docs/paper/figures.toml", self.name);
        value.with_context(place)?.with_context(place)
    }
}

/// Makes the files of a figure.
pub(crate) type Draw = fn(&Studio<'_>, &Figure) -> Result<Drawn>;

/// What came out of a figure.
#[derive(Serialize, Deserialize)]
pub(crate) struct Drawn {
    /// Contents of the files, in the order of their names.
    pub(crate) files: Vec<Vec<u8>>,
    pub(crate) findings: Findings,
}

impl Drawn {
    /// The contents of the files in the order of their names, and what they show in numbers.
    pub(crate) fn new(files: impl Into<Vec<Vec<u8>>>, findings: Findings) -> Self {
        let files = files.into();
        Self { files, findings }
    }
}

/// What a figure shows in numbers, by name, in the paper's symbols.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(crate) struct Findings(pub(crate) BTreeMap<String, f64>);

impl Findings {
    /// Adds the numbers of a thing that people read, by what their columns mean; their names begin alike.
    pub(crate) fn add_numbers<T>(&mut self, group: &str, columns: &[Column<T>], thing: &T) {
        for (what, value) in Record::of(columns, thing).numbers() {
            self.add(format!("{group}{what}"), value);
        }
    }

    /// Adds a value, if there is one.
    pub(crate) fn add(&mut self, name: impl Into<String>, value: impl Into<Option<f64>>) {
        self.0
            .extend(value.into().map(|value| (name.into(), value)));
    }
}

/// Adds values, one in each line, by what each is, from which its name is made.
macro_rules! findings {
    ($findings:expr, $name:expr; $($what:expr => $value:expr;)*) => {{
        let name = $name;
        $($findings.add(name($what), $value);)*
    }};
}
pub(crate) use findings;

/// What figures share.
pub(crate) struct Studio<'a> {
    pub(crate) detail: Detail,
    /// Where finished work is kept.
    pub(crate) kept: OptionalMemory<'a>,
    /// All transitions along rho = 10, once they are asked for.
    transitions: OnceLock<Vec<Transition>>,
}

/// How fine figures are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub(crate) enum Detail {
    /// For print.
    Full,
    /// For a first look.
    Draft,
}

impl<'a> Studio<'a> {
    pub(crate) fn new(detail: Detail, kept: OptionalMemory<'a>) -> Self {
        Self {
            detail,
            kept,
            transitions: OnceLock::new(),
        }
    }

    /// Works on all items side by side, each a piece to be kept.
    pub(crate) fn each<I, T>(
        &self,
        what: &str,
        items: &[I],
        work: impl Fn(&I) -> Result<T> + Sync,
    ) -> Result<Vec<T>>
    where
        I: Serialize + Sync,
        T: Serialize + DeserializeOwned + Send,
    {
        let kept = self.kept;
        let items = items.par_iter();
        let done = items.map(|item| recall_or_compute(kept, &(what, item), || work(item)));
        done.collect()
    }

    /// How transitions are looked for: with few motions and short runs for a first look.
    pub(crate) fn rules(&self) -> Rules {
        let full = Rules::default();
        let draft = Rules {
            survey: SearchOptions {
                starts: 64,
                patience: 20_000,
                ..full.survey
            },
            motions: 8,
            patience: 1000,
            ..full
        };
        self.detail.pick(full, draft)
    }

    /// All transitions along rho = 10; for a first look only those of the last two rows of Table 1.
    pub(crate) fn transitions(&self) -> Result<&[Transition]> {
        if let Some(known) = self.transitions.get() {
            return Ok(known);
        }
        let (range, values) = match self.detail {
            Detail::Full => (table1::RANGE, table1::values(&paper::INTERVALS)),
            Detail::Draft => ((1.01, 1.8), vec![1.2]),
        };
        let found = table1::transitions(&self.rules(), range, &values, self.kept)?;
        Ok(self.transitions.get_or_init(|| found))
    }
}

impl Detail {
    /// A number of points or periods: the first for print, the second for a first look.
    pub(crate) fn pick<T>(self, full: T, draft: T) -> T {
        match self {
            Self::Full => full,
            Self::Draft => draft,
        }
    }
}

/// So many values from one to another.
pub(crate) fn evenly_spread(low: f64, high: f64, count: usize) -> Vec<f64> {
    let step = (high - low) / (count - 1) as f64;
    (0..count).map(|index| low + step * index as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_has_layers_for_each_of_its_panels() -> Result<()> {
        let figure = Figure::called("7")?;
        let layers = |count: usize| vec![Vec::new(); count];
        let panels = figure.chart.panels.len();
        assert_eq!(figure.picture(layers(panels))?.panels.len(), panels);
        for wrong in [panels - 1, panels + 1] {
            let refused = figure.picture(layers(wrong)).err();
            let told = format!("has {panels} panels in docs/paper/figures.toml, {wrong} are drawn");
            assert!(refused.is_some_and(|it| it.to_string().contains(&told)));
        }
        Ok(())
    }
}
