//! The boundaries of the z = 1 motion: where it grazes first, doubles its period, and turns back.

use anyhow::{Context, Result};
use softstop::{Parameter, Ratios};
use softstop_dynamics::continuation::{Curve, CurvePoint, Region, SpecialKind, Test};
use softstop_dynamics::orbit::find;
use softstop_dynamics::zone::free_amplitude;
use softstop_dynamics::{Along, Follower, Limits};

use super::Window;
use crate::curves;
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
        let scene = machine.scene()?;
        let orbit = find(&scene).context("no z = 1 motion to start from")?;
        let family = Along::new(scene.clone(), [Parameter::Frequency])?;
        let limits = Limits {
            range: window.eta,
            points: MOST,
        };
        let branch = Follower::new(&family, 1).with_steps(STEP).branch(
            machine.frequency,
            orbit.state(),
            &limits,
            |_| interrupt::go_on(),
        );
        let branch = branch.context("the z = 1 motion cannot be followed")?;
        let region = Region {
            ranges: [window.eta, (window.rho.0.max(LEAST), window.rho.1)],
            points: MOST,
            step: STEP,
        };
        let of = |test| {
            let kind = SpecialKind::Critical(test);
            let points = branch.critical(test);
            let found = points.map(|point| curves::critical(machine, (kind, point), &region));
            found.collect::<Result<Vec<Curve>>>()
        };
        let (from, to) = window.eta;
        let etas = (0..=POINTS).map(|k| from + k as f64 / POINTS as f64 * (to - from));
        let boundaries = Self {
            grazing: etas.map(|eta| (eta, free_amplitude(&scene, eta))).collect(),
            flips: of(Test::Flip)?,
            folds: of(Test::Fold)?,
        };
        if interrupt::requested() {
            return Err(Failure::Interrupted.into());
        }
        Ok(boundaries)
    }

    /// As lines of the map, with the paper's names.
    pub fn lines(&self) -> Vec<(&'static str, Vec<(f64, f64)>)> {
        let points = |curve: &Curve| curve.points.iter().map(|at| at.parameters.into()).collect();
        let mut lines = vec![("g₀", self.grazing.clone())];
        lines.extend(self.flips.iter().map(|curve| ("s_PD", points(curve))));
        lines.extend(self.folds.iter().map(|curve| ("s_SN", points(curve))));
        lines
    }

    /// The point of s_SN with the hardest impact: the optimum clearance of the paper's section 3.
    pub fn hardest(&self) -> Option<&CurvePoint> {
        let all = self.folds.iter().flat_map(|curve| &curve.points);
        let velocity = CurvePoint::before_impact_velocity;
        all.max_by(|a, b| velocity(a).total_cmp(&velocity(b)))
    }
}
