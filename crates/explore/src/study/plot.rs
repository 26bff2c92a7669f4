//! `softstop study plot`: a map over two axes of a study, or a slice along one, from its Parquet.

use std::collections::BTreeMap;
use std::io;
use std::path::PathBuf;

use anyhow::{Context, Error, anyhow};
use clap::Args;
use serde_json::json;
use softstop_console::export::Export;
use softstop_console::failure::Failure;
use softstop_console::names::check_file;
use softstop_console::output::Format;
use softstop_console::record::Record;
use softstop_console::scene_file;

use super::read::read;
use super::report::{ColumnReport, Manifest};
use super::{FOLDER, MANIFEST, TABLE};

/// Arguments of `softstop study plot`.
#[derive(Debug, Args)]
pub struct PlotArguments {
    /// Folder with study.parquet and study.json
    #[arg(value_name = "DIR", default_value = FOLDER)]
    pub folder: PathBuf,
    /// Output to draw [default: the first that can be drawn so]
    #[arg(long, value_name = "NAME")]
    pub of: Option<String>,
    /// One axis for a slice, two grids for a map, by the names of their columns [default: the first two grids, or
    /// the only axis]
    #[arg(long, value_name = "ACROSS[,UP]", value_delimiter = ',')]
    pub over: Vec<String>,
    /// Value of another axis, to its nearest one; repeatable [default: the first]
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true, value_parser = place)]
    pub at: Vec<(String, f64)>,
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

fn place(text: &str) -> Result<(String, f64), String> {
    let parts = text.split_once('=');
    let parts = parts.and_then(|(name, value)| Some((name.to_owned(), value.parse().ok()?)));
    parts.ok_or_else(|| "must be NAME=VALUE".to_owned())
}

/// Which points of a study are drawn.
pub(super) struct StudyView<'a> {
    pub manifest: &'a Manifest,
    pub column: &'a ColumnReport,
    /// Numbers of the axes across and upwards.
    pub over: Vec<usize>,
    /// Numbers of the values of the other grids.
    pub held: BTreeMap<usize, u64>,
}

/// Draws and says what.
pub(super) fn run(arguments: &PlotArguments) -> Result<(), Failure> {
    let place = arguments.folder.join(MANIFEST);
    let cannot = || format!("{}: cannot be read", place.display());
    let text = scene_file::open(&place).and_then(io::read_to_string);
    let text = text.with_context(cannot)?;
    let manifest: Manifest = serde_json::from_str(&text).with_context(cannot)?;
    let view = StudyView::new(&manifest, arguments)?;
    let is_map = view.over.len() == 2;
    let kind = if is_map { "png" } else { "svg" };
    let name = format!("{}.{kind}", view.column.name);
    check_file(&name)?;
    let export = Export::of_file(kind, &arguments.folder, &name)?;
    let table = arguments.folder.join(TABLE);
    let in_table = |error: Error| error.context(format!("{}: cannot be read", table.display()));
    let points = view.points(&table).map_err(in_table)?;
    let picture = match is_map {
        true => view.map(&points)?,
        false => view.slice(&points),
    };
    export.file(kind, &picture)?;
    let names = |axis: &usize| manifest.axes[*axis].parameter.clone();
    let at = view.held.iter();
    let at = at.map(|(axis, number)| (names(axis), manifest.axes[*axis].values.at(*number)));
    let at: BTreeMap<String, f64> = at.collect();
    let over: Vec<String> = view.over.iter().map(names).collect();
    let (of, points) = (&view.column.name, points.len());
    let text = format!("{of} over {}: {points} points", over.join(" and "));
    let result = Record::default()
        .hidden("of", of.as_str())
        .hidden("over", json!(over))
        .hidden("at", json!(at))
        .hidden("points", points);
    export.finish(&result, text, arguments.format)
}

/// A point that is drawn: where it is along the axes, and what is there.
pub(super) struct PlotPoint {
    pub at: [f64; 2],
    pub number: f64,
    pub word: Option<String>,
}

