//! A point of an earlier `softstop continue` to start from.

use std::io::BufReader;
use std::path::PathBuf;

use nalgebra::Vector2;
use serde::Deserialize;
use serde_json::{Map, Value};
use softstop::{Machine, Parameter};

use softstop_console::failure::Failure;
use softstop_console::report::parameters;
use softstop_console::scene_file::open;

/// A point of a branch: the JSON of an earlier run, and which of its points.
#[derive(Debug, Clone)]
pub struct EarlierPoint {
    file: PathBuf,
    which: String,
}

/// Reads FILE:POINT.
///
/// # Errors
/// What is allowed.
pub fn parse(text: &str) -> Result<EarlierPoint, String> {
    let (file, which) = text.rsplit_once(':').unwrap_or_default();
    if file.is_empty() || which.is_empty() {
        return Err(
            "must be FILE:POINT, such as branch.json:SN, branch.json:PD2 or branch.json:17"
                .to_owned(),
        );
    }
    Ok(EarlierPoint {
        file: file.into(),
        which: which.to_owned(),
    })
}

/// The part of the JSON of `softstop continue` that is read.
#[derive(Deserialize)]
struct Earlier {
    machine: EarlierMachine,
    parameter: String,
    branches: Vec<EarlierBranch>,
}

#[derive(Deserialize)]
struct EarlierMachine {
    parameters: Map<String, Value>,
}

#[derive(Deserialize)]
struct EarlierBranch {
    periods: u64,
    table: Rows,
    specials: Vec<Special>,
}

#[derive(Deserialize)]
struct Rows {
    value: Vec<f64>,
    position: Vec<f64>,
    velocity: Vec<f64>,
}

#[derive(Deserialize)]
struct Special {
    symbol: String,
    value: f64,
    position: f64,
    velocity: f64,
}

/// A point: drive periods, value of the parameter, position and velocity.
type SavedPoint = (u64, [f64; 3]);

impl Earlier {
    /// The points of all branches, in the order of branches.csv.
    fn rows(&self) -> impl Iterator<Item = SavedPoint> + '_ {
        self.branches.iter().flat_map(|branch| {
            let Rows {
                value,
                position,
                velocity,
            } = &branch.table;
            let rows = value.iter().zip(position).zip(velocity);
            rows.map(|((value, position), velocity)| {
                (branch.periods, [*value, *position, *velocity])
            })
        })
    }

    /// The special points with a symbol.
    fn specials<'a>(&'a self, symbol: &'a str) -> impl Iterator<Item = SavedPoint> + 'a {
        self.branches.iter().flat_map(move |branch| {
            let same = branch.specials.iter().filter(move |it| it.symbol == symbol);
            same.map(|it| (branch.periods, [it.value, it.position, it.velocity]))
        })
    }

    /// The key of a value in which a machine differs from the earlier one, but for the parameter and what follows it.
    fn difference(&self, machine: &Machine, parameter: Parameter) -> Option<String> {
        let mut free = vec![machine.name(parameter)];
        free.extend(
            machine
                .followers(parameter)
                .iter()
                .map(|it| machine.name(*it)),
        );
        let (own, earlier) = (parameters(machine), &self.machine.parameters);
        let mut keys = own.keys().chain(earlier.keys());
        let differs = |key: &&String| own.get(*key) != earlier.get(*key);
        keys.find(|key| differs(key) && !free.contains(&key.as_str()))
            .cloned()
    }

    /// The point of this row, or the special one of this symbol, the first unless a number says which.
    fn point(&self, which: &str) -> Option<SavedPoint> {
        if let Ok(row) = which.parse::<usize>() {
            return self.rows().nth(row.checked_sub(1)?);
        }
        let symbol = which.trim_end_matches(|c: char| c.is_ascii_digit());
        let number = match &which[symbol.len()..] {
            "" => 1,
            number => number.parse::<usize>().ok()?,
        };
        self.specials(symbol).nth(number.checked_sub(1)?)
    }
}

impl EarlierPoint {
    /// Sets the parameter of the earlier run to its value at the point; the drive periods and the state there.
    ///
    /// # Errors
    /// [`Failure::Usage`] naming the file and what is wrong.
    pub fn take(&self, machine: &mut Machine) -> Result<(u64, Vector2<f64>), Failure> {
        let wrong = |what: &dyn std::fmt::Display| {
            Failure::usage(format!("--from-point {}: {what}", self.file.display()))
        };
        let file = open(&self.file).map_err(|error| wrong(&error))?;
        let earlier: Earlier = serde_json::from_reader(BufReader::new(file)).map_err(|error| {
            wrong(&format!(
                "no output of softstop continue --format json: {error}"
            ))
        })?;
        if self.which.starts_with("PF") {
            return Err(wrong(
                &"PF: symmetric and asymmetric motions meet there; take a row beside it",
            ));
        }
        let (periods, [value, position, velocity]) =
            earlier.point(&self.which).ok_or_else(|| {
                let (rows, which) = (earlier.rows().count(), &self.which);
                wrong(&format!(
                    "{which}: must be a row of its {rows}, or one of its special points"
                ))
            })?;
        let (parameter, _) = machine
            .free_parameter(&earlier.parameter)
            .map_err(|error| wrong(&error))?;
        if let Some(key) = earlier.difference(machine, parameter) {
            return Err(wrong(&format!("{key}: is not that of this machine")));
        }
        machine.set(parameter, value);
        machine.validate().map_err(|error| wrong(&error))?;
        Ok((periods, Vector2::new(position, velocity)))
    }
}
