//! `softstop stops`: the zoo of stops as force-deflection pictures.

pub mod loops;
pub mod stroke;
pub mod zoo;

use std::path::PathBuf;

use anyhow::Context;
use clap::Args;

use crate::stops::loops::Loops;
use softstop_console::failure::Failure;
use softstop_console::output::{self, Folder};
use stroke::Stroke;
use zoo::{Exhibit, Specimen, ZOO};

const EXAMPLES: &str = "\
Examples:
  softstop stops
      contact force over deflection of every law, in and out, into softstop-stops
  softstop stops --output docs/stops
      the pictures of docs/stops.md

Each picture is a simulated stroke: a mass of 1 kg on its suspension meets the stop at the
speed that the picture states and is thrown back; there is no drive. The machines are those of
docs/scenes, which `softstop simulate` runs. The files are written whole or not at all.";

/// Arguments of `softstop stops`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct StopsArguments {
    /// Folder for the pictures
    #[arg(long, value_name = "DIR", default_value = "softstop-stops")]
    pub output: PathBuf,
}

/// Draws the zoo.
///
/// # Errors
/// [`Failure::Run`] if the folder cannot be written, [`Failure::Interrupted`] after Ctrl-C.
pub fn run(arguments: &StopsArguments) -> Result<(), Failure> {
    let names: Vec<String> = ZOO
        .iter()
        .map(|exhibit| format!("{}.svg", exhibit.name))
        .collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let folder = Folder::open(&arguments.output, &names)?;
    for (exhibit, name) in ZOO.iter().zip(&names) {
        folder.stage(name, picture(exhibit)?.as_bytes())?;
    }
    let places: Vec<String> = names
        .iter()
        .map(|name| format!("Written: {}\n", folder.place(name).display()))
        .collect();
    folder.commit(&names)?;
    output::print(&places.concat())
}

/// Free flight before the first touch and after the last that is drawn, over the depth.
const LEAD: f64 = 0.12;

/// One picture as an SVG document.
///
/// # Errors
/// [`Failure`] if one of its scenes cannot be read or run.
pub fn picture(exhibit: &Exhibit) -> Result<String, Failure> {
    let strokes = exhibit
        .laws
        .iter()
        .map(|law| Ok((law.label, stroke(exhibit, law)?)))
        .collect::<Result<Vec<_>, Failure>>()?;
    let subtitle = format!("full stroke of 1 kg, first touch at {} m/s", exhibit.speed);
    Ok(Loops::new(exhibit.title, &subtitle, &strokes).svg())
}

/// The stroke of one law, with free flight in proportion to its depth.
fn stroke(exhibit: &Exhibit, law: &Specimen) -> Result<Stroke, Failure> {
    let scene = law.scene()?;
    let stroke = |lead| {
        Stroke::new(&scene, exhibit.speed, lead, exhibit.damped)
            .with_context(|| format!("cannot simulate the stroke of {}", law.label))
    };
    let depth = stroke(1.0)?.depth();
    Ok(stroke(LEAD * if depth > 0.0 { depth } else { 1.0 })?)
}
