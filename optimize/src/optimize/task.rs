//! The task as command line and TOML file state it together, checked.

use std::path::PathBuf;
use std::str::FromStr;

use super::OptimizeArguments;
use super::configuration::Task;
use crate::design::Problem;
use crate::design::search::{LEAST_EVALUATIONS, Settings};
use crate::design::space::Interval;
use softstop_console::failure::Failure;
use softstop_console::machine::{Machine, SceneSettings, finite, not_negative, positive, require};
use softstop_console::output::Format;
use softstop_console::scene_file;

const MARGIN: f64 = 0.25;
const STIFFNESS: Interval = Interval {
    low: 1.0,
    high: 30.0,
};
const CLEARANCE: Interval = Interval {
    low: 2.0,
    high: 22.0,
};
/// No bound: the zone itself and the margin limit the frequency.
const FREQUENCY: Interval = Interval {
    low: f64::MIN_POSITIVE,
    high: f64::INFINITY,
};
const EVALUATIONS: u64 = 1200;
const OUTPUT: &str = "softstop-design";

/// The quantities that are searched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    Stiffness,
    Clearance,
    Frequency,
}

impl Quantity {
    const ALL: [Self; 3] = [Self::Stiffness, Self::Clearance, Self::Frequency];

    const fn name(self) -> &'static str {
        match self {
            Self::Stiffness => "stiffness",
            Self::Clearance => "clearance",
            Self::Frequency => "frequency",
        }
    }

    fn check(self, value: f64) -> Result<(), Failure> {
        match self {
            Self::Stiffness => not_negative(self.name(), value),
            Self::Clearance => finite(self.name(), value),
            Self::Frequency => positive(self.name(), value),
        }
    }
}

/// A quantity and what is said of it, as `name=…` on the command line.
#[derive(Debug, Clone, Copy)]
pub struct Named<T> {
    quantity: Quantity,
    value: T,
}

impl FromStr for Named<f64> {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (quantity, value) = named(text, "value")?;
        Ok(Self {
            quantity,
            value: number(value)?,
        })
    }
}

impl FromStr for Named<[f64; 2]> {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (quantity, range) = named(text, "low:high")?;
        let (low, high) = range
            .split_once(':')
            .ok_or_else(|| format!("{range}: a range is low:high, such as 2:22"))?;
        Ok(Self {
            quantity,
            value: [number(low)?, number(high)?],
        })
    }
}

fn named<'text>(text: &'text str, what: &str) -> Result<(Quantity, &'text str), String> {
    let (name, value) = text
        .split_once('=')
        .ok_or_else(|| format!("expected name={what}"))?;
    let quantity = Quantity::ALL
        .into_iter()
        .find(|quantity| quantity.name() == name.trim());
    match quantity {
        Some(quantity) => Ok((quantity, value)),
        None => Err(format!(
            "unknown name {name}: must be stiffness, clearance or frequency"
        )),
    }
}

fn number(text: &str) -> Result<f64, String> {
    text.trim()
        .parse()
        .map_err(|_| format!("{text}: not a number"))
}

/// All that a run needs to know.
#[derive(Debug)]
pub(super) struct Job {
    pub problem: Problem,
    pub settings: Settings,
    pub output: PathBuf,
    pub format: Format,
}

