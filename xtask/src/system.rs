//! `piercing-machine.ssp`: drive, feeder and press, connected, with the parameters of three machines.

use std::f64::consts::TAU;
use std::path::Path;

use anyhow::{Context, Result};
use softstop::internals::samples::{LOADED, MachineSample, UNLOADED};
use softstop::{InitialConditions, Machine, Scene, Simulation, Start};
use softstop_fmi::package::{self, Library};
use softstop_fmi::variable::Kind;
use softstop_fmi::{Imprint, Row, Standard, Unit, parameter_set};
use softstop_fmu::StartValues;
use softstop_units::{Drive, Feeder};

const STRUCTURE: &str = include_str!("../assets/SystemStructure.ssd");
const DESIGN: &str = include_str!("../../docs/system/design.toml");

/// Torque at rest of the motor in N m.
const TORQUE: f64 = 60.0;

/// One machine: its name, and its units as they begin.
struct Variant {
    name: &'static str,
    press: Imprint<softstop_fmu::Machine>,
    drive: Imprint<Drive>,
}

/// Writes the system, by SSP 1.0 with units for FMI 2.0 and by SSP 2.0 with those for FMI 3.0; the units inside begin as the
/// machine B. Libraries are those of drive, feeder and press.
pub fn write(path: &Path, standard: Standard, libraries: [&[Library]; 3]) -> Result<()> {
    let sample =
        |of: &MachineSample| anyhow::Ok((of.ratios.scene()?, Start::new(of.position, of.velocity)));
    let design = Machine::from_toml(DESIGN)?;
    let variants = [
        variant("B", sample(&LOADED)?)?,
        variant("A", sample(&UNLOADED)?)?,
        variant("design", (design.scene, design.start))?,
    ];
    let [Variant { press, drive, .. }, ..] = &variants;
    let feeder = with(Imprint::<Feeder>::library(), &[("feed.takes.angle", 1.0)])?;
    let version = match standard {
        Standard::Fmi2 => "machine\" version=\"1.0\"",
        Standard::Fmi3 => "machine\" version=\"2.0\"",
    };
    let structure = STRUCTURE.replace("machine\" version=\"1.0\"", version);
    let press = press.clone().named("press")?;
    let mut entries = vec![
        ("SystemStructure.ssd".to_owned(), structure.into_bytes()),
        unit("press", standard, &press, libraries[2])?,
        unit("drive", standard, drive, libraries[0])?,
        unit("feeder", standard, &feeder, libraries[1])?,
    ];
    entries.extend(sets(&variants, "press", |of| &of.press)?);
    entries.extend(sets(&variants, "drive", |of| &of.drive)?);
    package::write_file(path, &package::zipped(entries)?)?;
    Ok(())
}

/// A unit of the system, with its place there.
fn unit<U: Unit>(
    name: &str,
    standard: Standard,
    imprint: &Imprint<U>,
    libraries: &[Library],
) -> Result<(String, Vec<u8>)> {
    let imprint = imprint.clone().with_standard(standard);
    let archive = package::archive(&imprint, libraries)?;
    Ok((format!("resources/{name}.fmu"), archive))
}

/// A machine on a motor whose torque is, at the speed of the motion, what this motion takes.
fn variant(name: &'static str, (scene, start): (Scene, Start)) -> Result<Variant> {
    let speed = scene.excitation.frequency;
    let mut run = Simulation::new(&scene, InitialConditions::from(start))?;
    run.advance(TAU / speed)?;
    let taken = run.energy().supplied / TAU;
    let values = StartValues::from_scene(&scene, start)?;
    let takes = [("drive.takes.speed", 1.0), ("drive.takes.amplitude", 1.0)];
    let motor = [
        ("motor.torque", TORQUE),
        ("motor.speed", speed / (1.0 - taken / TORQUE)),
        ("unbalance", scene.excitation.amplitude / (speed * speed)),
        ("initial.speed", speed),
        ("initial.angle", scene.excitation.phase),
    ];
    Ok(Variant {
        name,
        press: with(values.into(), &takes)?,
        drive: with(Imprint::library(), &motor)?,
    })
}

/// An imprint with other values of some parameters.
fn with<U: Unit>(imprint: Imprint<U>, changes: &[(&str, f64)]) -> Result<Imprint<U>> {
    let mut values = imprint.values().to_vec();
    for &(name, value) in changes {
        let row = U::about().table.by_name(name);
        let slot = row
            .and_then(Row::<U>::slot)
            .with_context(|| name.to_owned())?;
        values[slot.0] = value;
    }
    Ok(Imprint::new(&values))
}

/// The parameters in which the machines differ, a set for each machine.
fn sets<U: Unit>(
    variants: &[Variant],
    unit: &str,
    of: impl Fn(&Variant) -> &Imprint<U>,
) -> Result<Vec<(String, Vec<u8>)>> {
    let differs = |row: &Row<U>| {
        let value = |of: &Imprint<U>| row.slot().map(|slot| of.values()[slot.0]);
        let first = value(of(&variants[0]));
        matches!(row.kind, Kind::Real(_)) && variants.iter().any(|other| value(of(other)) != first)
    };
    variants
        .iter()
        .map(|variant| {
            let imprint = of(variant).clone().named(variant.name)?;
            let text = parameter_set::write(&imprint, differs)?;
            Ok((
                format!("resources/{}-{unit}.ssv", variant.name),
                text.into_bytes(),
            ))
        })
        .collect()
}
