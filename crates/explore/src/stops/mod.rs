//! `softstop stops`: the zoo of stops as force-deflection pictures.

pub mod loops;
pub mod stroke;
pub mod zoo;

use std::path::PathBuf;

use anyhow::Context;
use clap::Args;
use softstop::Scene;

use softstop_console::column::{Column, Units};
use softstop_console::columns;
use softstop_console::export::Export;
use softstop_console::failure::Failure;
use softstop_console::output::Format;
use softstop_console::record::{Record, below};
use stroke::ContactStroke;
use zoo::{StopPicture, ZOO};

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
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

/// What is told of a picture.
fn columns() -> [Column<StopPicture>; 3] {
    columns! { StopPicture, it;
        "name" [None] Plain, "its file, without ending" => it.name;
        "title" [None] Plain, "what it shows" => it.title;
        "velocity" [Velocity] Plain, "at the first touch" => it.speed;
    }
}

/// Draws the zoo.
pub fn run(arguments: &StopsArguments) -> Result<(), Failure> {
    let files = ZOO.map(|it| (format!("{}_svg", it.name), format!("{}.svg", it.name)));
    let files = files.each_ref();
    let files = files.map(|(kind, file)| (kind.as_str(), file.as_str()));
    let export = Export::open(&arguments.output, &files)?;
    for (exhibit, (kind, _)) in ZOO.iter().zip(&files) {
        export.file(kind, picture(exhibit)?.as_bytes())?;
    }
    let pictures = Record::all(&columns(), &ZOO);
    let text = below(&pictures, &Units::SI);
    let result = Record::default().hidden("pictures", pictures);
    export.finish(&result, text, arguments.format)
}

/// Free flight before the first touch and after the last that is drawn, over the depth.
const LEAD: f64 = 0.12;

/// One picture as an SVG document.
///
/// # Errors
/// [`Failure`] if one of its scenes cannot be read or run.
pub fn picture(exhibit: &StopPicture) -> Result<String, Failure> {
    let stroke = |law: &(&'static str, &str)| Ok((law.0, stroke(exhibit, *law)?));
    let strokes = exhibit.laws.iter().map(stroke);
    let strokes = strokes.collect::<Result<Vec<_>, Failure>>()?;
    let subtitle = format!("full stroke of 1 kg, first touch at {} m/s", exhibit.speed);
    Ok(loops::svg(exhibit.title, &subtitle, &strokes))
}

/// The stroke of one law, with free flight in proportion to its depth.
fn stroke(exhibit: &StopPicture, (label, scene): (&str, &str)) -> Result<ContactStroke, Failure> {
    let scene = Scene::from_toml(scene);
    let scene = scene.map_err(|error| Failure::usage(format!("{label}: {error}")))?;
    let stroke = |lead| {
        ContactStroke::new(&scene, exhibit.speed, lead, exhibit.damped)
            .with_context(|| format!("cannot simulate the stroke of {label}"))
    };
    let depth = stroke(1.0)?.depth();
    Ok(stroke(LEAD * if depth > 0.0 { depth } else { 1.0 })?)
}
