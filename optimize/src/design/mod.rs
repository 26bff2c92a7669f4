//! The search for the hardest impact inside the hysteresis zone, or among all stable z = 1 motions.
//!
//! Parameters of the machine (its stop's stiffness and clearance, if nothing else is said) are searched in
//! a box; the frequency is written as g0 + s (w_SN - g0), or between other ends, with s in [M, 1 - M], so that every point that has
//! a zone is feasible. The zone does not depend on s: at each point it is computed once and the best s is
//! then found along it (`line_search`). [`search`] drives the outer search.

mod ascent;
mod box_window;
pub mod case;
mod cases;
mod certain;
mod check_finalists;
mod check_trials;
pub mod conflict;
pub mod constraint;
pub mod coordinates;
pub mod cost;
pub mod critical;
mod design_search;
mod differences;
mod direct_search;
mod distant_values;
mod exact;
mod found;
pub mod front;
mod improve_catalogue;
mod incumbent;
pub mod judge;
mod line_search;
pub mod local;
mod multipliers;
mod nearest_miss;
mod no_design;
mod non_dominated;
pub mod operating_point;
pub mod pareto;
mod pareto_search;
mod passing_motion;
mod posed;
pub mod problem;
mod reach;
pub mod requirement;
mod robustify;
pub mod search;
pub mod share;
pub mod share_of_starts;
pub mod slope;
pub mod slsqp;
pub mod solution;
pub mod space;
mod survey;
pub mod trial;
mod trial_search;
mod within;
mod without_effect;
mod zone_border;
mod zoned;

use std::slice;

use box_window::BoxWindow;
use case::Case;
use judge::{RequirementValue, ZoneMotion};
use operating_point::OperatingPoint;
use softstop::{Dimension, Machine, MotionError, Scene};
use softstop_console::interrupt;
use softstop_dynamics::zone::{ZoneError, ZoneKind};
use softstop_dynamics::{Orbit, Zone, parallel, zone};
use zoned::ZonedMachine;

pub use problem::Problem;
pub use softstop_dynamics::figure;
use space::Interval;

/// A feasible point and the motion there.
#[derive(Debug, Clone)]
pub struct Design {
    /// The machine of the design, its drive at the design's frequency.
    pub machine: Machine,
    /// Place in the zone: 0 at its lower end, 1 at its upper end.
    pub place: f64,
    /// The zone of the machine.
    pub zone: Zone,
    /// The z = 1 motion.
    pub orbit: Orbit,
    /// What was sought, in SI units; of the worst machine within the tolerances, if that is what counts. Not a number until it is
    /// judged.
    pub value: f64,
    /// What the design does in each case, in the order of the problem's cases.
    pub cases: Vec<Design>,
}

impl Design {
    /// The design in the drawing's operating point, and in each case.
    pub fn points(&self) -> impl Iterator<Item = &Self> {
        [self].into_iter().chain(&self.cases)
    }

    /// Velocity in m/s at which the mass reaches the clearance.
    pub fn before_impact_velocity(&self) -> f64 {
        self.orbit.before_impact_velocity()
    }

    /// Its motion, to be judged.
    ///
    /// # Errors
    /// [`MotionError`] if it cannot be computed.
    pub fn judged(&self) -> Result<ZoneMotion<'_>, MotionError> {
        ZoneMotion::new(&self.machine, &self.zone, self.place, &self.orbit)
    }

    /// Drive frequency in the machine's own units.
    pub fn frequency(&self) -> f64 {
        self.own_frequency(self.machine.scene.excitation.frequency)
    }

    /// A frequency in rad/s in the machine's own units.
    pub fn own_frequency(&self, frequency: f64) -> f64 {
        self.machine.to_own(Dimension::Frequency, frequency)
    }
}

/// A point without a feasible motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Infeasible {
    /// How far from feasible, finite and >= 0: what the search descends along.
    pub gap: f64,
    /// Why, in words.
    pub reason: String,
    /// The point of the unit cube, if whoever looked there knows it.
    pub unit: Option<Vec<f64>>,
}

impl Infeasible {
    /// A point so far from feasible, for this reason.
    fn new(gap: f64, reason: impl Into<String>) -> Self {
        Self {
            gap,
            reason: reason.into(),
            unit: None,
        }
    }

