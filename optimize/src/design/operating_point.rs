//! The motion at a point of the search, and the operating points of a design.

use std::borrow::Cow;

use softstop::Machine;
use softstop_dynamics::{Orbit, Zone};

use super::Design;
use super::problem::Problem;
use super::space::{Axis, ROUNDING};

/// A point of the search: the cube's coordinates, those of them that are moved, and the place in the zone, if the
/// frequency is not held.
#[derive(Debug, Clone, Copy)]
pub struct SearchPoint<'a> {
    /// Coordinates of the unit cube.
    pub unit: &'a [f64],
    /// Which of them are moved.
    pub moved: &'a [usize],
    /// Place in the zone.
    pub place: Option<f64>,
}

/// A design in the drawing's operating point or in a case.
pub struct OperatingPoint<'a> {
    /// The index of the case; none of the drawing.
    pub case: Option<usize>,
    /// The problem of this operating point.
    pub problem: Cow<'a, Problem>,
    /// What the design does there.
    pub design: &'a Design,
}

impl Problem {
    /// The values of all axes at a point of the unit cube, which has no coordinates for those that are held.
    pub fn axis_values(&self, unit: &[f64]) -> Vec<f64> {
        let mut coordinates = unit.iter().copied();
        let value = |axis: &Axis| match axis.range.is_held() {
            true => axis.range.low,
            false => axis.at(coordinates.next().unwrap_or(0.5)),
        };
        self.axes.iter().map(value).collect()
    }

    /// The problem on the range of the zone on which a design was found.
    #[must_use]
    pub fn on_range_of(&self, design: &Design) -> Self {
        Self {
            range: design.zone.range,
            ..self.clone()
        }
    }

    /// The operating points of a design, that of the drawing first.
    pub fn operating_points<'a>(&'a self, design: &'a Design) -> Vec<OperatingPoint<'a>> {
        let own = OperatingPoint {
            case: None,
            problem: Cow::Borrowed(self),
            design,
        };
        let cases = self.in_cases().into_iter().zip(&design.cases).enumerate();
        let cases = cases.map(|(index, (problem, design))| OperatingPoint {
            case: Some(index),
            problem: Cow::Owned(problem),
            design,
        });
        [own].into_iter().chain(cases).collect()
    }
}

impl Design {
    /// The stable motion at a place of a machine's zone, without cases and without the value of what is sought.
    pub(super) fn on_zone(machine: Machine, zone: &Zone, place: f64) -> Option<Self> {
        let orbit = zone.orbit_of(&zone.point_at(place).ok()?).ok()?;
        let is_stable = orbit.is_stable() || place >= 1.0;
        is_stable.then(|| Self::of_orbit(machine, (zone, place), orbit))
    }

    /// A motion at a place of a machine's zone, without cases and without the value of what is sought.
    pub(super) fn of_orbit(
        mut machine: Machine,
        (zone, place): (&Zone, f64),
        orbit: Orbit,
    ) -> Self {
        machine.set_frequency(zone.frequency_at(place));
        Self {
            machine,
            zone: zone.clone(),
            place,
            orbit,
            value: f64::NAN,
            cases: Vec::new(),
        }
    }

    /// The frequency of its drive in rad/s.
    pub(super) fn drive_frequency(&self) -> f64 {
        self.zone.frequency_at(self.place)
    }

    /// How far the place is outside of what margin, bounds of the frequency and tolerances allow, in all cases; none if they
    /// allow no place.
    pub(super) fn outside_window(&self, problem: &Problem) -> Option<f64> {
        let of_point = |OperatingPoint {
                            problem, design, ..
                        }: &OperatingPoint<'_>| {
            let window = problem.window(&design.machine, &design.zone).ok()?;
            let away = (window.low - design.place).max(design.place - window.high);
            Some(if away > ROUNDING { away } else { 0.0 })
        };
        problem.operating_points(self).iter().map(of_point).sum()
    }

    /// The design with what the own machine of each operating point has of what is sought; none if one has no such figure.
    pub(super) fn with_own_values(mut self, problem: &Problem) -> Option<Self> {
        let points = problem.operating_points(&self);
        let values = points
            .iter()
            .map(|it| it.problem.sought(&it.design.judged().ok()?));
        let values = values.collect::<Option<Vec<f64>>>()?;
        self.set_values(values);
        Some(self)
    }

    /// Sets what is sought in each operating point.
    pub(super) fn set_values(&mut self, values: impl IntoIterator<Item = f64>) {
        let all = [&mut self.value].into_iter();
        let all = all.chain(self.cases.iter_mut().map(|it| &mut it.value));
        for (own, value) in all.zip(values) {
            *own = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use softstop::{Machine, Parameter};

    use super::Problem;
    use crate::design::space::{Axis, Interval};

    #[test]
    fn held_axes_take_no_coordinate_and_ends_are_exact() {
        let machine = Machine::named("unloaded").expect("the paper's machine");
        let axes = [
            (Parameter::StopStiffness, Interval::held(7.0)),
            (Parameter::Clearance, Interval::new(0.1, 0.3)),
        ]
        .map(|(parameter, range)| Axis::new(parameter, range));
        let problem = Problem::of(machine, axes.to_vec());
        assert_eq!(problem.free_axes().count(), 1);
        assert_eq!(problem.axis_values(&[0.0]), [7.0, 0.1]);
        assert_eq!(problem.axis_values(&[1.0]), [7.0, 0.3]);
        let outside = problem.axis_values(&[1.7]);
        assert_eq!(outside, [7.0, 0.3], "outside the cube: pulled in");
    }
}
