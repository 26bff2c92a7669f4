//! `softstop fmu`: a machine as an FMU, a library that this program holds with the machine's start values,
//! name and description.

use std::path::PathBuf;
use std::slice;

use anyhow::{Context, Result, ensure};
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use softstop::{Machine, Start};
use softstop_console::arguments::MachineArguments;
use softstop_console::failure::Failure;
use softstop_console::names::file_stem;
use softstop_console::output::{self, Folder};
use softstop_embed::c_library;
pub use softstop_fmu::Standard;
use softstop_fmu::package::{self, HOST_PLATFORM, Library};
use softstop_fmu::{Imprint, Options, StartValues, parameter_set};

/// Compiled along with this program, from the same engine.
static FMI2: &[u8] = c_library!(softstop_fmi2);
static FMI3: &[u8] = c_library!(softstop_fmi3);

/// The FMU's library for this machine.
///
/// # Errors
/// If this program was built without it.
pub fn library(standard: Standard) -> Result<Library> {
    let bytes = match standard {
        Standard::Fmi2 => FMI2,
        Standard::Fmi3 => FMI3,
    };
    ensure!(
        !bytes.is_empty(),
        "cannot make the FMU: this program holds no library for it: none was linked when it was built, as on systems without shared libraries"
    );
    Ok(Library {
        platform: HOST_PLATFORM.to_owned(),
        bytes: bytes.to_vec(),
    })
}

/// The bytes of the FMU that runs a machine (with m = 1 kg, k1 = 1 N/m, F0 = 1 N if it is stated in ratios) from a
/// state at time 0, under the machine's own name and description.
///
/// # Errors
/// If the FMU has no parameters for such a machine, or its name or description is too long.
pub fn archive(library: &Library, machine: &Machine, start: Start) -> Result<Vec<u8>> {
    packed(library, &imprint(machine, start)?)
}

fn packed(library: &Library, imprint: &Imprint) -> Result<Vec<u8>> {
    package::archive(imprint, slice::from_ref(library)).context("cannot make the FMU")
}

/// Its parameters as a parameter set of SSP 1.0 (SSV).
///
/// # Errors
/// As [`archive`].
pub fn parameters(machine: &Machine, start: Start) -> Result<String> {
    let set = parameter_set::write(&imprint(machine, start)?, |_| true);
    set.context("cannot make the parameter set")
}

fn imprint(machine: &Machine, start: Start) -> Result<Imprint> {
    let mut imprint = Imprint::from(StartValues::from_scene(&machine.scene, start)?);
    if let Some(name) = &machine.name {
        imprint = imprint.named(name)?;
    }
    if let Some(description) = &machine.description {
        imprint = imprint.described(description)?;
    }
    Ok(imprint)
}

const EXAMPLES: &str = "\
Examples:
  softstop fmu press.toml
      the machine of the file as press.fmu, under its name and in its units (SI)
  softstop fmu loaded --set excitation.frequency=1.2 --output b.fmu
      the paper's loaded machine, with m = 1 kg, k1 = 1 N/m, F0 = 1 N, at eta = 1.2
  softstop fmu press.toml --fmi 3
      the machine for FMI 3.0, where the importer sees every impact as an event

The FMU holds the library for this platform. It starts at the machine's
initial state at time 0; an importer may set parameters and inputs by the names in its modelDescription.xml.";

/// Arguments of `softstop fmu`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct FmuArguments {
    /// The machine.
    #[command(flatten)]
    pub machine: MachineArguments,
    /// File to write [default: NAME.fmu, by the machine's name]
    #[arg(long, value_name = "FILE.fmu")]
    pub output: Option<PathBuf>,
    /// Version of FMI
    #[arg(long, value_parser = version_parser(), value_name = "VERSION", default_value = "2")]
    pub fmi: Standard,
    /// Tell of model exchange by FMI 2.0, too, which some importers then choose; FMI 3.0 always does
    #[arg(long)]
    pub exchange: bool,
    /// Tell of the clock `impact` (FMI 3.0), which ticks at each impact
    #[arg(long)]
    pub impact_clock: bool,
    /// Tell of each array of parameters as one variable (FMI 3.0), not element by element
    #[arg(long)]
    pub arrays: bool,
}

/// The parser of a version of FMI, `2` or `3`.
pub fn version_parser() -> impl TypedValueParser<Value = Standard> {
    let two = PossibleValue::new("2").help("FMI 2.0");
    let three = PossibleValue::new("3").help("FMI 3.0");
    PossibleValuesParser::new([two, three]).map(|version| match &*version {
        "2" => Standard::Fmi2,
        _ => Standard::Fmi3,
    })
}

/// Packs the machine.
pub fn run(arguments: &FmuArguments) -> Result<(), Failure> {
    let machine = arguments.machine.machine()?;
    let name = machine.name.as_deref().unwrap_or("machine");
    let place = match &arguments.output {
        Some(place) => place.clone(),
        None => format!("{}.fmu", file_stem(name)).into(),
    };
    let of_three = [
        ("--impact-clock", arguments.impact_clock),
        ("--arrays", arguments.arrays),
    ];
    if arguments.fmi == Standard::Fmi2
        && let Some((option, _)) = of_three.iter().find(|(_, is_asked)| *is_asked)
    {
        return Err(Failure::usage(format!("{option} needs --fmi 3")));
    }
    let imprint = imprint(&machine, machine.start);
    let imprint = imprint.map_err(|error| Failure::usage(format!("{error:#}")))?;
    let imprint = imprint.with_standard(arguments.fmi).with_options(Options {
        exchange: arguments.exchange,
        clock: arguments.impact_clock,
        arrays: arguments.arrays,
    });
    let (folder, file) = output::folder_and_file(&place)?;
    let folder = Folder::of_file(folder, file)?;
    folder.stage(file, &packed(&library(imprint.standard())?, &imprint)?)?;
    folder.commit(&[file])?;
    output::print(&format!("Written: {}\n", place.display()))
}