    /// A point of which no more is known than that it cannot be computed.
    fn unknown(error: impl ToString) -> Self {
        Self::new(DISTANT, error.to_string())
    }

    /// What a search lacks that was stopped before it met anything.
    fn stopped() -> Self {
        Self::unknown("stopped")
    }

    /// At a point of the unit cube.
    fn at(self, unit: &[f64]) -> Self {
        Self {
            unit: Some(unit.to_vec()),
            ..self
        }
    }

    /// The nearer to feasible of it and what is known; of equals what is known.
    fn nearer(self, known: Option<Self>) -> Self {
        match known {
            Some(known) if known.gap <= self.gap => known,
            _ => self,
        }
    }

    /// What is lacking in an operating point of a problem.
    fn in_point(self, problem: &Problem, case: Option<usize>) -> Self {
        match case {
            Some(index) => self.in_case(&problem.cases[index]),
            None => self,
        }
    }

    /// What is lacking in a case.
    fn in_case(self, case: &Case) -> Self {
        Self {
            reason: format!("in case {}: {}", case.name, self.reason),
            ..self
        }
    }
}

impl Problem {
    /// The score of a design: the higher the better.
    fn score(&self, design: &Design) -> f64 {
        self.objective.score(self.sought_of(design))
    }

    /// The best frequency at these values of the axes.
    ///
    /// # Errors
    /// [`Infeasible`] if there is no zone, or none of it is allowed and stable.
    pub fn at(&self, values: &[f64]) -> Result<Design, Infeasible> {
        let zoned = |problem| {
            let machine = Self::machine_at(problem, values);
            let zone = match self.zone {
                ZoneKind::Hysteresis => {
                    let zone = zone::hysteresis_with_monitor(&machine.scene, &interrupt::watch);
                    let zone = zone.map(|zone| zone.on_range(self.range));
                    zone.or_else(|none| problem.zone_of(&machine).map_err(|_| none))
                }
                ZoneKind::SingleImpact { .. } => problem.zone_of(&machine),
            };
            ZonedMachine::new(problem, machine, zone)
        };
        let cases = self.in_cases();
        line_search::best(&self.with_cases(zoned(self), cases.iter().map(zoned))?)
    }

    /// The zone of a machine, on the way of a search.
    fn zone_of(&self, machine: &Machine) -> Result<Zone, ZoneError> {
        self.zones_of(slice::from_ref(&machine.scene)).remove(0)
    }

    /// The zones of some scenes, of less accuracy than a report has.
    pub fn zones_of(&self, scenes: &[Scene]) -> Vec<Result<Zone, ZoneError>> {
        let zones = zone::find_zones(self.zone, scenes, &interrupt::watch).into_iter();
        let zones = zones.map(|zone| zone.map(|zone| zone.on_range(self.range)));
        zones.collect()
    }

    /// The best frequencies at many points, with zones of less accuracy: on the way of a search.
    fn at_batch(&self, points: &[Vec<f64>]) -> Vec<Result<Design, Infeasible>> {
        self.on_zones(points, line_search::best)
    }

    /// What is computed of the zones of the machines at many points, with their cases.
    fn on_zones<T: Send + Sync>(
        &self,
        points: &[Vec<f64>],
        compute: impl Fn(&ZonedMachine<'_>) -> Result<T, Infeasible> + Sync,
    ) -> Vec<Result<T, Infeasible>> {
        let cases = self.in_cases();
        let own = self.zoned(points).into_iter();
        let others = cases.iter().map(|case| case.zoned(points).into_iter());
        let mut others: Vec<_> = others.collect();
        let all = own.map(|own| {
            let cases: Vec<_> = others.iter_mut().filter_map(Iterator::next).collect();
            self.with_cases(own, cases)
        });
        let all: Vec<Result<ZonedMachine, Infeasible>> = all.collect();
        parallel::map(&all, |zoned| match zoned {
            Ok(zoned) => compute(zoned),
            Err(lack) => Err(lack.clone()),
        })
    }

    /// The machines at many points with their zones, without cases.
    fn zoned(&self, points: &[Vec<f64>]) -> Vec<Result<ZonedMachine<'_>, Infeasible>> {
        let machines: Vec<Machine> = points.iter().map(|at| self.machine_at(at)).collect();
        let scenes: Vec<Scene> = machines.iter().map(|of| of.scene.clone()).collect();
        let pairs = machines.into_iter().zip(self.zones_of(&scenes));
        pairs
            .map(|(machine, zone)| ZonedMachine::new(self, machine, zone))
            .collect()
    }

