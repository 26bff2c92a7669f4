//! The motion at a point of the search.

use softstop::Machine;
use softstop_dynamics::{Orbit, Zone};

use super::Design;
use super::box_window::BoxWindow;
use super::judge::{Judged, violation};
use super::problem::Problem;

/// A point of the search: the cube's coordinates, those of them that are moved, and the place in the zone, if the
/// frequency is not held.
#[derive(Debug, Clone, Copy)]
pub struct At<'a> {
    /// Coordinates of the unit cube.
    pub unit: &'a [f64],
    /// Which of them are moved.
    pub moved: &'a [usize],
    /// Place in the zone.
    pub place: Option<f64>,
}

/// What rounding may do to a place.
const ROUNDING: f64 = 1e-12;

/// The stable motion of a point.
#[derive(Debug, Clone)]
pub(super) struct OperatingPoint {
    machine: Machine,
    pub(super) zone: Zone,
    pub(super) place: f64,
    pub(super) orbit: Orbit,
    /// That of each case.
    pub(super) cases: Vec<OperatingPoint>,
}

impl OperatingPoint {
    /// The motion of a design.
    pub(super) fn of(design: &Design) -> Self {
        Self {
            machine: design.machine.clone(),
            zone: design.zone.clone(),
            place: design.place,
            orbit: design.orbit.clone(),
            cases: design.cases.iter().map(Self::of).collect(),
        }
    }

    /// The motion at a place of a machine's zone, without cases.
    pub(super) fn on(mut machine: Machine, zone: &Zone, place: f64) -> Option<Self> {
        let point = zone.point_at(place).ok()?;
        let orbit = zone.orbit(&point).ok()?;
        if !(orbit.is_stable() || place >= 1.0) {
            return None;
        }
        machine.set_frequency(zone.frequency_at(place));
        Some(Self {
            machine,
            zone: zone.clone(),
            place,
            orbit,
            cases: Vec::new(),
        })
    }

    pub(super) fn with_cases(self, cases: Vec<Self>) -> Self {
        Self { cases, ..self }
    }

    /// The frequency of its drive in rad/s.
    pub(super) fn frequency(&self) -> f64 {
        self.zone.frequency_at(self.place)
    }

    pub(super) fn judged(&self) -> Option<Judged<'_>> {
        Judged::new(&self.machine, &self.zone, self.place, &self.orbit).ok()
    }

    /// True if margin, bounds of the frequency and tolerances allow the place.
    pub(super) fn is_within(&self, problem: &Problem, tolerated: Option<&BoxWindow>) -> bool {
        let window = problem.window_within(&self.zone, tolerated);
        window.is_ok_and(|it| (it.low - ROUNDING..=it.high + ROUNDING).contains(&self.place))
    }

    /// How far the place is outside of what margin, bounds of the frequency and tolerances allow, and its motion from what is
    /// required of it, in all cases; none if they allow no place.
    pub(super) fn violation(&self, problem: &Problem) -> Option<f64> {
        let window = problem.window(&self.machine, &self.zone).ok()?;
        let away = (window.low - self.place).max(self.place - window.high);
        let outside = if away > ROUNDING { away } else { 0.0 };
        let own = outside + violation(&problem.met(&self.judged()?));
        let cases = problem.in_cases();
        let others = cases.iter().zip(&self.cases);
        let others = others.map(|(case, point)| point.violation(case));
        Some(own + others.sum::<Option<f64>>()?)
    }

    /// Where the tolerances stay inside the zone; none of that if all is exact.
    pub(super) fn box_window(&self, problem: &Problem) -> Option<Option<BoxWindow>> {
        BoxWindow::of(problem, &self.machine, &self.zone).ok()
    }

    /// The machine, its drive at the motion's frequency.
    pub(super) fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The design of this operating point, without cases, with this value of what is sought.
    pub(super) fn design(&self, value: f64) -> Design {
        Design {
            machine: self.machine.clone(),
            place: self.place,
            zone: self.zone.clone(),
            orbit: self.orbit.clone(),
            value,
            cases: Vec::new(),
        }
    }

    /// The design of this operating point and its cases, with what their motions have of what is sought; none if one has no such figure.
    pub(super) fn sought(&self, problem: &Problem) -> Option<Design> {
        let value = problem.sought(&self.judged()?)?;
        let cases = problem.in_cases();
        let cases = cases.iter().zip(&self.cases);
        let cases = cases.map(|(case, point)| point.sought(case));
        Some(Design {
            cases: cases.collect::<Option<_>>()?,
            ..self.design(value)
        })
    }
}