impl<'a> StudyView<'a> {
    fn new(manifest: &'a Manifest, arguments: &PlotArguments) -> Result<Self, Failure> {
        let named = |flag: &str, name: &str| {
            let place = manifest.axes.iter().position(|axis| axis.parameter == name);
            place.ok_or_else(|| {
                let names = manifest.axes.iter().map(|axis| axis.parameter.as_str());
                let names = names.collect::<Vec<_>>().join(", ");
                Failure::usage(format!("--{flag} {name}: the axes are {names}"))
            })
        };
        let is_grid = |axis: &usize| manifest.axes[*axis].values.is_grid();
        let all = 0..manifest.axes.len();
        let mut over = match arguments.over.as_slice() {
            [] => all.clone().filter(is_grid).take(2).collect(),
            names => {
                let places = names.iter().map(|name| named("over", name));
                places.collect::<Result<Vec<_>, _>>()?
            }
        };
        if over.is_empty() {
            over = all.clone().take(1).collect();
        }
        if over.len() > 2 || (over.len() == 2 && (!over.iter().all(is_grid) || over[0] == over[1]))
        {
            return Err(Failure::usage(
                "--over: must be one axis, or two that are grids with from, to and count",
            ));
        }
        let columns = &manifest.columns;
        let column = match &arguments.of {
            None => {
                let can_be_drawn =
                    |it: &&ColumnReport| over.len() == 2 || it.summary.words.is_empty();
                columns.iter().find(can_be_drawn).or(columns.first())
            }
            Some(name) => columns.iter().find(|column| column.name == *name),
        };
        let column = column.ok_or_else(|| {
            let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
            let asked = arguments.of.as_deref().unwrap_or_default();
            Failure::usage(format!("--of {asked}: the study has {}", names.join(", ")))
        })?;
        if over.len() == 1 && !column.summary.words.is_empty() {
            let name = &column.name;
            return Err(Failure::usage(format!(
                "--of {name}: words go in maps, over two grids"
            )));
        }
        let mut held = BTreeMap::new();
        for axis in all.filter(|axis| !over.contains(axis)) {
            if manifest.axes[axis].values.count().is_some() {
                held.insert(axis, 0);
            }
        }
        for (name, value) in &arguments.at {
            let axis = named("at", name)?;
            let Some(number) = held.get_mut(&axis) else {
                let why = "is drawn over, or has no values of its own";
                return Err(Failure::usage(format!("--at {name}: {why}")));
            };
            *number = manifest.axes[axis].values.nearest(*value);
        }
        Ok(Self {
            manifest,
            column,
            over,
            held,
        })
    }

    /// The points that are drawn, in order.
    fn points(&self, table: &std::path::Path) -> Result<Vec<PlotPoint>, Error> {
        let name = |axis: &usize| self.manifest.axes[*axis].parameter.as_str();
        let mut names = vec![self.column.name.as_str()];
        names.extend(self.over.iter().map(name));
        let is_map = self.over.len() == 2;
        let samples = self.manifest.samples.unwrap_or(1);
        let mut points = Vec::new();
        read(table, &names, |first, columns| {
            for row in 0..columns[0].len() {
                let point = first + row as u64;
                if !self.shows(point / samples) || (is_map && !point.is_multiple_of(samples)) {
                    continue;
                }
                let at = |column: usize| {
                    let column = columns.get(column);
                    column.map_or(f64::NAN, |it| it.number(row))
                };
                points.push(PlotPoint {
                    at: [at(1), at(2)],
                    number: at(0),
                    word: columns[0].word(row).map(str::to_owned),
                });
            }
        })?;
        match points.len() as u64 <= self.manifest.points && !points.is_empty() {
            true => Ok(points),
            false => Err(anyhow!("it has not the points of its manifest")),
        }
    }

    /// Whether a point of the grid has the values that are held.
    fn shows(&self, mut rest: u64) -> bool {
        let mut shows = true;
        for (number, axis) in self.manifest.axes.iter().enumerate().rev() {
            let Some(count) = axis.values.count() else {
                continue;
            };
            let held = self.held.get(&number);
            shows &= held.is_none_or(|held| *held == rest % count);
            rest /= count;
        }
        shows
    }
}