    /// A machine of the drawing with the same one in each case.
    fn with_cases<'a>(
        &self,
        own: Result<ZonedMachine<'a>, Infeasible>,
        cases: impl IntoIterator<Item = Result<ZonedMachine<'a>, Infeasible>>,
    ) -> Result<ZonedMachine<'a>, Infeasible> {
        let own = own?;
        let cases = cases.into_iter().zip(&self.cases);
        let cases = cases.map(|(it, stated)| it.map_err(|lack| lack.in_case(stated)));
        Ok(own.with_cases(cases.collect::<Result<_, _>>()?))
    }

    /// Whether the drawing's machine is as required, and stands where margin, frequency bounds and the zones of the machines
    /// within the tolerances allow.
    fn is_allowed(&self, design: &Design) -> bool {
        self.operating_points(design).iter().all(|it| {
            let OperatingPoint {
                problem, design, ..
            } = it;
            let motion = design.judged();
            let is_met = motion
                .is_ok_and(|motion| problem.met(&motion).iter().all(RequirementValue::is_met));
            let window = problem.window(&design.machine, &design.zone);
            is_met && window.is_ok_and(|it| it.contains(design.place))
        })
    }

    /// The places s that margin, frequency bounds and tolerances leave of a zone.
    fn window(&self, machine: &Machine, zone: &Zone) -> Result<Interval, Infeasible> {
        self.window_within(zone, BoxWindow::of(self, machine, zone)?.as_ref())
    }

    /// The same of tolerances that are known.
    fn window_within(
        &self,
        zone: &Zone,
        tolerated: Option<&BoxWindow>,
    ) -> Result<Interval, Infeasible> {
        let si = |frequency: f64| self.machine.to_si(Dimension::Frequency, frequency);
        let mut low = self.margin.max(zone.place_of(si(self.frequency.low)));
        let mut high = (1.0 - self.margin).min(zone.place_of(si(self.frequency.high)));
        if let Some(tolerated) = tolerated {
            if let Some(edge) = &tolerated.low {
                low = low.max(zone.place_of(edge.frequency));
            }
            high = high.min(zone.place_of(tolerated.highest()));
        }
        if low <= high {
            return Ok(Interval { low, high });
        }
        let own = |frequency: f64| self.machine.to_own(Dimension::Frequency, frequency);
        let unit = match self.machine.unit(Dimension::Frequency) {
            "" => String::new(),
            unit => format!(" {unit}"),
        };
        let reason = format!(
            "bounds ({}{unit}), margin and tolerances leave no frequency in the zone {:.6} to {:.6}{unit}: it would have to be \
             at least {:.6} and at most {:.6}{unit}",
            self.frequency,
            own(zone.low.frequency),
            own(zone.high.frequency),
            own(zone.frequency_at(low)),
            own(zone.frequency_at(high))
        );
        Err(Infeasible::new(finite_or(low - high, DISTANT), reason))
    }
}

/// A grade for points without a zone. Above resonance g0 exists only for clearances between 0 and the
/// resonance peak of the motion without impacts: the farther from there, the worse. Elsewhere all points
/// count as equally distant.
fn distance_from_zones(scene: &Scene, error: &ZoneError) -> f64 {
    let ZoneError::NoGrazing { clearance, largest } = error else {
        return DISTANT;
    };
    let unit = scene.excitation.amplitude / scene.stiffness;
    let beyond = (clearance / largest - 1.0).max(-clearance / unit).max(0.0);
    DISTANT + finite_or(beyond, 0.0)
}

/// The gap of a point of which nothing better is known.
const DISTANT: f64 = 10.0;
/// Relative gain of a score that is none.
const GAIN: f64 = 1e-9;

fn finite_or(value: f64, otherwise: f64) -> f64 {
    if value.is_finite() { value } else { otherwise }
}
