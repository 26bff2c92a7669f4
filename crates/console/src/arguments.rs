//! The machine on the command line: a file or the paper's, and changes of it; its title, and what commands refuse of it.

use std::path::PathBuf;

use clap::Args;
use softstop::{Machine, Parameter, Scene, Stop, UnitSystem};

use crate::budget::BudgetArguments;
use crate::change::Change;
use crate::failure::Failure;
use crate::machine::PaperMachine;
use crate::output::Format;
use crate::scene_file::read;

/// What commands that compute something of one machine have in common.
#[derive(Debug, Args)]
pub struct CommandArguments {
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
    /// The machine.
    #[command(flatten)]
    pub machine: MachineArguments,
    /// What it may cost.
    #[command(flatten)]
    pub limit: BudgetArguments,
}

impl CommandArguments {
    /// The machine of a command in which the machine's own start plays no part.
    ///
    /// # Errors
    /// [`Failure::Usage`] naming what is wrong, or a start that is given.
    pub fn machine_without_start(&self) -> Result<Machine, Failure> {
        self.machine.refuse_start()?;
        self.machine.machine()
    }
}

/// Arguments of every command that looks at one machine: a file or a built-in name, changed by `KEY=VALUE`.
#[derive(Debug, Clone, PartialEq, Default, Args)]
pub struct MachineArguments {
    /// Machine: a TOML file (softstop schema says what it may hold), or the paper's by its name,
    /// `unloaded` (also A, its point in Fig. 7) or `loaded` (B) [default: unloaded]
    #[arg(value_name = "MACHINE")]
    pub machine: Option<PathBuf>,
    /// Change a value of the machine, by its key in the file; repeatable
    #[arg(long, value_name = "KEY=VALUE", allow_hyphen_values = true)]
    pub set: Vec<Change>,
}

impl MachineArguments {
    /// The machine that they state.
    ///
    /// # Errors
    /// [`Failure::Usage`] naming the file, the key, its value and what is allowed.
    pub fn machine(&self) -> Result<Machine, Failure> {
        self.machine_over(None, &[])
    }

    /// The machine that they state over what a task says of it: the command line has the last word.
    ///
    /// # Errors
    /// As [`MachineArguments::machine`].
    pub fn machine_over(
        &self,
        machine: Option<PathBuf>,
        below: &[Change],
    ) -> Result<Machine, Failure> {
        let named = self.machine.clone().or(machine);
        let named = named.unwrap_or_else(|| PaperMachine::Unloaded.name().into());
        let regime = PaperMachine::called(&named);
        let mut machine = match regime.and_then(|regime| Machine::named(regime.name())) {
            Some(machine) => machine,
            None => read(&named)?,
        };
        for (word, changes) in [("set", below), ("--set", &self.set)] {
            let of_strip = changes.iter().find(|it| it.key().starts_with("piercing."));
            if let (Some(PaperMachine::Unloaded), Some(change)) = (regime, of_strip) {
                return Err(Failure::usage(format!(
                    "{} = {}: the unloaded machine has no strip; the machine called loaded has one",
                    change.key(),
                    change.value()
                )));
            }
            let changes = changes.iter();
            machine
                .apply(changes.map(|change| (change.key(), change.value())))
                .map_err(|error| Failure::usage(format!("{word} {error}")))?;
        }
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
        match self.keys().find(|key| is_refused(key)) {
            Some(key) => Err(Failure::usage(format!("{key}: {why}"))),
            None => Ok(()),
        }
    }

