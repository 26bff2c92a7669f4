//! How a machine may be run up: what `require.run_up = { ... }` says besides bounds.

use serde::Deserialize;
use softstop::internals::with_near_word;
use softstop::{Dimension, Machine, Parameter, Stop};
use softstop_console::failure::Failure;
use softstop_dynamics::run_up::{RunUpSettings, Way};
use toml::Value;
use toml::de::Error;

use crate::design::conflict::format_in_own_unit;
use crate::design::requirement::Scope;

/// Drive periods in which a ramp could change the frequency by as much as that of the machine, at most.
const MAX_RAMP_PERIODS: f64 = 1e5;

/// `{ least = 10, most = 12, at = "drawing" }`.
#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Bounds {
    pub least: Option<f64>,
    pub most: Option<f64>,
    pub at: Option<Scope>,
}

/// `run_up = { ways = ["frequency_raised"], ramp_rate = 0.2 }`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RunUpTable {
    ways: Option<Vec<Way>>,
    ramp_rate: Option<f64>,
    force: Option<f64>,
    least: Option<f64>,
    most: Option<f64>,
    at: Option<Scope>,
}

/// How a machine may be run up, and in how many ways it must be possible, if a table says so: one if that names none. A ramp's
/// rate is a change of the frequency each drive period.
pub(super) fn ways(
    machine: &Machine,
    value: Option<&Value>,
) -> Result<(RunUpSettings, Option<Bounds>), Failure> {
    let usual = RunUpSettings::default();
    let Some(Value::Table(words)) = value else {
        return Ok((usual, None));
    };
    let usage = |what: &str| Failure::usage(format!("require.run_up{what}"));
    let words: RunUpTable = words
        .clone()
        .try_into()
        .map_err(|error: Error| usage(&format!(": {}", with_near_word(error.message()))))?;
    let positive = |key: &str, value: Option<f64>, dimension| {
        let Some(value) = value else { return Ok(None) };
        match value > 0.0 && value.is_finite() {
            true => Ok(Some(machine.to_si(dimension, value))),
            false => Err(usage(&format!(".{key} = {value}: must be positive"))),
        }
    };
    let ways = words.ways.unwrap_or(usual.ways);
    if ways.is_empty() {
        return Err(usage(".ways: must name a way"));
    }
    if let Some(twice) = (1..ways.len()).find(|index| ways[..*index].contains(&ways[*index])) {
        return Err(usage(&format!(
            ".ways: {} is given twice",
            ways[twice].name()
        )));
    }
    // A way changes one parameter of a motion's machine, of which only what follows the frequency is known there.
    for way in &ways {
        let Some(parameter) = way.changed_parameter() else {
            continue;
        };
        let (key, way) = (machine.name(parameter), way.name());
        if machine.expression(parameter).is_some() {
            return Err(usage(&format!(".ways: {way}: {key} follows others")));
        }
        let followers = machine.followers(parameter);
        if let (Some(follower), true) = (followers.first(), parameter != Parameter::Frequency) {
            let follower = machine.name(*follower);
            return Err(usage(&format!(".ways: {way}: {follower} follows {key}")));
        }
    }
    let (ramp, most_force) = (
        positive("ramp_rate", words.ramp_rate, Dimension::Frequency)?,
        positive("force", words.force, Dimension::Force)?,
    );
    let slowest = machine.scene.excitation.frequency / MAX_RAMP_PERIODS;
    if let Some(rate) = ramp.filter(|rate| *rate < slowest) {
        let own = |rate| format_in_own_unit(machine, Dimension::Frequency, rate);
        return Err(usage(&format!(
            ".ramp_rate = {}: must be at least {}, a part in {MAX_RAMP_PERIODS} of the machine's frequency",
            own(rate),
            own(slowest)
        )));
    }
    if most_force.is_some() && matches!(machine.scene.stop, Stop::None | Stop::Rigid { .. }) {
        return Err(usage(".force: this machine has no soft stop (stop.model)"));
    }
    let bounds = Bounds {
        least: words.least.or(words.most.is_none().then_some(1.0)),
        most: words.most,
        at: words.at,
    };
    let settings = RunUpSettings {
        ways,
        ramp,
        most_force,
        with_peaks: false,
    };
    Ok((settings, Some(bounds)))
}
