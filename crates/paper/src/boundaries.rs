//! The boundaries of the z = 1 motion over frequency and clearance: where it grazes first, doubles its period, and turns
//! back; and its ends at single clearances.

use anyhow::{Context, Result};
use nalgebra::Vector2;
use rayon::prelude::*;
use softstop::internals::highest_point;
use softstop::{Parameter, Ratios, Scene};
use softstop_dynamics::continuation::{
    Branch, ContinuationSettings, Curve, CurveLimits, CurvePoint, Direction, SpecialKind,
    TestFunction, follow_special,
};
use softstop_dynamics::orbit::find;
use softstop_dynamics::zone::{
    ZoneError, free_amplitude, grazing_frequencies, hysteresis, loss_of_stability,
};
use softstop_dynamics::{BranchLimits, Continuation, Orbit, ParameterFamily, StroboscopicMap};

use softstop_console::failure::check_interrupt;
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
        check_interrupt()?;
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
    let limits = BranchLimits { range, points };
    let continuation = Continuation::new(&family, 1).with_steps(step)?;
    let branch = continuation.branch(frequency, orbit.state(), &limits, |_| interrupt::go_on());
    branch.context("the z = 1 motion cannot be followed")
}

/// The frequency above which z = 1 is followed to its flip.
const LEAST: f64 = 0.7;
/// Clearances of g0, and from one of its points to the next.
const CLEARANCES: (f64, f64) = (1.0, 24.5);
const SPACING: f64 = 0.5;
/// Width to which the best clearance is found.
const WIDTH: f64 = 1e-3;

/// eta, X_m, X'-.
pub(super) type Figures = [f64; 3];

/// The ends of z = 1 of one machine.
pub(super) struct Ends {
    /// rho.
    pub(super) clearance: f64,
    /// z = 1 at the upper grazing frequency g0.
    pub(super) grazing: Figures,
    /// Its fold s_SN.
    pub(super) fold: Option<Figures>,
    /// Its flip s_PD.
    pub(super) flip: Option<Figures>,
}

/// The ends of z = 1 at each clearance.
pub(super) fn ends(machine: &Ratios, clearances: &[f64]) -> Result<Vec<Ends>> {
    let ends = clearances.par_iter().map(|clearance| {
        let ends = ends_of(&machine.at_clearance(*clearance));
        ends.with_context(|| format!("rho = {clearance}"))
    });
    ends.collect()
}

fn ends_of(machine: &Ratios) -> Result<Ends> {
    let at_g0 = grazing(machine)?;
    let fold = match hysteresis(&machine.scene()?) {
        Ok(zone) => Some(zone.high.point),
        Err(ZoneError::NoFold { .. } | ZoneError::Flip { .. }) => None,
        Err(error) => return Err(error.into()),
    };
    let flip = loss_of_stability(&at_g0, Direction::Down, TestFunction::Flip)?;
    let flip = flip.filter(|point| point.parameter > LEAST);
    let [fold, flip] = [fold, flip].map(|point| {
        let point = point.as_ref();
        point.map(|at| describe(machine, at.parameter, at.state(), &at.impacts))
    });
    Ok(Ends {
        clearance: machine.clearance,
        grazing: figures(&at_g0),
        fold: fold.transpose()?,
        flip: flip.transpose()?,
    })
}

/// z = 1 at g0.
fn grazing(machine: &Ratios) -> Result<Orbit> {
    let scene = machine.scene()?;
    let (_, above) = grazing_frequencies(&scene)?;
    Ok(find(&scene.at_frequency(above))?)
}

/// Those of a motion.
pub(super) fn figures(orbit: &Orbit) -> Figures {
    let eta = orbit.scene.excitation.frequency;
    [eta, orbit.max_position, orbit.before_impact_velocity()]
}

/// Those of z = 1 at a frequency, by a state and the impacts of it.
fn describe(machine: &Ratios, eta: f64, state: Vector2<f64>, impacts: &[f64]) -> Result<Figures> {
    let map = StroboscopicMap::new(&machine.at_frequency(eta).scene()?.check()?, 1);
    let velocity = impacts.iter().copied().fold(0.0, f64::max);
    Ok([eta, map.max_position(state)?, velocity])
}

/// The boundaries across the clearances: names and curves.
pub(super) fn across(machine: &Ratios) -> Result<Vec<(&'static str, Vec<Figures>)>> {
    let count = ((CLEARANCES.1 - CLEARANCES.0) / SPACING) as usize;
    let at_grazing = (0..=count).into_par_iter().map(|index| {
        let machine = machine.at_clearance(CLEARANCES.0 + SPACING * index as f64);
        Some(figures(&grazing(&machine).ok()?))
    });
    let mut curves = vec![("z = 1 at g0", at_grazing.flatten().collect())];
    let described = |at: &CurvePoint| {
        let ([eta, clearance], state) = (at.parameters, Vector2::new(at.position, at.velocity));
        describe(&machine.at_clearance(clearance), eta, state, &at.impacts).ok()
    };
    let boundaries = Boundaries::of(machine)?;
    for (name, _, curve) in &boundaries.curves {
        let points = curve.points.par_iter().filter_map(described);
        curves.push((*name, points.collect()));
    }
    Ok(curves)
}

/// The clearance of the highest velocity at the fold, and that velocity, by golden section between the
/// neighbours of the best of those given.
pub(super) fn optimum(machine: &Ratios, ends: &[Ends]) -> Option<(f64, f64)> {
    let folds = ends.iter().enumerate();
    let folds = folds.filter_map(|(index, end)| Some((index, end.fold?[2])));
    let (best, _) = folds.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let velocity = |clearance: f64| {
        let scene = machine.at_clearance(clearance).scene().ok();
        let zone = scene.and_then(|scene| hysteresis(&scene).ok());
        zone.map_or(f64::NEG_INFINITY, |zone| {
            zone.high.point.before_impact_velocity()
        })
    };
    let low = ends.get(best.wrapping_sub(1))?.clearance;
    let high = ends.get(best + 1)?.clearance;
    Some(highest_point(low, high, WIDTH, velocity))
}