impl Job {
    /// Joins command line, file and defaults.
    pub(super) fn new(arguments: &OptimizeArguments) -> Result<Self, Failure> {
        let task: Task = match &arguments.config {
            Some(path) => scene_file::read_toml(path)?,
            None => Task::default(),
        };
        let scene = scene(&task)?;
        let machine = Machine::from_layers(&[&arguments.machine, &scene])?;
        let words = [spoken(arguments), written(&task)];
        let interval = |quantity, default| interval(&words, quantity, default);
        let margin = arguments.margin.or(task.margin).unwrap_or(MARGIN);
        require(
            (0.0..=0.5).contains(&margin),
            "margin",
            margin,
            "in [0, 0.5]",
        )?;
        let evaluations = arguments
            .evaluations
            .or(task.evaluations)
            .unwrap_or(EVALUATIONS);
        if evaluations < LEAST_EVALUATIONS {
            let message = format!("evaluations = {evaluations}: must be >= {LEAST_EVALUATIONS}");
            return Err(Failure::usage(message));
        }
        Ok(Self {
            problem: Problem {
                machine,
                margin,
                stiffness: interval(Quantity::Stiffness, STIFFNESS)?,
                clearance: interval(Quantity::Clearance, CLEARANCE)?,
                frequency: interval(Quantity::Frequency, FREQUENCY)?,
            },
            settings: Settings {
                seed: arguments.seed.or(task.seed).unwrap_or(0),
                evaluations,
            },
            output: arguments
                .output
                .clone()
                .or(task.output)
                .unwrap_or_else(|| OUTPUT.into()),
            format: arguments.format.or(task.format).unwrap_or_default(),
        })
    }
}

/// The file's machine; its regime may stand at the top or in `[scene]`.
fn scene(task: &Task) -> Result<SceneSettings, Failure> {
    let mut scene = task.scene.clone();
    if task.regime.is_some() && scene.regime.is_some() {
        return Err(Failure::usage(
            "regime and scene.regime: only one of the two can be given",
        ));
    }
    scene.regime = task.regime.or(scene.regime);
    Ok(scene)
}

/// What one layer says about the searched quantities.
type Words = Vec<Named<[f64; 2]>>;

fn spoken(arguments: &OptimizeArguments) -> Words {
    let mut words = arguments.bounds.clone();
    words.extend(
        arguments
            .fix
            .iter()
            .map(|word| held(word.quantity, word.value)),
    );
    words.extend(scene_words(&arguments.machine));
    words
}

fn written(task: &Task) -> Words {
    let (fix, bounds) = (&task.fix, &task.bounds);
    let fixed = [
        (Quantity::Stiffness, fix.stiffness),
        (Quantity::Clearance, fix.clearance),
        (Quantity::Frequency, fix.frequency),
    ];
    let ranges = [
        (Quantity::Stiffness, bounds.stiffness),
        (Quantity::Clearance, bounds.clearance),
        (Quantity::Frequency, bounds.frequency),
    ];
    let fixed = fixed
        .into_iter()
        .filter_map(|(quantity, value)| Some(held(quantity, value?)));
    let ranges = ranges.into_iter().filter_map(|(quantity, value)| {
        Some(Named {
            quantity,
            value: value?,
        })
    });
    fixed
        .chain(ranges)
        .chain(scene_words(&task.scene))
        .collect()
}

fn scene_words(scene: &SceneSettings) -> impl Iterator<Item = Named<[f64; 2]>> {
    [
        (Quantity::Stiffness, scene.stiffness),
        (Quantity::Clearance, scene.clearance),
        (Quantity::Frequency, scene.frequency),
    ]
    .into_iter()
    .filter_map(|(quantity, value)| Some(held(quantity, value?)))
}

const fn held(quantity: Quantity, value: f64) -> Named<[f64; 2]> {
    Named {
        quantity,
        value: [value, value],
    }
}

/// The first layer that speaks of a quantity decides; it may do so only once.
fn interval(layers: &[Words], quantity: Quantity, default: Interval) -> Result<Interval, Failure> {
    for words in layers {
        let mut words = words.iter().filter(|word| word.quantity == quantity);
        let Some(word) = words.next() else { continue };
        if words.next().is_some() {
            let name = quantity.name();
            let message = format!("{name}: only one value to hold or one range can be given");
            return Err(Failure::usage(message));
        }
        let [low, high] = word.value;
        quantity.check(low)?;
        quantity.check(high)?;
        if low > high {
            let name = quantity.name();
            let message = format!("bounds {name} = {low}:{high}: low must be <= high");
            return Err(Failure::usage(message));
        }
        return Ok(Interval { low, high });
    }
    Ok(default)
}
