//! The machine on the command line: a file or the paper's, and changes of it.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::Args;
use softstop::{Language, Machine, Parameter};

use crate::failure::Failure;
use crate::machine::{Regime, SceneSettings};
use crate::scene_file::{read, read_toml};

/// Arguments of every command that looks at one machine.
#[derive(Debug, Clone, PartialEq, Default, Args)]
pub struct MachineArguments {
    /// Machine: a TOML file (softstop schema says what it may hold), or the paper's by its name,
    /// `unloaded` (also A, its point in Fig. 7) or `loaded` (B) [default: unloaded]
    #[arg(value_name = "MACHINE")]
    pub machine: Option<PathBuf>,
    /// Change a value of the machine, by its key in the file; repeatable
    #[arg(long, value_name = "KEY=VALUE", allow_hyphen_values = true)]
    pub set: Vec<Change>,
    /// The paper's machine in a TOML file, by the names of the ratios below; the command line has the
    /// last word
    #[arg(long, value_name = "FILE.toml", conflicts_with = "machine")]
    pub scene: Option<PathBuf>,
    /// Shorthands for the paper's machines.
    #[command(flatten)]
    pub ratios: SceneSettings,
}

/// `KEY=VALUE`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    key: String,
    value: String,
}

impl FromStr for Change {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.split_once('=') {
            Some((key, value)) if !key.trim().is_empty() => Ok(Self {
                key: key.trim().to_owned(),
                value: value.to_owned(),
            }),
            _ => Err("must be KEY=VALUE, as in stop.stiffness=8e6".to_owned()),
        }
    }
}

impl MachineArguments {
    /// The machine that they state.
    ///
    /// # Errors
    /// [`Failure::Usage`] naming the file, the key, its value and what is allowed.
    pub fn machine(&self) -> Result<Machine, Failure> {
        self.machine_over(&SceneSettings::default())
    }

    /// The same over ratios that stand in a task: the command line has the first word.
    ///
    /// # Errors
    /// As [`MachineArguments::machine`].
    pub fn machine_over(&self, below: &SceneSettings) -> Result<Machine, Failure> {
        let mut machine = match self.named()? {
            Some(regime) => {
                let machine = self.paper(regime, below)?;
                self.refuse_both(&machine)?;
                machine
            }
            None if *below == SceneSettings::default() => self.file()?,
            None => {
                return Err(Failure::usage(
                    "regime and scene of a task go with the paper's machines, not with a file",
                ));
            }
        };
        let changes = self.set.iter();
        machine
            .apply(changes.map(|change| (change.key.as_str(), change.value.as_str())))
            .map_err(|error| Failure::usage(format!("--set {error}")))?;
        Ok(machine)
    }

    /// Refuses a parameter of the machine that is given on the command line, and why.
    ///
    /// # Errors
    /// [`Failure::Usage`] naming it.
    pub fn refuse(
        &self,
        machine: &Machine,
        parameter: Parameter,
        why: &str,
    ) -> Result<(), Failure> {
        self.refuse_key(|key| machine.parameter(key) == Ok(parameter), why)
    }

    /// Refuses a start that is given on the command line, where it plays no part.
    ///
    /// # Errors
    /// [`Failure::Usage`] naming it.
    pub fn refuse_start(&self) -> Result<(), Failure> {
        let why = "the machine's own start plays no part";
        self.refuse_key(|key| of_start(key).is_some(), why)
    }

    /// Refuses a coordinate of the start, `position` or `velocity`, that is set although a flag of this name
    /// gives it.
    ///
    /// # Errors
    /// [`Failure::Usage`] naming both.
    pub fn refuse_start_beside(&self, flag: &str) -> Result<(), Failure> {
        let why = format!("goes not with --{flag}");
        self.refuse_key(|key| of_start(key) == Some(flag), &why)
    }

    /// Refuses a key that the command line states, and why.
    fn refuse_key(&self, is_refused: impl Fn(&str) -> bool, why: &str) -> Result<(), Failure> {
        match self.keys().iter().find(|key| is_refused(key)) {
            Some(key) => Err(Failure::usage(format!("{key}: {why}"))),
            None => Ok(()),
        }
    }

    /// Refuses a value that is given by a shorthand and by its key, or that a new stop would not have.
    fn refuse_both(&self, machine: &Machine) -> Result<(), Failure> {
        for (name, _) in self.ratios.given() {
            for Change { key, .. } in &self.set {
                let Ok(shorthand) = machine.parameter(name) else {
                    continue;
                };
                let is_lost = key == "stop.model" && shorthand.name().starts_with("stop.");
                if is_lost || machine.parameter(key) == Ok(shorthand) {
                    let flag = name.replace('_', "-");
                    return Err(Failure::usage(format!(
                        "--{flag} and --set {key}: only one of the two can be given"
                    )));
                }
            }
        }
        Ok(())
    }

