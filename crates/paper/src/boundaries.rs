//! The boundaries of the z = 1 motion over frequency and clearance: where it grazes first, doubles its period, and turns
//! back.

use anyhow::{Context, Result};
use softstop::{Parameter, Ratios, Scene};
use softstop_dynamics::continuation::{
    Branch, ContinuationSettings, Curve, CurveLimits, CurvePoint, SpecialKind, TestFunction,
    follow_special,
};
use softstop_dynamics::orbit::find;
use softstop_dynamics::zone::free_amplitude;
use softstop_dynamics::{Continuation, Limits, ParameterFamily};

use softstop_console::failure::Failure;
use softstop_console::interrupt;

/// The paper's range of eta, and clearances up to the resonance peak of the free motion, 25.005; at 0 the scale of the
/// motion changes.
const RANGES: [(f64, f64); 2] = [(0.8, 1.8), (0.1, 24.0)];
/// Points of g0.
const POINTS: usize = 400;
/// Most points of a branch or curve in each direction.
const MOST: usize = 400;
/// Steps along curves, in units of the parameters' scales, a fifth of their values.
const STEP: f64 = 0.08;

/// The boundaries of one machine.
pub(super) struct Boundaries {
    /// eta and rho of the grazing of the motion without impacts.
    pub(super) grazing: Vec<(f64, f64)>,
    /// Those of z = 1: the paper's name, the number where there are several, and the curve.
    pub(super) curves: Vec<(&'static str, usize, Curve)>,
}

impl Boundaries {
    /// Those of a machine: g0 in closed form, the others by continuation, located to 1e-10.
    pub(super) fn of(machine: &Ratios) -> Result<Self> {
        let [eta, _] = RANGES;
        let scene = machine.scene()?;
        let branch = branch(scene.clone(), eta, MOST, STEP)?;
        let plane = [Parameter::Frequency, Parameter::Clearance];
        let plane = ParameterFamily::new(scene.clone(), plane)?;
        let region = CurveLimits {
            ranges: RANGES,
            points: MOST,
            settings: ContinuationSettings::of_curves(STEP),
        };
        let mut curves = Vec::new();
        for (name, test) in [("s_PD", TestFunction::Flip), ("s_SN", TestFunction::Fold)] {
            let special = SpecialKind::Critical(test);
            for (number, point) in branch.critical_points(test).enumerate() {
                let at = [point.parameter, machine.clearance];
                let found =
                    follow_special(&plane, 1, (special, point.state()), at, &region, |_| {
                        interrupt::go_on()
                    });
                let found = found.with_context(|| format!("no curve of the {}", special.name()))?;
                curves.push((name, number, found));
            }
        }
        let etas = (0..=POINTS).map(|k| eta.0 + k as f64 / POINTS as f64 * (eta.1 - eta.0));
        let boundaries = Self {
            grazing: etas.map(|eta| (eta, free_amplitude(&scene, eta))).collect(),
            curves,
        };
        if interrupt::requested() {
            return Err(Failure::Interrupted.into());
        }
        Ok(boundaries)
    }

    /// The point of s_SN with the hardest impact: the optimum clearance of the paper's section 3.
    pub(super) fn hardest(&self) -> Option<&CurvePoint> {
        let folds = self.curves.iter().filter(|it| it.0 == "s_SN");
        let all = folds.flat_map(|(.., curve)| &curve.points);
        let velocity = CurvePoint::before_impact_velocity;
        all.max_by(|a, b| velocity(a).total_cmp(&velocity(b)))
    }
}

/// The branch of z = 1 through the motion of a scene over a range of frequencies: so many points each way, steps of this
/// size at most.
pub(super) fn branch(scene: Scene, range: (f64, f64), points: usize, step: f64) -> Result<Branch> {
    let orbit = find(&scene).context("no z = 1 motion to start from")?;
    let frequency = scene.excitation.frequency;
    let family = ParameterFamily::new(scene, [Parameter::Frequency])?;
    let limits = Limits { range, points };
    let continuation = Continuation::new(&family, 1).with_steps(step)?;
    let branch = continuation.branch(frequency, orbit.state(), &limits, |_| interrupt::go_on());
    branch.context("the z = 1 motion cannot be followed")
}
