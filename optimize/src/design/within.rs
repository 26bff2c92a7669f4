//! How machines within the tolerances of a point of the search change with its coordinates.

use softstop::{Machine, Parameter};
use softstop_dynamics::derivatives::Border;

use super::differences::{difference, machine_differences};
use super::exact::Linearization;

/// Changes by which parameters within the tolerances are differenced: of a coordinate of the search and of the frequency,
/// relative, and of the share of a way. They are products of two of them at most.
const CHANGE: f64 = 1e-2;

/// How the parameters of one machine of the tolerances change, in SI units.
pub(super) struct ParameterJacobian {
    /// With each coordinate of the search.
    by: Vec<Vec<f64>>,
    /// On the way out from the nominal machine.
    outwards: Vec<f64>,
    /// Those that change at all, but the frequency.
    parameters: Vec<Parameter>,
}

impl ParameterJacobian {
    /// At some coordinates of the box of tolerances.
    pub(super) fn at(about: &Linearization<'_>, coordinates: &[f64]) -> Option<Self> {
        let Linearization { problem, at, .. } = about;
        let frequency = about.point.orbit.scene.excitation.frequency;
        let values = |mut machine: Machine, frequency: f64, coordinates: &[f64]| {
            Parameter::Frequency.set(&mut machine.scene, frequency);
            let scene = problem.spread(&machine)?.scene(coordinates);
            let values = Parameter::ALL.iter();
            let values = values.map(|it| it.get(&scene).unwrap_or(0.0));
            Some(values.collect::<Vec<f64>>())
        };
        let own = |machine| values(machine, frequency, coordinates);
        let mut by = machine_differences((problem, at), CHANGE, own)?;
        by.extend(at.place.map(|_| vec![0.0; Parameter::ALL.len()]));
        let nominal = || problem.machine_at(&problem.axis_values(at.unit));
        let sides = [1.0 - CHANGE, 1.0 + CHANGE];
        let [slower, faster] =
            sides.map(|factor| values(nominal(), factor * frequency, coordinates));
        let by_frequency = difference(&slower?, &faster?, 2.0 * CHANGE * frequency);
        let [inner, outer] = sides.map(|factor| {
            let scaled: Vec<f64> = coordinates.iter().map(|it| factor * it).collect();
            values(nominal(), frequency, &scaled)
        });
        let outwards = difference(&inner?, &outer?, 2.0 * CHANGE);
        for (row, frequency) in by.iter_mut().zip(&about.frequency) {
            for (by, by_frequency) in row.iter_mut().zip(&by_frequency) {
                *by += frequency * by_frequency;
            }
        }
        let changes = |parameter: &Parameter| {
            let index = *parameter as usize;
            let is_moved = by.iter().any(|row| row[index] != 0.0) || outwards[index] != 0.0;
            is_moved && *parameter != Parameter::Frequency
        };
        let parameters = Parameter::ALL.into_iter().filter(changes).collect();
        Some(Self {
            by,
            outwards,
            parameters,
        })
    }

    /// What a border's normal has to be by.
    pub(super) fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Derivatives by some of the parameters as derivatives by the coordinates of the search.
    pub(super) fn chain(&self, parameters: &[Parameter], by: &[f64]) -> Vec<f64> {
        let total = |row: &Vec<f64>| {
            let pairs = parameters.iter().zip(by);
            pairs
                .map(|(parameter, by)| by * row[*parameter as usize])
                .sum()
        };
        self.by.iter().map(total).collect()
    }

    /// How the machine's distance in frequency from a border changes with each coordinate of the search, and on the way
    /// outwards, in rad/s.
    pub(super) fn across(&self, border: &Border) -> (Vec<f64>, f64) {
        let across = |row: &Vec<f64>| {
            let pairs = border.parameters.iter().zip(&border.normal);
            let others = pairs.map(|(parameter, normal)| normal * row[*parameter as usize]);
            others.sum::<f64>() + row[Parameter::Frequency as usize]
        };
        (self.by.iter().map(across).collect(), across(&self.outwards))
    }
}
