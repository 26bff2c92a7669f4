//! The report of `chart failures`: a table of all runs, maps for programs, shares for people.

use crate::methods::Verdict;
use serde_json::json;

use super::atlas::{Atlas, Cell, Map};
use softstop_console::column::Column;
use softstop_console::columns;
use softstop_console::record::Record;
use softstop_console::table::aligned;

/// One run of a method on a machine.
pub(super) struct Run<'a> {
    atlas: &'a Atlas,
    map: &'a Map,
    /// Index of its stiffness.
    column: usize,
    /// Index of its step.
    row: usize,
}

impl Run<'_> {
    fn cell(&self) -> &Cell {
        &self.map.columns[self.column][self.row]
    }
}

/// All runs.
pub(super) fn runs(atlases: &[Atlas]) -> impl Iterator<Item = Run<'_>> {
    let maps = atlases.iter();
    let maps = maps.flat_map(|atlas| atlas.maps.iter().map(move |map| (atlas, map)));
    let columns = maps.flat_map(|(atlas, map)| {
        let columns = 0..atlas.axes.stiffness.len();
        columns.map(move |column| (atlas, map, column))
    });
    columns.flat_map(|(atlas, map, column)| {
        let rows = 0..atlas.axes.step.len();
        rows.map(move |row| Run {
            atlas,
            map,
            column,
            row,
        })
    })
}

/// The columns of the table.
pub(super) fn table<'a>() -> [Column<Run<'a>>; 9] {
    columns! { Run<'a>, it;
        "scene" [None], "" => it.atlas.case.name.as_str();
        "scheme" [None], "" => it.map.family.title();
        "events" [None], "" => it.map.family.row();
        "stiffness (N/m)" [None], "" => it.atlas.axes.stiffness[it.column];
        "step (drive periods)" [None], "" => it.atlas.axes.step[it.row];
        "verdict" [None], "" => it.cell().verdict.name();
        "error" [None], "" => it.cell().error;
        "impacts" [None], "" => it.cell().impacts;
        "true impacts" [None], "" => it.atlas.columns[it.column].truth.impacts.len();
    }
}

/// The atlas for programs: what the letters in the maps stand for, and the maps of each machine.
pub(super) fn record(atlases: &[Atlas]) -> Record {
    let letters = columns! { Verdict, it;
        "letter" [None], "in the maps" => it.letter().to_string();
        "name" [None], "what it stands for" => it.name();
    };
    Record::default()
        .hidden("verdicts", Record::all(&letters, &Verdict::ALL))
        .hidden("scenes", Record::all(&scene(), atlases))
}

fn scene() -> [Column<Atlas>; 11] {
    columns! { Atlas, it;
        "name" [None], "" => it.case.name.as_str();
        "title" [None], "" => it.case.title.as_str();
        "periods" [None], "" => it.case.periods;
        "tolerance" [None], "" => it.tolerance;
        "stiffness" [None], "in N/m" => it.axes.stiffness.clone();
        "step" [None], "in drive periods" => it.axes.step.clone();
        "true_impacts" [None], "for each stiffness" => json!(it.columns.iter().map(|it| it.truth.impacts.len()).collect::<Vec<_>>());
        "shortest_contact" [None], "for each stiffness, in drive periods" => json!(it.columns.iter().map(|it| it.contact).collect::<Vec<_>>());
        "exact" [None], "for each stiffness a letter; `-` where nothing else tells the motion" => exact(it).0;
        "exact_largest_error" [None], "" => exact(it).1;
        "maps" [None], "" => Record::all(&map(), &it.maps);
    }
}

fn map() -> [Column<Map>; 5] {
    columns! { Map, it;
        "scheme" [None], "" => it.family.title();
        "events" [None], "" => it.family.row();
        "shares" [None], "of all runs, by verdict" => shares(it).to_vec();
        "map" [None], "for each stiffness a letter for each step" => json!(it.columns.iter().map(|cells| letters(cells)).collect::<Vec<_>>());
        "longest_stable_step" [None], "for each stiffness, in drive periods" => json!(it.limit);
    }
}

fn letters(cells: &[Cell]) -> String {
    cells.iter().map(|cell| cell.verdict.letter()).collect()
}

/// The letters of the exact method, and its largest error.
fn exact(atlas: &Atlas) -> (String, f64) {
    let cells = atlas.columns.iter().map(|column| column.exact);
    let letters = cells.clone();
    let letters = letters.map(|cell| cell.map_or('-', |cell| cell.verdict.letter()));
    let errors = cells.filter_map(|cell| cell?.error);
    (letters.collect(), errors.fold(0.0, f64::max))
}

/// The share of each verdict in all runs.
fn shares(map: &Map) -> [f64; 8] {
    let verdicts = || map.columns.iter().flatten().map(|cell| cell.verdict);
    let all = verdicts().count() as f64;
    Verdict::ALL.map(|own| verdicts().filter(|other| *other == own).count() as f64 / all)
}

/// For people: the shares of the classes in per cent.
pub(super) fn text(atlas: &Atlas) -> String {
    let line = |map: &Map| {
        let shares = Verdict::ALL.iter().zip(shares(map));
        let shares = shares.filter(|(_, share)| *share > 0.0);
        let words = shares.map(|(it, share)| format!("{:.1} {}", 100.0 * share, it.name()));
        vec![map.family.name(), words.collect::<Vec<_>>().join(", ")]
    };
    let maps: Vec<Vec<String>> = atlas.maps.iter().map(line).collect();
    let (exact, error) = exact(atlas);
    let count = |letter| exact.matches(letter).count();
    let untold = match count('-') {
        0 => String::new(),
        untold => format!("; {untold} not compared with another method"),
    };
    format!(
        "{} ({}): % of all runs\n{}exact: {} of {} converged, largest error {error:.1e}{untold}\n\n",
        atlas.case.title,
        atlas.case.name,
        aligned(&maps, |_| true),
        count('C'),
        exact.len() - count('-'),
    )
}