    /// The paper's machine that is asked for; none if it is a file's.
    fn named(&self) -> Result<Option<Option<Regime>>, Failure> {
        let Some(path) = &self.machine else {
            return Ok(Some(None));
        };
        let named = Regime::called(path);
        match (named, self.ratios.regime) {
            (Some(named), Some(regime)) if named != regime => Err(Failure::usage(format!(
                "{}: goes not with --regime {}",
                path.display(),
                regime.name()
            ))),
            (named, _) => Ok(named.map(Some)),
        }
    }

    /// The parameter of this key that the machine has, and the key's unit in the machine's own
    /// ([`Machine::stated`]); `flag` asks for it.
    ///
    /// # Errors
    /// [`Failure::Usage`] naming the flag, and what the machine has instead.
    pub fn parameter(
        &self,
        machine: &Machine,
        flag: &str,
        name: &str,
    ) -> Result<(Parameter, f64), Failure> {
        let found = machine.stated(name);
        found.map_err(|error| Failure::usage(format!("--{flag} {name}: {error}")))
    }

    /// The keys that the command line states.
    pub fn keys(&self) -> Vec<String> {
        let given = self.ratios.given().into_iter().map(|(name, _)| name);
        let set = self.set.iter().map(|change| change.key.as_str());
        given.chain(set).map(str::to_owned).collect()
    }

    /// The paper's machine under its shorthands, over those of a task.
    fn paper(&self, regime: Option<Regime>, below: &SceneSettings) -> Result<Machine, Failure> {
        let mut layers = vec![self.ratios.clone()];
        if let Some(path) = &self.scene {
            layers.push(read_toml(path)?);
        }
        layers.push(below.clone());
        layers[0].regime = layers[0].regime.or(regime);
        paper(&layers)
    }

    /// The machine of the file.
    fn file(&self) -> Result<Machine, Failure> {
        let path = self.machine.as_deref().unwrap_or(Path::new(""));
        let key = |name| {
            let parameter = Machine::named(Regime::Loaded.name())?.parameter(name).ok();
            parameter.filter(|parameter| parameter.is_called(name))
        };
        let flag = match (self.ratios.regime, self.ratios.given().first()) {
            (Some(_), _) => Some(("regime", String::new())),
            (_, Some((name, value))) => {
                let key = key(name).map_or(*name, Parameter::name);
                Some((*name, format!("; say --set {key}={value}")))
            }
            _ => None,
        };
        if let Some((name, instead)) = flag {
            return Err(Failure::usage(format!(
                "--{} goes with the paper's machines, unloaded and loaded, not with {}{instead}",
                name.replace('_', "-"),
                path.display()
            )));
        }
        read(path)
    }
}

/// The coordinate of the start that a key sets.
fn of_start(key: &str) -> Option<&str> {
    key.strip_prefix("initial.").or(key.strip_prefix("start."))
}

/// The paper's machine with what layers say of it, the first one having the first word.
///
/// # Errors
/// [`Failure::Usage`] naming parameter, value and allowed range.
pub fn paper(layers: &[SceneSettings]) -> Result<Machine, Failure> {
    let regime = layers.iter().find_map(|layer| layer.regime);
    let regime = regime.unwrap_or(Regime::Unloaded);
    let mut given: Vec<(&str, String)> = Vec::new();
    for layer in layers {
        let above = given.len();
        for (name, value) in layer.given() {
            let kind = |name: &str| name.trim_end_matches("_deflection").to_owned();
            if regime == Regime::Unloaded && layer.is_of_strip(name) {
                return Err(Failure::usage(format!(
                    "{name} = {value}: the unloaded regime has no strip; allowed only with regime loaded"
                )));
            }
            let mut told = given[..above].iter();
            if !told.any(|(other, _)| kind(other) == kind(name)) {
                given.push((name, format!("{value:?}")));
            }
        }
    }
    let tells = |name| given.iter().any(|(other, _)| *other == name);
    if tells("preload") && tells("preload_deflection") {
        return Err(Failure::usage(
            "preload and preload_deflection: only one of the two can be given",
        ));
    }
    let machine = Machine::named(regime.name());
    let mut machine = machine.ok_or_else(|| Failure::usage("no such machine"))?;
    machine
        .apply(given.iter().map(|(name, value)| (*name, value.as_str())))
        .map_err(|error| Failure::usage(error.to_string()))?;
    Ok(machine)
}

/// The machine in a few words: its name, and the paper's ratios if it speaks them.
pub fn title(machine: &Machine) -> String {
    let name = machine.name.as_deref().unwrap_or("machine");
    if machine.speaks != Language::Ratios {
        return name.to_owned();
    }
    format!(
        "the {name} machine at η = {}, ρ = {}",
        machine.scene.excitation.frequency, machine.scene.clearance
    )
}
