//! Older ways to state a machine, rewritten into the one form: a file or a built-in name, changed by `KEY=VALUE`.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use clap::Args;
use serde::{Deserialize, Serialize};
use softstop::{Machine, Parameter};

use crate::change::Change;
use crate::failure::Failure;
use crate::machine::Regime;
use crate::scene_file::read_toml;

/// Older flags of a machine.
#[derive(Debug, Clone, PartialEq, Default, Args)]
pub struct OlderFlags {
    /// The paper's machine in a TOML file, by the names of its ratios
    #[arg(
        long,
        value_name = "FILE.toml",
        conflicts_with = "machine",
        hide = true
    )]
    scene: Option<PathBuf>,
    /// The paper's machine by its ratios.
    #[command(flatten)]
    ratios: PaperRatios,
}

/// The paper's machine by its ratios, lengths in units of F0/k1, forces of F0, stiffnesses of k1: as flags, and as a
/// table of TOML.
#[derive(Debug, Clone, PartialEq, Default, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
#[command(allow_negative_numbers = true)]
pub struct PaperRatios {
    /// Without or with a strip to pierce
    #[arg(long, value_enum, hide = true)]
    pub regime: Option<Regime>,
    /// Drive frequency eta
    #[arg(long, hide = true)]
    frequency: Option<f64>,
    /// Clearance rho
    #[arg(long, hide = true)]
    clearance: Option<f64>,
    /// Stiffness k4/k1 of the stop
    #[arg(long, hide = true)]
    stiffness: Option<f64>,
    /// Preload of the stop as a force
    #[arg(long, hide = true, conflicts_with = "preload_deflection")]
    preload: Option<f64>,
    /// Preload of the stop as a deflection
    #[arg(long, hide = true)]
    #[serde(alias = "preload-deflection")]
    preload_deflection: Option<f64>,
    /// Damping beta1 of the free flight
    #[arg(long, hide = true)]
    damping: Option<f64>,
    /// Damping beta in contact
    #[arg(long, hide = true)]
    #[serde(alias = "contact-damping")]
    contact_damping: Option<f64>,
    /// Stiffness k2/k1 of the strip
    #[arg(long, hide = true)]
    #[serde(alias = "piercing-stiffness")]
    piercing_stiffness: Option<f64>,
    /// Dry friction k3/k1 of the strip
    #[arg(long, hide = true)]
    #[serde(alias = "piercing-friction")]
    piercing_friction: Option<f64>,
    /// Thickness sigma of the strip
    #[arg(long, hide = true)]
    thickness: Option<f64>,
    /// Travel nu from the strip to the stop
    #[arg(long, hide = true)]
    travel: Option<f64>,
}

impl PaperRatios {
    /// The values that are given, each by its older name and as a change of the machine.
    fn given(&self) -> Vec<(String, Change)> {
        let given = toml::Table::try_from(self).unwrap_or_default().into_iter();
        let given = given.filter(|(name, _)| name != "regime");
        given
            .map(|(name, value)| {
                let change = Change::new(&key(&name), &value.to_string());
                (name, change)
            })
            .collect()
    }

    /// The values that are given, as changes of the machine.
    pub fn changes(&self) -> Vec<Change> {
        self.given().into_iter().map(|(_, change)| change).collect()
    }
}

/// The key of a machine's file for the older name of a ratio.
fn key(name: &str) -> String {
    if name == "preload_deflection" {
        return "stop.preload_deflection".to_owned();
    }
    let loaded = Machine::named(Regime::Loaded.name());
    let parameter = loaded.and_then(|machine| machine.parameter(name).ok());
    let key = parameter.map(Parameter::name);
    key.unwrap_or(name).to_owned()
}

/// A machine in the one form.
#[derive(Debug, Default)]
pub(crate) struct Statement {
    /// A file or a built-in name; none if nothing is said.
    pub machine: Option<PathBuf>,
    /// Changes of a file of ratios, below those of the command line.
    pub below: Vec<Change>,
    /// Changes.
    pub set: Vec<Change>,
}

