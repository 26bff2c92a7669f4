//! One machine and one region of starts along the hysteresis zone; the paper's claim, tested.

use crate::figure::Findings;
use anyhow::{Context, Result};
use softstop::Ratios;
use softstop_console::progress::Progress;
use softstop_dynamics::basin::{Establishing, Options, establishing};
use softstop_dynamics::watch::Kept;
use softstop_dynamics::{Axis, Grid, Regime, Zone, zone};
use std::f64::consts::TAU;

/// Which states are asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Starts {
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
pub struct Curve {
    zone: Zone,
    pub starts: Starts,
    pub places: Vec<Establishing>,
}

/// Radius of the largest ball inside the basin of z = 1, in units of half of the region; 0 if there is none.
pub fn integrity(at: &Establishing) -> f64 {
    let ball = at.basins.largest_ball_of(Regime::ONE);
    ball.map_or(0.0, |ball| ball.radius)
}

/// All motions at a place and their shares.
pub fn motions(at: &Establishing) -> String {
    let classes = at.basins.classes.iter();
    let motions = classes.map(|class| format!("{}: {:.6}", class.motion, class.share));
    motions.collect::<Vec<_>>().join(", ")
}

impl Curve {
    /// The certainty at places of the zone, each with so many cells on a side.
    pub fn new(
        machine: &Ratios,
        starts: Starts,
        (places, cells): (&[f64], usize),
        progress: &Progress,
        kept: Kept<'_>,
    ) -> Result<Self> {
        let rho = machine.clearance;
        let zone = zone::hysteresis(&machine.scene()?);
        let zone = zone.with_context(|| format!("no hysteresis zone at rho = {rho}"))?;
        let grid = starts.grid(rho, cells);
        let watcher = progress.watcher();
        let places = establishing(&zone, places, &grid, &Options::default(), &watcher, kept)?;
        Ok(Self {
            zone,
            starts,
            places,
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
}

/// Places of which the certainty is told.
const TOLD: [f64; 3] = [0.25, 0.5, 0.75];

/// Certainties at the ends and in between, and how far the claim is off.
pub fn findings(curves: &[Curve]) -> Findings {
    let mut findings = Findings::default();
    for curve in curves {
        let name = curve.name();
        let (first, last) = (curve.places.first(), curve.places.last());
        let certainty = |at: &Establishing| at.certainty;
        let values = [
            ("certainty near g0", first.map(certainty)),
            ("certainty near s_SN", last.map(certainty)),
            (
                "largest rise of the certainty away from g0",
                Some(rise(&curve.places)),
            ),
            ("integrity near g0", first.map(integrity)),
            ("integrity near s_SN", last.map(integrity)),
        ];
        findings.group(&format!("{name}: "), values);
        for place in TOLD {
            let found = nearest(&curve.places, place).map(certainty);
            findings.add(format!("{name}: certainty at s = {place}"), found);
        }
    }
    findings
}

fn nearest(places: &[Establishing], place: f64) -> Option<&Establishing> {
    let gap = |found: &&Establishing| (found.place - place).abs();
    places.iter().min_by(|a, b| gap(a).total_cmp(&gap(b)))
}

/// How much larger the certainty is somewhere than at a place nearer to g0, beyond both 95 % intervals: 0 if it
/// falls all the way, as the paper has it.
fn rise(places: &[Establishing]) -> f64 {
    let later = |(index, place): (usize, &Establishing)| {
        let rest = places[index + 1..].iter();
        let rises = rest.filter(|other| other.interval[0] > place.interval[1]);
        let rises = rises.map(|other| other.certainty - place.certainty);
        rises.fold(0.0, f64::max)
    };
    places.iter().enumerate().map(later).fold(0.0, f64::max)
}
