//! Periodic motions along a parameter, stable or not, and the zone of z = 1.

use std::ops::ControlFlow;

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use softstop::internals::budget;
use softstop::{Dimension, Machine, Parameter};
use softstop_dynamics::continuation::TestFunction;
use softstop_dynamics::zone::{self, grazing_frequencies};
use softstop_dynamics::{Branch, BranchLimits, Continuation, ParameterFamily, Zone, orbit};

use crate::answer::{Answer, Answered};
use crate::machine::parameter;

/// Branches through motions: that of z = 1, and of the motion that is shown.
#[derive(Debug, Deserialize)]
pub(crate) struct Branches {
    /// The parameter's key.
    along: String,
    from: f64,
    to: f64,
    /// A motion that is shown: drive periods after which it repeats, and its state at drive angle phi.
    #[serde(default)]
    shown: Option<(u64, [f64; 2])>,
}

#[derive(Serialize)]
struct BranchReport {
    zone: Ends,
    branches: Vec<Length>,
    specials: Vec<Special>,
}

/// The ends of the zone in the machine's own unit of the frequency.
#[derive(Default, Serialize)]
struct Ends {
    g0: Option<f64>,
    s_sn: Option<f64>,
    s_pd: Option<f64>,
}

#[derive(Serialize)]
struct Length {
    periods: u64,
    points: usize,
}

#[derive(Serialize)]
struct Special {
    symbol: &'static str,
    name: &'static str,
    value: f64,
    velocity: f64,
    position: f64,
}

/// Points of a branch in each direction.
const MOST_POINTS: usize = 600;
/// Largest steps, scaled.
const STEP: f64 = 0.05;
/// What all may cost, in scan windows: a second or two.
const BUDGET: u64 = 100_000_000;

impl Branches {
    /// Points of each branch: the parameter, the highest before-impact velocity, the position at drive angle phi, and 1 if
    /// it is stable.
    pub(crate) fn answer(&self, machine: &Machine) -> Answered {
        let along = parameter(machine, &self.along)?;
        let (found, _) = budget::run_within(BUDGET, || self.find(machine, along));
        let (zone, branches) = found;
        let points = branches.iter().flat_map(|branch| &branch.points);
        let numbers = points.flat_map(|it| {
            let is_stable = f64::from(u8::from(it.is_stable()));
            [
                it.parameter,
                it.before_impact_velocity(),
                it.position,
                is_stable,
            ]
        });
        let specials = branches.iter().flat_map(|branch| &branch.specials);
        let specials = specials.map(|it| Special {
            symbol: it.kind.symbol(),
            name: it.kind.name(),
            value: it.point.parameter,
            velocity: it.point.before_impact_velocity(),
            position: it.point.position,
        });
        let lengths = branches.iter().map(|branch| Length {
            periods: branch.periods,
            points: branch.points.len(),
        });
        let told = BranchReport {
            zone,
            specials: specials.collect(),
            branches: lengths.collect(),
        };
        Ok(Answer::new(&told, numbers.collect()))
    }

    /// The zone and the branches.
    fn find(&self, machine: &Machine, along: Parameter) -> (Ends, Vec<Branch>) {
        let by_frequency = along == Parameter::Frequency;
        let zone = by_frequency
            .then(|| zone::hysteresis(&machine.scene).ok())
            .flatten();
        let own = |frequency| machine.to_own(Dimension::Frequency, frequency);
        let at_grazing = |zone: &Zone| Some((own(zone.low.frequency), zone.low.point.state()));
        let single = zone
            .as_ref()
            .map_or_else(|| single(machine, along), at_grazing);
        let single = single.and_then(|(value, state)| self.follow(machine, along, 1, value, state));
        let shown = self
            .shown
            .filter(|(periods, _)| *periods > 1 || single.is_none());
        let value = machine.value(along).unwrap_or(f64::NAN);
        let shown = shown.and_then(|(periods, [x, v])| {
            self.follow(machine, along, periods, value, Vector2::new(x, v))
        });
        let grazing = grazing_frequencies(&machine.scene)
            .ok()
            .filter(|_| by_frequency);
        let s_sn = zone.map(|zone| own(zone.high.frequency));
        let flips = single
            .iter()
            .flat_map(|branch| branch.critical_points(TestFunction::Flip));
        let flips = flips
            .map(|flip| flip.parameter)
            .filter(|flip| s_sn.is_some_and(|fold| *flip < fold));
        let ends = Ends {
            g0: grazing.map(|(_, above)| own(above)),
            s_sn,
            s_pd: flips.max_by(f64::total_cmp),
        };
        (ends, single.into_iter().chain(shown).collect())
    }

    /// The branch through the motion near a state.
    fn follow(
        &self,
        machine: &Machine,
        along: Parameter,
        periods: u64,
        value: f64,
        state: Vector2<f64>,
    ) -> Option<Branch> {
        let family = ParameterFamily::new(machine.clone(), [along]).ok()?;
        let limits = BranchLimits {
            range: (self.from.min(value), self.to.max(value)),
            points: MOST_POINTS,
        };
        let goes_on = |_: &_| match budget::is_spent() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        let continuation = Continuation::new(&family, periods).with_steps(STEP).ok()?;
        continuation.branch(value, state, &limits, goes_on).ok()
    }
}

/// The z = 1 motion of the machine itself.
fn single(machine: &Machine, along: Parameter) -> Option<(f64, Vector2<f64>)> {
    let orbit = orbit::find(&machine.scene).ok()?;
    Some((machine.value(along)?, orbit.state()))
}
