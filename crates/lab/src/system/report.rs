//! What the studies found, for people and for programs.

use serde::Serialize;
use softstop_console::column::{self, Column, Units};
use softstop_console::columns;
use softstop_console::export::Report;

use super::coupled::Coupling;
use super::order::{self, Error};
use super::run_up::{Plateau, RunUp};
use super::strips::{Chance, DRIVES, Fate, Run, Strips};

/// The table of runs of strips that fail.
pub(super) fn runs() -> [Column<Run>; 6] {
    columns! { Run, it;
        "drive" [None], "" => it.drive;
        "frequency (rad/s)" [None], "" => it.frequency;
        "missing strips" [None], "" => it.missing;
        "drive angle (deg)" [None], "" => it.angle;
        "missed" [None], "" => it.missed;
        "fate" [None], "" => it.fate.name();
    }
}

/// The table of runs from rest.
pub(super) fn run_ups() -> [Column<RunUp>; 5] {
    columns! { RunUp, it;
        "torque (N m)" [None], "" => it.torque;
        "rise (s)" [None], "" => it.rise;
        "speed (rad/s)" [None], "" => it.speed;
        "impacts per turn" [None], "" => it.impacts;
        "end" [None], "" => it.end.name();
    }
}

/// The table of errors.
pub(super) fn errors() -> [Column<Error>; 4] {
    columns! { Error, it;
        "coupling" [None], "" => it.coupling.name();
        "step (s)" [None], "" => it.step;
        "error of the speed (rad/s)" [None], "" => it.speed;
        "error of the last impact (s)" [None], "" => it.impact;
    }
}

/// Strips that fail.
#[derive(Serialize)]
pub(super) struct StripsReport {
    drives: Vec<OfDrive>,
    runs: Vec<Run>,
    chances: Vec<Chance>,
}

/// The runs on one drive.
#[derive(Serialize)]
struct OfDrive {
    drive: &'static str,
    runs: usize,
    kept: usize,
    back: usize,
    lost: usize,
}

impl StripsReport {
    pub fn new(strips: Strips) -> Self {
        let of_drive = |(drive, _): (&'static str, _)| {
            let own = strips.runs.iter().filter(|it| it.drive == drive);
            let count = |fate| own.clone().filter(|it| it.fate == fate).count();
            OfDrive {
                drive,
                runs: own.clone().count(),
                kept: count(Fate::Kept),
                back: count(Fate::Back),
                lost: count(Fate::Lost),
            }
        };
        Self {
            drives: DRIVES.map(of_drive).into(),
            runs: strips.runs,
            chances: strips.chances,
        }
    }
}

impl Report for StripsReport {
    fn text(&self) -> String {
        let drives = columns! { OfDrive, it;
            "drive" [None] Plain, "" => it.drive;
            "runs" [None] Plain, "" => it.runs;
            "no stroke missed" [None] Plain, "" => it.kept;
            "strokes missed, z = 1 again" [None] Plain, "" => it.back;
            "z = 1 lost" [None] Plain, "" => it.lost;
        };
        let chances = columns! { Chance, it;
            "drive" [None] Plain, "" => it.drive;
            "frequency (rad/s)" [None] Fixed(4), "" => it.frequency;
            "probability of a strip" [None] Fixed(3), "" => it.probability;
            "strokes missed" [None] Percent(2), "" => it.missed;
        };
        let drives = column::text(&drives, &self.drives, &Units::SI);
        let chances = column::text(&chances, &self.chances, &Units::SI);
        format!("{drives}\n{chances}")
    }
}

/// Running up.
#[derive(Serialize)]
pub(super) struct RunUpReport {
    pub run_ups: Vec<RunUp>,
    pub plateaus: Vec<Plateau>,
}

impl Report for RunUpReport {
    fn text(&self) -> String {
        let run_ups = columns! { RunUp, it;
            "torque at rest (N m)" [None] Fixed(2), "" => it.torque;
            "rise of the voltage (s)" [None] Fixed(1), "" => it.rise;
            "speed (rad/s)" [None] Fixed(4), "" => it.speed;
            "impacts per turn" [None] Fixed(3), "" => it.impacts;
            "end" [None] Plain, "" => it.end.name();
        };
        let plateaus = columns! { Plateau, it;
            "voltage" [None] Fixed(4), "" => it.voltage;
            "way" [None] Plain, "" => if it.up { "up" } else { "down" };
            "speed (rad/s)" [None] Fixed(4), "" => it.speed;
            "impacts per turn" [None] Fixed(3), "" => it.impacts;
        };
        let run_ups = column::text(&run_ups, &self.run_ups, &Units::SI);
        let plateaus = column::text(&plateaus, &self.plateaus, &Units::SI);
        format!("{run_ups}\n{plateaus}")
    }
}

/// Error over step.
#[derive(Serialize)]
pub(super) struct OrderReport {
    pub orders: Vec<(Coupling, f64)>,
    pub errors: Vec<Error>,
}

impl OrderReport {
    pub fn new(errors: Vec<Error>) -> Self {
        let order = |coupling| (coupling, order::order(&errors, coupling));
        Self {
            orders: order::COUPLINGS.map(order).into(),
            errors,
        }
    }
}

impl Report for OrderReport {
    fn text(&self) -> String {
        let errors = columns! { Error, it;
            "coupling" [None] Plain, "" => it.coupling.name();
            "step (s)" [None] Plain, "" => it.step;
            "error of the speed (rad/s)" [None] Power(1), "" => it.speed;
            "error of the last impact (s)" [None] Power(1), "" => it.impact;
        };
        let orders = columns! { (Coupling, f64), it;
            "coupling" [None] Plain, "" => it.0.name();
            "order seen" [None] Fixed(2), "" => it.1;
        };
        let errors = column::text(&errors, &self.errors, &Units::SI);
        let orders = column::text(&orders, &self.orders, &Units::SI);
        format!("{errors}\n{orders}")
    }
}
