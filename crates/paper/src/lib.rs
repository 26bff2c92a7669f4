//! `softstop-lab paper`: the figures of the paper, and of what it only describes.
//!
//! `docs/paper/figures.toml` states title, files, what is computed and the layout of the picture of each figure. To add one,
//! write its table there, and a function `draw` that makes its files, named in `FIGURES`.

mod basins;
mod boundaries;
mod certainty;
mod diagram;
mod exponents;
mod figure;
mod figure6;
mod figure7;
mod figure8;
mod figure9;
mod hardening;
mod laminar;
mod path;
mod regimes;
mod supply;
pub mod table1;
pub mod transitions;
mod ways;

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use clap::builder::PossibleValuesParser;

use figure::{Detail, Draw, Drawn, Figure, Findings, Studio};
use serde::Serialize;
use softstop_console::export;
use softstop_console::failure::{Failure, check_interrupt};
use softstop_console::keep::{Keep, KeepArguments};
use softstop_console::output::{self, Folder, Format};
use softstop_console::table::heading;
use softstop_dynamics::monitor::recall_or_compute;

const EXAMPLES: &str = "\
Examples:
  softstop-lab paper                      all figures, into the folder softstop-paper
  softstop-lab paper 6a 8                 two of them
  softstop-lab paper regimes --draft      coarser, ten times as fast
  softstop-lab paper --resume             goes on after Ctrl-C or a kill
  softstop-lab paper --format json        what was drawn, and the figures found, for programs

Pictures are SVG where they are curves and PNG where they are clouds or maps, with the data of
each beside it as CSV; files are written whole or not at all.";

/// The examples, and the figures by their names.
fn help() -> String {
    let figures = FIGURES.iter().filter_map(|it| Figure::called(it.0).ok());
    let lines = figures.map(|it| format!("\n  {:<11} {}", it.name, it.title));
    let head = "\n\nFigures of F. Peterka, Chaos, Solitons & Fractals 18 (2003) 79-88, and of what it only describes:";
    EXAMPLES.to_owned() + head + &lines.collect::<String>()
}

/// Arguments of `softstop-lab paper`.
#[derive(Debug, Args)]
#[command(after_help = help())]
pub struct PaperArguments {
    /// Figures to draw [default: all]
    #[arg(value_parser = PossibleValuesParser::new(FIGURES.iter().map(|it| it.0)), value_name = "FIGURE")]
    #[arg(hide_possible_values = true)]
    pub figures: Vec<String>,
    /// Coarser grids and shorter runs, ten times as fast
    #[arg(long)]
    pub draft: bool,
    /// Whether it goes on with an earlier one.
    #[command(flatten)]
    pub keep: KeepArguments,
    /// Folder for the figures and paper.json
    #[arg(long, value_name = "DIR", default_value = "softstop-paper")]
    pub output: PathBuf,
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

/// The figures by their names on the command line, each with its code.
static FIGURES: &[(&str, Draw)] = &[
    ("6a", figure6::draw),
    ("6b", figure6::draw),
    ("7a", figure7::draw),
    ("7b", figure7::draw),
    ("7", figure7::both),
    ("8", figure8::draw),
    ("9", figure9::draw),
    ("table1", table1::figure::draw),
    ("regimes", regimes::draw),
    ("exponents", exponents::draw),
    ("basins", basins::draw),
    ("certainty", certainty::draw),
    ("supply", supply::draw),
    ("hardening", hardening::draw),
    ("ways", ways::draw),
    ("laminar", laminar::draw),
];

const REPORT: &str = "paper.json";

/// Draws the figures.
///
/// # Errors
/// [`Failure::Run`] if one cannot be computed or the folder cannot be written, [`Failure::Interrupted`]
/// after Ctrl-C.
pub fn run(arguments: &PaperArguments) -> Result<(), Failure> {
    let asked = &arguments.figures;
    let is_wanted = |name: &str| asked.is_empty() || asked.iter().any(|it| it == name);
    let wanted = FIGURES.iter().filter(|(name, _)| is_wanted(name));
    let wanted = wanted.map(|(name, draw)| Ok((Figure::called(name)?, *draw)));
    let wanted = wanted.collect::<anyhow::Result<Vec<(&Figure, Draw)>>>()?;
    let files = wanted.iter().flat_map(|(figure, _)| &figure.files);
    let mut names: Vec<&str> = files.map(String::as_str).collect();
    names.push(REPORT);
    let folder = Folder::open(&arguments.output, &names)?;
    let detail = match arguments.draft {
        true => Detail::Draft,
        false => Detail::Full,
    };
    let of = (&names, detail);
    let keep = Keep::open(&arguments.output, "paper", &of, arguments.keep)?;
    let studio = Studio::new(detail, Some(&keep));
    let begin = Instant::now();
    let mut figures = Vec::new();
    for (figure, draw) in wanted {
        figures.push(make(figure, draw, &studio, &folder)?);
    }
    let report = PaperReport {
        figures,
        seconds: begin.elapsed().as_secs_f64(),
    };
    folder.stage(REPORT, output::json(&report)?.as_bytes())?;
    folder.commit(&names)?;
    keep.forget();
    export::print(&report, report.text(), arguments.format)
}

fn make(
    figure: &'static Figure,
    draw: Draw,
    studio: &Studio,
    folder: &Folder,
) -> Result<FigureReport, Failure> {
    check_interrupt()?;
    let begin = Instant::now();
    let (drawn, seconds): (Drawn, f64) = recall_or_compute(studio.kept, &figure.name, || {
        let drawn = draw(studio, figure)?;
        Ok::<_, anyhow::Error>((drawn, begin.elapsed().as_secs_f64()))
    })?;
    for (name, content) in figure.files.iter().zip(&drawn.files) {
        folder.stage(name, content)?;
    }
    Ok(FigureReport {
        figure: &figure.name,
        title: &figure.title,
        files: figure.files.iter().map(|name| folder.place(name)).collect(),
        findings: drawn.findings,
        seconds,
    })
}

/// All figures of a run.
#[derive(Debug, Serialize)]
struct PaperReport {
    /// The figures.
    figures: Vec<FigureReport>,
    /// Time that all took, in s.
    seconds: f64,
}

/// One figure.
#[derive(Debug, Serialize)]
struct FigureReport {
    /// Its name on the command line.
    figure: &'static str,
    /// What it shows.
    title: &'static str,
    /// Its files.
    files: Vec<PathBuf>,
    /// What it shows in numbers.
    findings: Findings,
    /// Time that it took, in s.
    seconds: f64,
}

/// Figures up to which all numbers are printed, too.
const FEW: usize = 3;

impl PaperReport {
    /// What people read.
    fn text(&self) -> String {
        let mut text = heading("Figures of Peterka 2003, computed anew");
        for figure in &self.figures {
            text += &format!(
                "\n{:<10}  {}  ({:.1} s)\n",
                figure.figure, figure.title, figure.seconds
            );
            for file in &figure.files {
                text += &format!("{:12}{}\n", "", file.display());
            }
            if self.figures.len() <= FEW {
                for (name, value) in &figure.findings.0 {
                    text += &format!("{:12}{name:<28} {value}\n", "");
                }
            }
        }
        if self.figures.len() > FEW {
            text += "\nThe numbers that they show are in paper.json.\n";
        }
        text += &format!("\n{:.1} s\n", self.seconds);
        text
    }
}
