//! The report of `chart failures`: a table of all runs, maps for programs, shares for people.

use crate::methods::Verdict;
use serde::Serialize;

use super::atlas::{Atlas, Map};
use softstop_console::failure::Failure;
use softstop_console::output::{self, Folder};

/// A row of the table.
#[derive(Debug, Serialize)]
struct Row<'a> {
    scene: &'a str,
    scheme: &'a str,
    events: &'a str,
    #[serde(rename = "stiffness (N/m)")]
    stiffness: f64,
    #[serde(rename = "step (drive periods)")]
    step: f64,
    verdict: &'a str,
    error: Option<f64>,
    impacts: Option<usize>,
    #[serde(rename = "true impacts")]
    true_impacts: usize,
}

/// A row for each run.
pub(super) fn table(atlases: &[Atlas]) -> Result<Vec<u8>, Failure> {
    let maps = atlases.iter();
    let maps = maps.flat_map(|atlas| atlas.maps.iter().map(move |map| (atlas, map)));
    output::csv(maps.flat_map(|(atlas, map)| rows(atlas, map)))
}

fn rows<'a>(atlas: &'a Atlas, map: &'a Map) -> Vec<Row<'a>> {
    let columns = atlas.axes.stiffness.iter().zip(&atlas.columns);
    let mut rows = Vec::new();
    for ((stiffness, column), cells) in columns.zip(&map.columns) {
        rows.extend(atlas.axes.step.iter().zip(cells).map(|(step, cell)| Row {
            scene: &atlas.view.name,
            scheme: map.family.title(),
            events: map.family.row(),
            stiffness: *stiffness,
            step: *step,
            verdict: cell.verdict.name(),
            error: cell.error,
            impacts: cell.impacts,
            true_impacts: column.truth.impacts.len(),
        }));
    }
    rows
}

/// The atlas for programs.
#[derive(Debug, Serialize)]
pub(super) struct FailuresReport {
    /// What the letters in the maps stand for.
    verdicts: Vec<Key>,
    scenes: Vec<SceneReport>,
    files: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Key {
    letter: char,
    name: &'static str,
}

#[derive(Debug, Serialize)]
struct SceneReport {
    name: String,
    title: String,
    periods: f64,
    tolerance: f64,
    /// In N/m.
    stiffness: Vec<f64>,
    /// In drive periods.
    step: Vec<f64>,
    /// For each stiffness.
    true_impacts: Vec<usize>,
    /// For each stiffness, in drive periods.
    shortest_contact: Vec<Option<f64>>,
    /// For each stiffness a letter; `-` where the true motion is the exact method's own.
    exact: String,
    exact_largest_error: f64,
    maps: Vec<MapReport>,
}

#[derive(Debug, Serialize)]
struct MapReport {
    scheme: &'static str,
    events: &'static str,
    /// Of all runs, by verdict.
    shares: Vec<f64>,
    /// For each stiffness a letter for each step.
    map: Vec<String>,
    /// For each stiffness, in drive periods.
    longest_stable_step: Vec<Option<f64>>,
}

/// Of [`Verdict::ALL`].
const LETTERS: &[u8; 8] = b"CIWMEBSU";

fn letter(verdict: Verdict) -> char {
    char::from(LETTERS[verdict as usize])
}

impl FailuresReport {
    pub(super) fn new(atlases: &[Atlas], names: &[&str], folder: &Folder) -> Self {
        let key = |verdict: Verdict| Key {
            letter: letter(verdict),
            name: verdict.name(),
        };
        let place = |name: &&str| folder.place(name).display().to_string();
        Self {
            verdicts: Verdict::ALL.into_iter().map(key).collect(),
            scenes: atlases.iter().map(SceneReport::new).collect(),
            files: names.iter().map(place).collect(),
        }
    }

    /// The shares of all classes in per cent, and the files.
    pub(super) fn text(&self) -> String {
        let mut text: String = self.scenes.iter().map(SceneReport::text).collect();
        for file in &self.files {
            text.push_str(&format!("Written: {file}\n"));
        }
        text
    }
}

impl SceneReport {
    fn new(atlas: &Atlas) -> Self {
        let columns = &atlas.columns;
        let exact = columns.iter().map(|column| column.exact);
        Self {
            name: atlas.view.name.clone(),
            title: atlas.view.title.clone(),
            periods: atlas.view.periods,
            tolerance: atlas.tolerance,
            stiffness: atlas.axes.stiffness.clone(),
            step: atlas.axes.step.clone(),
            true_impacts: columns
                .iter()
                .map(|column| column.truth.impacts.len())
                .collect(),
            shortest_contact: columns.iter().map(|column| column.contact).collect(),
            exact: exact
                .clone()
                .map(|cell| cell.map_or('-', |cell| letter(cell.verdict)))
                .collect(),
            exact_largest_error: exact.filter_map(|cell| cell?.error).fold(0.0, f64::max),
            maps: atlas.maps.iter().map(MapReport::new).collect(),
        }
    }

    fn text(&self) -> String {
        let heads = [
            "conv.", "inacc.", "count", "missed", "gain", "blow-up", "stuck", "unsuited",
        ];
        let heads: String = heads.iter().map(|head| format!("{head:>9}")).collect();
        let mut text = format!("{} ({}): % of all runs\n", self.title, self.name);
        text.push_str(&format!("  {:<37}{heads}\n", ""));
        for map in &self.maps {
            let name = format!("{}, {}", map.scheme, map.events);
            let share = |share: &f64| format!("{:>9.1}", 100.0 * share);
            let shares: String = map.shares.iter().map(share).collect();
            text.push_str(&format!("  {name:<37}{shares}\n"));
        }
        let count = |letter| self.exact.matches(letter).count();
        let compared = self.exact.len() - count('-');
        text.push_str(&format!(
            "  exact: {} of {compared} converged, largest error {:.1e}",
            count('C'),
            self.exact_largest_error
        ));
        if count('-') > 0 {
            text.push_str(&format!("; {} not compared with 67 digits", count('-')));
        }
        text.push_str("\n\n");
        text
    }
}

impl MapReport {
    fn new(map: &Map) -> Self {
        let verdicts = || map.columns.iter().flatten().map(|cell| cell.verdict);
        let all = verdicts().count() as f64;
        let share = |verdict| verdicts().filter(|other| *other == verdict).count() as f64 / all;
        let letters = map
            .columns
            .iter()
            .map(|cells| cells.iter().map(|cell| letter(cell.verdict)).collect());
        Self {
            scheme: map.family.title(),
            events: map.family.row(),
            shares: Verdict::ALL.into_iter().map(share).collect(),
            map: letters.collect(),
            longest_stable_step: map.limit.clone(),
        }
    }
}
