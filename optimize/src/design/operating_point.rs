//! The motion at a point of the search.

use softstop::{Dimension, Machine, Parameter};
use softstop_dynamics::{Orbit, Zone};

use super::Design;
use super::box_window::BoxWindow;
use super::judge::Judged;
use super::problem::Problem;
use super::space::Space;

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
#[derive(Debug)]
pub(super) struct OperatingPoint {
    machine: Machine,
    pub(super) zone: Zone,
    pub(super) place: f64,
    pub(super) orbit: Orbit,
}

impl OperatingPoint {
    /// None if there is no stable motion.
    pub(super) fn find(problem: &Problem, at: &At<'_>) -> Option<Self> {
        let values = Space(&problem.axes).values(at.unit);
        let machine = problem.machine_at(&values);
        machine.validate().ok()?;
        let zone = problem.zone_of(&machine).ok()?;
        let held = || {
            let frequency = machine.to_si(Dimension::Frequency, problem.frequency.low);
            zone.place_of(frequency)
        };
        let place = at.place.unwrap_or_else(held);
        Self::on(machine, &zone, place)
    }

    /// The motion at a place of a machine's zone.
    pub(super) fn on(mut machine: Machine, zone: &Zone, place: f64) -> Option<Self> {
        let point = zone.point_at(place).ok()?;
        let orbit = zone.orbit(&point).ok()?;
        if !(orbit.is_stable() || place >= 1.0) {
            return None;
        }
        Parameter::Frequency.set(&mut machine.scene, zone.frequency_at(place));
        Some(Self {
            machine,
            zone: zone.clone(),
            place,
            orbit,
        })
    }

    pub(super) fn judged(&self) -> Option<Judged<'_>> {
        Judged::new(&self.machine, &self.zone, self.place, &self.orbit).ok()
    }

    /// True if margin, bounds of the frequency and tolerances allow the place.
    pub(super) fn is_within(&self, problem: &Problem, tolerated: Option<&BoxWindow>) -> bool {
        let window = problem.window_within(&self.zone, tolerated);
        window.is_ok_and(|it| (it.low - ROUNDING..=it.high + ROUNDING).contains(&self.place))
    }

    /// How far the place is outside of what margin, bounds of the frequency and tolerances allow; none if they allow none.
    pub(super) fn outside(&self, problem: &Problem) -> Option<f64> {
        let window = problem.window(&self.machine, &self.zone).ok()?;
        let away = (window.low - self.place).max(self.place - window.high);
        Some(if away > ROUNDING { away } else { 0.0 })
    }

    /// Where the tolerances stay inside the zone; none of that if all is exact.
    pub(super) fn box_window(&self, problem: &Problem) -> Option<Option<BoxWindow>> {
        BoxWindow::of(problem, &self.machine, &self.zone).ok()
    }

    /// The machine, its drive at the motion's frequency.
    pub(super) fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The same as a design.
    pub(super) fn design(&self, value: f64) -> Design {
        Design {
            machine: self.machine.clone(),
            place: self.place,
            zone: self.zone.clone(),
            orbit: self.orbit.clone(),
            value,
        }
    }
}
