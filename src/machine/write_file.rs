//! Writes machines as TOML files.

use toml::Value;

use super::keys::WordKeys;
use super::{Machine, UnitSystem, keys};
use crate::scene::{Dimension, Release, Slope, Stop};

/// Least width of a statement before its comment, in characters.
const COMMENT_COLUMN: usize = 35;

/// A table of the file, and its lines.
type Section = (&'static str, Vec<Line>);

/// A line of the file: key, value as in TOML, and comment.
struct Line(&'static str, String, String);

impl Machine {
    /// The text of a machine file in its own units, complete, each number with what it is. [`Machine::from_toml`]
    /// makes the same machine of it, to the bit; but a drive frequency that no number of Hz gives, if it is to be
    /// in Hz, is the nearest one that has such a number.
    ///
    /// ```
    /// use softstop::Machine;
    ///
    /// let machine = Machine::named("loaded").expect("the paper's");
    /// assert_eq!(Machine::from_toml(&machine.to_toml())?, machine);
    /// # Ok::<(), softstop::MachineError>(())
    /// ```
    pub fn to_toml(&self) -> String {
        let mut sections: Vec<Section> = vec![("", Vec::new())];
        for line in self.file_lines() {
            // A table of one key is not worth its heading.
            let table = match line.0.split_once('.') {
                None | Some(("contact", _)) => "",
                Some((table, _)) => table,
            };
            match sections.iter_mut().find(|(name, _)| *name == table) {
                Some((_, lines)) => lines.push(line),
                None => sections.push((table, vec![line])),
            }
        }
        let mut text = String::new();
        for (key, value) in [("name", &self.name), ("description", &self.description)] {
            if let Some(value) = value {
                text += &format!("{key} = {}\n", Value::String(value.clone()));
            }
        }
        for (table, lines) in sections {
            let inside = self.unit_system == UnitSystem::Ratios && table != "initial";
            let heading = match (inside, table) {
                (true, "") => "\n[ratios]\n".to_owned(),
                (true, table) => format!("\n[ratios.{table}]\n"),
                (false, "") => "\n".to_owned(),
                (false, table) => format!("\n[{table}]\n"),
            };
            text += &heading;
            for Line(key, value, meaning) in lines {
                let key = key.strip_prefix(table).unwrap_or(key);
                let stated = format!("{} = {value}", key.trim_start_matches('.'));
                let line = match meaning.as_str() {
                    "" => stated,
                    _ => format!("{stated:COMMENT_COLUMN$} # {meaning}"),
                };
                text += &line;
                text.push('\n');
            }
        }
        text.trim_start().to_owned()
    }

    /// The lines of the file, all that makes out the machine.
    fn file_lines(&self) -> Vec<Line> {
        let mut lines = Vec::new();
        for parameter in self.parameters() {
            if let Some(value) = self.value(parameter) {
                let (key, value) = match (self.tie_of(parameter), self.name(parameter)) {
                    (Some((key, text)), _) => (key, Value::String(text.to_owned()).to_string()),
                    (None, key @ keys::FREQUENCY_HZ) => (key, number_text(self.exact_hertz(value))),
                    (None, key) => (key, number_text(value)),
                };
                lines.push(Line(key, value, self.label_of(parameter)));
            }
        }
        self.add_words(&self.scene.stop, keys::STOP_WORDS, &mut lines);
        if let Some(below) = &self.scene.below {
            self.add_words(&below.stop, keys::STOP_BELOW_WORDS, &mut lines);
        }
        for (key, value, what, dimension) in [
            (
                keys::POSITION,
                self.start.position,
                "position",
                Dimension::Length,
            ),
            (
                keys::VELOCITY,
                self.start.velocity,
                "velocity",
                Dimension::Velocity,
            ),
        ] {
            let meaning = self.label(&format!("{what} at time 0"), "", dimension);
            lines.push(Line(key, number_text(value), meaning));
        }
        lines
    }

    /// Adds the lines of what is no number of a stop: its model ahead of its numbers, the rest at the end.
    fn add_words(&self, stop: &Stop, keys: WordKeys, lines: &mut Vec<Line>) {
        let [model, release_key, loading_key, unloading_key] = keys;
        let word = |word: &str| format!("\"{word}\"");
        let table = model.trim_end_matches("model");
        let is_stops = |line: &Line| line.0.starts_with(table);
        let place = lines.iter().position(is_stops).unwrap_or(lines.len());
        let model = Line(model, word(stop.model()), String::new());
        lines.insert(place, model);
        match stop {
            Stop::KelvinVoigt { release, .. } => {
                let name = match release {
                    Release::Clearance => "clearance",
                    Release::ZeroForce => "zeroForce",
                };
                let meaning = "when a mass that moves back is let go".to_owned();
                lines.push(Line(release_key, word(name), meaning));
            }
            Stop::PiecewiseLinear { loading, unloading } => {
                let from = self.label("from this deflection", "", Dimension::Length);
                let slope = self.label("this stiffness", "", Dimension::Stiffness);
                let meaning = format!("{from} on {slope}");
                lines.push(Line(loading_key, slopes_text(loading), meaning.clone()));
                if !unloading.is_empty() {
                    lines.push(Line(unloading_key, slopes_text(unloading), meaning));
                }
            }
            _ => {}
        }
    }

    /// The number of Hz near this one that gives the drive's frequency to the bit, if there is one.
    fn exact_hertz(&self, near: f64) -> f64 {
        let exact = |hertz: &f64| {
            self.to_si(Dimension::Frequency, *hertz) == self.scene.excitation.frequency
        };
        let around = [near, near.next_down(), near.next_up()];
        around.into_iter().find(exact).unwrap_or(near)
    }
}

/// The shortest text to write that reads back as the same number.
fn number_text(value: f64) -> String {
    format!("{value:?}")
}

fn slopes_text(slopes: &[Slope]) -> String {
    let slope = |slope: &Slope| {
        let (from, stiffness) = (number_text(slope.from), number_text(slope.stiffness));
        format!("{{ from = {from}, stiffness = {stiffness} }}")
    };
    format!(
        "[{}]",
        slopes.iter().map(slope).collect::<Vec<_>>().join(", ")
    )
}
