//! The boundaries of the z = 1 motion: where it grazes first, doubles its period, and turns back.

use anyhow::{Context, Result};
use softstop::{Ratios, Scene};
use softstop_dynamics::continuation::{
    Along, Curve, CurvePoint, Follower, Limits, Parameter, Region, Special, SpecialKind, Test,
    curve,
};
use softstop_dynamics::zone::free_amplitude;

use super::Window;
use crate::regimes::chart::BoundaryCurve;
use softstop_console::failure::Failure;
use softstop_console::interrupt;

/// Points of g0.
const POINTS: usize = 400;
/// Most points of a branch or curve in each direction.
const MOST: usize = 400;
/// Steps along curves, in units of the parameters' scales, a fifth of their values.
const STEP: f64 = 0.08;
/// Least clearance of the curves: at 0 the scale of the motion changes.
const LEAST: f64 = 0.1;

/// The boundaries of one machine.
pub(super) struct Boundaries {
    /// eta and rho of the grazing of the motion without impacts.
    pub grazing: Vec<(f64, f64)>,
    /// Period doubling of z = 1.
    pub flips: Vec<Curve>,
    /// Folds of z = 1.
    pub folds: Vec<Curve>,
}

impl Boundaries {
    /// Those in a window: g0 in closed form, the others by continuation, located to 1e-10.
    pub fn of(machine: &Ratios, window: &Window) -> Result<Self> {
        let start = machine.frequency;
        let scene = machine.scene()?;
        let orbit =
            softstop_dynamics::orbit::find(&scene).context("no z = 1 motion to start from")?;
        let family = Along::new(scene.clone(), [Parameter::Frequency])?;
        let limits = Limits {
            range: window.eta,
            points: MOST,
        };
        let branch = Follower::new(&family, 1)
            .with_steps(STEP)
            .branch(start, orbit.state(), &limits, |_| interrupt::go_on())
            .context("the z = 1 motion cannot be followed")?;
        let of = |test| {
            let kind = SpecialKind::Critical(test);
            let own = branch.specials.iter();
            let own = own.filter(move |special| special.kind == kind);
            own.map(|special| follow(machine, window, special))
                .collect::<Result<Vec<Curve>>>()
        };
        let boundaries = Self {
            grazing: grazing(&scene, window),
            flips: of(Test::Flip)?,
            folds: of(Test::Fold)?,
        };
        if interrupt::requested() {
            return Err(Failure::Interrupted.into());
        }
        Ok(boundaries)
    }

    /// As lines of the map.
    pub fn curves(&self) -> Vec<BoundaryCurve> {
        let lines = |name: &'static str, curves: &[Curve]| -> Vec<BoundaryCurve> {
            let line = |curve: &Curve| BoundaryCurve {
                name,
                points: points(curve),
            };
            curves.iter().map(line).collect()
        };
        let grazing = BoundaryCurve {
            name: "g₀",
            points: self.grazing.clone(),
        };
        let mut all = vec![grazing];
        all.extend(lines("s_PD", &self.flips));
        all.extend(lines("s_SN", &self.folds));
        all
    }

    /// The point of s_SN with the hardest impact: the optimum clearance of the paper's section 3.
    pub fn hardest(&self) -> Option<&CurvePoint> {
        let all = self.folds.iter().flat_map(|curve| &curve.points);
        all.max_by(|a, b| hardest(a).total_cmp(&hardest(b)))
    }
}

/// The largest before-impact velocity of a point.
pub(super) fn hardest(point: &CurvePoint) -> f64 {
    point.impacts.iter().copied().fold(0.0, f64::max)
}

fn points(curve: &Curve) -> Vec<(f64, f64)> {
    curve
        .points
        .iter()
        .map(|point| point.parameters.into())
        .collect()
}

fn follow(machine: &Ratios, window: &Window, special: &Special) -> Result<Curve> {
    let parameters = [Parameter::Frequency, Parameter::Clearance];
    let family = Along::new(machine.scene()?, parameters)?;
    let region = Region {
        ranges: [window.eta, (window.rho.0.max(LEAST), window.rho.1)],
        points: MOST,
        step: STEP,
    };
    let at = [special.point.parameter, machine.clearance];
    let found = curve(
        &family,
        1,
        (special.kind, &special.point),
        at,
        &region,
        |_| interrupt::go_on(),
    );
    found.with_context(|| format!("no curve of the {}", special.kind.name()))
}

/// rho = the amplitude of the linear oscillator.
fn grazing(scene: &Scene, window: &Window) -> Vec<(f64, f64)> {
    let (from, to) = window.eta;
    let points = (0..=POINTS).map(|k| from + k as f64 / POINTS as f64 * (to - from));
    points
        .map(|eta| (eta, free_amplitude(scene, eta)))
        .collect()
}
