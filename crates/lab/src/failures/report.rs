//! What an atlas says: a table of all runs, maps for programs, shares for people.

use crate::methods::Verdict;
use serde::Serialize;

use super::atlas::{Atlas, Map};
use softstop_console::failure::Failure;
use softstop_console::output::{Folder, Staged};

/// A row of the table.
#[derive(Debug, Serialize)]
struct Row<'a> {
    scene: &'a str,
    scheme: &'a str,
    events: &'a str,
    stiffness: f64,
    step: f64,
    verdict: &'a str,
    error: Option<f64>,
    impacts: Option<usize>,
    true_impacts: usize,
}

const HEADER: [&str; 9] = [
    "scene",
    "scheme",
    "events",
    "stiffness (N/m)",
    "step (drive periods)",
    "verdict",
    "error",
    "impacts",
    "true impacts",
];

/// Writes a row for each run.
///
/// # Errors
/// [`Failure::Run`] if the table cannot be written.
pub(super) fn table(atlases: &[Atlas], mut table: Staged) -> Result<(), Failure> {
    table.header(&HEADER)?;
    for atlas in atlases {
        for map in &atlas.maps {
            rows(atlas, map, &mut table)?;
        }
    }
    table.close()
}

fn rows(atlas: &Atlas, map: &Map, table: &mut Staged) -> Result<(), Failure> {
    let columns = atlas.axes.stiffness.iter().zip(&atlas.columns);
    for ((stiffness, column), cells) in columns.zip(&map.columns) {
        for (step, cell) in atlas.axes.step.iter().zip(cells) {
            table.row(&Row {
                scene: &atlas.view.name,
                scheme: map.family.title(),
                events: map.family.row(),
                stiffness: *stiffness,
                step: *step,
                verdict: cell.verdict.name(),
                error: cell.error,
                impacts: cell.impacts,
                true_impacts: column.truth.impacts.len(),
            })?;
        }
    }
    Ok(())
}

/// The atlas for programs.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
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
#[serde(rename_all = "camelCase")]
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
#[serde(rename_all = "camelCase")]
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

const fn letter(verdict: Verdict) -> char {
    match verdict {
        Verdict::Converged => 'C',
        Verdict::Inaccurate => 'I',
        Verdict::WrongCount => 'W',
        Verdict::MissedContact => 'M',
        Verdict::EnergyGain => 'E',
        Verdict::BlownUp => 'B',
        Verdict::Stuck => 'S',
        Verdict::Unsuited => 'U',
    }
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
