//! A machine of the search with its zone, and the same machine in each case with that of its own.

use softstop::{Dimension, Machine};
use softstop_dynamics::Zone;
use softstop_dynamics::zone::ZoneError;

use super::operating_point::SearchPoint;
use super::problem::Problem;
use super::space::Interval;
use super::{Design, Infeasible, distance_from_zones, finite_or};

/// A machine with its zone.
pub(super) struct ZonedMachine<'a> {
    pub problem: &'a Problem,
    pub machine: Machine,
    pub zone: Zone,
    /// The machine in each case.
    pub cases: Vec<ZonedMachine<'a>>,
}

impl Design {
    /// The motion at a point of the search, without the values of what is sought; none if there is no stable one.
    pub(super) fn find(problem: &Problem, at: &SearchPoint<'_>) -> Option<Self> {
        let cases = problem.in_cases();
        let zoned = ZonedMachine::find(problem, &cases, &problem.axis_values(at.unit))?;
        let given = match &problem.drawing {
            Some(drawing) => Self::find(drawing, at)?.drive_frequency(),
            None => f64::NAN,
        };
        let place = at.place.filter(|_| !problem.has_given_frequency());
        zoned.at(place.unwrap_or_else(|| zoned.place_of(given)))
    }
}

impl<'a> ZonedMachine<'a> {
    /// A machine with what was found as its zone, without its cases.
    pub fn new(
        problem: &'a Problem,
        machine: Machine,
        zone: Result<Zone, ZoneError>,
    ) -> Result<Self, Infeasible> {
        let zone = zone.map_err(|error| {
            let gap = distance_from_zones(&machine.scene, &error);
            Infeasible::new(gap, error.in_units_of(&machine).to_string())
        })?;
        Ok(Self {
            problem,
            machine,
            zone,
            cases: Vec::new(),
        })
    }

    /// The machine with these values of the axes, with its cases; none if one has no zone.
    pub fn find(problem: &'a Problem, cases: &'a [Problem], values: &[f64]) -> Option<Self> {
        let machine = problem.machine_at(values);
        machine.validate().ok()?;
        let zone = problem.zone_of(&machine);
        let own = Self::new(problem, machine, zone).ok()?;
        let cases = cases.iter().map(|case| Self::find(case, &[], values));
        own.with_cases(cases.collect::<Option<_>>()?).into()
    }

    pub fn with_cases(self, cases: Vec<Self>) -> Self {
        Self { cases, ..self }
    }

    /// Its place if the drive of the drawing runs at a frequency in rad/s.
    pub fn place_of(&self, frequency: f64) -> f64 {
        let held = self.problem.frequency;
        self.zone.place_of(match held.is_held() {
            true => self.machine.to_si(Dimension::Frequency, held.low),
            false => frequency,
        })
    }

    /// The motion at a place, and that of each case at the same frequency or its own; none if one is not stable.
    pub fn at(&self, place: f64) -> Option<Design> {
        let own = Design::on_zone(self.machine.clone(), &self.zone, place)?;
        let frequency = own.drive_frequency();
        let cases = self.cases.iter();
        let cases = cases.map(|case| case.at(case.place_of(frequency)));
        Some(Design {
            cases: cases.collect::<Option<_>>()?,
            ..own
        })
    }

    /// The places that margin, frequency bounds and tolerances leave of the zone and of those of its cases.
    pub fn window(&self) -> Result<Interval, Infeasible> {
        let mut window = self.problem.window(&self.machine, &self.zone)?;
        for (case, stated) in self.cases.iter().zip(&self.problem.cases) {
            let own = case.window().map_err(|lack| lack.in_case(stated))?;
            if case.problem.drawing.is_none() {
                continue;
            }
            let [low, high] =
                [own.low, own.high].map(|place| self.zone.place_of(case.zone.frequency_at(place)));
            window.low = window.low.max(low);
            window.high = window.high.min(high);
            if window.low > window.high {
                let gap = finite_or(window.low - window.high, super::DISTANT);
                let reason = "there is no frequency that bounds, margin and tolerances allow in the drawing too";
                return Err(Infeasible::new(gap, reason).in_case(stated));
            }
        }
        Ok(window)
    }
}
