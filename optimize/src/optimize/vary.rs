//! What is searched: `[vary]` of a file and `--vary` of the command line.

use std::fmt;
use std::str::FromStr;

use serde::Deserialize;
use softstop::internals::rpm_value_hint;
use softstop::{Dimension, Machine, Parameter};
use softstop_console::failure::Failure;
use toml::{Table, Value};

use super::toml_leaves::{free_parameter, leaves, number, read_words, slopes};
use crate::design::problem::Link;
use crate::design::space::{Axis, Interval};

/// What is searched if nothing else is said, in units of k1 and of F0/k1.
const USUAL: [(Parameter, [f64; 2]); 2] = [
    (Parameter::StopStiffness, [1.0, 30.0]),
    (Parameter::Clearance, [2.0, 22.0]),
];

/// What is said of one parameter, by a key of the machine's file or a letter.
#[derive(Debug, Clone, PartialEq)]
pub struct VariedParameter {
    pub(super) key: String,
    pub(super) values: AllowedValues,
}

/// The values that a parameter may take, in units of its key.
#[derive(Debug, Clone, PartialEq)]
pub enum AllowedValues {
    /// It is searched from one value to another; equal ones hold it.
    Range([f64; 2]),
    /// It is one of these, in rising order.
    Catalogue(Vec<f64>),
    /// It follows another parameter.
    Follows(Follow),
}

/// `{ follows = "stop.stiffness", factor = 2e-5 }`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Follow {
    follows: String,
    factor: f64,
    #[serde(default)]
    offset: f64,
}

/// `NAME=VALUE` or `NAME=LOW:HIGH`.
impl FromStr for VariedParameter {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (key, values) = text
            .split_once('=')
            .ok_or("expected name=value or name=low:high")?;
        let number = |text: &str| {
            let number = text.trim().parse::<f64>();
            number.map_err(|_| format!("{text}: not a number{}", rpm_value_hint(text)))
        };
        let (low, high) = values.split_once(':').unwrap_or((values, values));
        Ok(Self {
            key: key.trim().to_owned(),
            values: AllowedValues::Range([number(low)?, number(high)?]),
        })
    }
}

impl fmt::Display for VariedParameter {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.values {
            AllowedValues::Range([low, high]) if low == high => {
                write!(formatter, "{}={low}", self.key)
            }
            AllowedValues::Range([low, high]) => write!(formatter, "{}={low}:{high}", self.key),
            _ => formatter.write_str(&self.key),
        }
    }
}

/// `{ values = [5, 7, 9] }`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CatalogueTable {
    values: Vec<f64>,
}

impl AllowedValues {
    /// What a key's value says; none if it says nothing of values.
    fn read(key: &str, value: &Value) -> Result<Option<Self>, Failure> {
        let key = format!("vary.{key}");
        let range = || value.clone().try_into().ok().map(Self::Range);
        Ok(match value {
            Value::Table(words) if words.contains_key("values") => read_words::<CatalogueTable>(
                &key, words,
            )?
            .and_then(|CatalogueTable { mut values }| {
                values.sort_by(f64::total_cmp);
                values.dedup();
                (!values.is_empty()).then_some(Self::Catalogue(values))
            }),
            Value::Table(words) => read_words(&key, words)?.map(Self::Follows),
            Value::Array(_) => range(),
            value => number(value).map(|held| Self::Range([held, held])),
        })
    }
}

/// What `[vary]` holds: ranges first, then catalogues, in the file's order of keys.
pub(super) fn variables(table: &Table) -> Result<Vec<VariedParameter>, Failure> {
    let one = |(key, value): (String, &Value)| {
        if let Some(slopes) = slopes(&key) {
            return Err(Failure::usage(format!("vary.{slopes}")));
        }
        let Some(values) = AllowedValues::read(&key, value)? else {
            return Err(Failure::usage(format!(
                "vary.{key} = {value}: must be a range [low, high], a number to hold, {{ values = [a, b, c] }} of \
                 a catalogue, or {{ follows = KEY, factor = NUMBER }}; numbers alone, in the machine's own units{}",
                rpm_value_hint(&value.to_string())
            )));
        };
        Ok(VariedParameter { key, values })
    };
    let all: Result<Vec<VariedParameter>, Failure> = leaves(table).into_iter().map(one).collect();
    let mut all = all?;
    all.sort_by_key(|it| !matches!(it.values, AllowedValues::Range(_)));
    Ok(all)
}

/// The machine's own values of these keys, held: those that the search would choose.
pub(super) fn held<'a>(
    machine: &Machine,
    keys: impl Iterator<Item = &'a str>,
) -> Vec<VariedParameter> {
    let one = |key| {
        let parameter = machine.parameter(key).ok()?;
        let usual = USUAL.iter().any(|(usual, _)| *usual == parameter);
        let is_searched = usual || parameter == Parameter::Frequency;
        let value = machine.value(parameter).filter(|_| is_searched)?;
        Some(VariedParameter {
            key: machine.name(parameter).to_owned(),
            values: AllowedValues::Range([value, value]),
        })
    };
    keys.filter_map(one).collect()
}

/// What is searched, and what follows it, in the machine's own units.
#[derive(Debug)]
pub(super) struct SearchSpace {
    /// All but the drive's frequency.
    pub axes: Vec<Axis>,
    /// The drive's frequency.
    pub frequency: Interval,
    /// What follows.
    pub links: Vec<Link>,
}