    /// The parameter of this key that the machine has, and the key's unit in the machine's own
    /// ([`Machine::stated`]); `flag` asks for it. `eta` is the drive's frequency in units of the machine's own sqrt(k1/m).
    ///
    /// # Errors
    /// [`Failure::Usage`] naming the flag, and what the machine has instead.
    pub fn parameter(
        &self,
        machine: &Machine,
        flag: &str,
        name: &str,
    ) -> Result<(Parameter, f64), Failure> {
        let refused = |error| Failure::usage(format!("--{flag} {name}: {error}"));
        let own = (machine.scene.stiffness / machine.scene.mass).sqrt();
        if name != "eta" || machine.unit_system == UnitSystem::Ratios {
            return machine.free_parameter(name).map_err(refused);
        }
        if own == 0.0 {
            let what = "is in units of sqrt(k1/m), but stiffness = 0";
            return Err(Failure::usage(format!(
                "--{flag} {name}: {what}; say excitation.frequency"
            )));
        }
        let key = Parameter::Frequency.name();
        let (frequency, _) = machine.free_parameter(key).map_err(refused)?;
        let followers = machine.followers(frequency);
        if [Parameter::Mass, Parameter::Suspension]
            .iter()
            .any(|it| followers.contains(it))
        {
            let what = format!("its unit sqrt(k1/m) follows {key} here; say {key}");
            return Err(Failure::usage(format!("--{flag} {name}: {what}")));
        }
        Ok((frequency, machine.to_own(frequency.about().dimension, own)))
    }

    /// The keys that the command line states.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.set.iter().map(Change::key)
    }
}

/// What is said of a machine without a stop.
pub const WITHOUT_STOP: &str =
    "stop.model = \"none\": the machine has no stop, so no motion of it has an impact";

/// True if anything stands in the way of the mass.
pub fn has_stop(scene: &Scene) -> bool {
    scene.stop != Stop::None || scene.piercing.is_some() || scene.wall().is_some()
}

/// Refuses a machine with a stop below, where it is not known what that does.
///
/// # Errors
/// [`Failure::Usage`] naming the stop.
pub fn refuse_stop_below(machine: &Machine) -> Result<(), Failure> {
    match machine.scene.below {
        Some(_) => Err(Failure::usage(
            "stop.below: this is computed of machines with stops on one side",
        )),
        None => Ok(()),
    }
}

/// Refuses a machine of which no zone is looked for: with a stop below, or whose drive's frequency follows others.
///
/// # Errors
/// [`Failure::Usage`] naming the stop, or the frequency and its expression.
pub fn refuse_without_zone(machine: &Machine) -> Result<(), Failure> {
    refuse_stop_below(machine)?;
    let free = machine.free_parameter(machine.name(Parameter::Frequency));
    free.map(|_| ())
        .map_err(|error| Failure::usage(error.to_string()))
}

/// Refuses a machine of which no zone is looked for, or of which something follows the drive's frequency, where all else stays.
///
/// # Errors
/// [`Failure::Usage`] naming what follows.
pub fn refuse_followers_of_frequency(machine: &Machine) -> Result<(), Failure> {
    refuse_without_zone(machine)?;
    let frequency = Parameter::Frequency;
    let Some(follower) = machine.followers(frequency).first().copied() else {
        return Ok(());
    };
    let name = machine.name(follower);
    Err(Failure::usage(format!(
        "{name}: follows the drive's frequency, which is looked for here while all else stays; state {name} as a number, or \
         use sweep, continue or study"
    )))
}

/// The coordinate of the start that a key sets.
fn of_start(key: &str) -> Option<&str> {
    key.strip_prefix("initial.").or(key.strip_prefix("start."))
}

/// The machine in a few words: its name, and the paper's ratios if it is stated in them.
pub fn title(machine: &Machine) -> String {
    let eta = machine.scene.excitation.frequency;
    title_at(machine, |rho| format!(" at η = {eta}, ρ = {rho}"))
}

/// The machine in a few words where its drive has many frequencies.
pub fn title_over_frequency(machine: &Machine) -> String {
    title_at(machine, |rho| format!(", ρ = {rho}"))
}

fn title_at(machine: &Machine, ratios: impl FnOnce(f64) -> String) -> String {
    let name = machine.name.as_deref().unwrap_or("machine");
    match machine.unit_system {
        UnitSystem::Ratios => format!("the {name} machine{}", ratios(machine.scene.clearance)),
        _ => name.to_owned(),
    }
}
