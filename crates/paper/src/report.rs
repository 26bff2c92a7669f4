//! What `softstop-lab paper` has drawn: figures, files and findings, as JSON and for people.

use std::path::PathBuf;

use serde::Serialize;

use crate::figure::Findings;
use softstop_console::table::heading;

/// All figures of a run.
#[derive(Debug, Serialize)]
pub(super) struct PaperReport {
    /// The figures.
    pub figures: Vec<FigureReport>,
    /// Time that all took, in s.
    pub seconds: f64,
}

/// One figure.
#[derive(Debug, Serialize)]
pub(super) struct FigureReport {
    /// Its name on the command line.
    pub figure: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// Its files.
    pub files: Vec<PathBuf>,
    /// What it shows in numbers.
    pub findings: Findings,
    /// Time that it took, in s.
    pub seconds: f64,
}

/// Figures up to which all numbers are printed, too.
const FEW: usize = 3;

impl PaperReport {
    /// What people read.
    pub(crate) fn text(&self) -> String {
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
