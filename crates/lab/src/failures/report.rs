//! The report of `chart failures`: a table of all runs, maps for programs, shares for people.

use crate::methods::Verdict;
use serde::Serialize;

use super::atlas::{Atlas, Column, Map};
use softstop_console::column::{self, Units};
use softstop_console::columns;

/// A run: its atlas and map, and the numbers of its stiffness and of its step.
pub(super) type Run<'a> = (&'a Atlas, &'a Map, usize, usize);

/// All runs.
pub(super) fn runs(atlases: &[Atlas]) -> impl Iterator<Item = Run<'_>> {
    let maps = atlases.iter();
    let maps = maps.flat_map(|atlas| atlas.maps.iter().map(move |map| (atlas, map)));
    maps.flat_map(|(atlas, map)| {
        let steps = atlas.axes.step.len();
        let all = 0..steps * atlas.axes.stiffness.len();
        all.map(move |run| (atlas, map, run / steps, run % steps))
    })
}

/// The columns of the table.
pub(super) fn table<'a>() -> [column::Column<Run<'a>>; 9] {
    columns! { Run<'a>, it;
        "scene" [None], "" => it.0.view.0.name.as_str();
        "scheme" [None], "" => it.1.family.title();
        "events" [None], "" => it.1.family.row();
        "stiffness (N/m)" [None], "" => it.0.axes.stiffness[it.2];
        "step (drive periods)" [None], "" => it.0.axes.step[it.3];
        "verdict" [None], "" => it.1.columns[it.2][it.3].verdict.name();
        "error" [None], "" => it.1.columns[it.2][it.3].error;
        "impacts" [None], "" => it.1.columns[it.2][it.3].impacts;
        "true impacts" [None], "" => it.0.columns[it.2].truth.impacts.len();
    }
}

/// The atlas for programs.
#[derive(Serialize)]
pub(super) struct FailuresReport<'a> {
    /// What the letters in the maps stand for.
    verdicts: Vec<Key>,
    scenes: Vec<SceneReport<'a>>,
}

#[derive(Serialize)]
struct Key {
    letter: char,
    name: &'static str,
}

#[derive(Serialize)]
struct SceneReport<'a> {
    name: &'a str,
    title: &'a str,
    periods: f64,
    tolerance: f64,
    /// In N/m.
    stiffness: &'a [f64],
    /// In drive periods.
    step: &'a [f64],
    /// For each stiffness.
    true_impacts: Vec<usize>,
    /// For each stiffness, in drive periods.
    shortest_contact: Vec<Option<f64>>,
    /// For each stiffness a letter; `-` where nothing else tells the motion.
    exact: String,
    exact_largest_error: f64,
    maps: Vec<MapReport<'a>>,
}

#[derive(Serialize)]
struct MapReport<'a> {
    scheme: &'static str,
    events: &'static str,
    /// Of all runs, by verdict.
    shares: [f64; 8],
    /// For each stiffness a letter for each step.
    map: Vec<String>,
    /// For each stiffness, in drive periods.
    longest_stable_step: &'a [Option<f64>],
}

impl<'a> FailuresReport<'a> {
    pub(super) fn new(atlases: &'a [Atlas]) -> Self {
        let key = |verdict: Verdict| Key {
            letter: verdict.letter(),
            name: verdict.name(),
        };
        Self {
            verdicts: Verdict::ALL.into_iter().map(key).collect(),
            scenes: atlases.iter().map(SceneReport::new).collect(),
        }
    }
}

impl FailuresReport<'_> {
    /// What people read.
    pub(super) fn text(&self) -> String {
        self.scenes.iter().map(SceneReport::text).collect()
    }
}

impl<'a> SceneReport<'a> {
    fn new(atlas: &'a Atlas) -> Self {
        let columns = atlas.columns.iter();
        let exact = columns.clone().map(|column| column.exact);
        let letters = exact.clone();
        let letters = letters.map(|cell| cell.map_or('-', |cell| cell.verdict.letter()));
        let impacts = |column: &Column| column.truth.impacts.len();
        Self {
            name: &atlas.view.0.name,
            title: &atlas.view.0.title,
            periods: atlas.view.0.periods,
            tolerance: atlas.tolerance,
            stiffness: &atlas.axes.stiffness,
            step: &atlas.axes.step,
            true_impacts: columns.clone().map(impacts).collect(),
            shortest_contact: columns.map(|column| column.contact).collect(),
            exact: letters.collect(),
            exact_largest_error: exact.filter_map(|cell| cell?.error).fold(0.0, f64::max),
            maps: atlas.maps.iter().map(MapReport::new).collect(),
        }
    }

    /// The shares of all classes in per cent.
    fn text(&self) -> String {
        let columns = columns! { MapReport<'_>, it;
            "method" [None] Plain, "" => format!("{}, {}", it.scheme, it.events);
            "conv." [None] Fixed(1), "" => 100.0 * it.shares[0];
            "inacc." [None] Fixed(1), "" => 100.0 * it.shares[1];
            "count" [None] Fixed(1), "" => 100.0 * it.shares[2];
            "missed" [None] Fixed(1), "" => 100.0 * it.shares[3];
            "gain" [None] Fixed(1), "" => 100.0 * it.shares[4];
            "blow-up" [None] Fixed(1), "" => 100.0 * it.shares[5];
            "stuck" [None] Fixed(1), "" => 100.0 * it.shares[6];
            "unsuited" [None] Fixed(1), "" => 100.0 * it.shares[7];
        };
        let count = |letter| self.exact.matches(letter).count();
        let (right, untold) = (count('C'), count('-'));
        let untold = match untold {
            0 => String::new(),
            _ => format!("; {untold} not compared with another method"),
        };
        format!(
            "{} ({}): % of all runs\n{}exact: {right} of {} converged, largest error {:.1e}{untold}\n\n",
            self.title,
            self.name,
            column::text(&columns, &self.maps, &Units::SI),
            self.exact.len() - count('-'),
            self.exact_largest_error
        )
    }
}

impl<'a> MapReport<'a> {
    fn new(map: &'a Map) -> Self {
        let verdicts = || map.columns.iter().flatten().map(|cell| cell.verdict);
        let all = verdicts().count() as f64;
        let share = |verdict| verdicts().filter(|other| *other == verdict).count() as f64 / all;
        let columns = map.columns.iter();
        let letters = columns.map(|cells| cells.iter().map(|cell| cell.verdict.letter()).collect());
        Self {
            scheme: map.family.title(),
            events: map.family.row(),
            shares: Verdict::ALL.map(share),
            map: letters.collect(),
            longest_stable_step: &map.limit,
        }
    }
}
