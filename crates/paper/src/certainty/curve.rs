//! One machine and one region of starts along the hysteresis zone.

use std::f64::consts::TAU;

use anyhow::{Context, Result};
use rayon::prelude::*;
use softstop::Ratios;
use softstop_dynamics::basin::{Axis, Establishing, Grid, Options, establishing};
use softstop_dynamics::orbit::Regime;
use softstop_dynamics::zone::{self, Zone};

use softstop_console::interrupt;
use softstop_console::progress::Progress;

/// Which states are asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Starts {
    /// Anywhere within the clearance on both sides, without velocity, at any drive angle.
    AtRest,
    /// At drive angle 0: positions and velocities up to so many clearances.
    Square(f64),
}

impl Starts {
    /// In the paper's symbols.
    pub fn label(self) -> String {
        match self {
            Self::AtRest => "|X| < ρ, X′ = 0, any φ".to_owned(),
            Self::Square(1.0) => "|X|, |X′| < ρ".to_owned(),
            Self::Square(half) => format!("|X|, |X′| < {half}ρ"),
        }
    }

    fn grid(self, clearance: f64, cells: usize) -> Grid {
        let axes = |half: f64| {
            let far = half * clearance;
            let up = Axis::velocity(-far, far, cells);
            (Axis::position(-far, far, cells), up)
        };
        let (across, up) = match self {
            Self::AtRest => (Axis::angle(0.0, TAU, cells), axes(1.0).0),
            Self::Square(half) => axes(half),
        };
        Grid::states(across, up, 0.0)
    }
}

/// The certainty along a zone.
pub(super) struct Curve {
    zone: Zone,
    pub starts: Starts,
    pub places: Vec<Place>,
}

/// The certainty at one place.
pub(super) struct Place {
    /// 0 at g0, 1 at s_SN.
    pub place: f64,
    /// eta.
    pub frequency: f64,
    pub certainty: f64,
    /// Wilson's 95 % interval of it.
    pub interval: [f64; 2],
    /// Radius of the largest ball inside the basin of z = 1, in units of half of the region; 0 if there is none.
    pub integrity: f64,
    /// All motions and their shares.
    pub motions: String,
}

impl Curve {
    pub fn new(machine: Ratios, clearance: f64, starts: Starts) -> Result<Self> {
        let machine = machine.at_clearance(clearance);
        let zone = zone::hysteresis(&machine.scene()?);
        Ok(Self {
            zone: zone.with_context(|| format!("no hysteresis zone at rho = {clearance}"))?,
            starts,
            places: Vec::new(),
        })
    }

    pub fn clearance(&self) -> f64 {
        self.zone.scene.clearance
    }

    /// Which of the paper's machines.
    pub fn machine(&self) -> &'static str {
        match self.zone.scene.piercing {
            Some(_) => "loaded",
            None => "unloaded",
        }
    }

    /// Which of them, at which clearance, with which starts.
    pub fn name(&self) -> String {
        let (machine, rho) = (self.machine(), self.clearance());
        format!("{machine}, rho = {rho}, starts {}", self.starts.label())
    }

    fn at(&self, place: f64, cells: usize, progress: &Progress) -> Result<Place> {
        let grid = self.starts.grid(self.clearance(), cells);
        let watcher = |_, _| {
            progress.beat();
            interrupt::go_on()
        };
        let found = establishing(&self.zone, &[place], &grid, &Options::default(), &watcher)?;
        progress.steps((cells * cells) as u64)?;
        let place = found.first().map(Place::new);
        place.context("no place")
    }
}

impl Place {
    fn new(found: &Establishing) -> Self {
        let classes = found.basins.classes.iter();
        let ball = found.basins.largest_ball_of(Regime::ONE);
        let motions = classes.map(|class| format!("{}: {:.6}", class.motion, class.share));
        Self {
            place: found.place,
            frequency: found.frequency,
            certainty: found.certainty,
            interval: found.interval,
            integrity: ball.map_or(0.0, |ball| ball.radius),
            motions: motions.collect::<Vec<_>>().join(", "),
        }
    }
}

/// Fills all curves, places side by side.
pub(super) fn fill(
    curves: &mut [Curve],
    places: &[f64],
    cells: usize,
    progress: &Progress,
) -> Result<()> {
    let tasks = (0..curves.len()).flat_map(|curve| places.iter().map(move |place| (curve, *place)));
    let tasks: Vec<(usize, f64)> = tasks.collect();
    let found = tasks
        .par_iter()
        .map(|(curve, place)| curves[*curve].at(*place, cells, progress));
    let found: Vec<Place> = found.collect::<Result<_>>()?;
    for ((curve, _), place) in tasks.into_iter().zip(found) {
        curves[curve].places.push(place);
    }
    Ok(())
}