/// What layers say of a machine. The first one that speaks of a parameter decides; it may do so only once. The usual
/// parameters are searched as well, if that is asked for and nothing else is said of them.
pub(super) fn searched(
    machine: &Machine,
    layers: &[Vec<VariedParameter>],
    with_usual: bool,
) -> Result<SearchSpace, Failure> {
    let (mut said, mut links) = (Vec::<Axis>::new(), Vec::<Link>::new());
    for layer in layers {
        let mut own = Vec::new();
        for variable in layer {
            let (parameter, unit) = free_parameter(machine, "vary", &variable.key)?;
            let axis = match &variable.values {
                AllowedValues::Follows(follow) => {
                    links.push(link(machine, (&variable.key, parameter, unit), follow)?);
                    continue;
                }
                AllowedValues::Range(ends) => {
                    let [low, high] = ends.map(|end| end * unit);
                    Axis::new(parameter, Interval { low, high })
                }
                AllowedValues::Catalogue(_) if parameter == Parameter::Frequency => {
                    let what = "can be a range or a value to hold, not a catalogue";
                    return Err(wrong(&variable.key, what));
                }
                AllowedValues::Catalogue(values) => {
                    Axis::of_catalogue(parameter, values.iter().map(|it| it * unit).collect())
                }
            };
            check_range(machine, &axis)?;
            if own.contains(&parameter) {
                return Err(wrong(
                    machine.name(parameter),
                    "only one value to hold or one range can be given",
                ));
            }
            own.push(parameter);
            if said.iter().all(|it| it.parameter != parameter) {
                said.push(axis);
            }
        }
    }
    let usual = USUAL.into_iter().filter(|_| with_usual);
    let mut axes: Vec<Axis> = usual
        .filter_map(|(it, range)| usual_axis(machine, it, range))
        .collect();
    // Without a bound the zone itself and the margin limit the frequency.
    let mut frequency = Interval::ANY;
    for axis in said {
        match axes.iter_mut().find(|it| it.parameter == axis.parameter) {
            _ if axis.parameter == Parameter::Frequency => frequency = axis.range,
            Some(known) => *known = axis,
            None => axes.push(axis),
        }
    }
    check_links(machine, &links, &axes)?;
    Ok(SearchSpace {
        axes,
        frequency,
        links,
    })
}

fn wrong(key: &str, what: &str) -> Failure {
    Failure::usage(format!("vary.{key}: {what}"))
}

/// Refuses an axis with an end that its parameter may not have, or whose ends are in the wrong order.
fn check_range(machine: &Machine, axis: &Axis) -> Result<(), Failure> {
    let Interval { low, high } = axis.range;
    let name = machine.name(axis.parameter);
    for value in [low, high] {
        let checked = axis.parameter.about().allowed.check(name, value);
        checked.map_err(|error| Failure::usage(format!("vary.{error}")))?;
    }
    match low > high {
        true => Err(Failure::usage(format!(
            "vary.{name} = {low}:{high}: low must be <= high"
        ))),
        false => Ok(()),
    }
}

/// A usual axis in the machine's own units; none if it has no such parameter, or one that follows others.
fn usual_axis(machine: &Machine, parameter: Parameter, ends: [f64; 2]) -> Option<Axis> {
    machine.value(parameter)?;
    if machine.expression(parameter).is_some() {
        return None;
    }
    let scene = &machine.scene;
    let unit = match parameter.about().dimension {
        Dimension::Stiffness => scene.stiffness,
        _ => scene.excitation.amplitude / scene.stiffness,
    };
    let [low, high] = ends.map(|end| end * unit);
    Some(Axis::new(parameter, Interval { low, high }))
}

/// The link of a parameter, with its key and the unit of that, to another one, in the machine's own units.
fn link(
    machine: &Machine,
    (key, parameter, unit): (&str, Parameter, f64),
    follow: &Follow,
) -> Result<Link, Failure> {
    let followed = machine.free_parameter(&follow.follows);
    let (follows, other) =
        followed.map_err(|error| wrong(&format!("{key}.follows"), &error.to_string()))?;
    if [parameter, follows].contains(&Parameter::Frequency) {
        let what = "the drive's frequency follows nothing, and nothing follows it: it is found along the zone";
        return Err(wrong(key, what));
    }
    if !(follow.factor.is_finite() && follow.offset.is_finite()) || parameter == follows {
        return Err(wrong(
            key,
            "must follow another parameter by a finite factor and offset",
        ));
    }
    Ok(Link {
        parameter,
        follows,
        factor: follow.factor * unit / other,
        offset: follow.offset * unit,
    })
}

fn check_links(machine: &Machine, links: &[Link], axes: &[Axis]) -> Result<(), Failure> {
    for (index, it) in links.iter().enumerate() {
        let is_same = |one: &Link| one.parameter == it.parameter;
        let name = machine.name(it.parameter);
        if links[..index].iter().any(is_same) || links.iter().any(|one| one.parameter == it.follows)
        {
            return Err(wrong(
                name,
                "must follow one parameter that follows no other",
            ));
        }
        if axes.iter().any(|axis| axis.parameter == it.parameter) {
            let what = "follows another parameter, and is searched or held as well; only one of the two can be given";
            return Err(wrong(name, what));
        }
    }
    Ok(())
}