impl OlderFlags {
    /// The keys that older flags stand for.
    pub(crate) fn changes(&self) -> Vec<Change> {
        self.ratios.changes()
    }

    /// The flags and what stands beside them in the one form; says once what to write instead.
    ///
    /// # Errors
    /// [`Failure::Usage`] if flags contradict what stands beside them.
    pub(crate) fn rewrite(
        &self,
        machine: Option<&Path>,
        set: &[Change],
    ) -> Result<Statement, Failure> {
        let regime = self.ratios.regime;
        let given = self.ratios.given();
        if let Some(path) = machine {
            self.refuse_beside(path, &given)?;
        }
        refuse_both(&given, set)?;
        let file = self.scene.as_deref().map(read_toml::<PaperRatios>);
        let file = file.transpose()?;
        let regime = regime.or(file.as_ref().and_then(|file| file.regime));
        let named = machine.map(Path::to_owned);
        self.say_what_to_write(&given);
        Ok(Statement {
            machine: named.or(regime.map(|regime| regime.name().into())),
            below: file.map_or_else(Vec::new, |file| file.changes()),
            set: self.changes().into_iter().chain(set.to_vec()).collect(),
        })
    }

    /// Refuses flags of the paper's machines beside another machine.
    fn refuse_beside(&self, path: &Path, given: &[(String, Change)]) -> Result<(), Failure> {
        let place = path.display();
        let flag = match (Regime::called(path), self.ratios.regime, given.first()) {
            (Some(named), Some(regime), _) if named != regime => {
                let regime = regime.name();
                let message = format!("{place}: goes not with --regime {regime}");
                return Err(Failure::usage(message));
            }
            (None, Some(_), _) => ("regime", String::new()),
            (None, None, Some((name, change))) => (&**name, format!("; say --set {change}")),
            _ => return Ok(()),
        };
        let (flag, instead) = (flag.0.replace('_', "-"), flag.1);
        Err(Failure::usage(format!(
            "--{flag} goes with the paper's machines, unloaded and loaded, not with {place}{instead}"
        )))
    }

    fn say_what_to_write(&self, given: &[(String, Change)]) {
        let mut old: Vec<String> = Vec::new();
        let mut new: Vec<String> = Vec::new();
        if let Some(file) = &self.scene {
            old.push(format!("--scene {}", file.display()));
            new.push("a MACHINE with a table [ratios]".to_owned());
        }
        if let Some(regime) = self.ratios.regime {
            old.push(format!("--regime {}", regime.name()));
            new.push(regime.name().to_owned());
        }
        for (name, change) in given {
            old.push(format!("--{} {}", name.replace('_', "-"), change.value()));
            new.push(format!("--set {change}"));
        }
        say_once(&old.join(" "), &new.join(" "));
    }
}

/// Refuses a value that is given by a flag and by its key, or that a new stop would not have.
fn refuse_both(given: &[(String, Change)], set: &[Change]) -> Result<(), Failure> {
    let Some(machine) = Machine::named(Regime::Loaded.name()) else {
        return Ok(());
    };
    let parameter = |change: &Change| machine.parameter(change.key()).ok();
    for (name, change) in given {
        let is_same = |other: &&Change| {
            parameter(other).is_some() && parameter(other) == parameter(change)
                || other.key() == "stop.model" && change.key().starts_with("stop.")
        };
        if let Some(other) = set.iter().find(is_same) {
            let (flag, key) = (name.replace('_', "-"), other.key());
            let message = format!("--{flag} and --set {key}: only one of the two can be given");
            return Err(Failure::usage(message));
        }
    }
    Ok(())
}

static SAID: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// Says on the standard error, once, what to write instead of older words; nothing if there are none.
pub fn say_once(old: &str, new: &str) {
    let mut said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
    if !old.is_empty() && !said.iter().any(|other| other == old) {
        said.push(old.to_owned());
        crate::say(&format!(
            "note: instead of {old} write {new}; the older words go with version 0.3\n"
        ));
    }
}
