//! `softstop-lab paper`: the figures of the paper, and of what it only describes.
//!
//! To add a figure, write a module with a `pub(crate) const FIGURE: Figure`, and name it in [`Subject`].

mod basins;
mod certainty;
mod diagram;
mod exponents;
mod figure;
mod figure6;
mod figure7;
mod figure8;
mod figure9;
mod hardening;
mod regimes;
mod report;
mod supply;
mod table;
pub mod table1;

use std::path::PathBuf;
use std::time::Instant;

use clap::{Args, ValueEnum};

use figure::{Detail, Figure, Studio};
use report::{FigureReport, PaperReport};
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::output::{self, Folder, Format};

const EXAMPLES: &str = "\
Examples:
  softstop-lab paper                      all figures, into the folder softstop-paper
  softstop-lab paper 6a 8                 two of them
  softstop-lab paper regimes --draft      coarser, ten times as fast
  softstop-lab paper --format json        what was drawn, and the figures found, for programs

Figures of F. Peterka, Chaos, Solitons & Fractals 18 (2003) 79-88, computed anew:
  6a, 6b   bifurcation diagrams over six clearances, unloaded and loaded, up and down
  7a, 7b   points A and B: time series and phase trajectory, phases shaded
  8        the diagram of rho = 10 with its four zooms and the numbered bifurcations of Table 1
  9        the motions (A) to (L): time series, phase trajectory, Poincare points
  table1   its Table 1
and what it only describes:
  regimes     map of the regimes z = p/n over eta and rho
  exponents   the largest Lyapunov exponent under the diagram
  basins      which start leads to which motion
  certainty   how certainly z = 1 establishes itself, from g0 to s_SN
  supply      whether an interrupted supply of strips ends z = 1
  hardening   the transition of the stop's stiffness k2 from 0 to infinity

Pictures are SVG where they are curves and PNG where they are clouds or maps, with the data of
each beside it as CSV; files are written whole or not at all.";

/// Arguments of `softstop-lab paper`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct PaperArguments {
    /// Figures to draw [default: all]
    #[arg(value_enum, value_name = "FIGURE", hide_possible_values = true)]
    pub figures: Vec<Subject>,
    /// Coarser grids and shorter runs, ten times as fast
    #[arg(long)]
    pub draft: bool,
    /// Folder for the figures and paper.json
    #[arg(long, value_name = "DIR", default_value = "softstop-paper")]
    pub output: PathBuf,
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

/// What can be drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Subject {
    /// Bifurcation diagrams of the unloaded machine
    #[value(name = "6a")]
    Unloaded,
    /// Bifurcation diagrams of the loaded machine
    #[value(name = "6b")]
    Loaded,
    /// Point A
    #[value(name = "7a")]
    PointA,
    /// Point B
    #[value(name = "7b")]
    PointB,
    /// The diagram of rho = 10, its zooms and numbered bifurcations
    #[value(name = "8")]
    Diagram,
    /// The motions (A) to (L)
    #[value(name = "9")]
    Motions,
    /// Table 1
    #[value(name = "table1")]
    Table,
    /// Map of the regimes
    Regimes,
    /// Lyapunov exponent under the diagram
    Exponents,
    /// Basins of attraction
    Basins,
    /// Establishing certainty along the hysteresis zone
    Certainty,
    /// z = 1 under an interrupted supply of strips
    Supply,
    /// The stop's stiffness from 0 to infinity
    Hardening,
}

impl Subject {
    fn figure(self) -> &'static Figure {
        match self {
            Self::Unloaded => &figure6::UNLOADED,
            Self::Loaded => &figure6::LOADED,
            Self::PointA => &figure7::POINT_A,
            Self::PointB => &figure7::POINT_B,
            Self::Diagram => &figure8::FIGURE,
            Self::Motions => &figure9::FIGURE,
            Self::Table => &table::FIGURE,
            Self::Regimes => &regimes::FIGURE,
            Self::Exponents => &exponents::FIGURE,
            Self::Basins => &basins::FIGURE,
            Self::Certainty => &certainty::FIGURE,
            Self::Supply => &supply::FIGURE,
            Self::Hardening => &hardening::FIGURE,
        }
    }

    /// Its name on the command line.
    fn name(self) -> String {
        let value = self.to_possible_value();
        value.map_or_else(String::new, |value| value.get_name().to_owned())
    }
}

const REPORT: &str = "paper.json";

/// Draws the figures.
///
/// # Errors
/// [`Failure::Run`] if one cannot be computed or the folder cannot be written, [`Failure::Interrupted`]
/// after Ctrl-C.
pub fn run(arguments: &PaperArguments) -> Result<(), Failure> {
    let subjects = subjects(&arguments.figures);
    let studio = Studio::new(if arguments.draft {
        Detail::Draft
    } else {
        Detail::Full
    });
    let mut names: Vec<&str> = subjects
        .iter()
        .flat_map(|subject| subject.figure().files)
        .copied()
        .collect();
    names.push(REPORT);
    let folder = Folder::open(&arguments.output, &names)?;
    let begin = Instant::now();
    let mut figures = Vec::new();
    for subject in subjects {
        figures.push(draw(subject, &studio, &folder)?);
    }
    let report = PaperReport {
        figures,
        seconds: begin.elapsed().as_secs_f64(),
    };
    let json = output::json(&report)?;
    folder.stage(REPORT, json.as_bytes())?;
    folder.commit(&names)?;
    output::print(&match arguments.format {
        Format::Json => json,
        Format::Text => report.text(),
    })
}

/// Those asked for, each once; all if none is.
fn subjects(asked: &[Subject]) -> Vec<Subject> {
    let is_wanted = |subject: &Subject| asked.is_empty() || asked.contains(subject);
    let all = Subject::value_variants().iter().copied();
    all.filter(is_wanted).collect()
}

fn draw(subject: Subject, studio: &Studio, folder: &Folder) -> Result<FigureReport, Failure> {
    if interrupt::requested() {
        return Err(Failure::Interrupted);
    }
    let figure = subject.figure();
    let begin = Instant::now();
    let drawn = (figure.draw)(studio)?;
    for (name, content) in figure.files.iter().zip(&drawn.files) {
        folder.stage(name, content)?;
    }
    Ok(FigureReport {
        figure: subject.name(),
        title: figure.title,
        files: figure.files.iter().map(|name| folder.place(name)).collect(),
        findings: drawn.findings.into_iter().collect(),
        seconds: begin.elapsed().as_secs_f64(),
    })
}
