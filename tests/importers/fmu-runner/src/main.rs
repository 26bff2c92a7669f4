//! Runs softstop.fmu with the crate fmu-runner and prints outputs.
//!
//! Usage: `run-by-fmu-runner <fmu> <step size> <steps> [<name>=<value> ...]`

use std::collections::HashMap;
use std::env;
use std::error::Error;
use std::path::PathBuf;

use fmu_runner::{fmi2Type, Fmu, FmuInstance};

const REALS: [&str; 3] = ["position", "velocity", "impact.velocity"];
const COUNTS: [&str; 2] = ["impact.count", "pierce.count"];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [path, size, steps, values @ ..] = arguments.as_slice() else {
        return Err("usage: run-by-fmu-runner <fmu> <step size> <steps> [<name>=<value> ...]".into());
    };
    let library = Fmu::unpack(PathBuf::from(path))?.load(fmi2Type::fmi2CoSimulation)?;
    let unit = FmuInstance::instantiate(&library, false)?;
    let variables = library.variables();

    let mut settings = HashMap::new();
    for value in values {
        let (name, number) = value.split_once('=').ok_or("a value is <name>=<value>")?;
        settings.insert(&variables[name], number.parse()?);
    }
    unit.set_reals(&settings)?;
    unit.setup_experiment(0.0, None, None)?;
    unit.enter_initialization_mode()?;
    unit.exit_initialization_mode()?;
    let size: f64 = size.parse()?;
    for step in 0..steps.parse()? {
        unit.do_step(f64::from(step) * size, size, true)?;
    }

    for name in REALS {
        println!("{:?}", unit.get_reals(&[&variables[name]])?[&variables[name]]);
    }
    for name in COUNTS {
        println!("{}", unit.get_integers(&[&variables[name]])?[&variables[name]]);
    }
    Ok(())
}
